//! Branches put together: the first from its gait, the others from bifurcations of those before them.

use super::corrector::{is_regular, null_space};
use super::locate::Found;
use super::path::{Path, Walk};
use super::system::{Sample, System};
use super::{
    Bifurcation, Branch, ContinuationError, ContinuationOutcome, ContinuationRequest, Diagram, EndReason, Kind, Parent,
    Point, Settings,
};
use crate::orbit::{GaitRequest, GaitStatus, find_gait, multipliers, spectral_radius};
use crate::return_map::{MapOutcome, RequestError, ReturnMap};
use nalgebra::DVector;
use rayon::prelude::*;

/// A coordinate smaller than this (SI units) at the start says nothing of its size.
const NO_SIZE: f64 = 1e-6;
/// Points this close are the same, in scaled unknowns.
const SAME: f64 = 1e-4;

/// A branch as it is followed: all that its successors need.
struct Traced<'a> {
    system: System<'a>,
    path: Path,
    before: EndReason,
    start: usize,
    parent: Option<Parent>,
    doublings: usize,
    repeats_sooner: bool,
}

/// Follows the gait near `guess` (section coordinates, SI units) over the parameter's range.
///
/// # Errors
/// When the request is wrong. A gait that is not found, a branch that ends are results.
pub fn follow(
    map: &dyn ReturnMap,
    request: &ContinuationRequest<'_>,
    guess: &[f64],
) -> Result<ContinuationOutcome, ContinuationError> {
    let (lower, upper) = request.range;
    let start =
        *request.gait.parameters.get(request.parameter).ok_or(ContinuationError::Parameter(request.parameter))?;
    if !(lower.is_finite() && upper.is_finite() && lower < upper && (lower..=upper).contains(&start)) {
        return Err(ContinuationError::Range { lower, upper, start });
    }
    let outcome = find_gait(map, &GaitRequest { measures: false, ..request.gait }, guess)?;
    let Some(gait) = outcome.gait.as_ref().filter(|_| outcome.status == GaitStatus::Converged) else {
        return Ok(ContinuationOutcome::NoStart(Box::new(outcome)));
    };
    let size = |(z, guess): (&f64, &f64)| Some(z.abs().max(guess.abs())).filter(|size| *size > NO_SIZE).unwrap_or(1.0);
    let scale = DVector::from_iterator(guess.len(), gait.coordinates.iter().zip(guess).map(size));
    let system = System {
        map,
        request: request.gait,
        parameter: request.parameter,
        range: request.range,
        period: request.gait.period,
        scale,
        usual: gait.map.duration,
    };
    let s = if start == upper { 1.0 } else { (start - lower) / (upper - lower) };
    let y = gait.coordinates.component_div(&system.scale).insert_row(guess.len(), s);
    match system.evaluate(&y)? {
        Ok(sample) => Ok(ContinuationOutcome::Diagram(diagram(system, &request.settings, sample)?)),
        // It could be evaluated a moment ago.
        Err(_) => Ok(ContinuationOutcome::NoStart(Box::new(outcome))),
    }
}

fn diagram(system: System<'_>, settings: &Settings, start: Sample) -> Result<Diagram, RequestError> {
    let mut traced = vec![first(system, settings, start)?];
    let mut not_entered = Vec::new();
    let mut at = 0;
    while at < traced.len() {
        for bifurcation in 0..traced[at].path.found.len() {
            let wanted = match traced[at].path.found[bifurcation].kind {
                Kind::Flip => traced[at].doublings > 0,
                Kind::Branch => settings.branches,
                Kind::Fold | Kind::NeimarkSacker => false,
            };
            if !wanted || settings.interrupt.requested() || is_known(&traced, at, bifurcation)? {
                continue;
            }
            let parent = Parent { branch: at, bifurcation };
            let entered =
                if traced.len() < settings.branch_limit { enter(&traced[at], parent, settings)? } else { None };
            match entered {
                Some(branch) => traced.push(branch),
                None => not_entered.push(parent),
            }
        }
        at += 1;
    }
    let branches: Result<Vec<Branch>, RequestError> = traced.iter().map(|branch| branch.finished(settings)).collect();
    Ok(Diagram { branches: branches?, not_entered })
}

