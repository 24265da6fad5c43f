//! Links between particles: springs and ropes, rigid rods, joints that resist bending, dihedrals, and triangles in the wind. Plain lists, by the
//! particles' ids; kernels use tables in which each element is stored with each of its particles.

mod chains;
mod check;
mod exclusions;
mod half;
mod network;
mod rods;

#[doc(hidden)]
pub use chains::{Chains, MOST_RODS, Node};
#[doc(hidden)]
pub use exclusions::{Exclusions, too_many_bonds};
#[doc(hidden)]
pub use half::{Corner, Half, Shared, Torsion, WORDS};
#[doc(hidden)]
pub use network::{MOST_LINKS, Network};

/// A spring between two particles, or a rope, which only pulls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Link {
    /// The ids of the two.
    pub ends: [u32; 2],
    /// The rest length \[length\]; zero: an isotropic spring, which pulls its ends together.
    pub rest: f64,
    /// The spring constant \[mass / time²\].
    pub stiffness: f64,
    /// The damping along the spring \[mass / time\].
    pub damping: f64,
    /// Whether it is a rope: slack when shorter than its rest length.
    pub rope: bool,
}

/// A rigid rod: a constant distance between two particles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rod {
    /// The ids of the two.
    pub ends: [u32; 2],
    /// Its length \[length\].
    pub length: f64,
}

/// A joint at the second of three particles: its energy is ½ k (θ − θ₀)², with θ the deflection from a straight line, from 0 to π. The
/// angle between two bonds is π − θ.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Joint {
    /// The ids of the three, in order.
    pub ids: [u32; 3],
    /// k \[mass length² / time²\]; for a rod of bending stiffness EI with joints ds apart it is EI / ds.
    pub stiffness: f64,
    /// θ₀, the deflection at rest \[radians\]; 0: straight.
    pub rest: f64,
}

/// A torsion about the bond between the second and the third of four particles: its energy is k (1 + cos(n φ − δ)), with φ the dihedral
/// angle, 0 where the first and the fourth are on the same side (cis) and π where they are opposite (trans), with the sign of IUPAC 1974. The same
/// four may have several of them, as terms of a Fourier series.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Dihedral {
    /// The ids of the four, in order.
    pub ids: [u32; 4],
    /// k, of either sign \[energy\].
    pub stiffness: f64,
    /// The number n of maxima in a turn, 1 to [`Dihedral::MOST`].
    pub multiplicity: u32,
    /// δ, n times the angle of a maximum \[radians\].
    pub phase: f64,
}

impl Dihedral {
    /// The most maxima in a turn.
    pub const MOST: u32 = 12;
}

/// All links between particles.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Links {
    /// Springs and ropes.
    pub springs: Vec<Link>,
    /// Rigid rods.
    pub rods: Vec<Rod>,
    /// Joints.
    pub joints: Vec<Joint>,
    /// Dihedrals.
    pub dihedrals: Vec<Dihedral>,
    /// Triangles of cloth, by the ids of their corners.
    pub triangles: Vec<[u32; 3]>,
}

impl Links {
    /// Whether there are no links.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.springs.is_empty()
            && self.rods.is_empty()
            && self.joints.is_empty()
            && self.dihedrals.is_empty()
            && self.triangles.is_empty()
    }
    /// The particles of joints, dihedrals and triangles, as they are named.
    pub fn corners(&self) -> impl Iterator<Item = &[u32]> {
        let joints = self.joints.iter().map(|joint| &joint.ids[..]);
        let dihedrals = self.dihedrals.iter().map(|dihedral| &dihedral.ids[..]);
        joints.chain(dihedrals).chain(self.triangles.iter().map(|ids| &ids[..]))
    }
    /// Adds all links of another set, whose ids are shifted by `first`.
    pub fn append(&mut self, other: &Self, first: u32) {
        let other = other.renumbered(&|id| Some(id.saturating_add(first)));
        self.springs.extend(other.springs);
        self.rods.extend(other.rods);
        self.joints.extend(other.joints);
        self.dihedrals.extend(other.dihedrals);
        self.triangles.extend(other.triangles);
    }
    /// The links whose particles all have new ids, with these.
    #[must_use]
    pub fn renumbered(&self, new: &impl Fn(u32) -> Option<u32>) -> Self {
        let two = |[a, b]: [u32; 2]| Some([new(a)?, new(b)?]);
        let three = |[a, b, c]: [u32; 3]| Some([new(a)?, new(b)?, new(c)?]);
        let spring = |link: &Link| Some(Link { ends: two(link.ends)?, ..*link });
        let rod = |rod: &Rod| Some(Rod { ends: two(rod.ends)?, ..*rod });
        let joint = |joint: &Joint| Some(Joint { ids: three(joint.ids)?, ..*joint });
        let four = |[a, b, c, d]: [u32; 4]| Some([new(a)?, new(b)?, new(c)?, new(d)?]);
        let dihedral = |dihedral: &Dihedral| Some(Dihedral { ids: four(dihedral.ids)?, ..*dihedral });
        Self {
            springs: self.springs.iter().filter_map(spring).collect(),
            rods: self.rods.iter().filter_map(rod).collect(),
            joints: self.joints.iter().filter_map(joint).collect(),
            dihedrals: self.dihedrals.iter().filter_map(dihedral).collect(),
            triangles: self.triangles.iter().filter_map(|ids| three(*ids)).collect(),
        }
    }
}
