//! Many starts and parameters for systems of the other files, spread evenly (Weyl sequences, so the same everywhere).

use crate::check::{Row, check};
use crate::family::{EITHER, FALL, Of, RISE};

const CASES: usize = 40;
const KINDS: [usize; 3] = [FALL, RISE, EITHER];

/// Number `j` of case `k`, in `low..high`.
fn spread(k: usize, j: usize, low: f64, high: f64) -> f64 {
    let roots = [2.0_f64, 3.0, 5.0, 7.0, 11.0, 13.0];
    low + (high - low) * ((k + 1) as f64 * roots[j].sqrt()).fract()
}

#[test]
fn cubics() {
    let mut rows = Vec::new();
    for k in 0..CASES {
        let a = spread(k, 0, 0.1, 1.0);
        let b = a + spread(k, 1, 0.1, 1.0);
        let c = b + spread(k, 2, 0.1, 1.0);
        let gate = spread(k, 3, 0.0, 3.0);
        // Between zeros, so that which of them count is clear.
        let clear = [a, b, c].iter().all(|zero| (zero - gate).abs() > 1e-6);
        let kind = KINDS[k % 3] as f64;
        rows.push(Row::new(&format!("cubic {k}"), Of::Cubic, [0.0, 0.2, 1.0], [a, b, c, kind, 0.0, 3.2]));
        if clear {
            let row = Row::new(&format!("gated {k}"), Of::GatedCubic, [0.0, 0.2, 1.0], [a, b, c, gate, 0.0, 3.2]);
            rows.push(if gate < a { row } else { row.planless() });
        }
    }
    check(&rows);
}

#[test]
fn oscillators() {
    let mut rows = Vec::new();
    for k in 0..CASES {
        let start = [spread(k, 0, -0.5, 0.5), spread(k, 1, 0.6, 1.0), 0.1];
        let p =
            [spread(k, 2, -0.6, 0.6), spread(k, 3, -0.5, 0.5), KINDS[k % 3] as f64, 0.0, 0.0, spread(k, 4, 5.0, 15.0)];
        rows.push(Row::new(&format!("oscillator {k}"), Of::Harmonic, start, p));
    }
    check(&rows);
}

#[test]
fn balls() {
    let mut rows = Vec::new();
    for k in 0..CASES {
        // They bounce for at least two seconds.
        let start = [spread(k, 0, 0.3, 2.0), spread(k, 1, -1.0, 2.0), 0.0];
        let p = [9.81, spread(k, 2, 0.8, 1.0), spread(k, 3, -0.3, 0.3), 0.0, 0.0, spread(k, 4, 0.5, 1.2)];
        rows.push(Row::new(&format!("ball {k}"), Of::Ball, start, p));
    }
    check(&rows);
}

#[test]
fn rays() {
    let mut rows = Vec::new();
    for k in 0..CASES {
        let p = [1.0, spread(k, 2, -0.3, 0.3), spread(k, 3, -0.3, 0.3), 0.0, 0.0, spread(k, 4, 4.0, 60.0)];
        let from = [spread(k, 0, -30.0, -1.5), spread(k, 1, -0.9, 0.9), 0.0];
        // Long enough to leave the circle.
        if p[5] + from[0] > 1.5 {
            rows.push(Row::new(&format!("lens {k}"), Of::Lens, from, p).planless());
        }
        let inside = [spread(k, 0, -0.5, 0.5), spread(k, 1, -0.5, 0.5), spread(k, 2, 0.0, 6.0)];
        rows.push(Row::new(
            &format!("billiard {k}"),
            Of::Billiard,
            inside,
            [1.0, 0.0, 0.0, 0.0, 0.0, spread(k, 3, 2.0, 6.0)],
        ));
    }
    check(&rows);
}
