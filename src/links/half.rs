//! A spring as seen from one of its ends, for references.

/// Words of a spring in the table of links.
pub const WORDS: usize = 4;

/// A spring as seen from one of its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Half {
    /// The particle at the other end.
    pub partner: usize,
    /// The rest length \[length\].
    pub rest: f64,
    /// The spring constant \[mass / time²\]; zero, like the damping, if it is broken.
    pub stiffness: f64,
    /// The damping along the spring \[mass / time\].
    pub damping: f64,
    /// Whether it is a rope, which only pulls.
    pub rope: bool,
}

impl Half {
    /// Reads the words of a spring.
    #[must_use]
    pub fn new(words: &[u32]) -> Self {
        let float = |place: usize| words.get(place).map_or(0.0, |bits| f64::from(f32::from_bits(*bits)));
        let partner = words.first().map_or(usize::MAX, |id| *id as usize);
        let (stiffness, damping) = (float(2), float(3));
        Self { partner, rest: float(1).abs(), stiffness, damping, rope: float(1) < 0.0 }
    }
    /// Whether it is broken.
    #[must_use]
    pub fn is_broken(&self) -> bool {
        self.stiffness == 0.0 && self.damping == 0.0
    }
}

/// Three particles of a joint or a triangle, as seen from one of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// The three, in order.
    pub ids: [usize; 3],
    /// The index of that one.
    pub place: usize,
    /// The bending stiffness \[mass length² / time²\].
    pub stiffness: f64,
}

impl Corner {
    /// Words of a corner in its table.
    pub const WORDS: usize = 5;

    /// Reads the words of a corner.
    #[must_use]
    pub fn new(words: &[u32]) -> Self {
        let id = |place: usize| words.get(place).map_or(usize::MAX, |id| *id as usize);
        let stiffness = words.get(4).map_or(0.0, |bits| f64::from(f32::from_bits(*bits)));
        Self { ids: [id(0), id(1), id(2)], place: id(3), stiffness }
    }
}
