//! A trade-off curve as table, JSON, CSV and picture.

use super::Trade;
use super::quantity::Quantity;
use crate::cli::optimize::report::status;
use crate::cli::output;
use crate::picture::{Line, Mark};
use gaitc_compiler::front::{format_quantity, in_unit};
use gaitc_compiler::ir::{Parameter, Sense};
use gaitc_runtime::optimize::{Aim, Curve, Gap, Solution, TradeOutcome, TradePoint};
use serde_json::{Map, Value, json};

/// A curve with the names and units of its spec.
pub(super) struct Report<'r, 'l> {
    pub(super) trade: &'r Trade<'l>,
    pub(super) outcome: &'r TradeOutcome,
    pub(super) warnings: &'r [String],
}

impl Report<'_, '_> {
    fn varied(&self) -> Vec<&Parameter> {
        self.trade.problem.vary.iter().map(|v| &self.trade.spec.parameters[v.parameter]).collect()
    }

    fn values(&self, solution: &Solution) -> Vec<f64> {
        self.trade.problem.vary.iter().map(|v| solution.parameters[v.parameter]).collect()
    }

    pub(super) fn json(&self) -> Value {
        let quantity = |q: &Quantity| {
            let sense = if q.sense == Sense::Maximize { "maximize" } else { "minimize" };
            json!({ "name": q.text, "sense": sense })
        };
        let mut all = Map::new();
        all.insert("model".into(), json!(self.trade.spec.name));
        all.insert("problem".into(), json!(self.trade.problem.name));
        all.insert("first".into(), quantity(&self.trade.first));
        all.insert("second".into(), quantity(&self.trade.second));
        all.insert("notes".into(), json!(self.warnings));
        match self.outcome {
            TradeOutcome::Curve(curve) => {
                all.insert("status".into(), json!(curve_status(curve)));
                all.insert("message".into(), json!(self.message(curve)));
                all.insert("points".into(), curve.points.iter().map(|p| self.point(p)).collect());
                all.insert("gaps".into(), curve.gaps.iter().map(|gap| self.gap(gap)).collect());
                all.insert("dominated".into(), json!(curve.dominated));
            }
            TradeOutcome::NoFirst(end) | TradeOutcome::NoSecond(end) => {
                all.insert("status".into(), json!(status(end.status)));
                all.insert("message".into(), json!(self.no_end()));
            }
        }
        Value::Object(all)
    }

    fn point(&self, point: &TradePoint) -> Value {
        let parameters: Map<String, Value> = self
            .varied()
            .into_iter()
            .zip(self.values(&point.solution))
            .map(|(p, v)| (p.name.clone(), json!(v)))
            .collect();
        let measures: Map<String, Value> = (self.trade.spec.measures.iter().zip(&point.solution.measures))
            .map(|(m, v)| (m.name.clone(), json!(v)))
            .collect();
        json!({
            "first": point.first,
            "second": point.second,
            "slope": point.slope,
            "parameters": parameters,
            "spectral_radius": point.solution.spectral_radius,
            "measures": measures,
        })
    }

    fn message(&self, curve: &Curve) -> String {
        let (a, b) = (&self.trade.first, &self.trade.second);
        let text = match &curve.points[..] {
            [_] => format!("one gait is best in both `{}` and `{}`: there is nothing to trade", a.text, b.text),
            points => format!("{} optima, each confirmed by simulation", points.len()),
        };
        match curve.gaps.len() {
            0 => text,
            gaps if curve.interrupted => format!("interrupted: {text}; {gaps} bounds not done"),
            gaps => format!("{text}; {gaps} bounds without an optimum"),
        }
    }

    fn gap(&self, gap: &Gap) -> Value {
        let end = gap.solution.as_ref();
        json!({
            "bound": gap.bound,
            "status": end.map(|solution| status(solution.status)),
            "message": end.map(|solution| self.trade.message(Aim::Bounded(gap.bound), solution)),
        })
    }

    /// Why there is no curve.
    fn no_end(&self) -> String {
        let of = |q: &Quantity, (aim, end): (Aim, &Solution)| {
            let message = self.trade.message(aim, end);
            format!("there is no best `{}` to begin with: {message} ({})", q.text, status(end.status))
        };
        match self.outcome {
            TradeOutcome::NoFirst(end) => of(&self.trade.first, (Aim::First, end)),
            TradeOutcome::NoSecond(end) => of(&self.trade.second, (Aim::Second, end)),
            TradeOutcome::Curve(_) => String::new(),
        }
    }

