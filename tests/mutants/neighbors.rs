//! Stages of the cell list and of the searches through it: small boxes in which every seam, fold and reach occurs.

#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds")]

use glam::{DVec3, Vec4};
use motes::forces::{Law, Over, Problem};
use motes::kernel::{ALARM, Backend, Machine, Plan, World};
use motes::{Bounds, Gpu, POSITION, SPECIES, Side, Simulation};

use crate::curious::{CHOOSY, MOVING, OTHERS, STILL, TOUCHING, law};
use crate::stages::{Device, FEW, Stage, fill, moving, put};
use crate::support::machines::{alone, subgroups_of_eight};
use crate::support::{Random, Shared};

use Side::{Open, Periodic};

const LANES: Machine = Machine { software: false, subgroup: 0, invocations: 1 << 18, ..Machine::HOST };
const EIGHT: Machine = Machine { software: true, subgroup: 8, invocations: 256, ..Machine::HOST };
/// The grid of a law, and the law.
fn plan(law: Law, problem: &Problem) -> Plan {
    let (grid, moving) = law.grid(problem).expect("a range").expect("a grid");
    let kernels = vec![grid.kernel(problem, moving).expect("a grid"), law.kernel(problem).expect("a search")];
    Plan::of(kernels)
}

struct Place<'a> {
    device: &'a Device,
    bounds: Bounds,
    /// Where the plan thinks that particles are.
    guess: Vec<DVec3>,
    positions: Vec<DVec3>,
}

impl<'a> Place<'a> {
    fn new(device: &'a Device, bounds: Bounds, positions: Vec<DVec3>) -> Self {
        Self { device, bounds, guess: positions.clone(), positions }
    }
    fn problem(&self, machine: Machine) -> Problem {
        Problem::new(u32::try_from(self.positions.len()).expect("few"), machine).at(&self.guess, self.bounds)
    }
    fn stage(&self, name: &str, law: Law, machine: Machine, change: impl Fn(&mut Plan, &Problem)) -> Stage {
        let problem = self.problem(machine);
        let mut plan = plan(law, &problem);
        change(&mut plan, &problem);
        self.run(name, plan, machine)
    }
    fn run(&self, name: &str, plan: Plan, machine: Machine) -> Stage {
        Stage::of(name, self.simulation(&plan, machine), plan)
    }
    fn simulation(&self, plan: &Plan, machine: Machine) -> Simulation<Gpu> {
        let count = self.positions.len();
        let mut simulation = moving(self.device, count, Some(machine));
        let clock = pollster::block_on(simulation.backend().world()).expect("a clock");
        simulation.backend().set_world(World { bounds: self.bounds, ..clock }).expect("a world");
        let mass = |i: usize| 0.2 + 0.1 * (i % 3) as f64;
        let places: Vec<Vec4> = self.positions.iter().enumerate().map(|(i, x)| x.extend(mass(i)).as_vec4()).collect();
        simulation.write(POSITION, &places).expect("places");
        put(&mut simulation, ALARM, &[u32::MAX; 3]);
        fill(&mut simulation, plan);
        if plan.fields(1).contains_key(SPECIES.name) {
            // A law that does not ask would get others, if there were any.
            let mixed = plan.kernels.iter().all(|kernel| kernel.name != "curious" || kernel.names(SPECIES.name));
            let of = |i| if mixed && i % 3 > 0 { OTHERS } else { OTHERS + 1 };
            let species: Vec<u32> = (0..count).map(of).collect();
            put(&mut simulation, SPECIES, &species);
        }
        simulation
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
        // Along an open axis the box says nothing.
        f64::from(if bounds.sides[axis] == Periodic { x } else { 1.5 * inside })
    };
    (0..count).map(|i| DVec3::new(place(i, 0), place(i, 1), place(i, 2))).collect()
}

fn near(range: f64) -> Over {
    Over::Near { range, of: None }
}

fn nothing(_: &mut Plan, _: &Problem) {}

/// A grid of unit cells, about.
const UNIT: f64 = 0.996;
const ONE: Over = Over::Near { range: UNIT, of: Some(OTHERS + 1) };

pub fn all(shared: &Shared, device: &Device, stages: &mut Vec<Stage>) {
    let mut machines = vec![LANES];
    if subgroups_of_eight(shared) {
        machines.push(EIGHT);
    }
    let bounds = |sides, size: [f64; 3]| {
        let low = DVec3::new(0.125, 3.0, -2.5);
        Bounds { low, high: low + DVec3::from_array(size), sides, dimensions: 3 }
    };
    for (place, machine) in machines.iter().enumerate() {
        // Few ranges and more, with seams everywhere; along x nine cells, of which each is in reach. Eight workgroups in two rows.
        let wide = bounds([Periodic; 3], [[2.3, 12.0, 4.0], [12.0, 3.0, 4.0]][place]);
        let here = Place::new(device, wide, scattered(FEW, &wide, 2.0));
        stages.push(here.stage("near, periodic", law(MOVING, near(UNIT)), *machine, nothing));
        // Two cells and one, and no end.
        let narrow = bounds([Periodic, Periodic, Open], [[1.5, 2.0, 3.0], [2.0, 1.5, 3.0]][place]);
        let here = Place::new(device, narrow, scattered(90, &narrow, 2.0));
        stages.push(here.stage("near, narrow", law(STILL, near(UNIT)), *machine, nothing));
    }
    open(device, &machines, stages);
    grids(device, stages);
    nearest(device, stages);
}

