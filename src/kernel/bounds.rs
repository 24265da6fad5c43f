//! The box and its boundaries.

use glam::{DVec3, Vec3};

/// The condition at two opposite sides of the box.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Side {
    /// Nothing: there is no box along this axis.
    #[default]
    Open = 0,
    /// Periodic: a particle that leaves at one side enters at the other, and pairs interact by the minimum image
    /// (Metropolis et al. 1953).
    Periodic = 1,
    /// Reflecting: a particle that would leave is reflected elastically.
    Reflecting = 2,
}

impl Side {
    /// The scene's words for them.
    pub const NAMES: &'static [&'static str] = &["open", "periodic", "reflecting"];

    /// The side of a scene's word.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        [Self::Open, Self::Periodic, Self::Reflecting].into_iter().find(|side| side.name() == name)
    }
    /// The scene's word for it.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}

/// The box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Its lowest corner \[length\].
    pub low: DVec3,
    /// Its highest corner \[length\]; along an open axis both are ignored.
    pub high: DVec3,
    /// The condition at its sides, axis by axis.
    pub sides: [Side; 3],
    /// 3, or 2 when everything happens in the plane z = 0.
    pub dimensions: u32,
}

/// For people: `x periodic from 0 to 1, y periodic from 0 to 1, z open`.
impl std::fmt::Display for Bounds {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
            let comma = if axis == 0 { "" } else { ", " };
            write!(f, "{comma}{name} {}", self.sides[axis].name())?;
            if self.sides[axis] != Side::Open {
                write!(f, " from {} to {}", self.low[axis], self.high[axis])?;
            }
        }
        if self.dimensions == 2 { write!(f, "; in the plane z = 0") } else { Ok(()) }
    }
}

impl Default for Bounds {
    /// Open space.
    fn default() -> Self {
        Self { low: DVec3::ZERO, high: DVec3::ZERO, sides: [Side::Open; 3], dimensions: 3 }
    }
}

impl Bounds {
    /// A box with the same at all sides; flat when its two corners have the same z.
    #[must_use]
    pub fn new(low: DVec3, high: DVec3, side: Side) -> Self {
        if (high.z - low.z).abs() <= 0.0 {
            return Self { low, high, sides: [side, side, Side::Open], dimensions: 2 };
        }
        Self { low, high, sides: [side; 3], dimensions: 3 }
    }
    /// The axes with such sides: 1 for these, 0 for others.
    #[must_use]
    pub fn axes(&self, side: Side) -> DVec3 {
        DVec3::from_array(self.sides.map(|s| f64::from(u8::from(s == side))))
    }
    /// Whether any side is of this kind.
    #[must_use]
    pub fn has(&self, side: Side) -> bool {
        self.sides.contains(&side)
    }
    /// The period of each axis \[length\]; 0 where it has none.
    #[must_use]
    pub fn period(&self) -> DVec3 {
        (self.high - self.low) * self.axes(Side::Periodic)
    }
    /// One over the period; 0 where there is none.
    #[must_use]
    pub fn frequency(&self) -> DVec3 {
        let of = |axis: usize| {
            let period = self.period()[axis];
            if period > 0.0 { 1.0 / period } else { 0.0 }
        };
        DVec3::new(of(0), of(1), of(2))
    }
    /// The shortest vector to any image. The image is chosen in single precision, as on the device: where two are equally near, half a box
    /// away, both must choose the same one.
    #[must_use]
    pub fn shortest(&self, r: DVec3) -> DVec3 {
        // The references call this for every pair.
        if !self.has(Side::Periodic) {
            return r;
        }
        r - self.period() * self.turns(r.as_vec3()).as_dvec3()
    }
    /// Whether an image is within a range, by the device's own arithmetic, operation by operation in single precision: a pair at the very
    /// edge must be inside for both or outside for both.
    #[must_use]
    pub fn within(&self, r: DVec3, range: f64) -> bool {
        #[expect(clippy::cast_possible_truncation, reason = "as the device holds it")]
        let range = range as f32;
        let r = self.shortest_single(r);
        r.x * r.x + r.y * r.y + r.z * r.z < range * range
    }
    /// The shortest vector to any image, in single precision.
    #[must_use]
    pub fn shortest_single(&self, r: DVec3) -> Vec3 {
        if !self.has(Side::Periodic) {
            return r.as_vec3();
        }
        let (r, period) = (r.as_vec3(), self.period().as_vec3());
        r - period * self.turns(r)
    }
    /// The image of a position inside the box, by the device's own arithmetic: see `shaders/neighbors/cell.wgsl`.
    #[must_use]
    pub fn wrapped_single(&self, x: DVec3) -> Vec3 {
        let (low, high, period) = (self.low.as_vec3(), self.high.as_vec3(), self.period().as_vec3());
        let x = x.as_vec3();
        let y = x - period * ((x - low) * self.frequency().as_vec3()).floor();
        let wrapped = |axis: usize| {
            let (x, y, low, high) = (x[axis], y[axis], low[axis], high[axis]);
            if period[axis] <= 0.0 || x >= low && x < high {
                x
            } else if y < low || y >= high {
                low
            } else {
                y
            }
        };
        Vec3::new(wrapped(0), wrapped(1), wrapped(2))
    }
    /// The number of whole periods in a vector.
    fn turns(&self, r: Vec3) -> Vec3 {
        let turns = r * self.frequency().as_vec3();
        Vec3::new(turns.x.round_ties_even(), turns.y.round_ties_even(), turns.z.round_ties_even())
    }
}