/// The branch through the start, in both directions.
fn first<'a>(system: System<'a>, settings: &Settings, mut start: Sample) -> Result<Traced<'a>, RequestError> {
    let repeats_sooner = system.repeats_sooner(&start)?;
    let (doublings, d) = (settings.doublings, start.coordinates());
    let direction = null_space(&start.matrix, 1).pop().filter(|_| is_regular(&start.matrix));
    let Some(direction) = direction else {
        let path = Path { samples: vec![start], found: Vec::new(), end: EndReason::NoDirection };
        return Ok(Traced {
            system,
            path,
            before: EndReason::NoDirection,
            start: 0,
            parent: None,
            doublings,
            repeats_sooner,
        });
    };
    start.tangent = if direction[d] < 0.0 { -direction } else { direction };
    let walk = Walk { system: &system, settings, period_can_halve: !repeats_sooner };
    let mut back = start.clone();
    back.tangent.neg_mut();
    let path = walk.follow(start, settings.initial)?;
    if path.end == EndReason::Closed {
        return Ok(Traced {
            system,
            path,
            before: EndReason::Closed,
            start: 0,
            parent: None,
            doublings,
            repeats_sooner,
        });
    }
    let before = walk.follow(back, settings.initial)?;
    let (path, start, before) = joined(before, path);
    Ok(Traced { system, path, before, start, parent: None, doublings, repeats_sooner })
}

/// Two paths from the same point as one; also the index of that point, and how the first ends.
fn joined(before: Path, mut after: Path) -> (Path, usize, EndReason) {
    let start = before.samples.len() - 1;
    let turned = |mut sample: Sample| {
        sample.tangent.neg_mut();
        sample
    };
    let mut samples: Vec<Sample> = before.samples.into_iter().rev().map(turned).collect();
    samples.extend(after.samples.drain(1..));
    // Between points i and i + 1 of the way back is between the points start - i - 1 and start - i of the whole.
    let mut found: Vec<Found> = before
        .found
        .into_iter()
        .rev()
        .map(|one| Found { after: start - one.after - 1, loses: !one.loses, sample: turned(one.sample), ..one })
        .collect();
    found.extend(after.found.into_iter().map(|one| Found { after: start + one.after, ..one }));
    (Path { samples, found, end: after.end }, start, before.end)
}

/// The branch that begins or crosses at a bifurcation.
fn enter<'a>(from: &Traced<'a>, parent: Parent, settings: &Settings) -> Result<Option<Traced<'a>>, RequestError> {
    let found = &from.path.found[parent.bifurcation];
    let doubles = found.kind == Kind::Flip;
    let period = from.system.period * if doubles { 2 } else { 1 };
    let system = from.system.with_period(period, &found.sample);
    // The bifurcation itself, as a point of the other branch.
    let Ok(mut origin) = system.evaluate(&system.rescaled(&from.system, &found.sample.y))? else {
        return Ok(None);
    };
    let repeats_sooner = !doubles && from.repeats_sooner;
    let [ahead, behind] = if doubles {
        [system.beside_flip(&found.sample, &from.system)?, None]
    } else {
        // Scaled unknowns are the branch's, up to factors: its direction is enough.
        let known = system.rescaled(&from.system, &found.sample.tangent).normalize();
        origin.tangent = known;
        system.beside_branch_point(&origin)?
    };
    let walk = Walk { system: &system, settings, period_can_halve: !repeats_sooner };
    let ahead = from_origin(&walk, &origin, ahead)?;
    let loops = ahead.as_ref().is_some_and(|path| path.end == EndReason::Closed);
    let behind = if loops { None } else { from_origin(&walk, &origin, behind)? };
    let (path, start, before) = match (behind, ahead) {
        (Some(behind), Some(ahead)) => joined(behind, ahead),
        (None, Some(path)) | (Some(path), None) => (path, 0, EndReason::Parent),
        (None, None) => return Ok(None),
    };
    let doublings = from.doublings - usize::from(doubles);
    Ok(Some(Traced { system, path, before, start, parent: Some(parent), doublings, repeats_sooner }))
}

/// The path from beside a bifurcation, with the bifurcation before it.
fn from_origin(walk: &Walk<'_, '_>, origin: &Sample, beside: Option<Sample>) -> Result<Option<Path>, RequestError> {
    let Some(sample) = beside else {
        return Ok(None);
    };
    let mut path = walk.follow(sample, walk.settings.initial)?;
    path.samples.insert(0, origin.clone());
    for found in &mut path.found {
        found.after += 1;
    }
    Ok(Some(path))
}

