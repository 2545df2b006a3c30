//! Root of a continuous function in a bracket, to the last bits.
//!
//! The method of Illinois (a false position that halves the weight of an end that stays), with bisection whenever two
//! steps did not halve the bracket.

const ITERATIONS: usize = 200;

/// A zero of `f` between `a` and `b`, where `fa` and `fb` have opposite signs (or one of them is 0).
///
/// Without a sign change, or with values that are not finite, some point of the interval is returned.
pub(crate) fn root(f: impl Fn(f64) -> f64, a: f64, fa: f64, b: f64, fb: f64) -> f64 {
    let (mut a, mut fa, mut b, mut fb) = (a, fa, b, fb);
    let mut kept = 0_i32;
    let mut width = (b - a).abs();
    for iteration in 0..ITERATIONS {
        if fa == 0.0 {
            return a;
        }
        if fb == 0.0 {
            return b;
        }
        if (b - a).abs() <= 2.0 * f64::EPSILON * a.abs().max(b.abs()) {
            break;
        }
        let mut m = b - fb * (b - a) / (fb - fa);
        let slow = iteration % 3 == 2 && (b - a).abs() > 0.5 * width;
        if slow || !(m > a.min(b) && m < a.max(b)) {
            m = 0.5 * (a + b);
        }
        if iteration % 3 == 2 {
            width = (b - a).abs();
        }
        if m == a || m == b {
            break;
        }
        let fm = f(m);
        if (fm > 0.0) == (fb > 0.0) && fm != 0.0 {
            (b, fb) = (m, fm);
            if kept == 1 {
                fa *= 0.5;
            }
            kept = 1;
        } else {
            (a, fa) = (m, fm);
            if kept == -1 {
                fb *= 0.5;
            }
            kept = -1;
        }
    }
    if fa.abs() < fb.abs() { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::root;

    #[test]
    fn finds_roots_to_the_last_bits() {
        let count = core::cell::Cell::new(0);
        let f = |x: f64| {
            count.set(count.get() + 1);
            x.cos() - x
        };
        let x = root(f, 0.0, 1.0, 1.0, f(1.0));
        approx::assert_abs_diff_eq!(x, 0.739_085_133_215_160_6, epsilon = 4e-16);
        assert!(count.get() < 20, "{} evaluations", count.get());
        let x = root(|x| x.powi(9), -0.3, -0.3_f64.powi(9), 1.0, 1.0);
        assert!(x.abs() < 1e-2);
        assert_eq!(root(|x| x - 0.25, 0.25, 0.0, 1.0, 0.75), 0.25);
    }

    #[test]
    fn stays_inside_and_ends_on_hopeless_input() {
        let x = root(|_| f64::NAN, 0.0, 1.0, 1.0, -1.0);
        assert!((0.0..=1.0).contains(&x));
    }
}
