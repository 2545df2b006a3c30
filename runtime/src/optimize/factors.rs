//! Factors of the characteristic polynomial: groups of multipliers that are apart from each other, each with inequalities of
//! its own.
//!
//! The Jury inequality of complex pairs on the circle is a product over all pairs of multipliers, so its gradient vanishes
//! where two pairs get there together. With p = f g, f and g real and without a common root, the coefficients of f are
//! smooth functions of those of p: from dp = df g + f dg, a linear system that is singular only where f and g have a common
//! root. So the inequalities are imposed on each factor, and multipliers that come close to each other stay in one.

use nalgebra::{Complex, DMatrix, DVector, Dyn, LU};

/// From this dimension of the section on there is something to separate.
const FROM: usize = 4;
/// Multipliers closer than this, in units of the bound, are of one group; ...
const TOGETHER: f64 = 0.1;
/// ... those of one group that are farther from each other than this are so no longer.
const APART: f64 = 0.2;
/// Largest imaginary part of a coefficient that is rounding.
const ROUNDING: f64 = 1e-6;
/// Newton steps that bring a product of factors to the polynomial.
const CORRECTIONS: usize = 2;

/// Multipliers in groups, each closed under conjugation; in units of the bound.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Groups(Vec<Vec<Complex<f64>>>);

impl Groups {
    /// Whether a section of this dimension has more than one group.
    pub(super) fn matter(dimension: usize) -> bool {
        dimension >= FROM
    }

    /// All in one.
    pub(super) fn whole(roots: &[Complex<f64>]) -> Self {
        Self(vec![roots.to_vec()])
    }

    /// The same groups at multipliers nearby; `None` where that is not clear.
    pub(super) fn followed(&self, roots: &[Complex<f64>]) -> Option<Self> {
        let old: Vec<(usize, Complex<f64>)> =
            self.0.iter().enumerate().flat_map(|(g, group)| group.iter().map(move |z| (g, *z))).collect();
        if old.len() != roots.len() || !roots.iter().all(|z| z.re.is_finite() && z.im.is_finite()) {
            return None;
        }
        let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
        for (i, (_, before)) in old.iter().enumerate() {
            pairs.extend(roots.iter().enumerate().map(|(k, z)| ((before - z).norm(), i, k)));
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
        let mut groups = vec![Vec::new(); self.0.len()];
        let (mut matched, mut taken) = (vec![false; old.len()], vec![false; roots.len()]);
        for (_, i, k) in pairs {
            if !matched[i] && !taken[k] {
                (matched[i], taken[k]) = (true, true);
                groups[old[i].0].push(roots[k]);
            }
        }
        groups.iter().all(|group| real(group).is_some()).then_some(Self(groups))
    }

    /// Groups anew: those that have come close are joined, and those that have come apart separated.
    pub(super) fn settled(&self) -> Self {
        let all: Vec<(usize, Complex<f64>)> =
            self.0.iter().enumerate().flat_map(|(g, group)| group.iter().map(move |z| (g, *z))).collect();
        let mut label: Vec<usize> = (0..all.len()).collect();
        for i in 0..all.len() {
            for k in 0..i {
                let ((g, a), (h, b)) = (all[i], all[k]);
                let near = if g == h { APART } else { TOGETHER };
                if (a - b).norm().min((a - b.conj()).norm()) < near {
                    let (from, to) = (label[i], label[k]);
                    label.iter_mut().filter(|l| **l == from).for_each(|l| *l = to);
                }
            }
        }
        let mut groups: Vec<(usize, Vec<Complex<f64>>)> = Vec::new();
        for (l, (_, z)) in label.into_iter().zip(all) {
            match groups.iter_mut().find(|(known, _)| *known == l) {
                Some((_, group)) => group.push(z),
                None => groups.push((l, vec![z])),
            }
        }
        let groups = Self(groups.into_iter().map(|(_, group)| group).collect());
        if groups.0.iter().all(|group| real(group).is_some()) { groups } else { self.clone() }
    }

    /// The factors of a polynomial a_0 to a_n = 1 whose roots these are.
    pub(super) fn factors(&self, polynomial: &[f64]) -> Vec<Factor> {
        let separate = || -> Option<Vec<Factor>> {
            let all: Vec<Vec<f64>> = self.0.iter().map(|group| real(group)).collect::<Option<_>>()?;
            (0..all.len()).map(|k| Factor::of(&all, k, polynomial)).collect()
        };
        let whole = || vec![Factor { coefficients: polynomial.to_vec(), system: None }];
        if self.0.len() < 2 { whole() } else { separate().unwrap_or_else(whole) }
    }
}

/// A real factor of the characteristic polynomial.
pub(super) struct Factor {
    /// a_0 to a_k = 1.
    pub(super) coefficients: Vec<f64>,
    /// From the change of the whole polynomial to that of the factor; none for the whole.
    system: Option<LU<f64, Dyn, Dyn>>,
}

impl Factor {
    fn of(all: &[Vec<f64>], k: usize, polynomial: &[f64]) -> Option<Self> {
        let others = all.iter().enumerate().filter(|(i, _)| *i != k).map(|(_, factor)| factor);
        let mut rest = others.fold(vec![1.0], |rest, factor| product(&rest, factor));
        let mut own = all[k].clone();
        let n = polynomial.len() - 1;
        for _ in 0..CORRECTIONS {
            let now = product(&own, &rest);
            let missing = DVector::from_fn(n, |i, _| polynomial[i] - now[i]);
            let change = system(&own, &rest).solve(&missing)?;
            let count = own.len() - 1;
            own.iter_mut().zip(change.iter()).take(count).for_each(|(a, d)| *a += d);
            let left = rest.len() - 1;
            rest.iter_mut().zip(change.iter().skip(count)).take(left).for_each(|(a, d)| *a += d);
        }
        let system = system(&own, &rest);
        own.iter().all(|a| a.is_finite()).then_some(Self { coefficients: own, system: Some(system) })
    }

