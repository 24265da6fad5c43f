//! Copies of some particles, such as those of a molecule, turned and placed at random.

use std::collections::BTreeMap;

use glam::{DMat3, DQuat, DVec3};

use super::random::Random;
use crate::error::Error;
use crate::kernel::{Bounds, Side};
use crate::state::State;

/// Attempts to place a copy before it is an error.
const ATTEMPTS: u32 = 10_000;

/// How often particles are placed, and where.
#[derive(Debug, Clone, PartialEq)]
pub struct Copies {
    /// The number of copies, 1 or above.
    pub count: u32,
    /// The corners between which the centres of mass lie \[length\].
    pub room: [DVec3; 2],
    /// Whether the centres are on a lattice; else anywhere in the room.
    pub lattice: bool,
    /// The least distance of particles of two copies, over periodic sides, too \[length\].
    pub separation: f64,
    /// k T: velocities are Maxwellian about the mean velocity of the particles, and have exactly 2 K / (3 N − 3) = k T about it, in the plane
    /// 2 K / (2 N − 2) \[energy\]; 0: those of the particles, turned with them.
    pub temperature: f64,
    /// The seed of the random numbers.
    pub seed: u64,
}

impl Copies {
    /// All copies, none of which reaches through a reflecting side, each turned by a uniform random rotation (Shoemake 1992), in the plane about the third axis. Columns of particles are those of
    /// the first ones.
    ///
    /// # Errors
    /// [`Error::Scene`] where numbers are not finite, particles without mass shall have a temperature, or a copy finds no place.
    pub fn of(&self, particles: &State, bounds: &Bounds) -> Result<State, Error> {
        let refuse = |text: String| Err(Error::Scene(text));
        let Self { count, room: [low, high], separation, temperature, .. } = *self;
        let finite = low.is_finite() && high.is_finite() && separation.is_finite() && temperature.is_finite();
        if count == 0 || !finite || (high - low).min_element() < 0.0 {
            return refuse(format!("{count} copies between {low} and {high}: give one or more, and finite corners"));
        }
        let (flat, number) = (bounds.dimensions == 2, particles.len());
        if let (Some(id), true) = (particles.mass().iter().position(|mass| *mass <= 0.0), temperature > 0.0) {
            return refuse(format!(
                "particle {id} has no mass, so it has no temperature: give it a mass, or no temperature"
            ));
        }
        let mut all = repeated(particles, count)?;
        let (middle, speed) = particles.center();
        let mut random = Random::new(self.seed);
        let centers = self.lattice.then(|| lattice(count, low, high, flat));
        let mut taken = Taken::new(separation, bounds);
        for n in 0..count {
            let start = n as usize * number;
            let mut attempts = 0;
            loop {
                let center = match &centers {
                    Some(centers) => centers[n as usize],
                    None => DVec3::from([0, 1, 2].map(|axis| random.between(low[axis], high[axis]))),
                };
                let turn = rotation(&mut random, flat);
                let places: Vec<_> = particles.position().iter().map(|x| center + turn * (*x - middle)).collect();
                let near = |place: &DVec3| separation > 0.0 && taken.is_near(*place);
                if places.iter().any(|place| near(place) || is_through(*place, bounds)) {
                    attempts += 1;
                    if attempts == ATTEMPTS {
                        let inside = if bounds.has(Side::Reflecting) { " and inside of the box" } else { "" };
                        let way_out = if self.lattice { "" } else { ", or arrangement = \"lattice\"" };
                        return refuse(format!(
                            "copy {} of {count} found no place with {separation} to the particles of others{inside}, in {ATTEMPTS} attempts: choose \
                             fewer `copies`, a smaller `separation`, another `room`{way_out}",
                            n + 1
                        ));
                    }
                    continue;
                }
                if separation > 0.0 {
                    places.iter().for_each(|place| taken.add(*place));
                }
                let velocities = particles.velocity().iter().map(|v| speed + turn * (*v - speed));
                all.velocity_mut()[start..start + number].iter_mut().zip(velocities).for_each(|(v, new)| *v = new);
                all.position_mut()[start..start + number].copy_from_slice(&places);
                break;
            }
        }
        if temperature > 0.0 {
            heat(&mut all, temperature, speed, flat, &mut random);
        }
        Ok(all)
    }
}

/// The same particles so many times.
fn repeated(particles: &State, count: u32) -> Result<State, Error> {
    if count <= 1 {
        return Ok(particles.clone());
    }
    let half = repeated(particles, count / 2)?;
    let mut all = half.clone();
    all.append(&half)?;
    if count % 2 == 1 {
        all.append(particles)?;
    }
    Ok(all)
}

