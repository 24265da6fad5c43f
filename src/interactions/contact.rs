//! Granular contacts: spheres with friction that depends on their sliding history.

use std::sync::Arc;

use glam::DVec3;

use super::pair_potential::rows;
use super::{Component, Law, Properties};
use crate::component::Largest;
use crate::error::Error;
use crate::grains::{self, Ball, ContactForce, MARGIN, Material, Meeting, Wound};
use crate::kernel::{Bounds, Column, World};
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;
use crate::visit::{Memory, Outcome, PairRow, PairTable, Particle};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::required("range", Kind::Positive, "the largest sum of two radii; larger ones are refused [length]"),
    grains::MODEL,
    grains::STIFFNESS,
    grains::YOUNG,
    grains::POISSON,
    grains::RESTITUTION,
    grains::FRICTION,
    grains::TANGENTIAL_STIFFNESS,
    grains::TANGENTIAL_DAMPING,
    grains::ROLLING,
    grains::ROLLING_MODEL,
    grains::ROLLING_DAMPING,
    grains::TORSION,
    grains::SURFACE_TENSION,
    grains::CONTACT_ANGLE,
    grains::BRIDGE_VOLUME,
    grains::PAIRS,
    Key::new("skin", Kind::NotNegative, Value::Number(0.0), "the skin of the neighbour list beyond the range; 0: a fifth of the range, and chosen anew while it runs [length]"),
];

/// `contact`: a spring and dashpot along the line between two spheres that overlap, linear or by Hertz, and across it a spring that
/// sliding winds up, bounded by Coulomb's friction (Cundall & Strack, Géotechnique 29, 47, 1979; Mindlin, J. Appl. Mech. 16, 259, 1949;
/// Luding, Granular Matter 10, 235, 2008), resistance to rolling (Ai et al., Powder Technol. 206, 269, 2011) and to torsion.
/// Between wet grains bridges of liquid pull (Willett et al., Langmuir 16, 9396, 2000) from where they touch until they break.
/// Spheres have their `radius`, and turn by the torques, with their `inertia`. The dashpot is that which makes the
/// coefficient of restitution what is asked for, whatever the masses and the speed (Tsuji et al., Powder Technol. 71, 239, 1992). The
/// energy of its springs is part of the potential, and what it dissipates is summed up in `dissipated`.
#[derive(Clone)]
pub struct Contact(Settings);

/// The sums over the contacts of a particle.
#[derive(Debug, Default)]
struct Sum {
    force: DVec3,
    torque: DVec3,
    energy: f64,
    heat: f64,
}

/// The material of a pair of species.
struct Row {
    species: [u32; 2],
    material: Material,
}

/// The row of two species, in any order.
fn find(rows: &[Row], [a, b]: [u32; 2]) -> Option<&Row> {
    rows.iter().find(|row| row.species == [a, b] || row.species == [b, a])
}

/// The farthest that any bridge of liquid reaches, relative to the smaller radius.
fn reach(rows: &[Row]) -> f64 {
    rows.iter().map(|row| row.material.reach).fold(0.0, f64::max)
}

impl Contact {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
    fn rows(&self) -> Vec<Row> {
        let rows = rows(&self.0, &grains::NAMES, Some(grains::mixed));
        let row = |(species, values): ([u32; 2], Vec<f64>)| Row { species, material: Material::new(&self.0, &values) };
        rows.into_iter().map(|one| row((one.species, one.values))).collect()
    }
}

