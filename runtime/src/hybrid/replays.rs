//! Plans and replays of a compiled model's return map.

use super::{Columns, Hybrid, Kept, explicit, request};
use crate::model::{Model, ModelInfo, Section};
use crate::replay::{
    Checks, Images, Piece, PieceEnd, Plan, Points, SecondOrder, run_piece, second_order as along_pairs, side_by_side,
};
use crate::return_map::{MapOutcome, MapRequest, Method, RequestError, ReturnMap};
use crate::scalar::{Lanes, Real, filled};

/// So many maps take longer one by one than in lanes, some of which stay idle.
const WORTH_LANES: usize = 3;

/// Runs a map and keeps its plan, if there is one.
pub(super) fn plan<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    map: &Hybrid<M, N, P, Q>,
    request: &MapRequest<'_>,
) -> Result<(MapOutcome, Option<Plan>), RequestError> {
    let section = request::check(M::INFO, request)?;
    let width = M::INFO.coordinates.len();
    let by_explicit = M::INFO.explicit && matches!(request.accuracy.method, Method::Automatic | Method::Explicit);
    if by_explicit && !request.measures && width <= super::WIDEST_BARE {
        let columns = Columns { first: 0, width, coordinates: width, chosen: &[], bare: true, kept: Kept::Plan };
        match explicit::<M, N, P, Q>(request, section, columns) {
            Ok((result, extra)) => {
                let plan = extra.plan;
                let plan = plan.filter(|_| result.warnings.is_empty());
                let plan = plan.and_then(|plan| spread::<M, N, P, Q>(plan, request));
                return Ok((MapOutcome::Completed(Box::new(result)), plan));
            }
            Err(failure) if !failure.stiff => return Ok((MapOutcome::Stopped(failure.stop), None)),
            Err(_) => {}
        }
    }
    Ok((map.evaluate(request)?, None))
}

/// Maps near the one of a plan are to hold, too: its own has to be so much more exact.
const MARGIN: f64 = 0.5;

/// The same plan with fewer steps, where that is exact enough; none where it does not hold as it is.
fn spread<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    plan: Plan,
    request: &MapRequest<'_>,
) -> Option<Plan> {
    let points = Points { coordinates: request.coordinates, parameters: request.parameters };
    let mut images = Images::default();
    let mut holds =
        |plan: &Plan| replay::<M, N, P, Q>(plan, points, &mut images).is_ok() && images.held.iter().all(|held| *held);
    let found = plan.spread().find(|spread| {
        let mut strict = Plan { checks: Checks::Trial, ..spread.clone() };
        strict.accuracy.relative *= MARGIN;
        strict.accuracy.absolute *= MARGIN;
        holds(&strict)
    });
    found.or_else(|| Some(plan).filter(|plan| holds(plan)))
}

/// Replays a plan at all points.
pub(super) fn replay<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    plan: &Plan,
    points: Points<'_>,
    images: &mut Images,
) -> Result<(), RequestError> {
    let section = check(M::INFO, plan)?;
    let (count, d) = (points.count(M::INFO)?, M::INFO.coordinates.len());
    images.make_room(count, d);
    if const { !M::INFO.explicit } {
        return Ok(());
    }
    // As many columns as coordinates: each that is idle would cost as much as one that is not.
    if const { M::INFO.coordinates.len() <= 1 } {
        points_of::<M, N, P, Q, 1>(plan, section, points, count, images);
    } else if const { M::INFO.coordinates.len() == 2 } {
        points_of::<M, N, P, Q, 2>(plan, section, points, count, images);
    } else if const { M::INFO.coordinates.len() == 3 } {
        points_of::<M, N, P, Q, 3>(plan, section, points, count, images);
    } else {
        points_of::<M, N, P, Q, 4>(plan, section, points, count, images);
    }
    Ok(())
}

/// Side by side in lanes as far as that pays. A lane has the bits of a single number, so that it does not show.
fn points_of<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize, const C: usize>(
    plan: &Plan,
    section: Section,
    points: Points<'_>,
    count: usize,
    images: &mut Images,
) {
    let points = &points.rows(M::INFO.coordinates.len(), P);
    let mut first = 0;
    while first < count {
        if count - first >= WORTH_LANES {
            side_by_side::<M, Lanes, N, P, Q, C>(plan, section, points, first, images);
            first += <Lanes as Real>::LANES;
        } else {
            side_by_side::<M, f64, N, P, Q, C>(plan, section, points, first, images);
            first += 1;
        }
    }
}

/// Runs a piece of a plan.
pub(super) fn piece<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    piece: &Piece,
    start: &[f64],
    parameters: &[f64],
) -> Result<Option<PieceEnd>, RequestError> {
    let section = check(M::INFO, &piece.plan)?;
    let expected = if piece.from_section { M::INFO.coordinates.len() } else { N };
    if start.len() != expected {
        return Err(RequestError::Length { what: "start of a piece", expected, got: start.len() });
    }
    let Ok(p) = <&[f64; P]>::try_from(parameters) else {
        return Err(RequestError::Length { what: "parameters", expected: P, got: parameters.len() });
    };
    if const { !M::INFO.explicit } {
        return Ok(None);
    }
    Ok(if const { M::INFO.coordinates.len() <= super::NARROW } {
        run_piece::<M, N, P, Q, 2>(piece, section, start, p)
    } else {
        run_piece::<M, N, P, Q, 4>(piece, section, start, p)
    })
}

/// Second derivatives at a point.
pub(super) fn second_order<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize>(
    plan: &Plan,
    point: Points<'_>,
    chosen: &[usize],
) -> Result<Option<SecondOrder>, RequestError> {
    let section = check(M::INFO, plan)?;
    let count = point.count(M::INFO)?;
    if count != 1 {
        return Err(RequestError::Length { what: "points for second derivatives", expected: 1, got: count });
    }
    if let Some(&worst) = chosen.iter().find(|i| **i >= P) {
        let what = "a parameter index of the second derivatives (counted from 0) is out of range: number of parameters";
        return Err(RequestError::Length { what, expected: P, got: worst });
    }
    if const { !M::INFO.explicit } {
        return Ok(None);
    }
    let mut images = Images::default();
    replay::<M, N, P, Q>(plan, point, &mut images)?;
    if !images.held.iter().all(|held| *held) {
        return Ok(None);
    }
    let rows = point.rows(M::INFO.coordinates.len(), P);
    let p: [f64; P] = filled(0.0, |i| rows.parameter(0, i));
    Ok(Some(along_pairs::<M, N, P, Q>(plan, section, point.coordinates, &p, chosen)))
}

fn check(info: &'static ModelInfo, plan: &Plan) -> Result<Section, RequestError> {
    // The same equations: names alone would not do.
    if plan.info.fingerprint != info.fingerprint || plan.info.name != info.name {
        return Err(RequestError::ForeignPlan { made_for: plan.info.name, given_to: info.name });
    }
    info.section.ok_or(RequestError::NoSection(info.name))
}
