//! Studies as pictures: curves over one range, cells over two.

use super::basin::Starts;
use super::columns::{integers, numbers, texts};
use super::sweep::Sweep;
use crate::cli::InputError;
use crate::picture::{Basin, Curve, Level, Mark, Panel, Picture, Series, label};
use crate::table::Table;
use gaitc_compiler::front::in_unit;
use gaitc_runtime::study::{Axis, Design};

/// An evenly spread axis of a picture, in the unit that people use.
struct Scale {
    label: String,
    lower: f64,
    upper: f64,
    count: usize,
}

impl Scale {
    /// The outer edges of its cells.
    fn edges(&self) -> (f64, f64) {
        let half = 0.5 * (self.upper - self.lower) / self.count.saturating_sub(1).max(1) as f64;
        (self.lower - half, self.upper + half)
    }
}

/// The axes of a grid of ranges of two values or more; `None` where it has lists or is no grid.
fn scales(design: &Design, named: &[(&str, &str)]) -> Option<Vec<Scale>> {
    let Design::Grid(axes) = design else { return None };
    let scale = |(axis, (name, unit)): (&Axis, &(&str, &str))| match axis {
        Axis::Range { lower, upper, count } if *count > 1 => Some(Scale {
            label: label(name, unit),
            lower: in_unit(*lower, unit),
            upper: in_unit(*upper, unit),
            count: usize::try_from(*count).ok()?,
        }),
        _ => None,
    };
    axes.iter().zip(named).map(scale).collect()
}

/// Cells of a grid over two ranges, of which the second runs fastest: `class` of each point.
fn cells(title: String, scales: &[Scale], classes: Vec<String>, class: impl Fn(usize) -> usize) -> Basin {
    let [x, y] = scales else { return Basin { title, ..Basin::default() } };
    let cells = (0..y.count).flat_map(|row| (0..x.count).map(move |column| column * y.count + row));
    Basin {
        title,
        x: x.label.clone(),
        y: y.label.clone(),
        x_range: x.edges(),
        y_range: y.edges(),
        columns: x.count,
        cells: cells.map(class).collect(),
        classes,
        marks: Vec::new(),
    }
}

impl Sweep<'_> {
    fn scales(&self) -> Option<Vec<Scale>> {
        let parameters = self.swept.iter().map(|&i| &self.loaded.spec.parameters[i]);
        let named: Vec<(&str, &str)> = parameters.map(|p| (p.name.as_str(), p.unit.as_str())).collect();
        scales(&self.design, &named).filter(|scales| (1..=2).contains(&scales.len()))
    }

    /// Refuses to draw what has no picture.
    pub(super) fn drawable(&self) -> Result<(), InputError> {
        match self.scales() {
            Some(_) => Ok(()),
            None => Err(InputError(
                "--plot: only sweeps over one or two ranges can be drawn\n  help: write --over 'NAME=LO..HI:COUNT' once or twice"
                    .to_owned(),
            )),
        }
    }

    /// The first measure (or the objective) and the spectral radius over one parameter; over two, where gaits are stable.
    pub(super) fn picture(&self, table: &Table) -> Box<dyn Picture> {
        let scales = self.scales().unwrap_or_default();
        let stable = integers(table, "stable").unwrap_or_default();
        let statuses = texts(table, "status").unwrap_or_default();
        let found = |i: usize| matches!(statuses.get(i).map(String::as_str), Some("converged" | "optimal"));
        let what = if self.problem.is_some() { "optimum" } else { "gait" };
        let title = format!("{}: {what} at each point", self.loaded.spec.name);
        if scales.len() == 2 {
            let classes = [format!("stable {what}"), format!("unstable {what}"), format!("no {what}")];
            let class = |i: usize| match (found(i), stable.get(i) == Some(&1)) {
                (true, true) => 0,
                (true, false) => 1,
                (false, _) => 2,
            };
            return Box::new(cells(title, &scales, classes.to_vec(), class));
        }
        let x: Vec<f64> =
            (0..table.rows() as u64).map(|i| self.design.point(i).first().copied().unwrap_or(f64::NAN)).collect();
        let unit = self.swept.first().map_or("", |&i| self.loaded.spec.parameters[i].unit.as_str());
        let curve = |name: &str, values: &[f64], unit_of: &str, keep: &dyn Fn(usize) -> bool| {
            let point = |(i, (x, y)): (usize, (&f64, &f64))| {
                (in_unit(*x, unit), if keep(i) { in_unit(*y, unit_of) } else { f64::NAN })
            };
            Curve { name: name.to_owned(), points: x.iter().zip(values).enumerate().map(point).collect() }
        };
        let mut panels = Vec::new();
        let (name, of) = self.ranked();
        if let Some(values) = numbers(table, &name) {
            let is_stable = |i: usize| stable.get(i) == Some(&1);
            // Both pieces reach the point where they meet.
            let is_unstable =
                |i: usize| found(i) && (!is_stable(i) || i > 0 && !is_stable(i - 1) || stable.get(i + 1) == Some(&0));
            let curves = vec![curve("stable", values, &of, &is_stable), curve("unstable", values, &of, &is_unstable)];
            let shown = self.problem.as_ref().map_or(name.clone(), |p| p.objective_text.clone());
            panels.push(Panel { y: label(&shown, &of), curves, levels: Vec::new() });
        }
        if let Some(values) = numbers(table, "spectral_radius") {
            let levels = vec![Level { name: "limit of stability".to_owned(), value: 1.0, curve: None }];
            let curves = vec![curve("spectral_radius", values, "", &found)];
            panels.push(Panel { y: "spectral_radius".to_owned(), curves, levels });
        }
        let x = scales.first().map(|scale| scale.label.clone()).unwrap_or_default();
        Box::new(Series { title, x, panels, events: Vec::new() })
    }
}

