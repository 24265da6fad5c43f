//! Stages of the grid and of the searches through it: small boxes in which every seam, fold and reach is met.

use glam::{DVec3, DVec4, Vec4};
use motes::forces::{Body, Law, Over, Problem};
use motes::kernel::{ALARM, Backend, Machine, Plan, Source, World};
use motes::{Bounds, POSITION, SPECIES, Side};

use crate::stages::{Device, FEW, Stage, fill, moving};
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
        (*sum).acceleration += near * f32(you.index % 7u + 1u) * r;
        (*sum).potential += me.mass * near;
    }
}
fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, sum.potential); }";

/// In a grid of one species, `MOVING` meets nobody else.
fn law(text: &'static str, over: Over) -> Law {
    let gather = move |me: &Body, you: &Body, r: DVec3, sum: &mut DVec4| {
        let near = you.mass / (1.0 + r.length_squared());
        let weight = (you.index % 7) as f64;
        let met = match over {
            Over::Near { of: Some(of), .. } => you.species == of,
            _ => true,
        };
        let part = if text == MOVING { you.velocity - me.velocity + weight * r } else { (weight + 1.0) * r };
        *sum += f64::from(u8::from(met)) * (near * part).extend(me.mass * near);
    };
    let finish = move |me: &Body, sum: &DVec4, _: &World| {
        if text == STILL && me.index % 5 == 2 { DVec4::ZERO } else { *sum }
    };
    Law::gathering("curious", over, Source::ours("curious", text), Vec::new(), gather, finish)
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
        fill(&mut simulation, &plan);
        if plan.fields(1).contains_key(SPECIES.name) {
            let species: Vec<u32> = (0..count).map(|i| if i % 3 == 0 { OTHERS + 1 } else { OTHERS }).collect();
            simulation.write(SPECIES, &species).expect("species");
        }
        Stage::of(name, simulation, plan)
    }
}

/// Places in a box, and some on the way outside of it, at its sides, and next to them.
fn scattered(count: usize, bounds: &Bounds, out: f64) -> Vec<DVec3> {
    let mut random = Random::new(5);
    let (low, size) = (bounds.low, bounds.high - bounds.low);
    let mut place = |i: usize, axis: usize| {
        let inside = (low[axis] + size[axis] * (0.5 + 0.5 * random.next())) as f32;
        let x = match (i + 3 * axis) % 31 {
            0 => low[axis] as f32,
            1 => bounds.high[axis] as f32,
            2 => (low[axis] as f32).next_down(),
            3 => (bounds.high[axis] as f32).next_down(),
            4..7 => (low[axis] + size[axis] * (0.5 + out * random.next())) as f32,
            _ => inside,
        };
        f64::from(if bounds.sides[axis] == Periodic { x } else { inside })
    };
    (0..count).map(|i| DVec3::new(place(i, 0), place(i, 1), place(i, 2))).collect()
}

fn near(range: f64) -> Over {
    Over::Near { range, of: None }
}

fn nothing(_: &mut Plan, _: &Problem) {}

/// A grid of unit cells, about.
const UNIT: f64 = 0.996;

pub fn all(shared: &Shared, device: &Device, stages: &mut Vec<Stage>) {
    let eight = subgroups_of_eight(shared);
    let machines: Vec<_> = [LANES, EIGHT].into_iter().filter(|m| eight || !m.software).collect();

    // Three, four and twelve cells, with seams everywhere; eight workgroups in two rows.
    let sides = |sides, size| Bounds {
        low: DVec3::new(0.125, 3.0, -2.5),
        high: DVec3::new(0.125, 3.0, -2.5) + size,
        sides,
        dimensions: 3,
    };
    let bounds = sides([Periodic; 3], DVec3::new(12.0, 3.0, 4.0));
    let positions = scattered(FEW, &bounds, 2.0);
    let place = Place { device, bounds, guess: positions.clone(), positions };
    for machine in &machines {
        stages.push(place.stage("near, periodic", law(MOVING, near(UNIT)), *machine, nothing));
    }
    // Two cells and one, and no end.
    let bounds = sides([Periodic, Periodic, Open], DVec3::new(2.0, 1.5, 3.0));
    let positions = scattered(90, &bounds, 2.0);
    let place = Place { device, bounds, guess: positions.clone(), positions };
    for machine in &machines {
        stages.push(place.stage("near, narrow", law(STILL, near(UNIT)), *machine, nothing));
    }
    let bounds = Bounds::default();
    // Distances that are just the range, and places where two cells meet.
    let lattice: Vec<DVec3> =
        (0..216).map(|i| DVec3::new(f64::from(i % 6), f64::from(i / 6 % 6), f64::from(i / 36))).collect();
    let place = Place { device, bounds, guess: lattice.clone(), positions: lattice };
    for machine in &machines {
        stages.push(place.stage("near, lattice", law(STILL, near(1.0)), *machine, nothing));
        for text in [CHOOSY, MOVING] {
            let over = Over::Near { range: 1.5, of: Some(OTHERS + 1) };
            stages.push(place.stage("near, one species", law(text, over), *machine, nothing));
        }
    }
}