/// Places 0 to 5 along each axis, in an order in which no particle lies beside the one before it.
fn lattice() -> Vec<DVec3> {
    (0..216)
        .map(|i| i * 85 % 216)
        .map(|i| DVec3::new(f64::from(i % 6), f64::from(i / 6 % 6), f64::from(i / 36)))
        .collect()
}

fn open(device: &Device, machines: &[Machine], stages: &mut Vec<Stage>) {
    // Three cells each way; distances that are just the range.
    let bounds = Bounds::new(DVec3::ZERO, DVec3::splat(6.0), Side::Reflecting);
    let here = Place::new(device, bounds, lattice());
    for machine in machines {
        let one = Over::Near { range: 2.0, of: Some(OTHERS + 1) };
        stages.push(here.stage("near, lattice", law(STILL, near(2.0)), *machine, nothing));
        stages.push(here.stage("near, one species", law(CHOOSY, one), *machine, nothing));
    }
    let machine = Machine::HOST;
    let kernel = law(TOUCHING, Over::Within { range: 2.0 }).kernel(&here.problem(machine)).expect("a search");
    stages.push(here.run("within", alone(kernel), machine));

    // Eight ids in a row, the first in the middle: of eight cells, which are too few to walk together; and of nine.
    for cells in [8_u32, 9] {
        let bounds = Bounds::new(DVec3::ZERO, DVec3::new(f64::from(cells) - 0.1, 4.9, 4.9), Side::Reflecting);
        let x = [3, 0, 6, 1, 5, 2, 4, cells - 1];
        let cell = |i: u32| DVec3::new(f64::from(x[i as usize % 8]), f64::from(i / 8 % 5), f64::from(i / 40));
        let mut random = Random::new(8);
        let mut place = |i| ((cell(i) + 0.5 + 0.4 * random.vector()) * 0.998).as_vec3().as_dvec3();
        let here = Place::new(device, bounds, (0..200).map(&mut place).collect());
        for machine in machines.iter().filter(|machine| cells == 8 || machine.software) {
            stages.push(here.stage("near, in rows", law(MOVING, ONE), *machine, halves));
        }
    }
    // Three cells, one of them on the other side of the corner.
    let mut random = Random::new(6);
    let mut here = Place::new(device, Bounds::default(), Vec::new());
    here.positions = (0..200).map(|_| (2.0 * random.vector()).as_vec3().as_dvec3()).collect();
    here.guess = (0..200).map(|i| DVec3::new(f64::from(i % 3), f64::from(i % 8), f64::from(i % 9))).collect();
    for machine in machines {
        stages.push(here.stage("near, folded", law(MOVING, ONE), *machine, nothing));
    }

    // Two cells away, and four, on both sides of the corner.
    let cloud = |center: [f64; 3]| {
        let mut random = Random::new(7);
        (0..40).map(move |_| (DVec3::from_array(center) + 1.4 * random.vector()).as_vec3().as_dvec3())
    };
    let far = [[9e3, 2.0, -9e3], [2.0, 9e3, 2.0], [3_000_008.0, 2.0, 1.0], [3.0, -3e6, 1.0], [-9e6, 3e6, 2e6]];
    for (place, machine) in machines.iter().enumerate() {
        let guess = |i| DVec3::new(f64::from(i % [4, 13][place]), f64::from(i % 5), f64::from(i % 6));
        let mut here = Place::new(device, Bounds::default(), far.into_iter().flat_map(cloud).collect());
        here.guess = (0..200).map(guess).collect();
        stages.push(here.stage("near, far away", law(STILL, near(UNIT)), *machine, nothing));
    }

    // As many around as a search can visit, and one more. Ids from 7 on stand in one cell, those before them in another;
    // 7 is left out by the law.
    let clump = (0..47).map(|i| DVec3::new(if i < 7 { 0.5 } else { 4.5 }, 0.5, 0.5)).collect();
    let here = Place::new(device, Bounds::default(), clump);
    for machine in machines {
        // One row, or eight lanes with one each.
        let all = 40.0 + 16.0 * if machine.software { 8.0 } else { 1.0 };
        let still = || law(STILL, near(UNIT));
        stages.push(here.stage("near, just below the limit", still(), *machine, |plan, _| most(plan, all)));
        let stage = here.stage("near, beyond the limit", still(), *machine, |plan, _| most(plan, all - 1.0));
        stages.push(stage.expected(ALARM.name, [u32::MAX, u32::MAX, 8].map(f32::from_bits).to_vec()));
    }
}

