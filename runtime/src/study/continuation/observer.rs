//! Somebody who looks on while branches are followed.

use core::fmt;
use std::sync::Arc;

/// What a look is like.
type Look = dyn Fn(f64) + Send + Sync;

/// Told of every gait that a branch is continued by. It changes nothing of the result.
#[derive(Clone, Default)]
pub struct Observer(Option<Arc<Look>>);

impl Observer {
    /// One that is told the parameter's value (SI units) at every gait.
    pub fn new(look: impl Fn(f64) + Send + Sync + 'static) -> Self {
        Self(Some(Arc::new(look)))
    }

    /// Tells it of a gait.
    pub(super) fn tell(&self, value: f64) {
        if let Some(look) = &self.0 {
            look(value);
        }
    }
}

impl fmt::Debug for Observer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.0.is_some() { "Observer" } else { "nobody" })
    }
}
