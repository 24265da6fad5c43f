//! Stages of laws that write columns and give no acceleration, with a table over pairs of species.

use glam::DVec3;
use motes::Bounds;
use motes::forces::{Law, Over, Particle, Problem};
use motes::kernel::{Column, Columns, Kind, Machine, SPECIES, Scalar, Source, World};
use motes::visit::{Outcome, PairRow, PairTable};

use crate::laws::resting;
use crate::stages::{Device, FEW, Stage, fill, put};
use crate::support;
use crate::support::equivalents::{Equivalent, same};
use crate::support::machines::alone;

pub const EQUIVALENT: &[Equivalent] =
    &[same("law/pair_index.wgsl", "override SPECIES: u32 = 1u;", "1u", "2u", "the table always sets it")];

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

/// The law of a table over pairs of so many species; of one a uniform block, which has rows beyond it.
fn laws(kinds: u32) -> [Law; 2] {
    let gather = |me: &Particle, you: &Particle, r: DVec3, _: &World, sum: &mut f64| {
        *sum += strength(me.species(), you.species()) / (1.0 + r.length_squared());
    };
    let finish = |_: &Particle, sum: &f64, _: &World, outcome: &mut Outcome| outcome.set("field", *sum);
    let row = |a: u32, b: u32| PairRow {
        species: [a, b],
        values: vec![("strength".to_owned(), Scalar::Float(strength(a, b)))],
    };
    let rows = (0..kinds).flat_map(|a| (a..kinds).map(move |b| row(a, b))).collect();
    let block = [
        ("<storage, read> pair_table: array<Pair>", "<uniform> pair_table: array<Pair, 64>"),
        ("{ strength: f32 }", "{ unused_word: u32, @size(12) strength: f32 }"),
    ];
    let block =
        block.into_iter().filter(|_| kinds == 1).fold(FIELD.to_owned(), |text, (old, new)| text.replace(old, new));
    let field = Source { text: block.into(), ..Source::ours("field", "") };
    let law = Law::computing("field", Over::Pairs, field, Vec::new(), &["field"], gather, finish);
    let mark = Law::updating("mark", Source::ours("mark", MARK), Vec::new(), &["field"], |me, _, outcome| {
        outcome.set("field", 0.75 * me.scalar("field").unwrap_or(f64::NAN) + me.position.x);
    });
    [Law { pairs: Some(PairTable { rows }), ..law }, mark]
}

pub fn all(device: &Device, stages: &mut Vec<Stage>) {
    let machine = Machine::HOST;
    let field = Column::new("field", Kind::Scalar, "", "what pairs add up to").derived();
    let problem =
        Problem::new(u32::try_from(FEW).expect("few"), machine).of_columns(Columns::with([field]).expect("a column"));
    for kinds in [3, 2, 1] {
        let species: Vec<u32> = support::species(FEW).into_iter().map(|kind| kind % kinds).collect();
        let problem = problem.clone().of_species(&species);
        for law in laws(kinds) {
            let mut simulation = resting(device, machine, Bounds::default());
            let (name, paired) = (format!("column, {}, of {kinds}", law.name), law.pairs.is_some());
            let plan = alone(law.kernel(&problem).expect("a kernel"));
            fill(&mut simulation, &plan);
            if paired {
                put(&mut simulation, SPECIES, &species);
            }
            stages.push(Stage::of(&name, simulation, plan));
        }
    }
}