    /// Change of a_0 to a_(k-1) for one of the whole polynomial's a_0 to a_(n-1).
    pub(super) fn slope(&self, whole: &[f64]) -> Vec<f64> {
        let Some(system) = &self.system else { return whole.to_vec() };
        let change = system.solve(&DVector::from_column_slice(whole));
        change.map_or_else(Vec::new, |change| change.iter().take(self.coefficients.len() - 1).copied().collect())
    }
}

/// Of df and dg: df g + f dg, all by their coefficients from a_0 on.
fn system(f: &[f64], g: &[f64]) -> LU<f64, Dyn, Dyn> {
    let (own, rest) = (f.len() - 1, g.len() - 1);
    let at = |polynomial: &[f64], i: usize, shift: usize| {
        i.checked_sub(shift).and_then(|k| polynomial.get(k)).copied().unwrap_or(0.0)
    };
    DMatrix::from_fn(own + rest, own + rest, |i, j| if j < own { at(g, i, j) } else { at(f, i, j - own) }).lu()
}

/// The monic polynomial with these roots, a_0 to a_k = 1; `None` where it is not real.
fn real(roots: &[Complex<f64>]) -> Option<Vec<f64>> {
    let mut all = vec![Complex::new(1.0, 0.0)];
    for root in roots {
        let mut next = vec![Complex::new(0.0, 0.0); all.len() + 1];
        for (k, a) in all.iter().enumerate() {
            next[k + 1] += a;
            next[k] -= a * root;
        }
        all = next;
    }
    let size = all.iter().map(|a| a.re.abs()).fold(1.0, f64::max);
    all.iter().all(|a| a.im.abs() <= ROUNDING * size).then(|| all.iter().map(|a| a.re).collect())
}

fn product(a: &[f64], b: &[f64]) -> Vec<f64> {
    let mut all = vec![0.0; a.len() + b.len() - 1];
    for (i, a) in a.iter().enumerate() {
        for (k, b) in b.iter().enumerate() {
            all[i + k] += a * b;
        }
    }
    all
}

#[cfg(test)]
#[path = "factors_tests.rs"]
mod tests;