impl Starts<'_> {
    fn scales(&self) -> Option<Vec<Scale>> {
        let spec = &self.loaded.spec;
        let states = self.over.iter().filter_map(|&i| spec.states.get(*self.loaded.coordinates().get(i)?));
        let named: Vec<(&str, &str)> = states.map(|state| (state.name.as_str(), state.unit.as_str())).collect();
        scales(&self.design, &named).filter(|scales| scales.len() == 2)
    }

    /// Refuses to draw what has no picture.
    pub(super) fn drawable(&self) -> Result<(), InputError> {
        match self.scales() {
            Some(_) => Ok(()),
            None => Err(InputError(
                "--plot: only basins over two ranges can be drawn\n  help: write --over 'COORD=LO..HI:COUNT' twice"
                    .to_owned(),
            )),
        }
    }

    /// Which start leads where; gaits of period 1 are marked where they are.
    pub(super) fn picture(&self, table: &Table) -> Basin {
        let outcomes = texts(table, "outcome").unwrap_or_default();
        let gaits = integers(table, "gait").unwrap_or_default();
        let periods = integers(table, "period").unwrap_or_default();
        let count = usize::try_from(gaits.iter().copied().max().unwrap_or(0)).unwrap_or(0);
        let first = |gait: usize| gaits.iter().position(|known| usize::try_from(*known) == Ok(gait)).unwrap_or(0);
        let mut classes: Vec<String> = (1..=count)
            .map(|gait| format!("gait {gait}, period {}", periods.get(first(gait)).copied().unwrap_or(0)))
            .collect();
        for outcome in outcomes.iter().filter(|outcome| *outcome != "gait") {
            if !classes[count..].contains(outcome) {
                classes.push(outcome.clone());
            }
        }
        let class = |i: usize| {
            let gait = gaits.get(i).and_then(|gait| usize::try_from(*gait).ok()).filter(|gait| *gait > 0);
            gait.map_or_else(
                || count + classes[count..].iter().position(|class| Some(class) == outcomes.get(i)).unwrap_or(0),
                |gait| gait - 1,
            )
        };
        let title = format!("{}: which start leads where", self.loaded.spec.name);
        let mut basin = cells(title, &self.scales().unwrap_or_default(), classes.clone(), class);
        let inside = |(low, high): (f64, f64), value: f64| (low..=high).contains(&value);
        for gait in (1..=count).filter(|gait| periods.get(first(*gait)) == Some(&1)) {
            let at: Vec<f64> = self
                .over
                .iter()
                .filter_map(|&i| {
                    let state = self.loaded.spec.states.get(*self.loaded.coordinates().get(i)?)?;
                    let value = *numbers(table, &format!("{}_end", state.name))?.get(first(gait))?;
                    Some(in_unit(value, &state.unit))
                })
                .collect();
            if let [x, y] = at[..]
                && inside(basin.x_range, x)
                && inside(basin.y_range, y)
            {
                basin.marks.push(Mark { at: (x, y), label: format!("gait {gait}") });
            }
        }
        basin
    }
}
