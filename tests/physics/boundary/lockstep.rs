//! The kernels of the sides, and all others in a box, against their references.

use glam::Vec4;
use motes::kernel::{Backend, Machine, Plan, Problem};
use motes::lockstep::{Verdict, compare};
use motes::{Bounds, Error, POSITION, Side, Simulation, VELOCITY};

use crate::boundary::{odd, scattered, setup};
use crate::support::machines::gpu;
use crate::support::states::force;
use crate::support::{self, Shared};

use Side::{Open, Periodic, Reflecting};

/// Every side at every axis.
const SIDES: [[Side; 3]; 5] = [
    [Periodic, Reflecting, Open],
    [Reflecting, Open, Periodic],
    [Open, Periodic, Reflecting],
    [Periodic; 3],
    [Reflecting; 3],
];

/// A simulation whose particles are anywhere, as a caller may write them.
fn anywhere(shared: &Shared, count: usize, bounds: Bounds, name: &str) -> Simulation<motes::Gpu> {
    let setup = setup(crate::boundary::inside(count, &bounds, 5), vec![force("uniform", &[])], name, 0.37, bounds);
    let mut simulation = Simulation::on(gpu(shared, count), &setup).expect("a simulation");
    simulation.step(2).expect("two steps");
    let places = scattered(count, &bounds, 9);
    let places: Vec<Vec4> = places.position().iter().zip(places.mass()).map(|(x, m)| x.extend(*m).as_vec4()).collect();
    simulation.write(POSITION, &places).expect("places");
    simulation
}

/// What brings particles back.
fn enclose(count: usize, bounds: &Bounds) -> Plan {
    let mut plan = Plan::default();
    let machine = Machine::HOST;
    let problem = Problem::new(u32::try_from(count).expect("few"), machine).at(&[], *bounds);
    let kernels = motes::boundary::kernels(&problem).expect("kernels");
    for kernel in kernels {
        plan.add(kernel);
    }
    plan
}

fn verdicts(simulation: &mut Simulation<motes::Gpu>, plan: &Plan) -> Vec<Verdict> {
    let count = simulation.count();
    pollster::block_on(compare(simulation.backend(), plan, count)).expect("verdicts")
}

#[test]
fn the_kernels_of_the_sides() {
    let shared = support::device();
    for sides in SIDES {
        let bounds = odd(sides);
        for count in [1, 2, 63, 64, 65, 1000, 65_537] {
            let mut simulation = anywhere(&shared, count, bounds, "symplectic_euler");
            let verdicts = verdicts(&mut simulation, &enclose(count, &bounds));
            assert!(!verdicts.is_empty());
            for verdict in verdicts {
                assert!(verdict.good(), "{sides:?}, {count} particles: {verdict:?}");
                assert!(verdict.changed || count < 63, "{sides:?}, {count} particles: {verdict:?}");
            }
        }
    }
}

#[test]
fn integrators_in_a_box() {
    let shared = support::device();
    for sides in SIDES {
        let bounds = odd(sides);
        for name in ["leapfrog", "rk4", "symplectic_euler", "pefrl"] {
            let count = 300;
            let mut simulation = anywhere(&shared, count, bounds, name);
            let forces =
                || vec![force("gravity", &[("softening", motes::settings::Value::Number(0.17))]), force("vortex", &[])];
            let setup = setup(crate::boundary::inside(count, &bounds, 5), forces(), name, 0.37, bounds);
            let machine = simulation.backend().machine();
            let plans = setup.plans(machine).expect("plans");
            // Numbers that are broken from the start are looked for in the forces too.
            assert!(plans.start.steps().any(|kernel| kernel.name == "gravity"), "{name}: {}", plans.start);
            for plan in [plans.start, plans.step] {
                let verdicts = verdicts(&mut simulation, &plan);
                let closed = verdicts.iter().filter(|v| ["periodic", "reflecting"].contains(&v.kernel.as_str()));
                assert!(closed.count() > 0, "{name} never looks at the sides");
                for verdict in verdicts {
                    assert!(verdict.good(), "{sides:?}, {name}: {verdict:?}");
                }
            }
        }
    }
}

/// Exactly at a side, next to it, or whole lengths away: where the numbers of a box are dyadic, device and reference agree to
/// the bit.
#[test]
fn at_the_very_sides() {
    let (low, high) = (glam::DVec3::new(0.125, 3.0, -2.5), glam::DVec3::new(1.625, 3.75, 0.5));
    let shared = support::device();
    for side in [Periodic, Reflecting] {
        let bounds = Bounds::new(low, high, side);
        let mut places = Vec::new();
        for turns in -9..=9_i16 {
            let x = (low + f64::from(turns) * (high - low)).as_vec3();
            places.push(x.extend(0.3));
        }
        for corner in [low, high] {
            let c = corner.as_vec3();
            places.push(glam::Vec3::new(c.x.next_up(), c.y.next_up(), c.z.next_up()).extend(0.3));
            places.push(glam::Vec3::new(c.x.next_down(), c.y.next_down(), c.z.next_down()).extend(0.3));
        }
        let count = places.len();
        let setup = setup(crate::boundary::inside(count, &bounds, 5), Vec::new(), "leapfrog", 0.37, bounds);
        let mut simulation = Simulation::on(gpu(&shared, count), &setup).expect("a simulation");
        simulation.write(POSITION, &places).expect("places");
        let verdicts = verdicts(&mut simulation, &enclose(count, &bounds));
        assert!(verdicts.iter().all(|v| v.good() && v.changed), "{verdicts:?}");
        let found = pollster::block_on(simulation.read(POSITION)).expect("places");
        for x in found {
            let x = x.truncate();
            let below = if side == Periodic { x.cmplt(high.as_vec3()) } else { x.cmple(high.as_vec3()) };
            assert!(x.cmpge(low.as_vec3()).all() && below.all(), "{side:?}: {x} is outside");
        }
    }
}

/// A number that is none is left for the watch, which names its particle.
#[test]
fn what_is_broken_stays_so() {
    let shared = support::device();
    for side in [Periodic, Reflecting] {
        let bounds = odd([side; 3]);
        for bad in [f32::NAN, f32::from_bits(0xffc0_0001), f32::INFINITY, f32::NEG_INFINITY] {
            let setup = setup(crate::boundary::inside(65, &bounds, 5), Vec::new(), "leapfrog", 0.1, bounds);
            let mut simulation = Simulation::on(gpu(&shared, 65), &setup).expect("a simulation");
            let mut places = pollster::block_on(simulation.read(POSITION)).expect("places");
            let speeds = pollster::block_on(simulation.read(VELOCITY)).expect("velocities");
            places[41].y = bad;
            places[41].x = 77.0;
            // `Simulation::write` would refuse them.
            simulation.backend().write_bytes(POSITION.name, 0, bytemuck::cast_slice(&places)).expect("places");
            let program = simulation.backend().compile(&enclose(65, &bounds)).expect("a program");
            simulation.backend().run(&program, 1).expect("a run");
            let bits = |x: &[Vec4]| bytemuck::cast_slice::<Vec4, u32>(x).to_vec();
            let found = pollster::block_on(simulation.read(POSITION)).expect("places");
            assert_eq!(bits(&found), bits(&places), "{side:?}, {bad}");
            assert_eq!(pollster::block_on(simulation.read(VELOCITY)).expect("velocities"), speeds);
            simulation.step(1).expect("a step");
            match pollster::block_on(simulation.check()) {
                Err(Error::NotFinite { particle: 41, step: 0 }) => {}
                other => panic!("{side:?}, {bad}: {other:?}"),
            }
        }
    }
}
