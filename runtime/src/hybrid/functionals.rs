//! Functionals of one map and their derivatives: integrals, means, values at the ends, extrema, duration.
//!
//! The place of an interior extremum moves with the parameters, but its value does not feel that (envelope theorem):
//! there d max = o_x v + o_p w + o_t s. At the ends of a segment the whole variation counts, with the event's time.

use crate::model::{Env, Functional, Model, ModelInfo, RateGradient};
use crate::scalar::filled;
use crate::sensitivity::dot;

/// One column of variations at a point: of state, parameters, tau and t.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Variation<'a, const N: usize, const P: usize> {
    /// Of the state.
    pub(crate) dx: &'a [f64; N],
    /// Of the rate.
    pub(crate) dk: &'a [f64; N],
    /// Of the parameters.
    pub(crate) dp: &'a [f64; P],
    /// Of tau.
    pub(crate) dtau: f64,
    /// Of t.
    pub(crate) dt: f64,
}

/// A value and its derivative along C columns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Varied<const C: usize> {
    /// The value.
    pub(crate) value: f64,
    /// Its derivatives.
    pub(crate) gradient: [f64; C],
}

/// The chain rule for a scalar function.
pub(crate) fn along<const N: usize, const P: usize>(g: &RateGradient<f64, N, P>, v: Variation<'_, N, P>) -> f64 {
    dot(&g.dx, v.dx) + rate_term(g, v.dk) + dot(&g.dp, v.dp) + g.dtau * v.dtau + g.dt * v.dt
}

/// The part of the rates; a rate that does not matter must not spoil it by not being known.
fn rate_term<const N: usize, const P: usize>(g: &RateGradient<f64, N, P>, dk: &[f64; N]) -> f64 {
    let mut sum = 0.0;
    for i in 0..N {
        if g.dk[i] != 0.0 {
            sum += g.dk[i] * dk[i];
        }
    }
    sum
}

/// An extremum that is being looked for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extremum<const C: usize> {
    /// Index into the functionals.
    pub(crate) functional: usize,
    /// Index of the observable.
    pub(crate) observable: usize,
    /// 1 for a maximum, -1 for a minimum.
    pub(crate) sense: f64,
    /// The best so far, not multiplied with `sense`.
    pub(crate) best: Option<Varied<C>>,
}

impl<const C: usize> Extremum<C> {
    /// Takes a candidate if it is better than the best so far.
    fn offer(&mut self, candidate: Varied<C>) {
        let better = self.best.is_none_or(|best| self.sense * candidate.value > self.sense * best.value);
        if better || candidate.value.is_nan() {
            self.best = Some(candidate);
        }
    }
}

/// A place where an extremum could be taken.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Offered<const C: usize> {
    /// Index into the functionals.
    pub(crate) functional: usize,
    /// Time since the start of the map (s).
    pub(crate) time: f64,
    /// The observable there.
    pub(crate) varied: Varied<C>,
}

/// The functionals that are not plain integrals, as far as they are known.
#[derive(Clone, Debug, Default)]
pub(crate) struct Functionals<const C: usize> {
    /// Extrema over the whole map.
    pub(crate) extrema: Vec<Extremum<C>>,
    /// All places that were offered, where they are wanted.
    pub(crate) offered: Option<Vec<Offered<C>>>,
    /// Values at the start of the map: functional, value.
    starts: Vec<(usize, Varied<C>)>,
    /// Values at the end of the map: functional, value.
    ends: Vec<(usize, Varied<C>)>,
}

impl<const C: usize> Functionals<C> {
    /// Those of a model; none when they are not wanted.
    pub(crate) fn new(info: &ModelInfo, wanted: bool) -> Self {
        let mut extrema = Vec::new();
        for (functional, kind) in info.functionals.iter().enumerate().filter(|_| wanted) {
            let (observable, sense) = match *kind {
                Functional::Maximum(o) => (o, 1.0),
                Functional::Minimum(o) => (o, -1.0),
                _ => continue,
            };
            extrema.push(Extremum { functional, observable, sense, best: None });
        }
        Self { extrema, offered: None, starts: Vec::new(), ends: Vec::new() }
    }

    /// Offers extremum number `number` the observable at a place.
    pub(crate) fn offer(&mut self, number: usize, time: f64, varied: Varied<C>) {
        let Some(extremum) = self.extrema.get_mut(number) else { return };
        extremum.offer(varied);
        let functional = extremum.functional;
        if let Some(offered) = &mut self.offered {
            offered.push(Offered { functional, time, varied });
        }
    }

    /// Records the observables of all `Start` functionals.
    pub(crate) fn record_start(&mut self, info: &ModelInfo, observe: impl Fn(usize) -> Varied<C>) {
        for (functional, kind) in info.functionals.iter().enumerate() {
            if let Functional::Start(o) = *kind {
                self.starts.push((functional, observe(o)));
            }
        }
    }

    /// Records the observables of all `End` functionals.
    pub(crate) fn record_end(&mut self, info: &ModelInfo, observe: impl Fn(usize) -> Varied<C>) {
        for (functional, kind) in info.functionals.iter().enumerate() {
            if let Functional::End(o) = *kind {
                self.ends.push((functional, observe(o)));
            }
        }
    }

    /// All functionals in the model's order, from the integrals and the duration of the map.
    pub(crate) fn finish(
        &self,
        info: &ModelInfo,
        integral: impl Fn(usize) -> Varied<C>,
        duration: Varied<C>,
    ) -> Vec<Varied<C>> {
        let recorded = |list: &[(usize, Varied<C>)], i| list.iter().find(|(f, _)| *f == i).map(|(_, v)| *v);
        let missing = Varied { value: f64::NAN, gradient: [f64::NAN; C] };
        let one = |(i, kind): (usize, &Functional)| match *kind {
            Functional::Integral(k) => integral(k),
            Functional::Mean(k) => quotient(integral(k), duration),
            Functional::Start(_) => recorded(&self.starts, i).unwrap_or(missing),
            Functional::End(_) => recorded(&self.ends, i).unwrap_or(missing),
            Functional::Maximum(_) | Functional::Minimum(_) => {
                self.extrema.iter().find(|e| e.functional == i).and_then(|e| e.best).unwrap_or(missing)
            }
            Functional::Duration => duration,
        };
        info.functionals.iter().enumerate().map(one).collect()
    }
}

fn quotient<const C: usize>(a: Varied<C>, b: Varied<C>) -> Varied<C> {
    let value = a.value / b.value;
    Varied { value, gradient: filled(0.0, |c| (a.gradient[c] - value * b.gradient[c]) / b.value) }
}

/// An observable with its derivatives along columns given by `variation`.
pub(crate) fn observe<M: Model<N, P, Q>, const N: usize, const P: usize, const Q: usize, const C: usize>(
    index: usize,
    mode: usize,
    (x, k): (&[f64; N], &[f64; N]),
    env: &Env<'_, f64, P>,
    gradient: impl Fn(&RateGradient<f64, N, P>, usize) -> f64,
) -> Varied<C> {
    let g = M::observable_gradient(index, mode, x, k, env);
    Varied { value: g.value, gradient: filled(0.0, |c| gradient(&g, c)) }
}