    pub(super) fn text(&self) -> String {
        let (a, b) = (&self.trade.first, &self.trade.second);
        let sense = |q: &Quantity| if q.sense == Sense::Maximize { "more" } else { "less" };
        let mut text = format!(
            "{} · {} · {} {} for {} {}\n",
            self.trade.spec.name,
            self.trade.problem.name,
            sense(a),
            a.text,
            sense(b),
            b.text
        );
        let TradeOutcome::Curve(curve) = self.outcome else {
            return text + &format!("{}\n", self.no_end());
        };
        text += &format!("{}\n", self.message(curve));
        for note in self.warnings {
            text += &format!("note: {note}\n");
        }
        let varied = self.varied();
        let mut header = vec![a.text.as_str(), b.text.as_str(), "slope"];
        header.extend(varied.iter().map(|p| p.name.as_str()));
        let rows = curve.points.iter().map(|point| {
            let mut row = vec![a.show(point.first), b.show(point.second), self.slope(point)];
            let values = varied.iter().zip(self.values(&point.solution));
            row.extend(values.map(|(p, v)| format_quantity(v, &p.unit)));
            row
        });
        text += &format!("\n{}", output::table(&header, rows));
        for Gap { bound, solution } in &curve.gaps {
            if let Some(solution) = solution {
                text += &format!(
                    "no optimum at {} = {}: {}\n",
                    b.text,
                    b.show(*bound),
                    self.trade.message(Aim::Bounded(*bound), solution)
                );
            }
        }
        text + &format!("slope: of {} per unit of {}\n", a.label(), b.label())
    }

    /// In the units of both columns.
    fn slope(&self, point: &TradePoint) -> String {
        let (a, b) = (&self.trade.first, &self.trade.second);
        let slope = point.slope.map(|slope| a.number(slope) / b.number(1.0));
        slope.map_or_else(String::new, gaitc_compiler::front::format_number)
    }

    /// One row a point, units in the header; every value with all its digits.
    pub(super) fn csv(&self, curve: &Curve) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
        let (a, b) = (&self.trade.first, &self.trade.second);
        let with_unit = |name: &str, unit: &str| match unit {
            "" | "1" => name.to_owned(),
            unit => format!("{name} [{unit}]"),
        };
        let varied = self.varied();
        let others: Vec<usize> = (0..self.trade.spec.measures.len())
            .filter(|&i| ![&a.text, &b.text].contains(&&self.trade.spec.measures[i].name))
            .collect();
        let mut header = vec![a.label(), b.label(), "slope".to_owned()];
        header.extend(varied.iter().map(|p| with_unit(&p.name, &p.unit)));
        header.extend(
            others.iter().map(|&i| with_unit(&self.trade.spec.measures[i].name, &self.trade.spec.measures[i].unit)),
        );
        let mut table = csv::Writer::from_writer(Vec::new());
        table.write_record(&header)?;
        for point in &curve.points {
            let slope = point.slope.map_or_else(String::new, |slope| (a.number(slope) / b.number(1.0)).to_string());
            let mut row = vec![a.number(point.first).to_string(), b.number(point.second).to_string(), slope];
            row.extend(varied.iter().zip(self.values(&point.solution)).map(|(p, v)| in_unit(v, &p.unit).to_string()));
            row.extend(
                others
                    .iter()
                    .map(|&i| in_unit(point.solution.measures[i], &self.trade.spec.measures[i].unit).to_string()),
            );
            table.write_record(&row)?;
        }
        Ok(table.into_inner()?)
    }

    /// The curve over the second quantity, its ends named by what varies.
    pub(super) fn picture(&self, curve: &Curve) -> Line {
        let (a, b) = (&self.trade.first, &self.trade.second);
        let at = |p: &TradePoint| (b.number(p.second), a.number(p.first));
        let mark = |p: &TradePoint| {
            let values = self.varied().into_iter().zip(self.values(&p.solution));
            let label: Vec<String> =
                values.map(|(q, v)| format!("{} = {}", q.name, format_quantity(v, &q.unit))).collect();
            Mark { at: at(p), label: label.join(", ") }
        };
        let ends = [curve.points.first(), curve.points.last().filter(|_| curve.points.len() > 1)];
        Line {
            title: format!("{}: best {} for every {}", self.trade.spec.name, a.text, b.text),
            x: b.label(),
            y: a.label(),
            points: curve.points.iter().map(at).collect(),
            marks: ends.into_iter().flatten().map(mark).collect(),
        }
    }
}

fn curve_status(curve: &Curve) -> &'static str {
    match (curve.interrupted, curve.gaps.is_empty()) {
        (true, _) => "interrupted",
        (false, true) => "complete",
        (false, false) => "gaps",
    }
}
