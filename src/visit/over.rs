//! Which pairs are evaluated.

use crate::kernel::{Machine, Problem};
use crate::tree::Opening;

/// The visits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Over {
    /// Each particle alone.
    Each,
    /// All pairs, each at its nearest image.
    Pairs,
    /// All pairs within a range, by brute force: the same pairs that [`Near`](Over::Near) finds through a cell list.
    Within {
        /// The range \[length\].
        range: f64,
    },
    /// All pairs within a range, found through a cell list.
    Near {
        /// The range \[length\].
        range: f64,
        /// Only particles of this species are put into the cell list. The law must exclude other species itself: this only
        /// avoids visiting them.
        of: Option<u32>,
    },
    /// The same pairs, found on a list of the neighbours within range + skin that is kept over several steps.
    List {
        /// The range \[length\].
        range: f64,
        /// The skin: the distance by which the list exceeds the range \[length\]; `None`: a fixed part of the range.
        skin: Option<f64>,
        /// Words of history that the law keeps for each pair.
        slots: u32,
    },
    /// All pairs within a range, through the cell list or the kept list, whichever is faster for the number of neighbours at the start: see
    /// [`few_neighbors`](crate::visit::few_neighbors).
    Auto {
        /// The range \[length\].
        range: f64,
        /// The skin of a kept list \[length\]; `None`: a fixed part of the range.
        skin: Option<f64>,
    },
    /// Each particle with its k nearest neighbours; of two at the same distance the lower id comes first.
    Nearest {
        /// The number k of neighbours.
        count: u32,
    },
    /// All pairs, far groups approximated as one, found through a tree.
    Tree {
        /// The criterion by which a group is too near for that.
        opening: Opening,
        /// A group is also too near if any of it may be nearer than this \[length\].
        core: f64,
        /// Only where this is faster than direct summation.
        auto: bool,
    },
    /// Each particle with its link partners.
    Links,
    /// Each particle with its joints.
    Joints,
    /// Each particle with its dihedrals.
    Dihedrals,
    /// Each particle with the triangles that it is a corner of.
    Triangles,
}

impl Over {
    /// The names of the visits in scenes.
    pub const NAMES: &'static [&'static str] = &[
        "each",
        "pairs",
        "within",
        "near",
        "list",
        "nearest",
        "tree",
        "auto",
        "links",
        "joints",
        "dihedrals",
        "triangles",
    ];

    /// Its name in scenes.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Each => "each",
            Self::Pairs => "pairs",
            Self::Within { .. } => "within",
            Self::Near { .. } => "near",
            Self::List { .. } => "list",
            Self::Nearest { .. } => "nearest",
            Self::Tree { auto: false, .. } => "tree",
            Self::Tree { auto: true, .. } | Self::Auto { .. } => "auto",
            Self::Links => "links",
            Self::Joints => "joints",
            Self::Dihedrals => "dihedrals",
            Self::Triangles => "triangles",
        }
    }
    /// The cut-off radius \[length\]; `None` if there is none.
    #[must_use]
    pub fn range(self) -> Option<f64> {
        match self {
            Self::Within { range } | Self::Near { range, .. } | Self::List { range, .. } | Self::Auto { range, .. } => {
                Some(range)
            }
            _ => None,
        }
    }
}

/// What a law loads of its neighbours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Loads {
    /// Positions alone.
    Positions,
    /// Velocities, too.
    Velocities,
    /// Fields of a method of several laws, which one list serves.
    Fields,
}

/// The mean number of neighbours within range at the start up to which a kept list is faster than the cell list. Measured on lavapipe by
/// `cargo bench --bench visits`, numbers of neighbours being those at the start: with a list a cheap law of positions takes 0.86 of the time for
/// 14 neighbours and 1.2 for 33, a dear one 0.95 for 33, flocks 0.85 for 14 and 1.2 for 33, and fluids 0.8 to 0.87 for 33 and 1.7 or more for
/// 113. GPUs have not been measured, and use the cell list.
#[must_use]
pub fn few_neighbors(machine: &Machine, loads: Loads) -> f64 {
    match loads {
        _ if !machine.software => 0.0,
        Loads::Positions => 15.0,
        Loads::Velocities => 20.0,
        Loads::Fields => 40.0,
    }
}

impl Over {
    /// The faster one of the cell list and the kept list, for `Auto`.
    pub(crate) fn faster(self, loads: Loads, problem: &Problem) -> Self {
        let Self::Auto { range, skin } = self else { return self };
        let few = few_neighbors(&problem.machine, loads);
        // A cell list has the order of its cells, which change with the box.
        if problem.elastic.is_some() {
            return Self::List { range, skin, slots: 0 };
        }
        match problem.neighbors_within(range) {
            Some(mean) if few > 0.0 && mean <= few => Self::List { range, skin, slots: 0 },
            _ => Self::Near { range, of: None },
        }
    }
}
