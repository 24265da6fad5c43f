//! A law of integers: its sums are exact in any order, so that searches must agree bit for bit.

use glam::{DVec3, DVec4, Vec4};
use motes::forces::{Component, Law, Over};
use motes::kernel::{Machine, Source};
use motes::{ACCELERATION, Bounds, Gpu, Setup, Simulation, State};

use crate::support::states::integrator;
use crate::support::{Shared, machines};

/// Counts the pairs of each particle, and adds their ids and the eighths of the way to them; all below 2²⁴.
#[derive(Clone)]
pub struct Whole(pub Over);

const WHOLE: &str = "fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let e = clamp(floor(r * 8.0), vec3f(-64.0), vec3f(64.0));
    (*sum).acceleration += vec3f(1.0, f32(you.index), e.x + 3.0 * e.y + 9.0 * e.z);
    (*sum).potential += 2.0 * f32(you.index % 13u);
}
fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, sum.potential); }";

/// The same on the host. The way is the device's, in single precision.
pub fn whole(id: usize, r: DVec3) -> DVec4 {
    let e = (r * 8.0).floor().clamp(DVec3::splat(-64.0), DVec3::splat(64.0));
    DVec4::new(1.0, id as f64, e.dot(DVec3::new(1.0, 3.0, 9.0)), (id % 13) as f64)
}

impl Component for Whole {
    fn laws(&self) -> Vec<Law> {
        let rule = |_: &motes::forces::Particle, you: &motes::forces::Particle, r: DVec3| {
            whole(you.index, r.as_vec3().as_dvec3())
        };
        vec![Law::between("whole", self.0, Source::ours("whole", WHOLE), Vec::new(), rule)]
    }
}

/// All within a range, found on the host by brute force, by the device's own arithmetic.
pub fn by_force(positions: &[DVec3], bounds: &Bounds, range: f64) -> Vec<Vec4> {
    let met = |i: usize| {
        let others = (0..positions.len()).filter(|j| *j != i);
        let within = others.filter(|j| bounds.within(positions[*j] - positions[i], range));
        let way = |j: usize| bounds.shortest_single(positions[j] - positions[i]).as_dvec3();
        within.map(|j| whole(j, way(j))).sum::<DVec4>().as_vec4()
    };
    (0..positions.len()).map(met).collect()
}

/// The nearest, found on the host by a sort.
pub fn by_sort(positions: &[DVec3], bounds: &Bounds, count: usize) -> Vec<Vec4> {
    let met = |i: usize| {
        let way = |j: usize| bounds.shortest_single(positions[j] - positions[i]);
        let square = |j: usize| {
            let r = way(j);
            r.x * r.x + r.y * r.y + r.z * r.z
        };
        let mut others: Vec<_> = (0..positions.len()).filter(|j| *j != i).map(|j| (square(j), j)).collect();
        others.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        others.iter().take(count).map(|(_, j)| whole(*j, way(*j).as_dvec3())).sum::<DVec4>().as_vec4()
    };
    (0..positions.len()).map(met).collect()
}

/// Particles at rest at these places, as f32 holds them.
pub fn at_rest(positions: &[DVec3]) -> State {
    let mut particles = State::default();
    for x in positions {
        particles.push(x.as_vec3().as_dvec3(), DVec3::ZERO, 1.0, 0.0);
    }
    particles
}

pub fn simulation(gpu: Gpu, positions: &[DVec3], bounds: Bounds, over: Over) -> Simulation<Gpu> {
    let setup = Setup {
        state: at_rest(positions),
        forces: vec![Box::new(Whole(over))],
        integrator: integrator("symplectic_euler"),
        dt: 1e-3,
        bounds,
        solver: motes::Solver::default(),
    };
    Simulation::on(gpu, &setup).expect("a simulation")
}

/// What the device finds.
pub fn found(shared: &Shared, machine: Option<Machine>, positions: &[DVec3], bounds: Bounds, over: Over) -> Vec<Vec4> {
    let mut gpu = machines::gpu(shared, positions.len());
    if let Some(machine) = machine {
        gpu.pretend(machine);
    }
    let mut simulation = simulation(gpu, positions, bounds, over);
    simulation.step(0).expect("a start");
    pollster::block_on(simulation.check()).expect("no alarm");
    pollster::block_on(simulation.read(ACCELERATION)).expect("accelerations")
}

/// Fails at the first particle with the wrong neighbours.
pub fn same(got: &[Vec4], want: &[Vec4], of: &str) {
    assert_eq!(got.len(), want.len());
    let wrong: Vec<_> = (0..got.len()).filter(|i| got[*i] != want[*i]).collect();
    if let Some(i) = wrong.first() {
        panic!("{of}: {} of {} are wrong; particle {i}: {} for {}", wrong.len(), got.len(), got[*i], want[*i]);
    }
}

#[test]
fn the_whole_law_meets_neighbours() {
    let list = by_force(&[DVec3::ZERO, DVec3::X, DVec3::Y * 3.0], &Bounds::default(), 1.5);
    assert_eq!(list[0], Vec4::new(1.0, 1.0, 8.0, 1.0));
    assert_eq!(list[2], Vec4::ZERO);
}
