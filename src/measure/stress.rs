//! The stress of grains: what contacts transmit and what moving grains carry, of the whole of a region or in slabs.

use glam::{DMat3, DVec3};

use super::region::{AXIS, BINS, HIGH, LOW, Region, Slabs, axes};
use super::{Cell, Measure, Moment, Row, Series, Times};
use crate::component::earlier;
use crate::error::Error;
use crate::forces::Component;
use crate::grains::{ContactForce, volume};
use crate::simulation::Setup;

/// `stress.csv`.
pub const MEASURE: Measure = Measure {
    name: "stress",
    about: "the stress tensor of grains in a region, or in slabs, −(Σ f ⊗ l − Σ m v ⊗ v) / V over contacts by `contact` and `contact_wall` and over grains that are not fixed: compression is positive (Love 1927, Weber 1966; Goldhirsch 2010); a contact belongs to slabs by the parts of the line between its centres that lie in them",
    keys: &[LOW, HIGH, AXIS, BINS],
    cells: &[
        ("low", "where a slab begins along the axis; empty without one [length]"),
        ("high", "where it ends"),
        ("pressure", "p, a third of xx + yy + zz; half of xx + yy in two dimensions [mass / length / time²; mass / time² in two dimensions, as the others]"),
        ("deviator", "q = √(3/2 s : s) with the symmetric deviator s; half the difference of the principal stresses in two dimensions [mass / length / time²]"),
        ("kinetic", "the part of the pressure that velocities relative to the mean of the slab carry [mass / length / time²]"),
        ("xx", "the force along x that passes an area across x [mass / length / time²]"),
        ("xy", "along x, across y"),
        ("xz", "along x, across z"),
        ("yx", "along y, across x"),
        ("yy", "along y, across y"),
        ("yz", "along y, across z"),
        ("zx", "along z, across x"),
        ("zy", "along z, across y"),
        ("zz", "along z, across z"),
        ("shear_rate", "by how much the mean velocity across the axis changes along it, between the slabs beside; empty without an axis and where no slab beside has grains [1 / time]"),
        ("inertial", "the inertial number, the shear rate times d √(ρ / p) with the mean diameter and the density of the grains (GDR MiDi 2004); empty where p is not above 0"),
    ],
    times: Times::Chosen,
    usual: |_| Ok(None),
    begin: |setup, settings| {
        let region = Region::of(MEASURE.name, setup, settings)?;
        Ok(Box::new(Stress { region, forces: contacts(setup)? }))
    },
};

/// A component with contacts, and how many of its kind are before it.
type Own = (Box<dyn Component>, usize);

/// The components with contacts of a setup.
fn contacts(setup: &Setup) -> Result<Vec<Own>, Error> {
    let forces = &setup.forces;
    let known = |place: &usize| !forces[*place].properties().touches.is_empty();
    let own = forces.iter().filter(|force| force.properties().touches.is_empty()).flat_map(|force| force.laws());
    if let Some(law) = own.into_iter().find(crate::visit::Law::remembers) {
        return Err(Error::Scene(format!(
            "the measure `stress` knows the forces of `contact` and `contact_wall`, and `{}` is another law that keeps history of pairs: leave \
             the measure out",
            law.name
        )));
    }
    let all: Vec<_> = (0..forces.len()).filter(known).map(|place| (forces[place].clone(), earlier(forces, place))).collect();
    if all.is_empty() {
        return Err(Error::Scene(
            "the measure `stress` is one of contacts, and there are none: add a force of kind `contact`, or leave it out".to_owned(),
        ));
    }
    Ok(all)
}

/// Stresses of a run.
struct Stress {
    region: Region,
    forces: Vec<Own>,
}

impl std::fmt::Debug for Stress {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Stress").field("region", &self.region).finish_non_exhaustive()
    }
}

/// The sums of a slab.
#[derive(Debug, Clone, Copy)]
struct Sum {
    grains: f64,
    mass: f64,
    momentum: DVec3,
    /// Σ m x along the axis.
    moment: f64,
    diameter: f64,
    volume: f64,
    /// Σ m v ⊗ v, and −Σ f ⊗ l: columns are those across an axis.
    kinetic: DMat3,
    contacts: DMat3,
}

impl Sum {
    /// That of no grains.
    const NONE: Self = Self {
        grains: 0.0,
        mass: 0.0,
        momentum: DVec3::ZERO,
        moment: 0.0,
        diameter: 0.0,
        volume: 0.0,
        kinetic: DMat3::ZERO,
        contacts: DMat3::ZERO,
    };
    fn velocity(&self) -> DVec3 {
        self.momentum / self.mass
    }
    fn has_mass(&self) -> bool {
        self.mass > 0.0
    }
    /// The stress, and its part of velocities.
    fn stress(&self, slabs: &Slabs) -> [DMat3; 2] {
        let own = if self.has_mass() { self.kinetic - outer(self.momentum, self.velocity()) } else { DMat3::ZERO };
        [(own + self.contacts) * (1.0 / slabs.volume()), own * (1.0 / slabs.volume())]
    }
}

/// a ⊗ b, with b in columns.
fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

