//! What lowering an expression gives, and what may stand in which place of a spec.

use crate::dimension::Dimension;
use crate::ir::NodeId;

/// A lowered expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Value {
    /// Its node.
    pub(crate) node: NodeId,
    /// Its dimension; `None` is the literal 0, which fits any.
    pub(crate) dimension: Option<Dimension>,
    /// What it depends on, conditions included.
    pub(crate) uses: Uses,
}

/// A set of kinds of variables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Uses(u16);

impl Uses {
    pub(crate) const NONE: Self = Self(0);
    pub(crate) const PARAMETER: Self = Self(1);
    pub(crate) const STATE: Self = Self(2);
    pub(crate) const MEMORY: Self = Self(4);
    pub(crate) const TAU: Self = Self(8);
    pub(crate) const TIME: Self = Self(16);
    pub(crate) const FUNCTIONAL: Self = Self(32);
    pub(crate) const MEASURE: Self = Self(64);
    pub(crate) const RADIUS: Self = Self(128);
    pub(crate) const RATE: Self = Self(256);
    /// What the equations of motion are made of.
    pub(crate) const MOTION: Self = Self::STATE.and(Self::MEMORY).and(Self::TAU).and(Self::TIME);
    /// What is known only after a map.
    pub(crate) const RESULT: Self = Self::FUNCTIONAL.and(Self::MEASURE).and(Self::RADIUS);

    /// Both.
    pub(crate) const fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Whether any of `other` is in it.
    pub(crate) const fn any(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }

    /// Whether nothing but `other` is in it.
    pub(crate) const fn only(self, other: Self) -> bool {
        self.0 & !other.0 == 0
    }
}

/// How conditions become nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Style {
    /// By a frozen selector: the integrator locates the switch.
    Frozen,
    /// By the sign of a margin at once: no integration runs there.
    Immediate,
}

/// Whether the time derivatives of states are known at a transition.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Rates {
    /// They are the flow of the mode that the transition leaves.
    Known,
    /// That mode has a mass matrix, which may be singular there.
    Unknown,
}

/// A place of a spec.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Place {
    /// Flow or mass matrix.
    Flow,
    /// Guard or reset.
    Event(Rates),
    /// The condition of a transition.
    When(Rates),
    /// Embedding or symmetry of the section.
    Section,
    /// A name of `[let]`, which may be used anywhere: checked at its use.
    Let(Style),
    /// The argument of a functional.
    Functional,
    /// A measure, outside functionals.
    Measure,
    /// What is looked at along a run: the values of a point decide conditions.
    Observation,
    /// Objective or constraint.
    Problem,
    /// A quantity.
    Constant,
}

impl Place {
    pub(crate) const fn style(self) -> Style {
        match self {
            Self::Flow | Self::Event(_) | Self::Functional => Style::Frozen,
            Self::Let(style) => style,
            Self::When(_) | Self::Section | Self::Measure | Self::Observation | Self::Problem | Self::Constant => {
                Style::Immediate
            }
        }
    }

    /// What has a value there.
    pub(crate) const fn available(self) -> Uses {
        match self {
            Self::Flow | Self::Event(Rates::Unknown) | Self::When(Rates::Unknown) => Uses::PARAMETER.and(Uses::MOTION),
            Self::Event(Rates::Known)
            | Self::When(Rates::Known)
            | Self::Let(_)
            | Self::Functional
            | Self::Observation => Uses::PARAMETER.and(Uses::MOTION).and(Uses::RATE),
            Self::Section => Uses::PARAMETER.and(Uses::STATE),
            Self::Measure => Uses::PARAMETER.and(Uses::FUNCTIONAL),
            Self::Problem => Uses::PARAMETER.and(Uses::MEASURE).and(Uses::RADIUS),
            Self::Constant => Uses::NONE,
        }
    }
}
