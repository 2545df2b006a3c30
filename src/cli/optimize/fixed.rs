//! Constraints in which nothing varies: they hold for every gait or for none, whatever a search does.

use crate::cli::InputError;
use crate::problem::fixed;
use gaitc_compiler::front::format_quantity;
use gaitc_compiler::ir::{Model, Node, NodeId, Problem, Symbol};

/// Notes on constraints that hold whatever varies.
///
/// # Errors
/// When one can never hold.
pub(super) fn constraints(spec: &Model, problem: &Problem, parameters: &[f64]) -> Result<Vec<String>, InputError> {
    let mut notes = Vec::new();
    for constraint in &problem.constraints {
        let Some(margin) = fixed(&spec.graph, constraint.margin, problem, parameters) else { continue };
        let text = &constraint.text;
        let values = values(spec, constraint.margin, parameters);
        // Not a number is not at least zero either.
        if margin >= 0.0 {
            notes.push(format!("`{text}` always holds: nothing in it varies{values}"));
        } else {
            return Err(InputError(format!(
                "`{text}` never holds: nothing in it varies{values}\n  help: vary what is in it with --vary, change its value \
                 with --set, or leave the constraint out"
            )));
        }
    }
    Ok(notes)
}

/// The parameters in an expression with their values, behind a comma; nothing where it has none.
fn values(spec: &Model, root: NodeId, parameters: &[f64]) -> String {
    let mut values = String::new();
    spec.graph.visit(&[root], |_, node| {
        if let Node::Symbol(Symbol::Parameter(i)) = node
            && let (Some(parameter), Some(value)) = (spec.parameters.get(i), parameters.get(i))
        {
            values += &format!(", `{}` is {}", parameter.name, format_quantity(*value, &parameter.unit));
        }
    });
    values
}
