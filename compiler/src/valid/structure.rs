//! Structural soundness: whatever code generation takes for granted.

use crate::ir::{Graph, Mode, Model, Node, NodeId, Symbol, graph};
use std::collections::HashSet;

/// Largest numbers that the generated code is meant for: its arrays live on the stack.
const MOST_STATES: usize = 64;
const MOST_PARAMETERS: usize = 256;
const MOST_OTHERS: usize = 1024;
const MOST_NODES: usize = 1_000_000;

/// All defects of a model.
pub(super) fn defects(model: &Model) -> Vec<String> {
    let mut check = Check { model, defects: Vec::new() };
    check.sizes();
    check.names();
    check.nodes();
    // Expressions can be followed only through a sound graph, and only if all lists have their lengths.
    if check.defects.is_empty() {
        check.lists();
    }
    if check.defects.is_empty() {
        check.modes();
        check.transitions();
        check.section();
        check.others();
    }
    check.defects
}

struct Check<'a> {
    model: &'a Model,
    defects: Vec<String>,
}

/// What may occur in an expression at a certain place.
#[derive(Clone, Copy)]
struct Allowed {
    /// States.
    state: bool,
    /// Time derivatives of states.
    rate: bool,
    /// Memory, tau and t.
    environment: bool,
    /// Values of functionals.
    functional: bool,
    /// Frozen `Select`s (`Choose`s where false).
    frozen: bool,
}

impl Allowed {
    const FLOW: Self = Self { state: true, rate: false, environment: true, functional: false, frozen: true };
    const STATIC: Self = Self { state: true, rate: false, environment: false, functional: false, frozen: false };
    const MEASURE: Self = Self { state: false, functional: true, ..Self::STATIC };

    fn symbol(self, symbol: Symbol) -> bool {
        match symbol {
            Symbol::State(_) => self.state,
            Symbol::Rate(_) => self.rate,
            Symbol::Parameter(_) => true,
            Symbol::Memory(_) | Symbol::Tau | Symbol::Time => self.environment,
            Symbol::Functional(_) => self.functional,
            Symbol::Measure(_) | Symbol::SpectralRadius => false,
        }
    }
}

