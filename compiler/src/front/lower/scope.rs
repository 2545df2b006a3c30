//! The names of a spec and what they stand for. One namespace for everything that an expression can name.

use crate::dimension::Dimension;
use crate::front::names::suggest;
use crate::ir::Model;
use crate::source::{FileId, Span};
use std::collections::HashMap;

/// What a name stands for; indices into the lists of the spec.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Entity {
    Parameter(usize),
    State(usize),
    Memory(usize),
    Let(usize),
    Function(usize),
    Measure(usize),
}

impl Entity {
    /// In words, with article.
    pub(crate) const fn kind(self) -> &'static str {
        match self {
            Self::Parameter(_) => "a parameter",
            Self::State(_) => "a state",
            Self::Memory(_) => "a memory",
            Self::Let(_) => "a name of [let]",
            Self::Function(_) => "a function",
            Self::Measure(_) => "a measure",
        }
    }
}

/// A defined name.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Definition {
    pub(crate) entity: Entity,
    /// Where; `None` for names that do not come from the text at hand.
    pub(crate) span: Option<Span>,
    /// Dimension of a parameter, state, memory or measure; `None` if its definition is broken (or for the others).
    pub(crate) dimension: Option<Dimension>,
}

/// All defined names.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scope {
    definitions: HashMap<String, Definition>,
    order: Vec<String>,
    /// The file of the spec; others are parts.
    spec: Option<FileId>,
}

impl Scope {
    /// No names yet, of a spec in this file.
    pub(super) fn of_spec(spec: Option<FileId>) -> Self {
        Self { spec, ..Self::default() }
    }

    /// The names of a compiled model that expressions on the command line may use.
    pub(crate) fn of_model(model: &Model) -> Self {
        let mut scope = Self::default();
        let mut insert = |name: &str, entity, dimension| {
            scope.insert(name, Definition { entity, span: None, dimension: Some(dimension) });
        };
        for (i, parameter) in model.parameters.iter().enumerate() {
            insert(&parameter.name, Entity::Parameter(i), parameter.dimension);
        }
        for (i, measure) in model.measures.iter().enumerate() {
            insert(&measure.name, Entity::Measure(i), measure.dimension);
        }
        for (i, state) in model.states.iter().enumerate() {
            insert(&state.name, Entity::State(i), state.dimension);
        }
        for (i, memory) in model.memory.iter().enumerate() {
            insert(&memory.name, Entity::Memory(i), Dimension::NONE);
        }
        scope
    }

    /// The same names for a text that is neither the spec nor a part.
    pub(super) fn outside(&self) -> Self {
        Self { spec: None, ..self.clone() }
    }

    /// Whether the text is that of a flag, which defines nothing.
    pub(super) fn is_of_flag(&self) -> bool {
        self.spec.is_none()
    }

    /// Whether a place is in a part.
    pub(super) fn in_part(&self, span: Span) -> bool {
        self.spec.is_some_and(|spec| span.file != spec)
    }

    pub(crate) fn get(&self, name: &str) -> Option<Definition> {
        self.definitions.get(name).copied()
    }

    /// Defines a name; a name that is there already stays what it is and is returned, its dimension forgotten: which of
    /// the two was meant is not known.
    pub(crate) fn insert(&mut self, name: &str, definition: Definition) -> Option<Definition> {
        if let Some(first) = self.definitions.get_mut(name) {
            first.dimension = first.dimension.filter(|_| first.dimension == definition.dimension);
            return Some(*first);
        }
        self.definitions.insert(name.to_owned(), definition);
        self.order.push(name.to_owned());
        None
    }

    /// The name of those for which `wanted` holds that `name` was probably meant to be.
    pub(crate) fn suggest(&self, name: &str, wanted: impl Fn(Entity) -> bool) -> Option<&str> {
        let known = |other: &&String| self.get(other).is_some_and(|definition| wanted(definition.entity));
        suggest(name, self.order.iter().filter(known).map(String::as_str))
    }
}