/// Whether the branch at a bifurcation has been followed already, from its other end or from another branch that it crosses.
fn is_known(traced: &[Traced<'_>], at: usize, bifurcation: usize) -> Result<bool, RequestError> {
    let from = &traced[at];
    let own = &from.path.found[bifurcation];
    let near = |other: &Traced<'_>, sample: &Sample| {
        (from.system.rescaled(&other.system, &sample.y) - &own.sample.y).norm() <= SAME
    };
    match own.kind {
        // A branch of twice the period that ends here.
        Kind::Flip => {
            let twice = traced.iter().filter(|t| t.system.period == 2 * from.system.period);
            let mut ends = twice.filter(|t| t.path.end == EndReason::PeriodHalved);
            for other in ends.by_ref() {
                let last = other.path.samples.last();
                // It may end at any of the points that the gait goes through.
                let mut y = last.map(|sample| from.system.rescaled(&other.system, &sample.y));
                for _ in 0..from.system.period {
                    if y.as_ref().is_some_and(|y| (y - &own.sample.y).norm() <= SAME) {
                        return Ok(true);
                    }
                    y = match y {
                        Some(y) => from.system.image(&y)?,
                        None => None,
                    };
                }
            }
            Ok(false)
        }
        // Both branches through it are there already.
        Kind::Branch => Ok(traced.iter().enumerate().any(|(i, other)| {
            let same_period = other.system.period == from.system.period;
            let crossing = other.path.found.iter().any(|f| f.kind == Kind::Branch && near(other, &f.sample));
            let origin = i != 0 && other.path.samples.get(other.start).is_some_and(|sample| near(other, sample));
            same_period && (origin || crossing && i != at)
        })),
        Kind::Fold | Kind::NeimarkSacker => Ok(true),
    }
}

impl System<'_> {
    /// The image of a point under one map.
    fn image(&self, y: &DVector<f64>) -> Result<Option<DVector<f64>>, RequestError> {
        let once = Self { period: 1, ..self.clone() };
        let gap = once.evaluate(y)?.ok().map(|sample| sample.gap.insert_row(self.scale.len(), 0.0));
        Ok(gap.map(|gap| y + gap))
    }

    /// A point for people, with its measures.
    fn point(&self, sample: &Sample) -> Result<Point, RequestError> {
        let count = self.map.info().measures.len();
        let measures = match self.run(&sample.y, true)? {
            MapOutcome::Completed(map) if map.measures.len() == count => map.measures,
            _ => DVector::from_element(count, f64::NAN),
        };
        let multipliers = multipliers(&sample.jacobian);
        Ok(Point {
            value: self.value(&sample.y),
            section: self.section(&sample.y),
            spectral_radius: spectral_radius(&multipliers),
            multipliers,
            measures,
            duration: sample.duration,
            residual: sample.residual,
        })
    }

    fn bifurcation(&self, found: &Found, settings: &Settings) -> Result<Bifurcation, RequestError> {
        let criticality = match found.kind {
            _ if settings.interrupt.requested() => None,
            Kind::Flip => self.with_period(2 * self.period, &found.sample).doubling(found, self)?,
            Kind::Branch => self.crossing(&found.sample)?,
            Kind::NeimarkSacker => self.swing(&found.sample)?,
            Kind::Fold => None,
        };
        Ok(Bifurcation { kind: found.kind, after: found.after, point: self.point(&found.sample)?, criticality })
    }
}

impl Traced<'_> {
    /// With measures, each point by itself: the result does not depend on the number of threads.
    fn finished(&self, settings: &Settings) -> Result<Branch, RequestError> {
        let points: Result<Vec<Point>, RequestError> =
            self.path.samples.par_iter().map(|sample| self.system.point(sample)).collect();
        let bifurcations: Result<Vec<Bifurcation>, RequestError> =
            self.path.found.par_iter().map(|found| self.system.bifurcation(found, settings)).collect();
        Ok(Branch {
            period: self.system.period,
            parent: self.parent,
            points: points?,
            start: self.start,
            bifurcations: bifurcations?,
            ends: [self.before.clone(), self.path.end.clone()],
            repeats_sooner: self.repeats_sooner,
        })
    }
}
