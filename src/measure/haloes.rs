//! Friends-of-friends groups (Davis, Efstathiou, Frenk & White, ApJ 292, 371, 1985): particles nearer to each other than the linking length b are
//! linked, and all that chains of links join are a group. Of a group of mass M = Σ m in d dimensions, with x by minimum images from one of it:
//!   centre  Σ m x / M,  velocity  v̄ = Σ m v / M,  dispersion  √(Σ m |v − v̄|² / d M),  radius  √(Σ m |x − centre|² / M).
//! N particles are sorted by cells with a diagonal shorter than b, so that all in a cell are linked, and two cells are joined by the first pair that
//! is found: O(N log N), also where thousands lie within b of each other.

mod lattice;

use std::borrow::Cow;
use std::cmp::Reverse;

use glam::DVec3;
use rayon::prelude::*;

use super::{Cell, Measure, Moment, Row, Series, Times};
use crate::boundary::wrapped;
use crate::error::Error;
use crate::kernel::Bounds;
use crate::settings::{Key, Kind, Value};
use crate::state::State;
use lattice::groups;

/// `haloes.csv`.
pub const MEASURE: Measure = Measure {
    name: "haloes",
    about: "friends-of-friends groups: sets of particles that are joined by chains of pairs nearer than a linking length (Davis, Efstathiou, Frenk & White 1985): a row for each group at each output, the largest first",
    keys: &[
        Key::new(
            "linking_length",
            Kind::Positive,
            Value::Number(0.2),
            "the linking length in a box that is periodic along all axes, in units of the mean distance (V / N)^(1/3) between the particles that are measured, or (A / N)^(1/2) in the plane",
        ),
        Key::new(
            "linking_distance",
            Kind::NotNegative,
            Value::Number(0.0),
            "the linking length in any box, in place of linking_length where it is above 0 [length]",
        ),
        Key::new("members", Kind::Count, Value::Number(20.0), "the minimum number of particles in a group"),
        Key::new(
            "species",
            Kind::Species,
            Value::Text(Cow::Borrowed("all")),
            "the species that is measured, or \"all\"",
        ),
    ],
    cells: &[
        (
            "rank",
            "the place of the group in the order of numbers of particles, from 1; of equal ones that with the lower id comes first",
        ),
        ("particles", "the number of its particles"),
        ("mass", "M = Σ m [mass]"),
        ("x", "the centre of mass, inside of the box; without mass, the mean position [length]"),
        ("y", "along y"),
        ("z", "along z"),
        ("velocity_x", "v̄ = Σ m v / M; without mass, the mean velocity [length / time]"),
        ("velocity_y", "along y"),
        ("velocity_z", "along z"),
        ("dispersion", "√(Σ m |v − v̄|² / d M) in d dimensions: the root mean square along one axis [length / time]"),
        ("radius", "√(Σ m |x − centre|² / M) [length]"),
        ("id", "the lowest id of its particles"),
    ],
    times: Times::Chosen,
    usual: |_| Ok(None),
    begin: |setup, settings| {
        let bounds = setup.bounds;
        let [part, distance] = ["linking_length", "linking_distance"].map(|key| settings.number(key));
        if distance <= 0.0 && spacing(&bounds, 1).is_none() {
            let why = format!(
                "`haloes` has linking_length = {part}, a part of the mean distance between particles, and a box that is not periodic along all axes has none: set linking_distance [length], or [box] boundary = \"periodic\""
            );
            return Err(Error::Setting { key: "linking_length", why });
        }
        let species = settings.species("species");
        if let Some(one) = species
            && !setup.state.species().contains(&one)
        {
            let why = format!("`haloes` has species = {one}, and no particle is of it: choose another, or \"all\"");
            return Err(Error::Setting { key: "species", why });
        }
        Ok(Box::new(Haloes { bounds, part, distance, species, members: settings.whole("members") }))
    },
};

/// The mean distance between so many particles \[length\]; none in a box that is not periodic along all axes.
fn spacing(bounds: &Bounds, count: usize) -> Option<f64> {
    let axes = if bounds.dimensions == 2 { 2 } else { 3 };
    let period = bounds.period().to_array();
    let sides = &period[..axes];
    let each = sides.iter().product::<f64>() / count as f64;
    sides.iter().all(|side| *side > 0.0).then(|| if axes == 2 { each.sqrt() } else { each.cbrt() })
}