fn most(plan: &mut Plan, most: f64) {
    plan.kernels[1].passes[0].constants.push(("MOST", most));
}

/// Two dispatches, of which each sees a part of the targets.
fn halves(plan: &mut Plan, problem: &Problem) {
    let (grid, _) = law(MOVING, ONE).grid(problem).expect("a range").expect("a grid");
    let whole = plan.kernels[1].passes.remove(0);
    for (first, end) in [(0, 64), (64, problem.capacity)] {
        let mut pass = whole.clone();
        let block = pass.shader.reflection().binding("grid").expect("a block").clone();
        pass.uniforms.retain(|(name, _)| *name != "grid");
        pass.uniforms.push(("grid", grid.uniform(&block, first, end).expect("a block")));
        pass.threads.count = end - first;
        plan.kernels[1].passes.push(pass);
    }
}

/// What the race of arrivals hides, and what stands in slots that no particle took.
fn grids(device: &Device, stages: &mut Vec<Stage>) {
    let bounds = Bounds::new(DVec3::ZERO, DVec3::splat(6.0), Side::Reflecting);
    let here = Place::new(device, bounds, lattice());
    let read = |simulation: &mut Simulation<Gpu>, name: &str, len: u64| {
        let bytes = pollster::block_on(simulation.backend().bytes(name, 0, 4 * len)).expect("a field");
        bytemuck::pod_collect_to_vec::<u8, u32>(&bytes)
    };
    for of in [None, Some(OTHERS + 1)] {
        let law = law(CHOOSY, Over::Near { range: 2.0, of });
        let (grid, _) = law.grid(&here.problem(LANES)).expect("a range").expect("a grid");
        let mut plan = alone(grid.kernel(&here.problem(LANES), false).expect("a grid"));
        let mut simulation = here.simulation(&plan, LANES);
        let count = if of.is_some() { 72 } else { 216 };
        simulation.backend().write_bytes("arrivals", 0, &[0; 4 * 216]).expect("a field");
        let program = simulation.backend().compile(&plan).expect("a plan");
        simulation.backend().run(&program, 1).expect("a grid");
        let (_, name) = grid.field("sorted_id");
        let sorted = read(&mut simulation, &name, count);
        if of.is_none() {
            // The last to arrive first.
            let keys = read(&mut simulation, "keys", count);
            let cell = |id: &u32| keys[*id as usize];
            let mut slots = sorted.clone();
            slots.chunk_by_mut(|a, b| cell(a) == cell(b)).for_each(<[u32]>::reverse);
            simulation.backend().write_bytes("slots", 0, bytemuck::cast_slice(&slots)).expect("a field");
            plan.kernels[0].passes.retain(|pass| pass.shader.reflection().entry == "order");
        } else {
            simulation.backend().write_bytes("arrivals", 0, &[0; 4 * 216]).expect("a field");
        }
        simulation.backend().write_bytes(&name, 0, &[0xff; 4 * 216]).expect("a field");
        let expected = sorted.into_iter().map(f32::from_bits).collect();
        stages.push(Stage::of("grid", simulation, plan).expected(name.into_owned().leak(), expected));
    }
}

fn nearest(device: &Device, stages: &mut Vec<Stage>) {
    let nearest = |count| law(STILL, Over::Nearest { count });
    // A line in the third direction, denser at one end: there is no end to the cube in the other two.
    let mut random = Random::new(4);
    // Many are equally near.
    let mut line = || DVec3::new(0.0, 0.0, (56.0 * random.next().powi(3)).round() / 8.0);
    let here = Place::new(device, Bounds::default(), (0..300).map(|_| line()).collect());
    for count in [5, 9, 13, 16] {
        stages.push(here.stage("nearest, in a line", nearest(count), LANES, nothing));
    }
    let (low, high) = (DVec3::new(0.125, 3.0, -2.5), DVec3::new(12.125, 7.0, 3.5));
    let bounds = Bounds { low, high, sides: [Periodic; 3], dimensions: 3 };
    let here = Place::new(device, bounds, scattered(FEW, &bounds, 0.5));
    stages.push(here.stage("nearest, periodic", nearest(3), LANES, nothing));
    // Fewer than asked for, and more than can be visited.
    let here = Place::new(device, Bounds::default(), lattice()[..12].to_vec());
    stages.push(here.stage("nearest, few", nearest(13), LANES, nothing));
    let stage = here.stage("nearest, beyond the limit", nearest(13), LANES, |plan, _| most(plan, 9.0));
    stages.push(stage.expected(ALARM.name, [u32::MAX, u32::MAX, 0].map(f32::from_bits).to_vec()));
}
