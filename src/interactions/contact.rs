//! Granular contacts: spheres with friction that depends on their sliding history.

use std::sync::Arc;

use glam::DVec3;

use super::pair_potential::rows;
use super::{Component, Law, Properties};
use crate::component::Largest;
use crate::error::Error;
use crate::grains::{self, MARGIN, Material, Meeting, Wound, may_touch, moment, reduced};
use crate::kernel::{Bounds, Column, World};
use crate::settings::{Key, Kind, Settings, Value};
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
    grains::PAIRS,
    Key::new("skin", Kind::NotNegative, Value::Number(0.0), "the skin of the neighbour list beyond the range; 0: a fifth of the range [length]"),
];

/// `contact`: a spring and dashpot along the line between two spheres that overlap, linear or by Hertz, and across it a spring that
/// sliding winds up, bounded by Coulomb's friction (Cundall & Strack, Géotechnique 29, 47, 1979; Mindlin, J. Appl. Mech. 16, 259, 1949;
/// Luding, Granular Matter 10, 235, 2008), resistance to rolling (Ai et al., Powder Technol. 206, 269, 2011) and to torsion.
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
        rows(&self.0, &grains::NAMES, Some(grains::mixed)).iter().try_for_each(|row| grains::check(&row.values))
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
    fn laws(&self) -> Vec<Law> {
        let rows = self.rows();
        let slots = rows.iter().map(|row| row.material.words()).max().unwrap_or(0);
        let table = rows.iter().map(|row| PairRow { species: row.species, values: row.material.members() }).collect();
        let rows: Arc<[Row]> = rows.into();
        let gather = move |me: &Particle, you: &Particle, r: DVec3, world: &World, memory: &mut Memory<'_>, sum: &mut Sum| {
            let pair = [me.species(), you.species()];
            let known = rows.iter().find(|row| row.species == pair || row.species == [pair[1], pair[0]]);
            if let Some(row) = known {
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
        // The largest reduced radius is a quarter of the largest sum of two.
        let range = self.0.number("range") * (1.0 + 0.25 * MARGIN);
        let (over, wgsl) = ((range, skin, slots), crate::shader!("interactions/contact.wgsl"));
        let law = Law::remembering("contact", over, wgsl, Vec::new(), &["acceleration", "torque"], gather, finish);
        vec![Law { reciprocal: true, pairs: Some(PairTable { rows: table }), ..law }]
    }
}

fn touch(material: &Material, (me, you): (&Particle, &Particle), r: DVec3, world: &World, memory: &mut Memory<'_>, sum: &mut Sum) {
    let [mine, yours] = [me, you].map(|particle| particle.vector("angular_velocity").unwrap_or_default());
    let distance = r.length();
    let overlap = mine.w + yours.w - distance;
    // Two particles at the same position have no direction between them.
    let radius = reduced(mine.w, yours.w);
    if distance <= 0.0 || mine.w <= 0.0 || yours.w <= 0.0 || !may_touch(overlap, radius) {
        return;
    }
    let n = r / distance;
    // From the centres to the middle of the overlap.
    let [arm, other] = [mine.w - 0.5 * overlap, yours.w - 0.5 * overlap];
    let [spin, yours_spin] = [mine, yours].map(glam::DVec4::truncate);
    let at = Meeting {
        n,
        overlap,
        v: me.velocity - you.velocity + (arm * spin + other * yours_spin).cross(n),
        radius,
        spin: spin - yours_spin,
        mass: reduced(me.mass, you.mass),
        rest: reduced(moment(me.mass, mine.w), moment(you.mass, yours.w)),
    };
    // Each has half of what a pair has, and all of it where the other has no mass. The visit halves energies.
    let share = if me.mass <= 0.0 { 0.0 } else if you.mass > 0.0 { 0.5 } else { 1.0 };
    let last = Wound::of(|word| memory.recall(word));
    if overlap <= 0.0 {
        sum.heat += share * material.left(&at, &last, world.dt);
        return;
    }
    let touch = material.touch(&at, &last, world.dt);
    touch.wound.words().into_iter().enumerate().for_each(|(word, value)| memory.remember(word, value));
    sum.force += touch.push;
    sum.torque += arm * n.cross(touch.push) + touch.turn;
    sum.energy += 2.0 * share * touch.energy;
    sum.heat += share * touch.heat;
}