/// The middles of as many cells of a box, which are as much like cubes as they can be; the layers of the last axis first.
fn lattice(count: u32, low: DVec3, high: DVec3, flat: bool) -> Vec<DVec3> {
    let size = high - low;
    let axes = if flat { 2 } else { 3 };
    let mut number = [1u32; 3];
    while number.iter().map(|n| u64::from(*n)).product::<u64>() < u64::from(count) {
        // The longest edge of a cell is divided.
        let edge = |axis: &usize| size[*axis] / f64::from(number[*axis]);
        let longest = (0..axes).max_by(|a, b| edge(a).total_cmp(&edge(b))).unwrap_or(0);
        number[longest] += 1;
    }
    let [x, y, _] = number;
    let middle = |n: u32| DVec3::from([n % x, n / x % y, n / x / y].map(|k| f64::from(k) + 0.5));
    (0..count).map(|n| low + size * middle(n) / DVec3::from(number.map(f64::from))).collect()
}

fn rotation(random: &mut Random, flat: bool) -> DMat3 {
    let turn = std::f64::consts::TAU * random.uniform();
    let (cosine, sine) = (libm::cos(turn), libm::sin(turn));
    if flat {
        return DMat3::from_cols(DVec3::new(cosine, sine, 0.0), DVec3::new(-sine, cosine, 0.0), DVec3::Z);
    }
    let part = random.uniform();
    let other = std::f64::consts::TAU * random.uniform();
    let (a, b) = ((1.0 - part).sqrt(), part.sqrt());
    DMat3::from_quat(DQuat::from_xyzw(a * sine, a * cosine, b * libm::sin(other), b * libm::cos(other)).normalize())
}

/// Whether a place is on the other side of a mirror.
fn is_through(place: DVec3, bounds: &Bounds) -> bool {
    let mirrors = bounds.axes(Side::Reflecting);
    (0..3).any(|axis| mirrors[axis] > 0.0 && !(bounds.low[axis]..=bounds.high[axis]).contains(&place[axis]))
}

/// Maxwellian velocities in place of those that there are, about a mean velocity.
fn heat(particles: &mut State, temperature: f64, speed: DVec3, flat: bool, random: &mut Random) {
    let (axes, dimensions) = if flat { (DVec3::new(1.0, 1.0, 0.0), 2.0) } else { (DVec3::ONE, 3.0) };
    let masses = particles.mass().to_vec();
    let total: f64 = masses.iter().sum();
    let drawn: Vec<DVec3> = masses.iter().map(|mass| random.normals() * axes / mass.sqrt()).collect();
    let mean = drawn.iter().zip(&masses).map(|(v, mass)| *v * *mass).sum::<DVec3>() / total;
    let sum: f64 = drawn.iter().zip(&masses).map(|(v, mass)| mass * (*v - mean).length_squared()).sum();
    if sum <= 0.0 {
        return;
    }
    let factor = (temperature * dimensions * (masses.len() as f64 - 1.0) / sum).sqrt();
    particles.velocity_mut().iter_mut().zip(drawn).for_each(|(v, drawn)| *v = speed + (drawn - mean) * factor);
}

/// Places of particles by cells that are no smaller than a distance.
struct Taken<'a> {
    bounds: &'a Bounds,
    distance: f64,
    /// Cells along each axis; 0: any number.
    cells: [i64; 3],
    edge: DVec3,
    by_cell: BTreeMap<[i64; 3], Vec<DVec3>>,
}

impl<'a> Taken<'a> {
    #[expect(clippy::cast_possible_truncation, reason = "saturates, and a million is the most")]
    fn new(distance: f64, bounds: &'a Bounds) -> Self {
        let (periodic, period) = (bounds.axes(Side::Periodic), bounds.high - bounds.low);
        let cells = [0, 1, 2]
            .map(|axis| if periodic[axis] > 0.0 { ((period[axis] / distance) as i64).clamp(1, 1_000_000) } else { 0 });
        let of = |axis: usize| if cells[axis] > 0 { period[axis] / cells[axis] as f64 } else { distance };
        Self { bounds, distance, cells, edge: DVec3::new(of(0), of(1), of(2)), by_cell: BTreeMap::new() }
    }
    #[expect(clippy::cast_possible_truncation, reason = "saturates: far away all are in one cell")]
    fn cell(&self, place: DVec3) -> [i64; 3] {
        let at = ((place - self.bounds.low) / self.edge).floor();
        [0, 1, 2].map(|axis| self.inside(axis, at[axis] as i64))
    }
    fn inside(&self, axis: usize, n: i64) -> i64 {
        if self.cells[axis] > 0 { n.rem_euclid(self.cells[axis]) } else { n }
    }
    fn add(&mut self, place: DVec3) {
        let cell = self.cell(place);
        self.by_cell.entry(cell).or_default().push(place);
    }
    fn is_near(&self, place: DVec3) -> bool {
        let cell = self.cell(place);
        (0..27).any(|n| {
            let way = [n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1];
            let there = [0, 1, 2].map(|axis| self.inside(axis, cell[axis].saturating_add(way[axis])));
            let near = |other: &DVec3| self.bounds.shortest(*other - place).length() < self.distance;
            self.by_cell.get(&there).is_some_and(|places| places.iter().any(near))
        })
    }
}
