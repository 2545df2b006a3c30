//! Measures: expressions over functionals, parameters and other measures.

use super::definitions::cycle_diagnostic;
use super::lowering::{Expected, Lowering};
use super::order::order;
use super::scope::{Definition, Entity};
use super::value::{Place, Value};
use crate::dimension::Dimension;
use crate::front::spec::{Measure, Named, Spec};
use crate::ir;

impl Lowering<'_> {
    /// Lowers `[measures]`: each after those that it uses, kept in the order of the spec.
    pub(super) fn measures(&mut self, spec: &Spec) {
        let measure = |name: &str| match self.scope.get(name) {
            Some(Definition { entity: Entity::Measure(i), .. }) => Some(i),
            _ => None,
        };
        let names = |item: &Named<Measure>| {
            let expression = item.value.expr.as_ref().and_then(|equation| equation.expression.as_ref());
            expression.map_or(Vec::new(), |e| e.names.iter().filter_map(|name| measure(&name.name)).collect())
        };
        let uses: Vec<Vec<usize>> = spec.measures.iter().map(names).collect();
        let order = order(&uses);
        for cycle in &order.cycles {
            let members: Vec<_> = cycle.iter().filter_map(|&i| spec.measures.get(i)).collect();
            let members: Vec<_> = members.iter().map(|item| (item.name.as_str(), Some(item.span))).collect();
            self.diagnostics.extend(cycle_diagnostic(&members));
        }
        let mut items: Vec<usize> = (0..spec.measures.len()).filter(|&i| !order.cyclic[i]).collect();
        items.sort_by_key(|&i| order.rank[i]);
        for i in items {
            let value = self.measure(&spec.measures[i]);
            self.measures.insert(i, value);
        }
        let zero = self.model.graph.constant(0.0);
        for (i, item) in spec.measures.iter().enumerate() {
            let value = self.measures.get(&i).copied().flatten();
            self.model.measures.push(ir::Measure {
                name: item.name.clone(),
                expr: value.map_or(zero, |value| value.node),
                dimension: value.and_then(|value| value.dimension).unwrap_or(Dimension::NONE),
                unit: item.value.unit.as_ref().map_or(String::new(), |unit| unit.value.trim().to_owned()),
                doc: item.value.doc.clone(),
            });
        }
    }

    fn measure(&mut self, item: &Named<Measure>) -> Option<Value> {
        let dimension = self.scope.get(&item.name).and_then(|definition| definition.dimension);
        let expected = Expected {
            dimension,
            what: format!("the measure `{}`", item.name),
            help: "change its `unit`, or the expression".to_owned(),
        };
        let value = self.checked(item.value.expr.as_ref()?, Place::Measure, &expected)?;
        Some(Value { dimension: dimension.or(value.dimension), ..value })
    }
}