/// Groups of a run.
#[derive(Debug)]
struct Haloes {
    bounds: Bounds,
    /// The linking length in units of the mean distance between particles.
    part: f64,
    /// The linking length \[length\]; 0: that in units of the mean distance counts.
    distance: f64,
    species: Option<u32>,
    members: u64,
}

/// A group.
#[derive(Debug)]
struct Halo {
    particles: u64,
    mass: f64,
    centre: DVec3,
    velocity: DVec3,
    dispersion: f64,
    radius: f64,
    id: u32,
}

impl Halo {
    /// That of the particles at some places of a state, in whose order sums are taken.
    fn of(state: &State, bounds: &Bounds, places: &[usize], ids: &[u32]) -> Self {
        let (x, v, m) = (state.position(), state.velocity(), state.mass());
        let mass: f64 = places.iter().map(|i| m[*i]).sum();
        // Where none has mass, all count alike.
        let weight = |i: usize| if mass > 0.0 { m[i] / mass } else { 1.0 / places.len() as f64 };
        let origin = places.first().map_or(DVec3::ZERO, |i| x[*i]);
        let from = |i: usize| bounds.shortest(x[i] - origin);
        let middle: DVec3 = places.iter().map(|i| weight(*i) * from(*i)).sum();
        let velocity: DVec3 = places.iter().map(|i| weight(*i) * v[*i]).sum();
        let spread: f64 = places.iter().map(|i| weight(*i) * (from(*i) - middle).length_squared()).sum();
        let random: f64 = places.iter().map(|i| weight(*i) * (v[*i] - velocity).length_squared()).sum();
        Self {
            particles: places.len() as u64,
            mass,
            centre: wrapped(bounds, origin + middle),
            velocity,
            dispersion: (random / f64::from(bounds.dimensions)).sqrt(),
            radius: spread.sqrt(),
            id: places.iter().map(|i| ids[*i]).min().unwrap_or(u32::MAX),
        }
    }
    fn row(&self, rank: u64) -> Row {
        let [x, y, z] = self.centre.to_array();
        let [u, v, w] = self.velocity.to_array();
        let filled = |x: f64| if x.is_finite() { Cell::Number(x) } else { Cell::Empty };
        let numbers = [self.mass, x, y, z, u, v, w, self.dispersion, self.radius].map(filled);
        [rank, self.particles].map(Cell::Whole).into_iter().chain(numbers).chain([Cell::from(self.id)]).collect()
    }
}

impl Series for Haloes {
    fn take(&mut self, moment: &Moment<'_>) -> Result<Vec<Row>, Error> {
        let (state, bounds) = (moment.state, moment.bounds(&self.bounds));
        let (position, species) = (state.position(), state.species());
        let is = |i: &usize| {
            let is_of = self.species.is_none_or(|one| species.get(*i) == Some(&one));
            is_of && state.is_active(*i) && position[*i].is_finite()
        };
        let chosen: Vec<usize> = (0..state.len()).filter(is).collect();
        let distance = match spacing(&bounds, chosen.len()) {
            Some(mean) if self.distance <= 0.0 => self.part * mean,
            _ => self.distance,
        };
        let images: Vec<DVec3> = chosen.iter().map(|i| wrapped(&bounds, position[*i])).collect();
        let ids = state.ids();
        let halo = |group: Vec<usize>| {
            let places: Vec<usize> = group.into_iter().map(|k| chosen[k]).collect();
            Halo::of(state, &bounds, &places, &ids)
        };
        let found = groups(&images, &bounds, distance, self.members);
        let mut haloes: Vec<Halo> = found.into_par_iter().map(halo).collect();
        haloes.sort_unstable_by_key(|halo| (Reverse(halo.particles), halo.id));
        Ok(haloes.iter().zip(1..).map(|(halo, rank)| halo.row(rank)).collect())
    }
    fn recall(&mut self, _: u64, _: &[&str]) {}
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::component::barostat::{CORNER, corner};
    use crate::kernel::{Array, Side};
    use crate::life::Life;

