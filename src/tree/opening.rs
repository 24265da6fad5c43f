//! Opening criteria of the tree.

/// The opening criteria. `d` is the minimum distance from the box of a group of targets to a node's centre of mass, and from the
/// targets themselves where the box is four times as wide as the node reaches; `l` is the longest side of the node's tight box,
/// `s` the distance of its centre of mass from the middle of that box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Opening {
    /// A node is opened where d ≤ l / θ + s (Barnes & Hut 1986; the offset: Barnes 1994; for groups: Bédorf, Gaburov &
    /// Portegies Zwart 2012).
    Geometric {
        /// θ, between 0 and 1: the smaller, the more exact.
        theta: f64,
    },
    /// A node of mass M is opened where G M l² / d⁴ > α a, with a the smallest of the last accelerations of the group (Springel 2005), or d
    /// ≤ l + s. If a target has no acceleration yet, the geometric criterion is used. Where attractions cancel, a is 1/32 of the sum of
    /// their magnitudes.
    Relative {
        /// α: about the relative error of a force.
        alpha: f64,
        /// G of the law \[length³ / mass / time²\].
        g: f64,
        /// θ of the geometric criterion.
        theta: f64,
    },
}

impl Opening {
    /// Whether it compares forces.
    #[must_use]
    pub fn is_relative(self) -> bool {
        matches!(self, Self::Relative { .. })
    }
    /// Its θ.
    #[must_use]
    pub fn theta(self) -> f64 {
        match self {
            Self::Geometric { theta } | Self::Relative { theta, .. } => theta,
        }
    }
}

impl std::fmt::Display for Opening {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Geometric { theta } => write!(f, "θ={theta}"),
            Self::Relative { alpha, g, theta } => write!(f, "α={alpha} g={g} θ={theta}"),
        }
    }
}
