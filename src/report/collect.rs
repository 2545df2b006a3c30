//! From a model and its gait to what the page shows.

use super::run::capital;
use super::{Animation, Contents, Figure, Table, comparison};
use crate::figures::{self, Orbit, Run};
use crate::load::Loaded;
use crate::motion::body_path;
use crate::provenance::Provenance;
use gaitc_compiler::front::{format_number, format_quantity};
use gaitc_compiler::ir::Observation;
use gaitc_compiler::show::Sheet;
use gaitc_runtime::orbit::{Gait, GaitOutcome, GaitRequest, GaitStatus};
use gaitc_runtime::return_map::RequestError;
use gaitc_runtime::trajectory::Trajectory;

/// What a page is made from.
pub struct Study<'a> {
    /// The model.
    pub loaded: &'a Loaded,
    /// The same model on paper.
    pub sheet: &'a Sheet,
    /// All parameters in SI units.
    pub parameters: &'a [f64],
    /// What gait was looked for, where the model has a section.
    pub request: Option<GaitRequest<'a>>,
    /// Where the search began: section coordinates in SI units.
    pub guess: &'a [f64],
    /// What it found.
    pub outcome: Option<&'a GaitOutcome>,
    /// How many steps the animation shows.
    pub steps: usize,
    /// What the user should know of the input.
    pub warnings: Vec<String>,
}

impl Study<'_> {
    pub(super) fn gait(&self) -> Option<&Gait> {
        let outcome = self.outcome.filter(|outcome| outcome.status == GaitStatus::Converged)?;
        outcome.gait.as_ref()
    }
}

/// Everything that the page shows.
///
/// # Errors
/// When a request does not fit the model.
pub fn contents(study: &Study<'_>, provenance: Provenance, command: String) -> Result<Contents, RequestError> {
    let spec = &study.loaded.spec;
    let title = if spec.title.is_empty() { spec.name.clone() } else { spec.title.clone() };
    let trajectory = study.follow(study.steps)?;
    Ok(Contents {
        title,
        model: spec.name.clone(),
        source: spec.source.clone(),
        summary: summary(study),
        animation: animation(study, trajectory.as_ref()),
        gait: study.gait().map_or_else(Vec::new, |gait| tables(study, gait)),
        figures: pictures(study, trajectory.as_ref())?,
        published: comparison::all(study)?,
        parameters: parameters(study),
        equations: study.sheet.markdown(),
        provenance,
        command,
    })
}

fn summary(study: &Study<'_>) -> Vec<String> {
    let first = match (study.outcome, study.gait()) {
        (None, _) => "The model has no [section]: there is no return map, and no gait.".to_owned(),
        (Some(outcome), None) => format!("No gait was found: {}", outcome.message),
        (Some(_), Some(gait)) if gait.multipliers.is_empty() => {
            "The gait is stable: the section has no coordinates, so every step is the same, whatever came before."
                .to_owned()
        }
        (Some(_), Some(gait)) => {
            let (stable, other) =
                if gait.spectral_radius < 1.0 { ("stable", "below") } else { ("not stable", "not below") };
            let radius = format_number(gait.spectral_radius);
            format!("The gait is {stable}: its spectral radius, {radius}, is {other} 1.")
        }
    };
    let warnings = study.warnings.iter().map(|warning| format!("Warning: {warning}"));
    std::iter::once(first).chain(warnings).collect()
}

fn animation(study: &Study<'_>, trajectory: Option<&Trajectory>) -> Result<Animation, String> {
    let Some(trajectory) = trajectory else {
        return Err("There is no animation: without a [section] the model has no steps to show.".to_owned());
    };
    let Some(path) = body_path(&study.loaded.observations, study.parameters, trajectory) else {
        return Err(
            "There is no animation: the spec does not say how the machine is drawn ([drawing] with `velocity`)."
                .to_owned(),
        );
    };
    if trajectory.samples.len() < 2 || trajectory.time <= 0.0 {
        return Err("There is no animation: the run comes to no step.".to_owned());
    }
    Ok(Animation { t: trajectory.samples.t.clone(), path })
}

fn texts<const N: usize>(all: [&str; N]) -> Vec<String> {
    all.map(str::to_owned).to_vec()
}

fn tables(study: &Study<'_>, gait: &Gait) -> Vec<Table> {
    let multipliers = (!gait.multipliers.is_empty()).then(|| multipliers(gait));
    std::iter::once(values(study, gait)).chain(multipliers).collect()
}