/// The pressure of a tensor.
fn pressure(stress: &DMat3, dimensions: usize) -> f64 {
    (0..dimensions).map(|axis| stress.col(axis)[axis]).sum::<f64>() / dimensions as f64
}

/// q of a tensor.
fn deviator(stress: &DMat3, dimensions: usize) -> f64 {
    let symmetric = (*stress + stress.transpose()) * 0.5;
    let s = symmetric - DMat3::from_diagonal(DVec3::splat(pressure(stress, dimensions)));
    let square: f64 = (0..dimensions).flat_map(|k| (0..dimensions).map(move |l| (k, l))).map(|(k, l)| s.col(k)[l].powi(2)).sum();
    (if dimensions == 2 { 0.5 } else { 1.5 } * square).sqrt()
}

impl Stress {
    fn sums(&self, moment: &Moment<'_>, slabs: &Slabs) -> Result<Vec<Sum>, Error> {
        let (state, bounds) = (moment.state, moment.bounds(self.region.bounds()));
        let (grains, radii) = (self.region.grains(state), state.scalar("radius").unwrap_or_default());
        let mut sums = vec![Sum::NONE; slabs.count()];
        for i in grains.all.into_iter().filter(|i| !grains.fixed[*i]) {
            let (x, v, m) = (state.position()[i], state.velocity()[i], state.mass()[i]);
            let Some(sum) = slabs.slab(x).map(|slab| &mut sums[slab]) else { continue };
            sum.grains += 1.0;
            sum.mass += m;
            sum.momentum += m * v;
            sum.moment += m * slabs.along(x);
            sum.diameter += 2.0 * radii[i];
            sum.volume += volume(radii[i], bounds.dimensions);
            sum.kinetic += outer(m * v, v);
        }
        for (force, earlier) in &self.forces {
            for one in force.contacts(state, &bounds, *earlier)? {
                let Some((from, way, force)) = branch(&one, state.position(), &grains.fixed) else { continue };
                slabs.path(from, way, |slab, part| sums[slab].contacts -= outer(force, way) * part);
            }
        }
        Ok(sums)
    }
    fn row(sums: &[Sum], slabs: &Slabs, number: usize) -> Row {
        let (sum, dimensions) = (&sums[number], axes(slabs.bounds()));
        let [stress, own] = sum.stress(slabs);
        let p = pressure(&stress, dimensions);
        let numbers = [p, deviator(&stress, dimensions), pressure(&own, dimensions)];
        let parts = (0..3).flat_map(|along| (0..3).map(move |across| stress.col(across)[along]));
        let rate = shear_rate(sums, slabs, number);
        let inertial = rate.filter(|_| p > 0.0 && sum.grains > 0.0 && sum.has_mass());
        let inertial = inertial.map(|rate| rate * sum.diameter / sum.grains * (sum.mass / sum.volume / p).sqrt());
        let ends = [rate, inertial].map(|x| x.map_or(Cell::Empty, Cell::from));
        let numbers = numbers.into_iter().chain(parts).map(Cell::from);
        slabs.ends(number).into_iter().chain(numbers).chain(ends).collect()
    }
}

/// The line along which a contact's force acts inside of grains that are not fixed, from where and which way, and the force on that end: fixed
/// grains end where they are touched, as walls do (Weinhart et al., Granular Matter 14, 289, 2012).
fn branch(one: &ContactForce, places: &[DVec3], fixed: &[bool]) -> Option<(DVec3, DVec3, DVec3)> {
    let from = places[one.grain];
    match one.other {
        None => (!fixed[one.grain]).then_some((from, one.way, one.force)),
        Some(other) => match (fixed[one.grain], fixed[other]) {
            (true, true) => None,
            (true, false) => Some((from + one.arm, one.way - one.arm, one.force)),
            (false, true) => Some((from, one.arm, one.force)),
            (false, false) => Some((from, one.way, one.force)),
        },
    }
}

/// How the mean velocity changes along the axis, from the slab before to the one after, as far as they have grains.
fn shear_rate(sums: &[Sum], slabs: &Slabs, number: usize) -> Option<f64> {
    let axis = slabs.axis()?;
    let near = |slab: Option<usize>| slab.and_then(|slab| sums.get(slab)).filter(|sum| sum.has_mass());
    let own = near(Some(number))?;
    let (before, after) = (near(number.checked_sub(1)).unwrap_or(own), near(Some(number + 1)).unwrap_or(own));
    let way = after.moment / after.mass - before.moment / before.mass;
    let mut change = after.velocity() - before.velocity();
    change[axis] = 0.0;
    (way > 0.0).then(|| change.length() / way)
}

impl Series for Stress {
    fn take(&mut self, moment: &Moment<'_>) -> Result<Vec<Row>, Error> {
        let slabs = self.region.at(moment)?;
        let sums = self.sums(moment, &slabs)?;
        Ok((0..slabs.count()).map(|number| Self::row(&sums, &slabs, number)).collect())
    }
    fn recall(&mut self, _: u64, _: &[&str]) {}
    fn follow(&mut self, setup: &Setup) -> Result<(), Error> {
        self.forces = contacts(setup)?;
        Ok(())
    }
}
