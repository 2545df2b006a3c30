//! Following a gait along a straight line through the parameters, predicted along the secant; the way is halved where the next
//! gait is not found.

/// Smallest part of the way that is taken at once.
const SHORTEST: f64 = 1.0 / 512.0;

/// How far a gait was followed.
pub(crate) struct Followed<E> {
    /// All parameters where it ended.
    pub(crate) parameters: Vec<f64>,
    /// Section coordinates of the gait there.
    pub(crate) section: Vec<f64>,
    /// Why it went no further; `None` at the end of the way.
    pub(crate) failure: Option<E>,
}

/// Follows the gait with section coordinates `section` at the parameters `from` towards the parameters `to`. `gait` finds one near
/// a guess: `gait(parameters, guess)`. A failure that is `final` ends the way at once, after others shorter ways are tried.
pub(crate) fn follow<E>(
    (from, section): (&[f64], &[f64]),
    to: &[f64],
    mut gait: impl FnMut(&[f64], &[f64]) -> Result<Vec<f64>, E>,
    is_final: impl Fn(&E) -> bool,
) -> Followed<E> {
    let between =
        |t: f64| -> Vec<f64> { from.iter().zip(to).map(|(a, b)| if t < 1.0 { a + t * (b - a) } else { *b }).collect() };
    let (mut t, mut stride) = (0.0, 1.0);
    let mut z = section.to_vec();
    let mut slope = vec![0.0; z.len()];
    let mut failure = None;
    while t < 1.0 && failure.is_none() {
        let next: f64 = f64::min(1.0, t + stride);
        let guess: Vec<f64> = z.iter().zip(&slope).map(|(z, s)| z + s * (next - t)).collect();
        match gait(&between(next), &guess) {
            Ok(found) => {
                slope = found.iter().zip(&z).map(|(a, b)| (a - b) / (next - t)).collect();
                (z, t) = (found, next);
                stride *= 2.0;
            }
            Err(reason) => {
                stride *= 0.5;
                slope.fill(0.0);
                failure = (stride < SHORTEST || is_final(&reason)).then_some(reason);
            }
        }
    }
    let parameters = if t > 0.0 { between(t) } else { from.to_vec() };
    Followed { parameters, section: z, failure }
}
