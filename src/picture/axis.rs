//! Ranges and ticks of an axis.

/// A range that shows all values with some air; a little around a single value.
pub(super) fn range(values: impl Iterator<Item = f64>) -> std::ops::Range<f64> {
    let finite = values.filter(|v| v.is_finite());
    let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    if low > high {
        return 0.0..1.0;
    }
    let size = low.abs().max(high.abs());
    let spread = if high - low > 1e-9 * size { high - low } else { 0.1 * if size > 0.0 { size } else { 1.0 } };
    low - 0.06 * spread..high + 0.06 * spread
}

/// A tick's label: as many decimals as ticks of this range need to differ.
pub(super) fn tick(value: f64, range: &std::ops::Range<f64>) -> String {
    let spread = range.end - range.start;
    // Ten ticks or so: the distance between them has its first digit at this decimal place.
    let decimals = (1.0 - (spread / 5.0).log10().floor()).clamp(0.0, 12.0) as usize;
    let size = range.start.abs().max(range.end.abs());
    if !(1e-4..1e6).contains(&size) {
        return format!("{value:.2e}");
    }
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}
