//! The range of an axis, its ticks, and what stands beside them.

/// Values of this size and more are not drawn: differences of such numbers overflow.
const HUGE: f64 = 1e300;

/// An axis from its lower to its upper end, in the units of its values.
#[derive(Clone, Debug)]
pub(super) struct Axis {
    pub(super) low: f64,
    pub(super) high: f64,
    /// Places and labels.
    pub(super) ticks: Vec<(f64, String)>,
    /// Labels are to be multiplied by 10 to this power ...
    pub(super) exponent: i32,
    /// ... and added to this.
    pub(super) offset: f64,
}

/// Whether a value has a place on an axis.
pub(super) fn drawable(value: f64) -> bool {
    value.is_finite() && value.abs() < HUGE
}

/// The smallest and the largest of the values that can be drawn.
pub(super) fn extent(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    let values = values.into_iter().filter(|&v| drawable(v));
    values.fold(None, |all, v| Some(all.map_or((v, v), |(low, high): (f64, f64)| (low.min(v), high.max(v)))))
}

/// Ends that leave some air around an extent; a little around a single value.
pub(super) fn aired(extent: Option<(f64, f64)>, air: f64) -> (f64, f64) {
    let Some((low, high)) = extent else { return (0.0, 1.0) };
    let size = low.abs().max(high.abs());
    if size < 1e-300 {
        return (-1.0, 1.0);
    }
    // Differences in the last digits are rounding: shown as a flat line, not as mountains.
    match high - low > 1e-13 * size {
        true => (low - air * (high - low), high + air * (high - low)),
        false => (low - 0.1 * size, high + 0.1 * size),
    }
}

impl Axis {
    /// From end to end, with about as many ticks as are wished for.
    pub(super) fn new((low, high): (f64, f64), wished: usize) -> Self {
        let (mut wished, mut step) = (wished.max(2), 0.0);
        let mut places: Vec<f64> = Vec::new();
        // A scale cannot be read off a single tick.
        while places.len() < 2 && wished < 20 {
            step = round_step((high - low) / wished as f64);
            let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
            places = (0..=(last - first).clamp(0.0, 100.0) as usize).map(|i| (first + i as f64) * step).collect();
            wished += 1;
        }
        let size = low.abs().max(high.abs());
        // Where labels would differ in their seventh digit only, they say the difference from the first.
        let offset = if high - low < 1e-5 * size { places.first().copied().unwrap_or(0.0) } else { 0.0 };
        let exponent = exponent(places.iter().map(|place| (place - offset).abs()).fold(0.0, f64::max));
        let unit = 10f64.powi(exponent);
        let ticks = places.iter().map(|&place| (place, decimal((place - offset) / unit, step / unit))).collect();
        Self { low, high, ticks, exponent, offset }
    }

    /// With every second tick, that at 0 among them, as long as two are left.
    pub(super) fn thinned(mut self) -> Self {
        let zero = self.ticks.iter().position(|(place, _)| *place == 0.0).unwrap_or(0) % 2;
        if self.ticks.len() - zero > 2 {
            self.ticks = self.ticks.into_iter().skip(zero).step_by(2).collect();
        }
        self
    }

    /// Whether labels are not the values themselves, which the picture then has to say.
    pub(super) fn is_scaled(&self) -> bool {
        self.exponent != 0 || self.offset != 0.0
    }

    /// Where a value is: 0 at the lower end, 1 at the upper.
    pub(super) fn share(&self, value: f64) -> f64 {
        (value - self.low) / (self.high - self.low)
    }
}

/// The power of ten that labels leave out: none for numbers that can be read.
fn exponent(largest: f64) -> i32 {
    match largest {
        v if v < 1e-300 => 0,
        v if !(1e-3..1e5).contains(&v) => v.log10().floor() as i32,
        _ => 0,
    }
}

/// The smallest of 1, 2, 5 times a power of ten that is no less.
fn round_step(at_least: f64) -> f64 {
    let power = 10f64.powf(at_least.log10().floor());
    let digit = at_least / power;
    let of = [1.0, 2.0, 5.0].into_iter().find(|&d| digit <= d * (1.0 + 1e-9)).unwrap_or(10.0);
    of * power
}

/// With as many decimals as neighbours need to differ.
fn decimal(value: f64, step: f64) -> String {
    let decimals = (-(step.log10() + 1e-9).floor()).clamp(0.0, 12.0) as usize;
    let text = format!("{value:.decimals$}");
    let zero = text.trim_start_matches('-').chars().all(|c| c == '0' || c == '.');
    match text.strip_prefix('-') {
        Some(_) if zero => text.trim_start_matches('-').to_owned(),
        Some(rest) => format!("−{rest}"),
        None => text,
    }
}
