//! A step that was taken, whatever the method, and the tolerance it has to meet.

/// A step: values and rates at both ends, and the method's stages K between them.
#[derive(Clone, Copy, Debug)]
pub struct Step<V, K> {
    /// Where it starts.
    pub tau: f64,
    /// Its size.
    pub h: f64,
    /// Value at the start.
    pub start: V,
    /// Rate at the start.
    pub start_rates: V,
    /// What the method keeps.
    pub stages: K,
    /// Value at the end.
    pub end: V,
    /// Rate at the end.
    pub end_rates: V,
}

impl<V: Copy, K> Step<V, K> {
    /// Makes the end the start of the next step.
    pub fn move_on(&mut self) {
        self.tau += self.h;
        self.start = self.end;
        self.start_rates = self.end_rates;
    }
}

/// Tolerance of the local error of a component: `relative * |y| + absolute * max(1, largest of its block)`.
///
/// The block's size enters so that a component of a large variation that passes through zero is not asked for digits
/// that its neighbours do not have.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// Relative part.
    pub relative: f64,
    /// Absolute part, in the unit of the component.
    pub absolute: f64,
}
