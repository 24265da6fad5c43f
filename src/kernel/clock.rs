//! The clock: what `World` in `shaders/world.wgsl` says, in f64.

use super::pack::{Packed, Scalar};

/// Time, step size and count, as every kernel sees them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Clock {
    /// The time at which forces are evaluated \[time\]: `step × dt` between steps.
    pub time: f64,
    /// The step size \[time\].
    pub dt: f64,
    /// Steps done.
    pub step: u32,
    /// Particles.
    pub count: u32,
}

impl Clock {
    /// The members of `World`, by name.
    #[must_use]
    pub fn members(&self) -> [(&'static str, Scalar); 4] {
        [
            ("time", Scalar::Float(self.time)),
            ("dt", Scalar::Float(self.dt)),
            ("step", Scalar::Uint(self.step)),
            ("count", Scalar::Uint(self.count)),
        ]
    }
    /// Reads the members of `World` back.
    #[must_use]
    pub fn from_packed(packed: &Packed, bytes: &[u8]) -> Self {
        Self {
            time: packed.float(bytes, "time"),
            dt: packed.float(bytes, "dt"),
            step: packed.uint(bytes, "step"),
            count: packed.uint(bytes, "count"),
        }
    }
}
