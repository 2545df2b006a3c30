//! Hybrid return maps: flow, events, resets, with exact first derivatives, for any compiled model.
//!
//! [`Hybrid`] implements the object-safe [`ReturnMap`] on top of [`Model`]. All inner loops are compiled for the model
//! and for the number of sensitivity columns (padded to the next width in store; more columns take several passes).

mod extremum;
mod follow;
mod functionals;
mod landing;
mod map;
mod passing;
mod replays;
mod request;
mod resolution;
mod run;
mod segment;
mod tracing;

use crate::collocation;
use crate::integrate;
use crate::integrate::{Bare, Carried, Explicit, Radau, Whole};
use crate::model::{Model, ModelInfo, Section};
use crate::replay::Record;
use crate::return_map::{
    AlsoZeroAt, Images, MapOutcome, MapRequest, MapResult, Method, Piece, PieceEnd, Plan, Points, RequestError,
    ReturnMap, SecondOrder, Sensitivity, Stop, StopReason,
};
use crate::trajectory::{FollowRequest, Trajectory};
use core::marker::PhantomData;
use functionals::{Functionals, Varied};
use map::{Coordinates, Reached};
use nalgebra::{DMatrix, DVector};
pub(crate) use passing::GRAZING;
pub(crate) use resolution::{FAR, MISFIT, PLACES};
use run::Run;

/// The largest numbers of columns in one pass. Each width is compiled for each model, so there are few.
const WIDEST_BARE: usize = 4;
const WIDEST_WHOLE: usize = 8;
/// A section of more coordinates than this takes the widest pass.
const NARROW: usize = 2;

/// The return map of a compiled model.
#[derive(Clone, Copy, Debug, Default)]
pub struct Hybrid<M, const N: usize, const P: usize, const Q: usize>(pub PhantomData<M>);

impl<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize> Hybrid<M, N, P, Q> {
    /// The return map of `M`.
    pub const fn new() -> Self {
        const {
            assert!(M::INFO.states.len() == N, "number of states");
            assert!(M::INFO.parameters.len() == P, "number of parameters");
            assert!(M::INFO.coordinates.len() <= N, "more section coordinates than states");
        }
        Self(PhantomData)
    }

    fn evaluate_columns(
        &self,
        request: &MapRequest<'_>,
        section: Section,
        method: Method,
    ) -> Result<MapResult, Failure> {
        let coordinates = M::INFO.coordinates.len();
        let (count, chosen): (usize, &[usize]) = match request.sensitivity {
            Sensitivity::None => (0, &[]),
            Sensitivity::Coordinates => (coordinates, &[]),
            Sensitivity::CoordinatesAndParameters(chosen) => (coordinates + chosen.len(), chosen),
        };
        let mut result: Option<MapResult> = None;
        let mut first = 0;
        let bare = !request.measures && chosen.is_empty();
        loop {
            let width = (count - first).min(if bare { WIDEST_BARE } else { WIDEST_WHOLE });
            let columns = Columns { first, width, coordinates, chosen, bare, recorded: false };
            let part = match method {
                Method::Explicit | Method::Automatic => explicit::<M, N, P, Q>(request, section, columns),
                Method::Radau5 => radau5::<M, N, P, Q>(request, section, columns),
                Method::Radau3 => radau3::<M, N, P, Q>(request, section, columns),
            };
            let (part, _) = part?;
            result = Some(match result {
                None => part,
                Some(all) => append(all, part),
            });
            first += width;
            if first >= count {
                break;
            }
        }
        result.ok_or_else(Failure::impossible)
    }
}

impl<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize> ReturnMap for Hybrid<M, N, P, Q> {
    fn info(&self) -> &'static ModelInfo {
        M::INFO
    }

    fn evaluate(&self, request: &MapRequest<'_>) -> Result<MapOutcome, RequestError> {
        let section = request::check(M::INFO, request)?;
        let asked = request.accuracy.method;
        let first = match asked {
            Method::Automatic if M::INFO.explicit => Method::Explicit,
            Method::Automatic => Method::Radau5,
            method => method,
        };
        let mut result = self.evaluate_columns(request, section, first);
        if asked == Method::Automatic && result.as_ref().is_err_and(|failure| failure.stiff) {
            result = self.evaluate_columns(request, section, Method::Radau5);
        }
        Ok(match result {
            Ok(result) => MapOutcome::Completed(Box::new(result)),
            Err(failure) => MapOutcome::Stopped(failure.stop),
        })
    }

    fn plan(&self, request: &MapRequest<'_>) -> Result<(MapOutcome, Option<Plan>), RequestError> {
        replays::plan(self, request)
    }

    fn replay(&self, plan: &Plan, points: Points<'_>, images: &mut Images) -> Result<(), RequestError> {
        replays::replay::<M, N, P, Q>(plan, points, images)
    }

    fn piece(&self, piece: &Piece, start: &[f64], parameters: &[f64]) -> Result<Option<PieceEnd>, RequestError> {
        replays::piece::<M, N, P, Q>(piece, start, parameters)
    }

    fn second_order(
        &self,
        plan: &Plan,
        point: Points<'_>,
        chosen: &[usize],
    ) -> Result<Option<SecondOrder>, RequestError> {
        replays::second_order::<M, N, P, Q>(plan, point, chosen)
    }

    fn follow(&self, request: &FollowRequest<'_>) -> Result<Trajectory, RequestError> {
        follow::follow::<M, N, P, Q>(request)
    }

    fn collocate(
        &self,
        request: &MapRequest<'_>,
        stretches: &[f64],
        steps: usize,
    ) -> Result<Option<DVector<f64>>, RequestError> {
        let section = request::check(M::INFO, request)?;
        let Ok(p) = <&[f64; P]>::try_from(request.parameters) else {
            return Ok(None);
        };
        let image = collocation::image::<M, N, P, Q>(
            section,
            (request.coordinates, p),
            (request.memory, request.period),
            (stretches, steps),
        );
        Ok(image.map(DVector::from_vec))
    }
}