impl Check<'_> {
    fn require(&mut self, holds: bool, defect: impl FnOnce() -> String) {
        if !holds {
            self.defects.push(defect());
        }
    }

    fn sizes(&mut self) {
        let m = self.model;
        let sizes = [
            ("states", m.states.len(), MOST_STATES),
            ("parameters", m.parameters.len(), MOST_PARAMETERS),
            ("memory entries", m.memory.len(), MOST_PARAMETERS),
            ("switching functions", m.switches.len(), MOST_OTHERS),
            ("modes", m.modes.len(), MOST_OTHERS),
            ("transitions", m.transitions.len(), MOST_OTHERS),
            ("functionals", m.functionals.len(), MOST_OTHERS),
            ("measures", m.measures.len(), MOST_OTHERS),
            ("expression nodes", m.graph.nodes().len(), MOST_NODES),
        ];
        for (what, size, most) in sizes {
            self.require(size <= most, || format!("the model has {size} {what}; the most is {most}"));
        }
        self.require(!m.modes.is_empty(), || "the model has no mode; write a table `[modes.NAME.flow]`".to_owned());
    }

    fn names(&mut self) {
        let m = self.model;
        self.require(is_module_name(&m.name), || {
            format!("`{}` cannot name a model; take lower-case letters, digits and `_`, and no Rust keyword", m.name)
        });
        let lists: [(&str, Vec<&str>); 6] = [
            ("parameter", m.parameters.iter().map(|x| x.name.as_str()).collect()),
            ("state", m.states.iter().map(|x| x.name.as_str()).collect()),
            ("memory", m.memory.iter().map(|x| x.name.as_str()).collect()),
            ("mode", m.modes.iter().map(|x| x.name.as_str()).collect()),
            ("transition", m.transitions.iter().map(|x| x.name.as_str()).collect()),
            ("measure", m.measures.iter().map(|x| x.name.as_str()).collect()),
        ];
        for (what, names) in lists {
            let mut seen = HashSet::new();
            for name in names {
                self.require(is_name(name), || {
                    format!("`{name}` cannot name a {what}; take letters, digits and `_`, at most 100 of them")
                });
                self.require(seen.insert(name), || format!("two {what}s are called `{name}`"));
            }
        }
    }

    fn nodes(&mut self) {
        let graph = &self.model.graph;
        for (i, &node) in graph.nodes().iter().enumerate() {
            let sound = graph::operands(node).all(|o| (o.0 as usize) < i)
                && match node {
                    Node::Symbol(symbol) | Node::Partial(_, symbol) => self.exists(symbol),
                    Node::Select { switch, .. } => switch < self.model.switches.len(),
                    _ => true,
                };
            self.require(sound, || format!("expression node {i} refers to something that is not there"));
            self.require(!matches!(node, Node::Partial(_, Symbol::Memory(_))), || {
                "memory is integer and has no derivative; make it a state with zero flow".to_owned()
            });
        }
    }

    fn exists(&self, symbol: Symbol) -> bool {
        let m = self.model;
        match symbol {
            Symbol::State(i) | Symbol::Rate(i) => i < m.states.len(),
            Symbol::Parameter(i) => i < m.parameters.len(),
            Symbol::Memory(i) => i < m.memory.len(),
            Symbol::Functional(i) => i < m.functionals.len(),
            Symbol::Measure(i) => i < m.measures.len(),
            Symbol::Tau | Symbol::Time | Symbol::SpectralRadius => true,
        }
    }

    /// Lengths of lists and ranges of indices outside the graph.
    fn lists(&mut self) {
        let (m, n) = (self.model, self.model.states.len());
        for mode in &m.modes {
            let square = mode.mass.as_ref().is_none_or(|rows| rows.len() == n && rows.iter().all(|r| r.len() == n));
            self.require(mode.flow.len() == n && mode.has_state.len() == n && square, || {
                format!("mode `{}` does not have one equation a state", mode.name)
            });
        }
        for t in &m.transitions {
            self.require(t.from < m.modes.len() && t.to < m.modes.len(), || {
                format!("transition `{}` leaves or enters a mode that is not there", t.name)
            });
            self.require(t.reset.len() == n && t.memory_reset.len() == m.memory.len(), || {
                format!("transition `{}` does not have one reset a state and memory entry", t.name)
            });
            for zero in &t.also_zero {
                let exist = [zero.start, zero.end, zero.rate].iter().all(|&i| i < m.functionals.len());
                self.require(exist, || format!("`{}` of transition `{}` has no functionals", zero.text, t.name));
            }
        }
        if let Some(section) = &m.section {
            let distinct: HashSet<_> = section.coordinates.iter().collect();
            let sound = section.transition < m.transitions.len()
                && section.coordinates.iter().all(|&i| i < n)
                && distinct.len() == section.coordinates.len()
                && section.start.len() == section.coordinates.len()
                && section.embed.len() == n
                && section.symmetry.as_ref().is_none_or(|s| s.len() == n);
            self.require(sound, || "the section's transition, coordinates, embed or symmetry do not fit".to_owned());
        }
    }

    fn modes(&mut self) {
        for mode in &self.model.modes {
            let place = format!("the flow of mode `{}`", mode.name);
            // Rates enter by the mass matrix only, so that the residual is linear in them.
            for &root in mode.flow.iter().chain(mode.mass.iter().flatten().flatten()) {
                self.expression(root, Allowed::FLOW, &place);
            }
        }
    }

    fn transitions(&mut self) {
        let m = self.model;
        for t in &m.transitions {
            let allowed = Allowed { rate: m.modes.get(t.from).is_some_and(is_explicit), ..Allowed::FLOW };
            self.expression(t.guard, allowed, &format!("the guard of transition `{}`", t.name));
            if let Some(when) = t.when {
                let allowed = Allowed { frozen: false, ..allowed };
                self.expression(when, allowed, &format!("`when` of transition `{}`", t.name));
            }
            for &root in t.reset.iter().chain(&t.memory_reset) {
                self.expression(root, allowed, &format!("the reset of transition `{}`", t.name));
            }
        }
    }

    fn section(&mut self) {
        let m = self.model;
        let Some(section) = &m.section else { return };
        for &root in &section.embed {
            self.expression(root, Allowed::STATIC, "the section's embed");
            let others = self.follow(root, |symbol| match symbol {
                Symbol::State(i) => !section.coordinates.contains(&i),
                _ => false,
            });
            self.require(!others, || "the section's embed depends on states that are no coordinates".to_owned());
        }
        for &root in section.symmetry.iter().flatten() {
            self.expression(root, Allowed::STATIC, "the section's symmetry");
        }
    }

    fn others(&mut self) {
        let m = self.model;
        for s in &m.switches {
            self.expression(s.expr, Allowed::FLOW, &format!("the condition `{}`", s.text));
        }
        let allowed = Allowed { rate: true, ..Allowed::FLOW };
        for f in &m.functionals {
            self.expression(f.expr, allowed, "a measure's functional");
        }
        for measure in &m.measures {
            self.expression(measure.expr, Allowed::MEASURE, &format!("measure `{}`", measure.name));
        }
    }

    fn follow(&self, root: NodeId, wanted: impl Fn(Symbol) -> bool) -> bool {
        self.model.graph.depends(&[root], wanted)
    }

    /// The expression exists, and holds only what has a value where it is evaluated.
    fn expression(&mut self, root: NodeId, allowed: Allowed, place: &str) {
        let graph: &Graph = &self.model.graph;
        if root.0 as usize >= graph.nodes().len() {
            self.defects.push(format!("{place} refers to an expression that is not there"));
            return;
        }
        let mut found: Option<String> = None;
        graph.visit(&[root], |_, node| {
            let defect = match node {
                Node::Symbol(symbol) | Node::Partial(_, symbol) if !allowed.symbol(symbol) => {
                    Some(format!("{place} depends on {}, which has no value there", self.describe(symbol)))
                }
                Node::Constant(bits) if !f64::from_bits(bits).is_finite() => {
                    Some(format!("{place} contains a constant that is not a finite number"))
                }
                Node::Select { .. } if !allowed.frozen => Some(format!("{place} selects on a frozen branch")),
                Node::Choose { .. } if allowed.frozen => Some(format!("{place} chooses without a switching function")),
                _ => None,
            };
            found = found.take().or(defect);
        });
        self.defects.extend(found);
    }

    fn describe(&self, symbol: Symbol) -> String {
        let m = self.model;
        let name = match symbol {
            Symbol::State(i) => m.states.get(i).map(|s| format!("state `{}`", s.name)),
            Symbol::Rate(i) => m.states.get(i).map(|s| format!("the rate `dot({})`", s.name)),
            Symbol::Parameter(i) => m.parameters.get(i).map(|p| format!("parameter `{}`", p.name)),
            Symbol::Memory(i) => m.memory.get(i).map(|x| format!("memory `{}`", x.name)),
            Symbol::Tau => Some("`tau`".to_owned()),
            Symbol::Time => Some("`t`".to_owned()),
            Symbol::Functional(_) => Some("a functional of the map".to_owned()),
            Symbol::Measure(i) => m.measures.get(i).map(|x| format!("measure `{}`", x.name)),
            Symbol::SpectralRadius => Some("`spectral_radius`".to_owned()),
        };
        name.unwrap_or_else(|| "something unknown".to_owned())
    }
}

fn is_explicit(mode: &Mode) -> bool {
    mode.mass.is_none()
}

/// Letters, digits and underscores, no digit first.
fn is_name(name: &str) -> bool {
    let start = name.chars().next().is_some_and(|c| c.is_ascii_alphabetic() || c == '_');
    start && name.len() <= 100 && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// A name that can stand as a module's, and in camel case as a type's.
fn is_module_name(name: &str) -> bool {
    is_name(name)
        && name.chars().all(|c| !c.is_ascii_uppercase())
        && name.chars().next().is_some_and(|c| c.is_ascii_lowercase())
        && syn::parse_str::<syn::Ident>(name).is_ok()
        && syn::parse_str::<syn::Ident>(&crate::back::rust::camel(name)).is_ok()
}