impl Component for Contact {
    fn columns(&self) -> Vec<Column> {
        grains::columns()
    }
    fn check(&self, _: &Bounds) -> Result<(), Error> {
        rows(&self.0, &grains::NAMES, Some(grains::mixed)).iter().try_for_each(|row| grains::check(&self.0, &row.values))
    }
    fn properties(&self) -> Properties {
        Properties {
            fixed_step: Some("contact integrates the sliding distance with a fixed time step"),
            dissipates: vec!["contacts"],
            turns: vec!["contacts"],
            touches: self.rows().into_iter().map(|row| row.material).collect(),
            largest: vec![Largest { column: "radius", value: 0.5 * self.0.number("range"), why: "its range is the largest sum of two radii" }],
            ..Properties::default()
        }
    }
    fn contacts(&self, state: &State, bounds: &Bounds, _: usize) -> Result<Vec<ContactForce>, Error> {
        let rows = self.rows();
        Ok(grains::between(state, bounds, reach(&rows), |pair| find(&rows, pair).map(|row| row.material)))
    }
    fn laws(&self) -> Vec<Law> {
        let rows = self.rows();
        let slots = rows.iter().map(|row| row.material.words()).max().unwrap_or(0);
        let table = rows.iter().map(|row| PairRow { species: row.species, values: row.material.members() }).collect();
        // The largest reduced radius is a quarter of the largest sum of two, and the largest smaller one a half.
        let range = self.0.number("range") * (1.0 + (0.25 * MARGIN).max(0.5 * reach(&rows)));
        let rows: Arc<[Row]> = rows.into();
        let gather = move |me: &Particle, you: &Particle, r: DVec3, world: &World, memory: &mut Memory<'_>, sum: &mut Sum| {
            if let Some(row) = find(&rows, [me.species(), you.species()]) {
                touch(&row.material, (me, you), r, world, memory, sum);
            }
        };
        let finish = |me: &Particle, sum: &Sum, _: &World, outcome: &mut Outcome| {
            if me.mass > 0.0 {
                outcome.accelerate(sum.force.extend(sum.energy) / me.mass);
            }
            outcome.add("torque", sum.torque.extend(sum.heat));
        };
        let skin = Some(self.0.number("skin")).filter(|skin| *skin > 0.0);
        let (over, wgsl) = ((range, skin, slots), crate::shader!("interactions/contact.wgsl"));
        let law = Law::remembering("contact", over, wgsl, Vec::new(), &["acceleration", "torque"], gather, finish);
        vec![Law { reciprocal: true, pairs: Some(PairTable { rows: table }), ..law }]
    }
}

/// A sphere, as a contact reads it.
fn ball(particle: &Particle) -> Ball {
    let spin = particle.vector("angular_velocity").unwrap_or_default();
    Ball { velocity: particle.velocity, spin: spin.truncate(), radius: spin.w, mass: particle.mass }
}

fn touch(material: &Material, (me, you): (&Particle, &Particle), r: DVec3, world: &World, memory: &mut Memory<'_>, sum: &mut Sum) {
    let Some(at) = Meeting::between(&ball(me), &ball(you), r)else { return };
    if !material.is_near(&at) {
        return;
    }
    // Each has half of what a pair has, and all of it where the other has no mass. The visit halves energies.
    let share = if me.mass <= 0.0 { 0.0 } else if you.mass > 0.0 { 0.5 } else { 1.0 };
    let last = Wound::of(|word| memory.recall(word));
    let bridge = material.bridge(&at, last.is_wet, world.dt);
    sum.force += bridge.pull * at.n;
    sum.energy += 2.0 * share * bridge.energy;
    sum.heat += share * bridge.heat;
    let mut keep = |wound: Wound| {
        let kept = Wound { is_wet: bridge.is_there, ..wound };
        kept.words().into_iter().enumerate().for_each(|(word, value)| memory.remember(word, value));
    };
    if at.overlap <= 0.0 {
        sum.heat += share * material.left(&at, &last, world.dt);
        keep(Wound::default());
        return;
    }
    let touch = material.touch(&at, &last, world.dt);
    keep(touch.wound);
    sum.force += touch.push;
    sum.torque += at.arm * at.n.cross(touch.push) + touch.turn;
    sum.energy += 2.0 * share * touch.energy;
    sum.heat += share * touch.heat;
}
