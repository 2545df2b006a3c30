//! Mass matrices: M(x) x' = flow. Rows that a mode does not give are the identity's.

use super::dimension_text;
use super::lowering::Lowering;
use super::value::Place;
use crate::diagnostic::{Code, Diagnostic};
use crate::dimension::Dimension;
use crate::front::spec::{Equation, MassRow, Mode, Named};
use crate::ir::NodeId;
use crate::source::Span;

/// A mass matrix and what it makes of the flow's dimensions.
pub(super) struct Mass {
    pub(super) rows: Vec<Vec<NodeId>>,
    /// For each row that the mode gives the dimension of its flow; inner `None` where that is not known. Outer `None`
    /// is a row of the identity.
    pub(super) dimensions: Vec<Option<Option<Dimension>>>,
}

/// The dimension of a row times the rates, and the entry that it comes from.
type RowDimension = Option<(Dimension, Span)>;

impl Lowering<'_> {
    /// The mass matrix of a mode that has one.
    pub(super) fn mass(&mut self, mode: &Named<Mode>, has_state: &[bool]) -> Option<Mass> {
        let (first, n) = (mode.value.mass.first()?, has_state.len());
        let [zero, one] = [0.0, 1.0].map(|value| self.model.graph.constant(value));
        let identity = |i: usize| (0..n).map(|j| if i == j { one } else { zero }).collect::<Vec<NodeId>>();
        let mut mass = Mass { rows: (0..n).map(identity).collect(), dimensions: vec![None; n] };
        // What is broken may have been meant to fill a gap.
        let mut whole = true;
        for row in &mode.value.mass {
            let own = self.state_named(&row.name, row.span, "mass");
            let entries = match &row.value {
                MassRow::Factor(factor) => vec![(own, row.span, factor)],
                MassRow::Entries(entries) => {
                    let column = |entry| (self.state_of(entry, "rate"), entry.span, &entry.value);
                    entries.iter().map(column).collect()
                }
            };
            if own.is_some_and(|i| has_state.get(i) == Some(&false)) {
                self.no_rate(mode, &row.name, row.span);
                whole = false;
                continue;
            }
            let mut values = vec![zero; n];
            let mut dimension: RowDimension = None;
            for (column, span, equation) in entries {
                let value = self.mass_entry(mode, (column, span), equation, has_state, &mut dimension);
                whole &= value.is_some();
                if let (Some(slot), Some(value)) = (column.and_then(|j| values.get_mut(j)), value) {
                    *slot = value;
                }
            }
            if let Some(i) = own {
                mass.dimensions[i] = Some(dimension.map(|(dimension, _)| dimension));
                mass.rows[i] = values;
            }
            whole &= own.is_some();
        }
        if let Some(state) = undetermined(&mass.rows, zero).filter(|_| whole) {
            self.singular(mode, state, first.span);
        }
        Some(mass)
    }

    /// One entry of the matrix; checks that all entries of a row agree on the dimension of its flow.
    fn mass_entry(
        &mut self,
        mode: &Named<Mode>,
        (column, span): (Option<usize>, Span),
        equation: &Equation,
        has_state: &[bool],
        row: &mut RowDimension,
    ) -> Option<NodeId> {
        let value = self.equation(equation, Place::Flow)?;
        self.only_states_of((&mode.name, has_state), value.node, equation, "this entry");
        let column = column?;
        if has_state.get(column) == Some(&false) {
            let name = self.state_name(column);
            self.no_rate(mode, &name, span);
            return None;
        }
        let rate = self.state_dimension(column).and_then(|dimension| dimension.div(Dimension::TIME));
        let product = value.dimension.zip(rate).and_then(|(factor, rate)| factor.mul(rate));
        let span = self.root_span(equation);
        match (product, *row) {
            (Some(product), Some((expected, first))) if product != expected => {
                let (product, expected) = (dimension_text(product), dimension_text(expected));
                let name = self.state_name(column);
                let message = format!("this entry times `dot({name})` is {product}, but the row's first is {expected}");
                let error = Diagnostic::error(Code::EquationDimension, message).at(span, "");
                let error = error.see(first, format!("times its rate this is {expected}"));
                self.diagnostics.push(error.help("a row is a sum of entries times rates: all have one dimension"));
                return None;
            }
            (Some(product), None) => *row = Some((product, span)),
            _ => {}
        }
        Some(value.node)
    }

    fn no_rate(&mut self, mode: &Named<Mode>, state: &str, span: Span) {
        let message = format!("mode `{}` does not have the state `{state}`", mode.name);
        let error = Diagnostic::error(Code::SuperfluousEquation, message).at(span, "");
        let help = format!("remove it from the mass matrix, or add `{}` to the state's `modes`", mode.name);
        self.diagnostics.push(error.help(help));
    }

    fn singular(&mut self, mode: &Named<Mode>, state: usize, span: Span) {
        let name = self.state_name(state);
        let message = format!("the mass matrix of mode `{}` is singular everywhere", mode.name);
        let label = format!("no row is left that determines `dot({name})`");
        let error = Diagnostic::error(Code::Mass, message).at(span, label);
        let help = format!("give `{name}` a row with its rate; a mass matrix may be singular at points only");
        self.diagnostics.push(error.help(help));
    }
}

/// A state whose rate no row is left for, when each row determines one of the rates that it contains; `None` where all
/// can be determined.
fn undetermined(rows: &[Vec<NodeId>], zero: NodeId) -> Option<usize> {
    // A largest matching of rates to rows, by augmenting paths.
    let mut of_row: Vec<Option<usize>> = vec![None; rows.len()];
    (0..rows.len()).find(|&state| !assign(state, rows, zero, &mut of_row, &mut vec![false; rows.len()]))
}

/// Finds a row for the rate of `state`, moving others if need be. As deep as there are states, at most.
fn assign(
    state: usize,
    rows: &[Vec<NodeId>],
    zero: NodeId,
    of_row: &mut Vec<Option<usize>>,
    seen: &mut Vec<bool>,
) -> bool {
    for (i, row) in rows.iter().enumerate() {
        if seen[i] || row.get(state).is_none_or(|&entry| entry == zero) {
            continue;
        }
        seen[i] = true;
        if of_row[i].is_none_or(|other| assign(other, rows, zero, of_row, seen)) {
            of_row[i] = Some(state);
            return true;
        }
    }
    false
}
