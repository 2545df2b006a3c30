//! Hybrid return maps: flow, events, resets, with exact first derivatives, for any compiled model.
//!
//! [`Hybrid`] implements the object-safe [`ReturnMap`] on top of [`Model`]. All inner loops are compiled for the model
//! and for the number of sensitivity columns (padded to the next width in store; more columns take several passes).

mod candidates;
mod extremum;
mod follow;
mod functionals;
mod gather;
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
    Candidate, Images, MapOutcome, MapRequest, MapResult, Method, Piece, PieceEnd, Plan, Points, RequestError,
    ReturnMap, SecondOrder, Sensitivity, Stop, StopReason,
};
use crate::trajectory::{FollowRequest, Trajectory};
use core::marker::PhantomData;
use functionals::Functionals;
use gather::{append, gather};
use map::Coordinates;
use nalgebra::DVector;
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
        kept: Kept,
    ) -> Result<(MapResult, Vec<Candidate>), Failure> {
        let coordinates = M::INFO.coordinates.len();
        let (count, chosen): (usize, &[usize]) = match request.sensitivity {
            Sensitivity::None => (0, &[]),
            Sensitivity::Coordinates => (coordinates, &[]),
            Sensitivity::CoordinatesAndParameters(chosen) => (coordinates + chosen.len(), chosen),
        };
        let mut result: Option<(MapResult, Vec<Candidate>)> = None;
        let mut first = 0;
        let bare = !request.measures && chosen.is_empty();
        loop {
            let width = (count - first).min(if bare { WIDEST_BARE } else { WIDEST_WHOLE });
            let columns = Columns { first, width, coordinates, chosen, bare, kept };
            let part = match method {
                Method::Explicit | Method::Automatic => explicit::<M, N, P, Q>(request, section, columns),
                Method::Radau5 => radau5::<M, N, P, Q>(request, section, columns),
                Method::Radau3 => radau3::<M, N, P, Q>(request, section, columns),
            };
            let (part, extra) = part?;
            result = Some(match result {
                None => (part, extra.candidates),
                Some((all, places)) => (append(all, part), candidates::append(places, &extra.candidates)),
            });
            first += width;
            if first >= count {
                break;
            }
        }
        result.ok_or_else(Failure::impossible)
    }

    /// The map by the method that is asked for, or that fits; with the candidates for its extrema where these are kept.
    fn evaluate_keeping(
        &self,
        request: &MapRequest<'_>,
        kept: Kept,
    ) -> Result<(MapOutcome, Vec<Candidate>), RequestError> {
        let section = request::check(M::INFO, request)?;
        let asked = request.accuracy.method;
        let first = match asked {
            Method::Automatic if M::INFO.explicit => Method::Explicit,
            Method::Automatic => Method::Radau5,
            method => method,
        };
        let mut result = self.evaluate_columns(request, section, first, kept);
        if asked == Method::Automatic && result.as_ref().is_err_and(|failure| failure.stiff) {
            result = self.evaluate_columns(request, section, Method::Radau5, kept);
        }
        Ok(match result {
            Ok((result, candidates)) => (MapOutcome::Completed(Box::new(result)), candidates),
            Err(failure) => (MapOutcome::Stopped(failure.stop), Vec::new()),
        })
    }
}

impl<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize> ReturnMap for Hybrid<M, N, P, Q> {
    fn info(&self) -> &'static ModelInfo {
        M::INFO
    }

    fn evaluate(&self, request: &MapRequest<'_>) -> Result<MapOutcome, RequestError> {
        Ok(self.evaluate_keeping(request, Kept::Nothing)?.0)
    }

    fn candidates(&self, request: &MapRequest<'_>) -> Result<(MapOutcome, Vec<Candidate>), RequestError> {
        self.evaluate_keeping(request, if request.measures { Kept::Candidates } else { Kept::Nothing })
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
    kept: Kept,
}

/// What a pass keeps besides its result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kept {
    Nothing,
    /// What a plan is made of.
    Plan,
    /// Where extrema could have been taken.
    Candidates,
}

/// What was kept.
struct Extra {
    plan: Option<Plan>,
    candidates: Vec<Candidate>,
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
) -> Result<(MapResult, Extra), Failure> {
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
) -> Result<(MapResult, Extra), Failure> {
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
) -> Result<(MapResult, Extra), Failure> {
    if const { M::INFO.explicit } {
        return Err(Failure::impossible());
    }
    widths!(Radau<3>, Whole, Q, (request, section, columns); 8)
}

fn pass<X, M, R, const N: usize, const P: usize, const Q: usize, const W: usize, const C: usize>(
    request: &MapRequest<'_>,
    section: Section,
    columns: Columns<'_>,
) -> Result<(MapResult, Extra), Failure>
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
    let mut functionals = Functionals::new(M::INFO, request.measures);
    functionals.offered = (columns.kept == Kept::Candidates).then(Vec::new);
    let mut run = Run::<X, M, R, N, P, Q, W, C>::new(request.accuracy, &p, (dp, columns.width), functionals);
    run.record = (columns.kept == Kept::Plan).then(Record::default);
    match run.map(request, section, at) {
        Ok(reached) => {
            let plan = run.record.take().and_then(|record| record.plan(M::INFO, request.accuracy));
            let candidates = match columns.kept {
                Kept::Candidates => candidates::gather(&run, columns.width.min(C)),
                Kept::Nothing | Kept::Plan => Vec::new(),
            };
            Ok((gather(&run, request, columns, &reached), Extra { plan, candidates }))
        }
        Err(reason) => {
            let stop = Stop { reason, time: run.time(), state: run.step.start.x.to_vec() };
            Err(Failure { stop, stiff: run.stiff() })
        }
    }
}
