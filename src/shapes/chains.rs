//! Chains that fill a box: a melt of polymers.

use glam::DVec3;

use super::build::{CENTER, PARTICLE_SIZE, Reader, SEED, VELOCITY};
use super::crystal::heat;
use super::random::Random;
use super::{Amount, Resolution, Shape};
use crate::error::Error;
use crate::links::Link;
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;

/// The shape `chains`.
pub const CHAINS: Shape = Shape {
    name: "chains",
    about: "chains that fill a cubic lattice: one random path through all of its places, made by moves of its ends (Mansfield 1982), cut into pieces",
    keys: KEYS,
    build,
    amount,
    parts,
    resolution: Resolution::Own,
};

const KEYS: &[Key] = &[
    Key::required("size", Kind::Vector, "places along x, y and z: three whole numbers, 1 or above"),
    Key::required("beads", Kind::Count, "particles in a chain: the number of places is a multiple of it"),
    Key::new(
        "spacing",
        Kind::Positive,
        Value::Number(1.0),
        "distance between neighbours on the lattice, and length of each bond [length]",
    ),
    Key::new(
        "periodic",
        Kind::Flag,
        Value::Flag(true),
        "whether chains pass through the sides: the box is then as long as its places, `size` times `spacing`, and periodic; of more than 8192 places each block of as many has its own path, which stays in it where there are several along an axis",
    ),
    Key::new(
        "moves",
        Kind::NotNegative,
        Value::Number(10.0),
        "moves of an end of the path, per place, 1000 at most: without any, chains lie straight in rows",
    ),
    Key::new("mass", Kind::Positive, Value::Number(1.0), "mass of each particle [mass]"),
    Key::new(
        "stiffness",
        Kind::NotNegative,
        Value::Number(30.0),
        "of each bond: K of `fene`, or Hooke's constant of `spring` [mass / time²]",
    ),
    Key::new("damping", Kind::NotNegative, Value::Number(0.0), "of each bond, along its axis [mass / time]"),
    Key::new(
        "temperature",
        Kind::NotNegative,
        Value::Number(0.0),
        "k T: velocities are Maxwellian, without total momentum, and have exactly 2 K / (3 N − 3) = k T; of one layer, they lie in it, with 2 K / (2 N − 2) = k T [energy]",
    ),
    SEED,
    CENTER,
    VELOCITY,
    PARTICLE_SIZE,
];

/// Places of one path, where the lattice can be cut into such blocks; and at most.
const FEW_PLACES: u64 = 8192;
const MOST_PLACES: u64 = 32_768;
/// Moves of an end of a path, per place.
const MOST_MOVES: f64 = 1000.0;

/// The number of places, and of beads in a chain.
fn counts(settings: &Settings) -> (f64, f64) {
    (settings.vector("size").element_product(), settings.number("beads").max(1.0))
}

fn amount(settings: &Settings) -> Amount {
    let (places, beads) = counts(settings);
    Amount { springs: (places - places / beads).max(0.0), ..Amount::of(places) }
}

/// Each chain is a part of its own, with a colour of the palette.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "`build` has found whole numbers that fit 32 bits"
)]
fn parts(settings: &Settings) -> Vec<(&'static str, u32)> {
    let (places, beads) = counts(settings);
    vec![("", beads as u32); ((places / beads) as usize).saturating_sub(1)]
}

/// The chains about `center`, their particles in a row.
fn build(settings: &Settings) -> Result<State, Error> {
    let reader = Reader { shape: "chains", settings };
    let size = reader.vector("size")?;
    if size.to_array().iter().any(|n| n.fract() != 0.0 || *n < 1.0) {
        return Err(reader.error(&format!("size is {size}; it must be three whole numbers, 1 or above")));
    }
    let beads = settings.number("beads");
    if beads < 2.0 {
        return Err(reader.error(&format!("beads is {beads}; a chain has 2 or more")));
    }
    let places = size.element_product();
    if places % beads != 0.0 {
        let text = format!(
            "{places} places are no whole number of chains of {beads} beads: choose `size` or `beads` so that they are"
        );
        return Err(reader.error(&text));
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "whole; beyond 2^64 it saturates, and is refused"
    )]
    let (count, mut particles) = reader.room_for(places as u64)?;
    let [spacing, mass] = ["spacing", "mass"].map(|key| reader.positive(key));
    let (spacing, mass) = (spacing?, mass?);
    let [stiffness, damping, temperature, moves, radius] =
        ["stiffness", "damping", "temperature", "moves", "particle_size"].map(|key| reader.not_negative(key));
    let (stiffness, damping, temperature, moves, radius) = (stiffness?, damping?, temperature?, moves?, radius?);
    let (center, velocity) = (reader.vector("center")?, reader.vector("velocity")?);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "factors of a product that fits 32 bits"
    )]
    let [sides, beads] = [size.to_array(), [beads; 3]].map(|all| all.map(|n| n as u32));
    let beads = beads[0];
    if moves > MOST_MOVES {
        return Err(reader.error(&format!("moves is {moves}; it must be {MOST_MOVES} or below")));
    }
    let Some(block) = block(sides, beads) else {
        let text = format!(
            "{places} places are more than the {MOST_PLACES} of one path, and its sides divide into no smaller blocks that chains of {beads} beads \
             fill: choose another `size`, such as multiples of 20"
        );
        return Err(reader.error(&text));
    };
    let periodic = [0, 1, 2].map(|axis| settings.flag("periodic") && block[axis] == sides[axis]);
    let lattice = Lattice { sides: block, periodic };
    let mut random = Random::new(settings.whole("seed"));
    let middle = 0.5 * (size - DVec3::ONE);
    let volume = block.iter().product::<u32>();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most a thousand of each place")]
    let moves = (moves * f64::from(volume)).round() as u64;
    let number = [0, 1, 2].map(|axis| sides[axis] / block[axis]);
    for n in 0..number.iter().product::<u32>() {
        let mut path = Path::straight(&lattice, volume as usize);
        for _ in 0..moves {
            path.turn(&lattice, &mut random);
        }
        let corner = [n % number[0], n / number[0] % number[1], n / number[0] / number[1]];
        for site in &path.order {
            let place = lattice.place(*site);
            let place = DVec3::from([0, 1, 2].map(|axis| f64::from(place[axis] + block[axis] * corner[axis])));
            particles.push((place - middle) * spacing + center, DVec3::ZERO, mass, radius);
        }
    }
    let last = u32::try_from(count).unwrap_or(u32::MAX);
    for i in (1..last).filter(|i| i % beads != 0) {
        particles.links.springs.push(Link { ends: [i - 1, i], rest: spacing, stiffness, damping, rope: false });
    }
    heat(&mut particles, temperature / mass, sides[2] == 1, &mut random);
    particles.velocity_mut().iter_mut().for_each(|v| *v += velocity);
    reader.finished(particles)
}