/// The sensitivity columns of one pass: `width` from number `first`, out of coordinates, then chosen parameters.
#[derive(Clone, Copy, Debug)]
struct Columns<'a> {
    first: usize,
    width: usize,
    coordinates: usize,
    chosen: &'a [usize],
    bare: bool,
    recorded: bool,
}

/// A pass that did not reach the section, and whether stiffness is to blame.
struct Failure {
    stop: Stop,
    stiff: bool,
}

impl Failure {
    /// For widths that are never asked for.
    fn impossible() -> Self {
        Self { stop: Stop { reason: StopReason::NotFinite, time: 0.0, state: Vec::new() }, stiff: false }
    }
}

macro_rules! widths {
    ($method:ty, $kind:ty, $w:expr, $arguments:expr; $($c:literal),+) => {{
        let (request, section, columns) = $arguments;
        match columns.width {
            $(width if width <= $c => pass::<$method, M, $kind, N, P, Q, { $w }, $c>(request, section, columns),)+
            _ => Err(Failure::impossible()),
        }
    }};
}

fn explicit<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    request: &MapRequest<'_>,
    section: Section,
    columns: Columns<'_>,
) -> Result<(MapResult, Option<Plan>), Failure> {
    // Nothing of it is compiled for models that have no explicit flow.
    if const { !M::INFO.explicit } {
        return Err(Failure::impossible());
    }
    if !columns.bare {
        return widths!(Explicit, Whole, Q, (request, section, columns); 8);
    }
    // Without parameters there are no more columns than coordinates.
    if const { M::INFO.coordinates.len() <= NARROW } {
        widths!(Explicit, Bare, 0, (request, section, columns); 0, 2)
    } else {
        widths!(Explicit, Bare, 0, (request, section, columns); 0, 4)
    }
}

/// One width for each kind: the method solves for the columns in use only, and compiles slowly. Models with an explicit flow
/// come here when they are stiff, or to check the other method.
fn radau5<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    request: &MapRequest<'_>,
    section: Section,
    columns: Columns<'_>,
) -> Result<(MapResult, Option<Plan>), Failure> {
    if !columns.bare || const { M::INFO.explicit } {
        return widths!(Radau<5>, Whole, Q, (request, section, columns); 8);
    }
    if const { M::INFO.coordinates.len() <= NARROW } {
        widths!(Radau<5>, Bare, 0, (request, section, columns); 2)
    } else {
        widths!(Radau<5>, Bare, 0, (request, section, columns); 4)
    }
}

/// One width for all: it is there to check the other method where that is the only one that fits, and costs time to compile.
fn radau3<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    request: &MapRequest<'_>,
    section: Section,
    columns: Columns<'_>,
) -> Result<(MapResult, Option<Plan>), Failure> {
    if const { M::INFO.explicit } {
        return Err(Failure::impossible());
    }
    widths!(Radau<3>, Whole, Q, (request, section, columns); 8)
}

fn pass<X, M, R, const N: usize, const P: usize, const Q: usize, const W: usize, const C: usize>(
    request: &MapRequest<'_>,
    section: Section,
    columns: Columns<'_>,
) -> Result<(MapResult, Option<Plan>), Failure>
where
    X: integrate::Method,
    M: Model<N, P, Q>,
    R: Carried<M, N, P, Q, W, C>,
{
    let mut p = [0.0; P];
    p.copy_from_slice(request.parameters);
    let mut at = Coordinates { z: [0.0; N], dz: [[0.0; N]; C] };
    at.z[..request.coordinates.len()].copy_from_slice(request.coordinates);
    let mut dp = [[0.0; P]; C];
    for c in 0..columns.width.min(C) {
        let column = columns.first + c;
        if column < columns.coordinates {
            at.dz[c][column] = 1.0;
        } else if let Some(&parameter) = columns.chosen.get(column - columns.coordinates) {
            dp[c][parameter] = 1.0;
        }
    }
    let functionals = Functionals::new(M::INFO, request.measures);
    let mut run = Run::<X, M, R, N, P, Q, W, C>::new(request.accuracy, &p, (dp, columns.width), functionals);
    run.record = columns.recorded.then(Record::default);
    match run.map(request, section, at) {
        Ok(reached) => {
            let plan = run.record.take().and_then(|record| record.plan(M::INFO, request.accuracy));
            Ok((gather(&run, request, columns, &reached), plan))
        }
        Err(reason) => {
            let stop = Stop { reason, time: run.time(), state: run.step.start.x.to_vec() };
            Err(Failure { stop, stiff: run.stiff() })
        }
    }
}

