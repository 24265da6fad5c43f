//! Stages of the grid and of the searches through it: small boxes in which every seam, fold and reach is met.

use glam::{DVec3, DVec4, Vec4};
use motes::forces::{Law, Over, Problem};
use motes::kernel::{Backend, Kernel, Machine, Plan, Source, World};
use motes::{ALARM, Bounds, POSITION, SPECIES, Side};

use crate::stages::{Device, Stage, filled, moving};
use crate::support::machines::subgroups_of_eight;
use crate::support::{Random, Shared};

use Side::{Open, Periodic};

const LANES: Machine = Machine { software: false, subgroup: 0, invocations: 1 << 18 };
const EIGHT: Machine = Machine { software: true, subgroup: 8, invocations: 256 };
/// Who is not put into a filtered grid.
const OTHERS: u32 = 1;

/// A law that looks at everything that a visit passes to it, and vanishes at no edge.
const MOVING: &str = "fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let v = velocity_of(you) - velocity_of(me);
    let near = 1.0 / (1.0 + dot(r, r));
    (*sum).acceleration += (you.mass * near) * (v + f32(you.index % 7u) * r);
    (*sum).potential += you.mass * me.mass * near;
}
fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, sum.potential); }";
/// One that asks for no velocities, and leaves some out.
const STILL: &str = "fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let near = you.mass / (1.0 + dot(r, r));
    (*sum).acceleration += near * f32(you.index % 7u + 1u) * r;
    (*sum).potential += me.mass * near;
}
fn acts_on(me: Particle) -> bool { return me.index % 5u != 2u; }
fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, sum.potential); }";
/// One that meets one species, and says so itself.
const CHOOSY: &str = "fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    if species[you.index] == 2u {
        let near = you.mass / (1.0 + dot(r, r));
        (*sum).acceleration += near * f32(you.index % 7u + 1u) * (r + velocity_of(you));
        (*sum).potential += me.mass * near;
    }
}
fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, sum.potential); }";

fn law(text: &'static str, over: Over) -> Law {
    Law::gathering(
        "curious",
        over,
        Source::ours("curious", text),
        Vec::new(),
        move |me, you, r, sum: &mut DVec4| {
            let near = you.mass / (1.0 + r.length_squared());
            let weight = (you.index % 7) as f64;
            *sum += match text {
                MOVING => (near * (you.velocity - me.velocity + weight * r)).extend(me.mass * near),
                STILL => (near * (weight + 1.0) * r).extend(me.mass * near),
                _ if you.species == OTHERS + 1 => {
                    (near * (weight + 1.0) * (r + you.velocity)).extend(me.mass * near)
                }
                _ => DVec4::ZERO,
            };
        },
        move |me, sum, _| if text == STILL && me.index % 5 == 2 { DVec4::ZERO } else { *sum },
    )
}

/// The grid of a law, and the law.
fn plan(law: Law, problem: &Problem) -> Plan {
    let (grid, moving) = law.grid(problem).expect("a range").expect("a grid");
    let kernels = vec![grid.kernel(problem, moving).expect("a grid"), law.kernel(problem).expect("a search")];
    Plan { kernels, order: vec![0, 1] }
}

struct Place<'a> {
    device: &'a Device,
    bounds: Bounds,
    /// Where the plan thinks that particles are.
    guess: Vec<DVec3>,
    positions: Vec<DVec3>,
}

impl Place<'_> {
    fn stage(&self, name: &str, law: Law, machine: Machine, change: impl Fn(&mut Plan, &Problem)) -> Stage {
        let count = self.positions.len();
        let problem = Problem::new(u32::try_from(count).expect("few"), machine).at(&self.guess, self.bounds);
        let mut plan = plan(law, &problem);
        change(&mut plan, &problem);
        let mut simulation = moving(self.device, count, Some(machine));
        let clock = pollster::block_on(simulation.backend().world()).expect("a clock");
        simulation.backend().set_world(World { bounds: self.bounds, ..clock }).expect("a world");
        let places: Vec<Vec4> =
            self.positions.iter().enumerate().map(|(i, x)| x.extend(0.2 + 0.1 * (i % 3) as f64).as_vec4()).collect();
        simulation.write(POSITION, &places).expect("places");
        simulation.write(ALARM, &[u32::MAX; 3]).expect("an alarm");
        filled(&mut simulation, &plan);
        if plan.fields(1).contains_key(SPECIES.name) {
            let species: Vec<u32> = (0..count).map(|i| if i % 3 == 0 { OTHERS + 1 } else { OTHERS }).collect();
            simulation.write(SPECIES, &species).expect("species");
        }
        Stage::of(name, simulation, plan)
    }
}
