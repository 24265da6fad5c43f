//! A spring, a joint, a triangle or a dihedral as seen from one of its particles, for references.

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
        let partner = id(words, 0);
        let (rest, stiffness, damping) = (float(words, 1), float(words, 2), float(words, 3));
        Self { partner, rest: rest.abs(), stiffness, damping, rope: rest < 0.0 }
    }
    /// Whether it is broken.
    #[must_use]
    pub fn is_broken(&self) -> bool {
        self.stiffness == 0.0 && self.damping == 0.0
    }
}

/// What several particles share, stored with each of them, as a reference reads it.
pub trait Shared<const N: usize> {
    /// Words of it in its table.
    const WORDS: usize;
    /// Reads its words.
    fn new(words: &[u32]) -> Self;
    /// The particles, in order.
    fn ids(&self) -> [usize; N];
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
    /// The deflection at rest \[radians\].
    pub rest: f64,
}

impl Shared<3> for Corner {
    const WORDS: usize = 6;

    fn new(words: &[u32]) -> Self {
        Self {
            ids: [0, 1, 2].map(|n| id(words, n)),
            place: id(words, 3),
            stiffness: float(words, 4),
            rest: float(words, 5),
        }
    }
    fn ids(&self) -> [usize; 3] {
        self.ids
    }
}

/// Four particles of a dihedral, as seen from one of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Torsion {
    /// The four, in order.
    pub ids: [usize; 4],
    /// The index of that one.
    pub place: usize,
    /// The number of maxima in a turn.
    pub multiplicity: u32,
    /// The stiffness \[energy\].
    pub stiffness: f64,
    /// The cosine of the phase.
    pub cosine: f64,
    /// The sine of the phase.
    pub sine: f64,
}

impl Shared<4> for Torsion {
    const WORDS: usize = 9;

    fn new(words: &[u32]) -> Self {
        Self {
            ids: [0, 1, 2, 3].map(|n| id(words, n)),
            place: id(words, 4),
            multiplicity: words.get(5).copied().unwrap_or(0),
            stiffness: float(words, 6),
            cosine: float(words, 7),
            sine: float(words, 8),
        }
    }
    fn ids(&self) -> [usize; 4] {
        self.ids
    }
}

fn id(words: &[u32], place: usize) -> usize {
    words.get(place).map_or(usize::MAX, |id| *id as usize)
}

fn float(words: &[u32], place: usize) -> f64 {
    words.get(place).map_or(0.0, |bits| f64::from(f32::from_bits(*bits)))
}