fn gather<X, M, R, const N: usize, const P: usize, const Q: usize, const W: usize, const C: usize>(
    run: &Run<'_, X, M, R, N, P, Q, W, C>,
    request: &MapRequest<'_>,
    columns: Columns<'_>,
    reached: &Reached<N, C>,
) -> MapResult
where
    X: integrate::Method,
    M: Model<N, P, Q>,
    R: Carried<M, N, P, Q, W, C>,
{
    let (d, width) = (columns.coordinates, columns.width.min(C));
    let duration = run.duration();
    let functionals = if request.measures { run.functionals() } else { Vec::new() };
    let (measures, measures_jacobian) = if request.measures {
        measures::<M, N, P, Q, C>(&functionals, &run.segment.dp, run.segment.p, width)
    } else {
        (DVector::zeros(0), DMatrix::zeros(0, width))
    };
    MapResult {
        coordinates: DVector::from_fn(d, |i, _| reached.at.z[i]),
        jacobian: DMatrix::from_fn(d, width, |i, c| reached.at.dz[c][i]),
        state: DVector::from_column_slice(&reached.first),
        end: DVector::from_column_slice(&reached.end),
        duration: duration.value,
        duration_gradient: DVector::from_fn(width, |c, _| duration.gradient[c]),
        measures,
        measures_jacobian,
        events: run.events.clone(),
        also_zero: also_zero(M::INFO, &functionals),
        method: X::KIND,
        statistics: run.statistics,
        warnings: run.warnings.clone(),
    }
}

/// The functions that vanish with a guard, from their functionals.
fn also_zero<const C: usize>(info: &ModelInfo, functionals: &[Varied<C>]) -> Vec<AlsoZeroAt> {
    let value = |i: usize| functionals.get(i).map(|f| f.value);
    let listed = info.transitions.iter().enumerate().flat_map(|(transition, t)| {
        t.also_zero.iter().enumerate().map(move |(index, listed)| (transition, index, listed))
    });
    listed
        .filter_map(|(transition, index, listed)| {
            let (start, end, rate) = (value(listed.start)?, value(listed.end)?, value(listed.rate)?);
            Some(AlsoZeroAt { transition, index, start, end, rate })
        })
        .collect()
}

/// Measures and their derivatives along the columns, by the chain rule.
fn measures<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize, const C: usize>(
    functionals: &[Varied<C>],
    dp: &[[f64; P]; C],
    p: &[f64; P],
    width: usize,
) -> (DVector<f64>, DMatrix<f64>) {
    let values: Vec<f64> = functionals.iter().map(|f| f.value).collect();
    let (m, f) = (M::INFO.measures.len(), values.len());
    let mut measures = vec![0.0; m];
    M::measures(&values, p, &mut measures);
    let mut by_functional = vec![0.0; m * f];
    let mut by_parameter = vec![[0.0; P]; m];
    if width > 0 {
        M::measures_jacobian(&values, p, &mut by_functional, &mut by_parameter);
    }
    let jacobian = DMatrix::from_fn(m, width, |i, c| {
        let mut sum = 0.0;
        for j in 0..f {
            let slope = by_functional[i * f + j];
            // A functional that a measure does not depend on must not spoil it.
            if slope != 0.0 {
                sum += slope * functionals[j].gradient[c];
            }
        }
        for j in 0..P {
            sum += by_parameter[i][j] * dp[c][j];
        }
        sum
    });
    (DVector::from_vec(measures), jacobian)
}

/// Appends the columns of a further pass of the same map.
fn append(mut all: MapResult, part: MapResult) -> MapResult {
    let side_by_side = |a: &DMatrix<f64>, b: &DMatrix<f64>| {
        DMatrix::from_fn(a.nrows(), a.ncols() + b.ncols(), |i, j| {
            if j < a.ncols() { a[(i, j)] } else { b[(i, j - a.ncols())] }
        })
    };
    all.jacobian = side_by_side(&all.jacobian, &part.jacobian);
    all.measures_jacobian = side_by_side(&all.measures_jacobian, &part.measures_jacobian);
    let split = all.duration_gradient.len();
    all.duration_gradient = DVector::from_fn(split + part.duration_gradient.len(), |c, _| {
        if c < split { all.duration_gradient[c] } else { part.duration_gradient[c - split] }
    });
    all.statistics.steps += part.statistics.steps;
    all.statistics.rejected += part.statistics.rejected;
    all.statistics.evaluations += part.statistics.evaluations;
    all
}
