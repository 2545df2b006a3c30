//! A section just before its transition: the falling ball of the other tests, by both methods.

use crate::common::toys::FALLING;
use crate::common::{completed, request};
use approx::assert_abs_diff_eq;
use gaitc_runtime::return_map::{Accuracy, MapRequest, Method, Sensitivity};

/// The map from impact to impact begins with the reset: v+ = e v, the flight takes 2 e |v|/g.
#[test]
fn section_before_the_impact() {
    let (g, e, v) = (9.81, 0.8, -3.0);
    let (z, p, memory) = ([v], [g, e], [0.0]);
    for (method, tolerance) in [(Method::Explicit, 1e-13), (Method::Radau5, 1e-10)] {
        let accuracy = Accuracy { method, ..Accuracy::default() };
        let base = request(&z, &p, Sensitivity::CoordinatesAndParameters(&[0, 1]));
        let r = completed(&FALLING, &MapRequest { accuracy, memory: &memory, ..base });
        assert_abs_diff_eq!(r.coordinates[0], e * v, epsilon = tolerance);
        assert_abs_diff_eq!(r.duration, -2.0 * e * v / g, epsilon = tolerance);
        let duration = [-2.0 * e / g, 2.0 * e * v / (g * g), -2.0 * v / g];
        for (column, (map, duration)) in [e, 0.0, v].into_iter().zip(duration).enumerate() {
            assert_abs_diff_eq!(r.jacobian[(0, column)], map, epsilon = tolerance);
            assert_abs_diff_eq!(r.duration_gradient[column], duration, epsilon = tolerance);
        }
    }
}
