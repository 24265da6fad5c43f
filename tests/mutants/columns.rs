//! Stages of laws that write columns and give no acceleration, with a table over pairs of species.

use glam::DVec3;
use motes::Bounds;
use motes::forces::{Law, Over, Particle, Problem};
use motes::kernel::{Column, Columns, Kind, Machine, Scalar, Source, World};
use motes::visit::{Outcome, PairRow, PairTable};

use crate::laws::resting;
use crate::stages::{Device, FEW, Stage, stage};
use crate::support;
use crate::support::equivalents::{Equivalent, same};

pub const EQUIVALENT: &[Equivalent] = &[
    same("law/pair_index.wgsl", "override SPECIES: u32 = 1u;", "1u", "2u", "the table always sets it"),
    same(
        "visit/each_columns.wgsl",
        "if i < world.count {",
        "<",
        "<=",
        "the last particle is written by two lanes that read before either writes",
    ),
];

const FIELD: &str = "
struct Pair { strength: f32 }
@group(3) @binding(1) var<storage, read> pair_table: array<Pair>;
@group(3) @binding(2) var<storage, read_write> field: array<f32>;
struct Sum { field: f32 }
fn merge(total: ptr<function, Sum>, part: Sum) { (*total).field += part.field; }
fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let pair = pair_table[pair_index(species[me.index], species[you.index])];
    (*sum).field += pair.strength / (1.0 + dot(r, r));
}
fn finish(me: Particle, sum: Sum) { field[me.index] = sum.field; }";
const MARK: &str = "
@group(3) @binding(2) var<storage, read_write> field: array<f32>;
fn update(me: Particle) { field[me.index] = 0.75 * field[me.index] + me.position.x; }";

fn strength(a: u32, b: u32) -> f64 {
    0.3 + f64::from(a + b) + 2.0 * f64::from(a * b)
}

fn laws() -> [Law; 2] {
    let gather = |me: &Particle, you: &Particle, r: DVec3, _: &World, sum: &mut f64| {
        *sum += strength(me.species(), you.species()) / (1.0 + r.length_squared());
    };
    let finish = |_: &Particle, sum: &f64, _: &World, outcome: &mut Outcome| outcome.set("field", *sum);
    let row = |a: u32, b: u32| PairRow {
        species: [a, b],
        values: vec![("strength".to_owned(), Scalar::Float(strength(a, b)))],
    };
    let rows = (0..3).flat_map(|a| (a..3).map(move |b| row(a, b))).collect();
    let law =
        Law::computing("field", Over::Pairs, Source::ours("field", FIELD), Vec::new(), &["field"], gather, finish);
    let mark = Law::updating("mark", Source::ours("mark", MARK), Vec::new(), &["field"], |me, _, outcome| {
        outcome.set("field", 0.75 * me.scalar("field").unwrap_or(f64::NAN) + me.position.x);
    });
    [Law { pairs: Some(PairTable { rows }), ..law }, mark]
}

pub fn all(device: &Device, stages: &mut Vec<Stage>) {
    let machine = Machine::HOST;
    let field = Column::new("field", Kind::Scalar, "", "what pairs add up to").derived();
    let problem = Problem::new(u32::try_from(FEW).expect("few"), machine)
        .of_species(&support::species(FEW))
        .of_columns(Columns::with([field]).expect("a column"));
    for law in laws() {
        let simulation = resting(device, machine, Bounds::default());
        let name = format!("column, {}", law.name);
        stages.push(stage(&name, simulation, law.kernel(&problem).expect("a kernel")));
    }
}
