//! Parameters of pairs of species.

use glam::{DVec3, DVec4};
use motes::forces::{Law, Over, Particle};
use motes::kernel::{Machine, Scalar, Source};
use motes::lockstep::compare;
use motes::visit::{PairRow, PairTable};

use super::{plan, problem};
use crate::support::{self, machines};
use motes::kernel::{Array, Backend, POSITION, SPECIES, VELOCITY, World};

const TABLED: &str = "
struct Pair { strength: f32, reach: f32 }
@group(3) @binding(1) var<storage, read> pair_table: array<Pair>;
fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let pair = pair_table[pair_index(species[me.index], species[you.index])];
    (*sum).acceleration += (pair.strength / (pair.reach * pair.reach + dot(r, r))) * r;
}
fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, sum.potential); }";

fn strength(a: u32, b: u32) -> f64 {
    f64::from(a + b) * 0.5 + f64::from(a * b) + 0.25
}
fn reach(a: u32, b: u32) -> f64 {
    0.5 + 0.125 * f64::from(a.max(b))
}

fn row(a: u32, b: u32) -> PairRow {
    let values = [("strength", strength(a, b)), ("reach", reach(a, b))];
    PairRow { species: [a, b], values: values.map(|(name, x)| (name.to_owned(), Scalar::Float(x))).to_vec() }
}

fn tabled(rows: Vec<PairRow>) -> Law {
    let rule = |me: &Particle, you: &Particle, r: DVec3| -> DVec4 {
        let (a, b) = (me.species(), you.species());
        (strength(a, b) / (reach(a, b).powi(2) + r.length_squared()) * r).extend(0.0)
    };
    let law = Law::between("tabled", Over::Pairs, Source::ours("tabled", TABLED), Vec::new(), rule);
    Law { pairs: Some(PairTable { rows }), ..law }
}

/// Each pair once, in an order that is not sorted.
fn all() -> Vec<PairRow> {
    vec![row(2, 0), row(1, 1), row(0, 1), row(2, 2), row(0, 0), row(2, 1)]
}

#[test]
fn both_orders_of_a_pair_find_its_row() {
    let shared = support::device();
    let count = 300;
    for (name, machine) in machines::machines(&shared) {
        let plan = plan(tabled(all()), &problem(count, machine));
        let cloud = support::cloud(count, 3);
        let mut gpu = machines::gpu(&shared, count);
        gpu.pretend(machine);
        gpu.compile(&plan).expect("a program");
        let number = u32::try_from(count).expect("few");
        gpu.set_world(World { time: 0.0, dt: 1e-3, step: 0, count: number, free: 0, bounds: motes::Bounds::default() })
            .expect("a world");
        let place = cloud.position().iter().zip(cloud.mass()).map(|(x, m)| x.extend(*m));
        gpu.write(POSITION.name, &Array::Vec4(place.collect())).expect("positions");
        gpu.write(SPECIES.name, &Array::Uint(cloud.species().to_vec())).expect("species");
        gpu.write(VELOCITY.name, &Array::Vec4(vec![DVec4::ZERO; count])).ok();
        let verdicts = pollster::block_on(compare(&mut gpu, &plan, number)).expect("verdicts");
        assert!(verdicts.iter().all(|v| v.sound() && v.changed) && !verdicts.is_empty(), "{name}: {verdicts:?}");
    }
}

#[test]
fn a_pair_that_is_missing_or_given_twice_is_named() {
    let refused = |rows| tabled(rows).kernel(&problem(300, Machine::HOST)).expect_err("refused").to_string();
    let mut rows = all();
    rows.remove(0);
    let text = refused(rows);
    assert!(text.contains("species 0 and 2") && text.contains("species = [0, 2]"), "{text}");
    let mut rows = all();
    rows.push(row(1, 0));
    let text = refused(rows);
    assert!(text.contains("species 1 and 0") && text.contains("twice"), "{text}");
    let mut rows = all();
    rows[0].values.pop();
    let text = refused(rows);
    assert!(text.contains("`reach`"), "{text}");
}