fn values(study: &Study<'_>, gait: &Gait) -> Table {
    let spec = &study.loaded.spec;
    let mut rows = Vec::new();
    for (&state, &value) in study.loaded.coordinates().iter().zip(gait.coordinates.iter()) {
        let state = &spec.states[state];
        rows.push(vec![state.name.clone(), format_quantity(value, &state.unit), state.doc.clone()]);
    }
    rows.push(vec!["duration".to_owned(), format_quantity(gait.map.duration, "s"), "time of one step".to_owned()]);
    for (measure, &value) in spec.measures.iter().zip(gait.map.measures.iter()) {
        let (shown, doc) = if value.is_finite() {
            (format_quantity(value, &measure.unit), measure.doc.clone())
        } else {
            let why = "no number at these parameters: what it divides by is zero, or a function has no value there";
            (
                "–".to_owned(),
                [measure.doc.as_str(), why].into_iter().filter(|text| !text.is_empty()).collect::<Vec<_>>().join("; "),
            )
        };
        rows.push(vec![measure.name.clone(), shown, doc]);
    }
    Table {
        caption: "The gait on its section, and its measures".to_owned(),
        header: texts(["quantity", "value", "what it is"]),
        rows,
        names: true,
    }
}

fn multipliers(gait: &Gait) -> Table {
    // Six decimals, and of what is less than these some digits.
    let shown = |v: f64| if v != 0.0 && v.abs() < 1e-6 { format_number(v) } else { format!("{v:.6}") };
    let row = |m: &nalgebra::Complex<f64>| [m.norm(), m.re, m.im].map(shown).to_vec();
    Table {
        caption: "Multipliers: eigenvalues of the return map's derivative; the gait is stable where all have a magnitude below 1".to_owned(),
        header: texts(["magnitude", "real part", "imaginary part"]),
        rows: gait.multipliers.iter().map(row).collect(),
        names: false,
    }
}

fn parameters(study: &Study<'_>) -> Table {
    let spec = &study.loaded.spec;
    let row = |(p, &value): (&gaitc_compiler::ir::Parameter, &f64)| {
        let range = p.range.map_or_else(String::new, |(low, high)| {
            format!("{} to {}", format_quantity(low, &p.unit), format_quantity(high, &p.unit))
        });
        let changed = if value == p.value {
            String::new()
        } else {
            format!("in the spec: {}", format_quantity(p.value, &p.unit))
        };
        let doc = [p.doc.clone(), changed].into_iter().filter(|text| !text.is_empty()).collect::<Vec<_>>().join("; ");
        vec![p.name.clone(), format_quantity(value, &p.unit), range, doc]
    };
    let rows = spec.parameters.iter().zip(study.parameters).map(row).collect();
    Table {
        caption: "Values of this page".to_owned(),
        header: texts(["parameter", "value", "range", "what it is"]),
        rows,
        names: true,
    }
}

fn pictures(study: &Study<'_>, trajectory: Option<&Trajectory>) -> Result<Vec<Figure>, RequestError> {
    let mut figures = Vec::new();
    let mut add = |caption: &str, picture: Box<dyn crate::picture::Picture>| {
        figures.push(Figure { caption: caption.to_owned(), picture });
    };
    // Two steps, a left and a right one, show how each curve repeats.
    if let Some(trajectory) = study.follow(2)? {
        let run = Run { loaded: study.loaded, parameters: study.parameters, trajectory: &trajectory };
        let levels = |observation: &Observation| {
            study.gait().and_then(|gait| figures::mean(study.sheet, gait, observation)).into_iter().collect()
        };
        let extent = study.extent(&trajectory, 2);
        let series = run.over_time(&capital(&extent), &levels);
        if !series.panels.is_empty() {
            let lines = if series.events.is_empty() { "" } else { "; dashed vertical lines are transitions" };
            add(&format!("What the spec finds worth plotting, over {extent}{lines}."), Box::new(series));
        }
    }
    if let Some(trajectory) = trajectory
        && let Some(body) = body_path(&study.loaded.observations, study.parameters, trajectory)
    {
        let run = Run { loaded: study.loaded, parameters: study.parameters, trajectory };
        let title = format!("Path of the body over {}", study.extent(trajectory, study.steps));
        let links = if body.links.is_empty() { "" } else { "; links as they stand before and after transitions" };
        add(
            &format!("The body's path, to the same scale in both directions{links}."),
            Box::new(run.path(&title, &body)),
        );
    }
    if let Some(gait) = study.gait().filter(|gait| !gait.multipliers.is_empty()) {
        add("The multipliers of the gait.", Box::new(figures::multipliers(study.loaded, gait)));
    }
    if let Some(request) = study.request.as_ref().filter(|_| !study.loaded.coordinates().is_empty()) {
        let gait = study.gait().map(|gait| gait.coordinates.as_slice());
        let orbit = Orbit { map: figures::map_of(request, study.guess), start: study.guess, gait };
        let map = figures::return_map(study.loaded, &orbit)?;
        let which = if map.maps.len() == 1 { "the section's coordinate" } else { "each coordinate of the section" };
        let led = map.maps.first().is_some_and(|map| map.iterates.len() > 1);
        let where_to = if led { "Where the first guess leads" } else { "The first guess leads to no next step" };
        add(&format!("{where_to}: {which} against its next value."), Box::new(map));
    }
    Ok(figures)
}
