//! Torsions about bonds.

use std::borrow::Cow;

use glam::DVec4;

use super::{Component, Law, Over};
use crate::links::Torsion;
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[Key::new(
    "over",
    Kind::Choice(&["dihedrals"]),
    Value::Text(Cow::Borrowed("dihedrals")),
    "what is evaluated: the four particles of a dihedral, which has its own stiffness, multiplicity and phase",
)];

/// `dihedral`: E = k (1 + cos(n φ − δ)) at every dihedral, with φ the angle between the planes of its first and of its last three
/// particles: 0 for cis, π for trans (IUPAC, Eur. J. Biochem. 17, 193, 1970), and its gradient by Blondel & Karplus (J. Comput. Chem. 17,
/// 1132, 1996). Several of the same particles add up to a Fourier series, as that of OPLS (Jorgensen et al., J. Am. Chem. Soc. 118, 11225, 1996).
#[derive(Clone)]
pub struct Dihedral;

impl Dihedral {
    /// From checked settings.
    #[must_use]
    pub fn new(_: &Settings) -> Self {
        Self
    }
}

impl Component for Dihedral {
    fn laws(&self) -> Vec<Law> {
        let wgsl = crate::shader!("interactions/dihedral.wgsl");
        let law = Law::corners("dihedral", Over::Dihedrals, wgsl, Vec::new(), |at, torsion: &Torsion, world| {
            let way = |from: usize, to: usize| world.bounds.shortest(at[to].position - at[from].position);
            // Three bonds, and the normals of the two planes.
            let (before, axis, after) = (way(0, 1), way(1, 2), way(2, 3));
            let (near, far) = (before.cross(axis), axis.cross(after));
            if near.length_squared() == 0.0 || far.length_squared() == 0.0 {
                return DVec4::ZERO;
            }
            let long = axis.length();
            let angle = (before.dot(far) * long).atan2(near.dot(far));
            let phase = torsion.sine.atan2(torsion.cosine);
            let n = f64::from(torsion.multiplicity);
            // By how much the angle grows with the place of the first and of the last; the two between take it up, by the levers of both.
            let first = -near * (long / near.length_squared());
            let last = far * (long / far.length_squared());
            let second = last * (after.dot(axis) / long.powi(2)) - first * (1.0 + before.dot(axis) / long.powi(2));
            let slope = [first, second, -first - last - second, last][torsion.place];
            let torque = torsion.stiffness * n * libm::sin(n * angle - phase);
            let size = libm::hypot(torsion.cosine, torsion.sine);
            (torque * slope).extend(torsion.stiffness * size.mul_add(libm::cos(n * angle - phase), 1.0))
        });
        vec![Law { reciprocal: true, ..law }]
    }
}
