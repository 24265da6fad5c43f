//! Approximation of far groups: an implicit binary tree over particles in Hilbert order, built on the device at each evaluation,
//! independent of laws.
//!
//! Particles are sorted along a Hilbert curve and divided into leaves of [`LEAF`]; a node is the union of its two children. Nodes are
//! numbered as in a heap: 1 is the root, 2 n and 2 n + 1 are the children of n, and all leaves are [`height`](Tree::height) levels below
//! the root. Nodes after the last leaf do not exist, and are not visited.

mod build;
mod curve;
mod nodes;
mod opening;
mod reference;

pub use curve::hilbert;
pub use nodes::Nodes;
pub use opening::Opening;

use std::ops::Range;

use crate::kernel::{Field, Name, POSITION, Precision, Problem};

/// Particles of a leaf.
pub const LEAF: u32 = 4;
/// Targets that walk together: the particles of a node three levels above the leaves.
pub const GROUP: u32 = 8 * LEAF;

/// A tree over all particles.
#[derive(Debug, Clone, PartialEq)]
pub struct Tree {
    /// The criterion by which a node is opened.
    pub opening: Opening,
    /// A node is also opened if any point in its box may be nearer than this \[length\]: there the expansion of the law does not hold.
    pub core: f64,
    /// The number of rows allocated.
    pub count: u32,
    /// The number of rows in use.
    pub used: u32,
    /// Whether its bodies have places from the lowest corner of all, by both words of their positions, and not positions of one word.
    pub two_words: bool,
}

impl Tree {
    /// A tree over all particles of a problem.
    #[must_use]
    pub fn new(opening: Opening, core: f64, problem: &Problem) -> Self {
        let two_words = problem.precision == Precision::DoubleSingle;
        Self { opening, core, count: problem.capacity, used: problem.capacity, two_words }
    }
    /// The field with the places of its bodies, by id.
    fn places(&self) -> Field<glam::Vec4> {
        if self.two_words { build::PLACE } else { POSITION }
    }
    /// The same over the rows in use.
    #[must_use]
    pub fn of_rows(&self, used: u32) -> Self {
        Self { used: used.min(self.count), ..self.clone() }
    }
    /// The number of leaves allocated.
    #[must_use]
    pub fn leaves(&self) -> u32 {
        self.count.div_ceil(LEAF).max(1)
    }
    /// Levels between the root and the leaves.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.leaves().next_power_of_two().ilog2()
    }
    /// Elements of the fields of nodes.
    #[must_use]
    pub fn nodes(&self) -> u64 {
        2 << self.height()
    }
    /// The number of groups of targets.
    #[must_use]
    pub fn groups(&self) -> u32 {
        self.count.div_ceil(GROUP)
    }
    /// The nodes of a level, `above` levels above the leaves: the first, and the number of existing ones.
    #[must_use]
    pub fn level(&self, above: u32) -> (u32, u32) {
        let wide = 1_u64 << (self.height().saturating_sub(above));
        let nodes = u64::from(self.used.div_ceil(LEAF)).div_ceil(1 << above.min(self.height()));
        // Below 2³²: there are four particles for each leaf.
        [wide, nodes].map(|n| u32::try_from(n).unwrap_or(u32::MAX)).into()
    }
    /// Whether there is such a node.
    #[must_use]
    pub fn exists(&self, n: u32) -> bool {
        n > 0 && n.ilog2() <= self.height() && !self.range(n).is_empty()
    }
    /// Whether a node is at the level of the leaves.
    #[must_use]
    pub fn is_leaf(&self, n: u32) -> bool {
        n.checked_ilog2() == Some(self.height())
    }
    /// The particles of a node, by their indices along the curve; empty, where it does not exist.
    #[must_use]
    pub fn range(&self, n: u32) -> Range<usize> {
        let level = n.checked_ilog2().unwrap_or(0);
        let bodies = u64::from(LEAF) << self.height().saturating_sub(level);
        let first = u64::from(n.saturating_sub(1 << level)) * bodies;
        let place = |k: u64| usize::try_from(k.min(self.used.into())).unwrap_or(usize::MAX);
        place(first)..place(first + bodies)
    }
    /// The reach of a node of side 1.
    fn stretch(&self) -> f64 {
        match self.opening {
            Opening::Geometric { theta } => 1.0 / theta,
            Opening::Relative { .. } => 1.0,
        }
    }
    /// Its name, by its opening criterion.
    #[must_use]
    pub fn name(&self) -> String {
        if self.core > 0.0 { format!("{} core={}", self.opening, self.core) } else { self.opening.to_string() }
    }
    /// A field of it, by its name in shaders.
    #[must_use]
    pub fn field(&self, name: &'static str) -> (&'static str, Name) {
        (name, format!("{name} of {}", self.name()).into())
    }
}

/// Ids, in the order of the Hilbert curve; those of one key in ascending order.
pub(crate) const TREE_ID: &str = "tree_id";
/// Positions and masses in that order.
pub(crate) const TREE_BODY: &str = "tree_body";
/// Of each node: its centre of mass (of its box, where its mass is 0), and the distance of a target below which it is opened \[length\]:
/// the greater of l / θ + s (l + s, where the opening is relative) and core + s + l √3 / 2.
pub(crate) const TREE_CENTER: &str = "tree_center";
/// Of each node: xx, xy and xz of its second moments Σ m y yᵀ about the centre of mass, and its mass.
pub(crate) const TREE_MASS: &str = "tree_mass";
/// Of each node: yy, yz and zz of the second moments, and the longest side of its tight box \[length\].
pub(crate) const TREE_SHAPE: &str = "tree_shape";
/// Of each node: the lowest corner of its tight box, and 0.
pub(crate) const TREE_LOW: &str = "tree_low";
/// Of each node: the highest corner of its tight box, and 0.
pub(crate) const TREE_HIGH: &str = "tree_high";
/// Of each group of targets: G / (α a) with the smallest last acceleration a of its targets, or a part of the sum of the magnitudes of all
/// attractions where that is larger; 0 if a target has no acceleration yet. Only with the relative criterion.
pub(crate) const TREE_DEMAND: &str = "tree_demand";
