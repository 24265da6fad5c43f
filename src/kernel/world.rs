//! Parameters of every kernel: `World` in `shaders/world.wgsl`, in f64.

use super::Bounds;
use super::pack::{Packed, Scalar};

/// Time, step size, count and the box, as every kernel sees them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct World {
    /// The time at which forces are evaluated \[time\]: `step × dt` between steps.
    pub time: f64,
    /// The step size \[time\].
    pub dt: f64,
    /// Steps done.
    pub step: u32,
    /// Rows in use: particles, and removed ones between them.
    pub count: u32,
    /// Free rows after those.
    pub free: u32,
    /// The box and its boundaries.
    pub bounds: Bounds,
}

impl World {
    /// All rows.
    #[must_use]
    pub fn capacity(&self) -> u32 {
        self.count.saturating_add(self.free)
    }
    /// The members of `World`, by name.
    #[must_use]
    pub fn members(&self) -> [(&'static str, Scalar); 12] {
        let sides = self.bounds.sides.map(|side| side as u32);
        [
            ("time", Scalar::Float(self.time)),
            ("dt", Scalar::Float(self.dt)),
            ("step", Scalar::Uint(self.step)),
            ("count", Scalar::Uint(self.count)),
            ("capacity", Scalar::Uint(self.capacity())),
            ("low", Scalar::Vector(self.bounds.low)),
            ("dimensions", Scalar::Uint(self.bounds.dimensions)),
            ("high", Scalar::Vector(self.bounds.high)),
            ("sides", Scalar::Uint(sides[0] | sides[1] << 8 | sides[2] << 16)),
            ("period", Scalar::Vector(self.bounds.period())),
            ("zero", Scalar::Uint(0)),
            ("frequency", Scalar::Vector(self.bounds.frequency())),
        ]
    }
    /// Updates the members that change on the device from data read back.
    #[must_use]
    pub fn updated(self, packed: &Packed, bytes: &[u8]) -> Self {
        // A box that has not changed has the digits with which it was given.
        let mut bounds = self.bounds;
        let high = packed.vector(bytes, "high");
        let given = bounds.high.as_vec3();
        for axis in (0..3).filter(|axis| high[*axis].to_bits() != given[*axis].to_bits()) {
            bounds.high[axis] = f64::from(high[axis]);
        }
        Self {
            bounds,
            time: packed.float(bytes, "time"),
            dt: packed.float(bytes, "dt"),
            step: packed.uint(bytes, "step"),
            count: packed.uint(bytes, "count"),
            free: packed.uint(bytes, "capacity").saturating_sub(packed.uint(bytes, "count")),
        }
    }
}
