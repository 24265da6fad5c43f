//! A block of jelly.

use glam::DVec3;

use super::build::{CENTER, MASS, PARTICLE_SIZE, Reader, VELOCITY};
use super::{Amount, Resolution, Shape, one_part};
use crate::error::Error;
use crate::links::{Link, Links};
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;

/// The shape `jelly`.
pub const JELLY: Shape = Shape {
    name: "jelly",
    about: "an elastic block: a cubic lattice of springs along edges and face diagonals, of Young's modulus 2.5 k / a and \
            Poisson's ratio 1/4",
    keys: KEYS,
    build,
    amount,
    parts: one_part,
    resolution: Resolution::Cells { key: "size", least: 2, periodic: false },
};

const KEYS: &[Key] = &[
    Key::required("size", Kind::Vector, "particles along x, y and z: three whole numbers, 2 or above"),
    Key::new("spacing", Kind::Positive, Value::Number(0.1), "distance between neighbours along an edge [length]"),
    MASS,
    Key::new("stiffness", Kind::Positive, Value::Number(1000.0), "k, of edges and face diagonals alike [mass / time²]"),
    Key::new("damping", Kind::NotNegative, Value::Number(0.0), "damping of each spring, along its axis [mass / time]"),
    CENTER,
    VELOCITY,
    PARTICLE_SIZE,
];

fn amount(settings: &Settings) -> Amount {
    let size = settings.vector("size");
    let (x, y, z) = (size.x, size.y, size.z);
    let edges = (x - 1.0) * y * z + x * (y - 1.0) * z + x * y * (z - 1.0);
    let faces = (x - 1.0) * (y - 1.0) * z + (x - 1.0) * y * (z - 1.0) + x * (y - 1.0) * (z - 1.0);
    let skin = (x - 1.0) * (y - 1.0) + (x - 1.0) * (z - 1.0) + (y - 1.0) * (z - 1.0);
    Amount { springs: edges + 2.0 * faces, triangles: 4.0 * skin, ..Amount::of(x * y * z) }
}

/// `size.x * size.y * size.z` particles, the middle of the block at `center`; x runs fastest. Springs in the surface belong to
/// one cell less than those inside: they have half of the stiffness, edges of the block a quarter, so that the block is
/// a homogeneous material; likewise the masses.
fn build(settings: &Settings) -> Result<State, Error> {
    let reader = Reader { shape: "jelly", settings };
    let size = reader.vector("size")?;
    if size.to_array().iter().any(|n| n.fract() != 0.0 || *n < 2.0) {
        return Err(reader.error(&format!("size is {size}; it must be three whole numbers, 2 or above")));
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "whole; beyond 2^64 it saturates, and is refused"
    )]
    let (_, mut particles) = reader.room_for((size.x * size.y * size.z) as u64)?;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the product fits 32 bits")]
    let cells = size.to_array().map(|n| n as u32);
    let spacing = reader.positive("spacing")?;
    let mass = reader.positive("mass")?;
    let (stiffness, damping) = (reader.positive("stiffness")?, reader.not_negative("damping")?);
    let (center, velocity) = (reader.vector("center")?, reader.vector("velocity")?);
    let radius = reader.not_negative("particle_size")?;
    let middle = (size - DVec3::ONE) * 0.5;
    let block = Block { cells };
    block.places().for_each(|at| {
        let place = (DVec3::from(at.map(f64::from)) - middle) * spacing + center;
        particles.push(place, velocity, mass * block.share(at, at), radius);
    });
    for at in block.places() {
        for way in WAYS {
            let there: [i64; 3] = std::array::from_fn(|k| i64::from(at[k]) + i64::from(way[k]));
            let Some(to) = block.inside(there) else { continue };
            let share = block.share(at, to);
            let rest = spacing * f64::from(way.iter().map(|n| n * n).sum::<i32>()).sqrt();
            let ends = [block.id(at), block.id(to)];
            let [stiffness, damping] = [stiffness, damping].map(|x| x * share);
            particles.links.springs.push(Link { ends, rest, stiffness, damping, rope: false });
        }
    }
    block.skin(&mut particles.links);
    reader.finished(particles)
}

/// Half of the neighbours along edges and face diagonals: each pair once.
const WAYS: [[i32; 3]; 9] =
    [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0], [1, -1, 0], [1, 0, 1], [1, 0, -1], [0, 1, 1], [0, 1, -1]];

struct Block {
    cells: [u32; 3],
}

impl Block {
    fn id(&self, [i, j, k]: [u32; 3]) -> u32 {
        i + self.cells[0] * (j + self.cells[1] * k)
    }
    fn places(&self) -> impl Iterator<Item = [u32; 3]> + use<> {
        let [x, y, z] = self.cells;
        (0..z).flat_map(move |k| (0..y).flat_map(move |j| (0..x).map(move |i| [i, j, k])))
    }
    fn inside(&self, at: [i64; 3]) -> Option<[u32; 3]> {
        let mut place = [0; 3];
        for (axis, n) in at.into_iter().enumerate() {
            place[axis] = u32::try_from(n).ok().filter(|n| *n < self.cells[axis])?;
        }
        Some(place)
    }
    /// The fraction of the cells around two lattice sites that are inside of the block: a half for each of its sides that they share.
    fn share(&self, a: [u32; 3], b: [u32; 3]) -> f64 {
        let outer = |axis: usize| a[axis] == b[axis] && (a[axis] == 0 || a[axis] + 1 == self.cells[axis]);
        (0..3).filter(|axis| outer(*axis)).map(|_| 0.5).product()
    }
    /// The triangles of its surface, anticlockwise as seen from outside.
    fn skin(&self, links: &mut Links) {
        for axis in 0..3 {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            for (side, flip) in [(0, true), (self.cells[axis] - 1, false)] {
                for p in 0..self.cells[u] - 1 {
                    for q in 0..self.cells[v] - 1 {
                        let corner = |du: u32, dv: u32| {
                            let mut at = [0; 3];
                            (at[axis], at[u], at[v]) = (side, p + du, q + dv);
                            self.id(at)
                        };
                        let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                        links.triangles.extend(if flip { [[a, c, b], [a, d, c]] } else { [[a, b, c], [a, c, d]] });
                    }
                }
            }
        }
    }
}
