//! Time integrals of sampled values: between two samples that of the cubic through them and their neighbours.

/// Nodes of Gauss' quadrature with two points on an interval from -1 to 1, exact for cubics.
const GAUSS: f64 = 0.577_350_269_189_625_8;
/// A neighbour that is nearer than this, in lengths of the interval, is passed over: the cubic would magnify rounding.
const NEAR: f64 = 0.2;

/// The integral of `v` from the first sample to each, starting at 0. Two samples at one time are both sides of a jump; cubics do
/// not reach over it.
pub(super) fn integral(t: &[f64], v: &[f64]) -> Vec<f64> {
    let count = t.len().min(v.len());
    let (t, v) = (&t[..count], &v[..count]);
    let mut all = Vec::with_capacity(count);
    let mut sum = 0.0;
    for i in 0..count {
        all.push(sum);
        if i + 1 < count && t[i + 1] > t[i] {
            sum += over(t, v, i);
        }
    }
    all
}

/// The integral from sample `i` to the next.
fn over(t: &[f64], v: &[f64], i: usize) -> f64 {
    let (start, end) = (t[i], t[i + 1]);
    let length = end - start;
    let mut nodes = vec![i, i + 1];
    let mut l = i;
    while l > 0 && t[l - 1] < t[l] {
        l -= 1;
        if start - t[l] >= NEAR * length {
            nodes.push(l);
            break;
        }
    }
    let mut r = i + 1;
    while r + 1 < t.len() && t[r + 1] > t[r] {
        r += 1;
        if t[r] - end >= NEAR * length {
            nodes.push(r);
            break;
        }
    }
    let (middle, half) = (0.5 * (start + end), 0.5 * length);
    half * (interpolated(t, v, &nodes, middle - GAUSS * half) + interpolated(t, v, &nodes, middle + GAUSS * half))
}

/// The polynomial through the samples `nodes`, at `at`.
fn interpolated(t: &[f64], v: &[f64], nodes: &[usize], at: f64) -> f64 {
    let basis = |n: usize| -> f64 { nodes.iter().filter(|m| **m != n).map(|&m| (at - t[m]) / (t[n] - t[m])).product() };
    nodes.iter().map(|&n| v[n] * basis(n)).sum()
}