    /// Particles at rest.
    fn at(positions: &[DVec3]) -> State {
        let mut state = State::default();
        positions.iter().for_each(|x| state.push(*x, DVec3::ZERO, 1.0, 0.0));
        state
    }
    fn along(x: &[f64]) -> State {
        at(&x.iter().map(|x| DVec3::new(*x, 0.0, 0.0)).collect::<Vec<_>>())
    }
    /// By a linking length in units of length.
    fn linked(distance: f64, members: u64) -> Haloes {
        Haloes { bounds: Bounds::default(), part: 0.2, distance, species: None, members }
    }
    fn rows(mut haloes: Haloes, state: State) -> Vec<Row> {
        let state = Arc::new(state);
        let moment = Moment { state: &state, density: &[], clock: None, links: None, virial: None };
        haloes.take(&moment).expect("rows")
    }
    fn whole(rows: &[Row], cell: usize) -> Vec<u64> {
        let of = |row: &Row| if let Cell::Whole(n) = row[cell] { n } else { u64::MAX };
        rows.iter().map(of).collect()
    }
    fn number(row: &[Cell], cell: usize) -> f64 {
        if let Cell::Number(x) = row[cell] { x } else { f64::NAN }
    }

    /// Of two with the reduced mass μ: radius √(μ / M) r, dispersion √(μ / d M) |Δv|.
    #[test]
    fn a_pair_has_its_centre_radius_and_dispersion_across_seams() {
        for (dimensions, side) in [(3_u32, Side::Periodic), (3, Side::Open), (2, Side::Periodic), (2, Side::Open)] {
            let solid = if dimensions == 3 { 1.0 } else { 0.0 };
            let bounds = Bounds::new(DVec3::new(-1.0, -2.0, -2.0 * solid), DVec3::new(1.0, 2.0, 2.0 * solid), side);
            assert_eq!(bounds.dimensions, dimensions);
            let (first, way) = (DVec3::new(0.97, -1.98, 0.5 * solid), DVec3::new(0.08, -0.05, 0.06 * solid));
            let (start, turn) = (DVec3::new(1.0, 0.5, -solid), DVec3::new(0.4, -0.2, 0.4 * solid));
            let across = if side == Side::Periodic { DVec3::new(-2.0, 4.0, 0.0) } else { DVec3::ZERO };
            let mut state = State::default();
            state.push(first, start, 1.0, 0.0);
            state.push(first + way + across, start + turn, 3.0, 0.0);
            let rows = rows(Haloes { bounds, ..linked(0.2, 2) }, state);
            assert_eq!([whole(&rows, 0), whole(&rows, 1), whole(&rows, 11)], [[1], [2], [0]]);
            let (centre, velocity) = (first + 0.75 * way + across, start + 0.75 * turn);
            let part = (3.0_f64 / 16.0).sqrt();
            let dispersion = part / f64::from(dimensions).sqrt() * turn.length();
            let want = [4.0, centre.x, centre.y, centre.z, velocity.x, velocity.y, velocity.z, dispersion];
            for (cell, want) in want.into_iter().chain([part * way.length()]).enumerate() {
                let have = number(&rows[0], 2 + cell);
                assert!((have - want).abs() < 1e-12, "{dimensions} {side:?}, cell {cell}: {have} for {want}");
            }
        }
    }
    #[test]
    fn a_bridge_of_one_particle_joins_two_groups() {
        let line = |from: f64| (0..20).map(move |k| from + 0.9 * f64::from(k));
        let apart: Vec<f64> = line(0.0).chain(line(18.9)).collect();
        assert_eq!(whole(&rows(linked(1.0, 20), along(&apart)), 1), [20, 20]);
        assert!(rows(linked(1.0, 21), along(&apart)).is_empty());
        let joined: Vec<f64> = apart.iter().copied().chain([18.0]).collect();
        assert_eq!(whole(&rows(linked(1.0, 41), along(&joined)), 1), [41]);
        assert!(rows(linked(1.0, 42), along(&joined)).is_empty());
        let aside: Vec<f64> = apart.iter().copied().chain([18.0 + 1e3]).collect();
        assert_eq!(whole(&rows(linked(1.0, 1), along(&aside)), 1), [20, 20, 1]);
    }
    #[test]
    fn the_largest_is_first_and_of_equal_ones_that_with_the_lowest_id() {
        let mut state = along(&[0.0, 0.5, 10.0, 10.5, 20.0, 20.5, 21.0]);
        state.set_ids(vec![7, 8, 9, 3, 20, 21, 22]).expect("ids");
        let rows = rows(linked(1.0, 2), state);
        assert_eq!([whole(&rows, 0), whole(&rows, 1), whole(&rows, 11)], [[1, 2, 3], [3, 2, 2], [20, 3, 7]]);
    }
    #[test]
    fn particles_that_are_removed_not_finite_or_of_another_species_link_nothing() {
        let chain = || along(&[0.0, 0.9, 1.8]);
        assert_eq!(whole(&rows(linked(1.0, 2), chain()), 1), [3]);
        let mut gap = chain();
        gap.set_life(1, Life::Removed);
        assert!(rows(linked(1.0, 2), gap).is_empty());
        let mut lost = chain();
        lost.position_mut()[1].y = f64::NAN;
        assert!(rows(linked(1.0, 2), lost).is_empty());
        let mut mixed = chain();
        mixed.species_mut()[1] = 4;
        let only = |species: u32| Haloes { species: Some(species), ..linked(1.0, 1) };
        assert_eq!(whole(&rows(only(0), mixed.clone()), 1), [1, 1]);
        assert_eq!(whole(&rows(only(4), mixed), 11), [1]);
        assert!(rows(linked(1.0, 1), State::default()).is_empty());
    }
    #[test]
    fn without_mass_all_count_alike() {
        let mut state = along(&[1.0, 1.5, 2.0]);
        state.mass_mut().fill(0.0);
        let rows = rows(linked(1.0, 2), state);
        assert!(number(&rows[0], 2).abs() < 1e-15 && (number(&rows[0], 3) - 1.5).abs() < 1e-12, "{rows:?}");
        assert!((number(&rows[0], 10) - (0.5_f64 / 3.0).sqrt()).abs() < 1e-12, "{rows:?}");
    }
    /// Eight particles in a volume of 8, or four in an area of 4, have a mean distance of 1; so have those of one species among others.
    #[test]
    fn the_linking_length_is_a_part_of_the_mean_distance() {
        for (flat, apart, groups) in [(false, 0.49, 4), (false, 0.51, 0), (true, 0.49, 2), (true, 0.51, 0)] {
            let high = DVec3::new(2.0, 2.0, if flat { 0.0 } else { 2.0 });
            let layers: &[f64] = if flat { &[0.0] } else { &[0.5, 1.5] };
            let mut state = State::default();
            for z in layers {
                for x in [0.5, 1.5] {
                    // Across the side at y = 0.
                    let ends = [0.5 * apart, 2.0 - 0.5 * apart];
                    ends.iter().for_each(|y| state.push(DVec3::new(x, *y, *z), DVec3::ZERO, 1.0, 0.0));
                    state.push(DVec3::new(x, 1.0, *z), DVec3::ZERO, 1.0, 0.0);
                    let last = state.len() - 1;
                    state.species_mut()[last] = 1;
                }
            }
            let bounds = Bounds::new(DVec3::ZERO, high, Side::Periodic);
            let haloes = |species| Haloes { bounds, part: 0.5, species, ..linked(0.0, 2) };
            assert_eq!(rows(haloes(Some(0)), state.clone()).len(), groups, "{flat} {apart}");
            // A half as many more have a mean distance of 0.87, or 0.82.
            assert!(rows(haloes(None), state).is_empty(), "{flat} {apart}");
        }
    }
    #[test]
    fn the_mean_distance_is_that_of_the_box_as_it_is() {
        let bounds = Bounds::new(DVec3::ZERO, DVec3::splat(2.0), Side::Periodic);
        let haloes = || Haloes { bounds, part: 0.5, ..linked(0.0, 2) };
        let mut state = along(&[0.0, 0.9]);
        (0..6).for_each(|_| state.push(DVec3::splat(1.0), DVec3::ZERO, 1.0, 0.0));
        assert_eq!(whole(&rows(haloes(), state.clone()), 1), [6]);
        state.declare(&corner()).expect("a column");
        state.set(CORNER.name, Array::Vec3(vec![DVec3::splat(4.0)])).expect("a box");
        assert_eq!(whole(&rows(haloes(), state), 1), [6, 2]);
    }
}
