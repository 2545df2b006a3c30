//! A diagram as JSON: the first branch as `points` and `bifurcations`, all of them as `branches`.

use super::{Report, words};
use crate::cli::gait::named;
use gaitc_runtime::study::continuation::{
    Bifurcation, Branch, Criticality, Diagram, EndReason, Kind, Parent, Point, Side,
};
use serde_json::{Map, Value, json};

impl Report<'_> {
    pub(super) fn json(&self, status: &str, message: &str, diagram: &Diagram) -> Value {
        let (spec, parameter) = (&self.loaded.spec, self.parameter());
        let branches: Vec<Value> =
            diagram.branches.iter().map(|branch| Value::Object(self.branch(diagram, branch))).collect();
        let first = |key: &str| branches.first().map_or_else(|| json!([]), |branch| branch[key].clone());
        json!({
            "model": spec.name,
            "status": status,
            "message": message,
            "warnings": self.warnings,
            "parameters": named(spec.parameters.iter().map(|p| p.name.as_str()), self.parameters),
            "over": {
                "name": parameter.name,
                "unit": parameter.unit,
                "range": [self.range.0, self.range.1],
                "start": self.parameters[self.over],
            },
            "points": first("points"),
            "bifurcations": first("bifurcations"),
            "not_entered": diagram.not_entered.iter().map(|p| parent(*p)).collect::<Vec<_>>(),
            "branches": branches,
        })
    }

    fn branch(&self, diagram: &Diagram, branch: &Branch) -> Map<String, Value> {
        let ends: Vec<Value> = branch
            .ends
            .iter()
            .map(|end| json!({ "reason": reason(end), "message": words::end(self, diagram, branch, end).0 }))
            .collect();
        let mut all = Map::new();
        for (key, value) in [
            ("period", json!(branch.period)),
            ("parent", branch.parent.map_or(Value::Null, parent)),
            ("points", branch.points.iter().map(|point| Value::Object(self.point(point))).collect()),
            ("bifurcations", branch.bifurcations.iter().map(|b| self.bifurcation(b)).collect()),
            ("start", json!(branch.start)),
            ("ends", json!(ends)),
            ("repeats_sooner", json!(branch.repeats_sooner)),
        ] {
            all.insert(key.to_owned(), value);
        }
        all
    }

    fn point(&self, point: &Point) -> Map<String, Value> {
        let spec = &self.loaded.spec;
        let coordinates = self.loaded.coordinates().iter().map(|&i| spec.states[i].name.as_str());
        let mut all = Map::new();
        for (key, value) in [
            ("value", json!(point.value)),
            ("section", named(coordinates, point.section.as_slice())),
            ("multipliers", json!(point.multipliers.iter().map(|m| [m.re, m.im]).collect::<Vec<_>>())),
            ("spectral_radius", json!(point.spectral_radius)),
            ("stable", json!(point.stable())),
            ("measures", named(spec.measures.iter().map(|m| m.name.as_str()), point.measures.as_slice())),
            ("duration", json!(point.duration)),
            ("residual", json!(point.residual)),
        ] {
            all.insert(key.to_owned(), value);
        }
        all
    }

    fn bifurcation(&self, bifurcation: &Bifurcation) -> Value {
        let mut all = Map::new();
        all.insert("kind".to_owned(), json!(kind(bifurcation.kind)));
        all.extend(self.point(&bifurcation.point));
        // On a bifurcation a gait is neither.
        all.remove("stable");
        all.insert("after".to_owned(), json!(bifurcation.after));
        let criticality = bifurcation.criticality.map(|criticality| match criticality {
            Criticality::Supercritical => "supercritical",
            Criticality::Subcritical => "subcritical",
            Criticality::Transcritical => "transcritical",
        });
        all.insert("criticality".to_owned(), json!(criticality));
        Value::Object(all)
    }
}

fn parent(parent: Parent) -> Value {
    json!({ "branch": parent.branch, "bifurcation": parent.bifurcation })
}

fn kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Fold => "fold",
        Kind::Branch => "branch",
        Kind::Flip => "flip",
        Kind::NeimarkSacker => "neimark_sacker",
    }
}

fn reason(end: &EndReason) -> &'static str {
    match end {
        EndReason::RangeEnd(Side::Lower) => "lower_end",
        EndReason::RangeEnd(Side::Upper) => "upper_end",
        EndReason::Closed => "closed",
        EndReason::MapStops(stop) => stop.reason.name(),
        EndReason::NotClosed(_) => "not_closed",
        EndReason::StepTooSmall => "step_failed",
        EndReason::Unbounded => "unbounded",
        EndReason::PointLimit => "point_limit",
        EndReason::PeriodHalved => "period_halved",
        EndReason::Parent => "parent",
        EndReason::NoDirection => "no_direction",
        EndReason::Interrupted => "interrupted",
    }
}
