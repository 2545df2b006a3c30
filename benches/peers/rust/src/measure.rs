//! A configuration of a code, the loosest setting at which it is exact enough, and its time there.

use crate::unit::Unit;
use serde_json::{Value, json};
use std::hint::black_box;
use std::time::Instant;

/// One unit of work: image, then Jacobian row by row; an error is the code's own message.
pub type Call = Box<dyn FnMut() -> Result<Vec<f64>, String>>;

/// A way to use a code.
pub struct Attempt {
    /// What was chosen, for the table.
    pub configuration: String,
    /// Tolerances, the loosest first.
    pub settings: Vec<f64>,
    /// Units in one call: more than one where they are computed side by side.
    pub units: usize,
    /// Makes the unit at a tolerance.
    pub build: Box<dyn Fn(f64) -> Call>,
}

/// 1 and 3 times powers of ten from 1e-4 to 1e-14.
pub fn tolerances() -> Vec<f64> {
    (4..=14).flat_map(|power| [10f64.powi(-power), 0.3 * 10f64.powi(-power)]).collect()
}

impl Attempt {
    /// Measures: one row of the table as JSON.
    pub fn row(&self, unit: &Unit, quick: bool) -> Value {
        let mut closest = f64::INFINITY;
        let mut message = String::new();
        for setting in &self.settings {
            let mut call = (self.build)(*setting);
            match call() {
                Ok(values) => {
                    let error = unit.error(&values);
                    closest = closest.min(error);
                    if error <= unit.wanted {
                        return json!({
                            "configuration": self.configuration, "status": "ok", "setting": format!("rtol {setting:.0e}"),
                            "error": error, "deviation": unit.deviation(&values), "median_us": time(&mut call, quick) / self.units as f64,
                        });
                    }
                }
                Err(failure) => message = failure,
            }
        }
        let note = if closest.is_finite() { format!("closest: {closest:.1e}") } else { message };
        json!({ "configuration": self.configuration, "status": "missed", "note": note })
    }
}

/// Minimum over repeats of the median time of a call (us).
fn time(call: &mut Call, quick: bool) -> f64 {
    let (repeats, seconds) = if quick { (2, 0.02) } else { (8, 0.25) };
    let once = |n: usize, call: &mut Call| {
        let start = Instant::now();
        for _ in 0..n {
            let _ = black_box(call());
        }
        start.elapsed().as_secs_f64()
    };
    // As many calls a sample as take about 50 us.
    let warm = once(3, call) / 3.0;
    let n = (50e-6 / warm).ceil().clamp(1.0, 1000.0) as usize;
    let medians = (0..repeats).map(|_| {
        let (start, mut samples) = (Instant::now(), Vec::new());
        while start.elapsed().as_secs_f64() < seconds || samples.len() < 3 {
            samples.push(once(n, call) / n as f64);
        }
        samples.sort_by(f64::total_cmp);
        samples[samples.len() / 2] * 1e6
    });
    medians.fold(f64::INFINITY, f64::min)
}