/// The sides of the blocks into which a lattice is cut: all of it where it has few places, since the moves of a path take as long as it is, or the
/// largest of few places that chains fill. `None` where there are no blocks that one path can fill in a reasonable time.
fn block(sides: [u32; 3], beads: u32) -> Option<[u32; 3]> {
    let parts = sides.map(|side| (1..=side).filter(|part| side % part == 0).collect::<Vec<u32>>());
    let places = |block: &[u32; 3]| block.iter().map(|n| u64::from(*n)).product::<u64>();
    let all = parts[0].iter().flat_map(|a| {
        let (b, c) = (&parts[1], &parts[2]);
        b.iter().flat_map(move |b| c.iter().map(move |c| [*a, *b, *c]))
    });
    let fit: Vec<[u32; 3]> = all.filter(|block| places(block).is_multiple_of(u64::from(beads))).collect();
    // Of blocks with as many places the one that is most like a cube.
    let most = |block: &&[u32; 3]| (places(block), block.iter().min().copied());
    let few = fit.iter().filter(|block| places(block) <= FEW_PLACES).max_by_key(most);
    few.or_else(|| fit.iter().min_by_key(|block| places(block))).copied().filter(|block| places(block) <= MOST_PLACES)
}

/// A cubic lattice; site (i, j, k) has the number  i + x (j + y k).
struct Lattice {
    sides: [u32; 3],
    periodic: [bool; 3],
}

impl Lattice {
    fn place(&self, site: u32) -> [u32; 3] {
        let [x, y, _] = self.sides;
        [site % x, site / x % y, site / x / y]
    }
    fn site(&self, [i, j, k]: [u32; 3]) -> u32 {
        i + self.sides[0] * (j + self.sides[1] * k)
    }
    /// One of the six neighbours; `None` beyond a side.
    fn neighbor(&self, site: u32, way: usize) -> Option<u32> {
        let (axis, up) = (way / 2, way.is_multiple_of(2));
        let (mut place, side) = (self.place(site), self.sides[way / 2]);
        place[axis] = match (up, place[axis]) {
            (true, n) if n + 1 < side => n + 1,
            (false, n) if n > 0 => n - 1,
            (true, _) if self.periodic[axis] => 0,
            (false, _) if self.periodic[axis] => side - 1,
            _ => return None,
        };
        Some(self.site(place))
    }
}

/// A path through all sites, each once.
struct Path {
    order: Vec<u32>,
    /// Where in the order a site is.
    place: Vec<u32>,
}

impl Path {
    /// To and fro along rows.
    fn straight(lattice: &Lattice, count: usize) -> Self {
        let [x, y, _] = lattice.sides;
        let snake = |n: u32| {
            let (row, layer) = (n / x, n / x / y);
            let i = if row.is_multiple_of(2) { n % x } else { x - 1 - n % x };
            let j = if layer.is_multiple_of(2) { row % y } else { y - 1 - row % y };
            lattice.site([i, j, layer])
        };
        let order: Vec<u32> = (0..u32::try_from(count).unwrap_or(u32::MAX)).map(snake).collect();
        let mut path = Self { place: vec![0; count], order };
        path.note(0, count);
        path
    }
    /// Stores where the sites of a piece are.
    fn note(&mut self, from: usize, to: usize) {
        for at in from..to {
            self.place[self.order[at] as usize] = u32::try_from(at).unwrap_or(u32::MAX);
        }
    }
    /// Joins an end with a neighbour on the lattice, and opens the loop there: what is between is reversed.
    fn turn(&mut self, lattice: &Lattice, random: &mut Random) {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "one of twelve")]
        let choice = (12.0 * random.uniform()) as usize;
        let last = self.order.len() - 1;
        let front = choice.is_multiple_of(2);
        let end = if front { self.order[0] } else { self.order[last] };
        let Some(other) = lattice.neighbor(end, choice / 2) else { return };
        let at = self.place[other as usize] as usize;
        let (from, to) = if front { (0, at) } else { (at + 1, last + 1) };
        if from < to {
            self.order[from..to].reverse();
            self.note(from, to);
        }
    }
}
