//! What must hold whatever the fluid is.

use glam::{DVec3, DVec4, Vec4};
use motes::kernel::{ACCELERATION, Array};
use motes::settings::Value;
use motes::sph::DENSITY;
use motes::{Bounds, POSITION, Side, State, VELOCITY};

use crate::fluids::{gpu, setup};
use crate::support;
use crate::support::fluids::{DENSITY as DENSITY_AT_REST, bounds, cloud, fluid};
use crate::support::states::{accelerations_in, cpu_in, word};
use Value::{Flag, Number};

fn smooth(more: &[(&'static str, Value)]) -> Box<dyn motes::forces::Component> {
    fluid(&[&[("alpha", Number(0.0)), ("viscosity", Number(0.0))], more].concat())
}

fn open(flat: bool) -> Bounds {
    bounds(1, flat, Side::Open)
}

/// The force is minus the gradient of the internal energy of all.
#[test]
fn pressure_is_the_slope_of_the_energy() {
    for (flat, more) in [
        (false, vec![]),
        (true, vec![("kernel", word("wendland")), ("support", Number(2.6))]),
        (true, vec![("negative_pressure", Flag(false)), ("gamma", Number(2.0))]),
    ] {
        let forces = [smooth(&more)];
        let particles = cloud(60, flat, false);
        let energy = |particles: &State| {
            let acting = accelerations_in(&open(flat), &forces, particles, 0.0);
            acting.iter().zip(particles.mass()).map(|(a, m)| m * a.w).sum::<f64>()
        };
        let acting = accelerations_in(&open(flat), &forces, &particles, 0.0);
        let usual = (acting.iter().map(|a| a.truncate().length_squared()).sum::<f64>() / acting.len() as f64).sqrt();
        assert!(usual > 1.0, "{usual}");
        let e = 1e-5;
        for id in [3, 17, 40] {
            for axis in [DVec3::X, DVec3::Y] {
                let moved = |by: f64| {
                    let mut particles = particles.clone();
                    particles.position_mut()[id] += by * axis;
                    energy(&particles)
                };
                let slope = (moved(e) - moved(-e)) / (2.0 * e) / particles.mass()[id];
                // e² / 6 of a third derivative, which is of the order of the acceleration over the square of the support:
                // (1e-5 / 0.2)² = 2.5e-9, by γ² at most.
                let off = (acting[id].truncate().dot(axis) + slope).abs();
                assert!(off < 1e-6 * usual, "{id}: {} is not −{slope}", acting[id]);
            }
        }
    }
}

/// Σ m a and Σ m x × a are nothing; Morris' friction does not act along the line between two, and turns a fluid.
#[test]
fn momentum_is_kept_without_walls() {
    for flat in [false, true] {
        let particles = cloud(200, flat, false);
        let morris = vec![("viscosity_form", word("morris"))];
        let none = vec![("viscosity", Number(0.0)), ("viscosity_form", word("morris"))];
        for (more, turns) in [(none, false), (vec![], false), (morris, true)] {
            let acting = accelerations_in(&open(flat), &[fluid(&more)], &particles, 0.0);
            let each = || acting.iter().zip(particles.mass()).map(|(a, m)| *m * a.truncate());
            let (total, size) = (each().sum::<DVec3>().length(), each().map(DVec3::length).sum::<f64>());
            // Sums of 200 in f64.
            assert!(total < 1e-13 * size && size > 0.0, "{total:e} of {size}");
            let turning = || each().zip(particles.position()).map(|(f, x)| x.cross(f));
            let (total, size) = (turning().sum::<DVec3>().length(), turning().map(DVec3::length).sum::<f64>());
            assert!((total > 1e-6 * size) == turns && (turns || total < 1e-13 * size), "{total:e} of {size}");
            // The law claims what is so.
            let law = fluid(&more).laws().into_iter().find(motes::forces::Law::accelerates).expect("a law");
            assert_eq!(law.reciprocal, !turns);
        }
    }
}

/// A blob that is pressed together flies apart; leapfrog's error of the energy goes with the square of the step.
#[test]
fn energy_is_kept_without_walls_and_friction() {
    let mut particles = cloud(64, true, false);
    particles.position_mut().iter_mut().for_each(|x| *x *= 0.95);
    particles.velocity_mut().fill(DVec3::ZERO);
    let total = |simulation: &mut motes::Simulation<motes::Cpu>| {
        let snapshot = pollster::block_on(simulation.snapshot()).expect("a snapshot");
        let energy = motes::Energy::of(&snapshot).expect("energies");
        (energy.total(), energy.kinetic)
    };
    let drift = |dt: f64, steps: u32| {
        let mut simulation = cpu_in(&open(true), &particles, vec![smooth(&[])], "leapfrog", dt);
        let (first, _) = total(&mut simulation);
        simulation.step(steps).expect("steps");
        let (last, kinetic) = total(&mut simulation);
        assert!(kinetic > 0.3 * first, "{kinetic} of {first}: it hardly moves");
        (last / first - 1.0).abs()
    };
    let (coarse, fine) = (drift(1e-3, 200), drift(5e-4, 400));
    // Order 2 is a factor of 4; the kernel's third derivative jumps, and takes some of that.
    assert!(coarse < 1e-3 && (3.0..5.0).contains(&(coarse / fine)), "{coarse:e}, then {fine:e}");
}

/// However it is computed, it is a column, which files and programs have by its name; between steps it is that of the positions.
#[test]
fn the_density_is_a_column() {
    let shared = support::device();
    let particles = cloud(700, false, true);
    for more in [vec![], vec![("density_by", word("continuity"))], vec![("solver", word("dfsph"))]] {
        let setup = setup(&particles, vec![fluid(&more)], "leapfrog", 0.002, bounds(700, false, Side::Periodic));
        let mut simulation = gpu(&shared, &setup);
        simulation.step(5).expect("steps");
        let field = pollster::block_on(simulation.read(DENSITY)).expect("a field");
        let column = pollster::block_on(simulation.read_column("density")).expect("a column");
        let Array::Float(column) = column else { panic!("{column:?}") };
        let bits = |x: f64| (x as f32).to_bits();
        assert_eq!(column.len(), particles.len());
        assert!(column.iter().zip(&field).all(|(x, y)| bits(*x) == y.to_bits()), "{more:?}");
        let mean = column.iter().sum::<f64>() / column.len() as f64;
        assert!((mean / DENSITY_AT_REST - 1.0).abs() < 0.2, "{more:?}: {mean}");
        assert!(column.iter().any(|x| bits(*x) != bits(column[0])), "{more:?}: nothing computed it");
    }
}

#[test]
fn the_same_run_twice_gives_the_same_bits() {
    let shared = support::device();
    let run = |batches: &[u32]| {
        let setup =
            setup(&cloud(700, false, true), vec![fluid(&[])], "leapfrog", 0.002, bounds(700, false, Side::Periodic));
        let mut simulation = gpu(&shared, &setup);
        for steps in batches {
            simulation.step(*steps).expect("steps");
        }
        let fields = [POSITION, VELOCITY, ACCELERATION];
        let all: Vec<Vec4> =
            fields.iter().flat_map(|f| pollster::block_on(simulation.read(*f)).expect("a field")).collect();
        let density = pollster::block_on(simulation.read(DENSITY)).expect("a field");
        let bytes: Vec<u8> = [bytemuck::cast_slice::<_, u8>(&all), bytemuck::cast_slice(&density)].concat();
        bytes
    };
    let whole = run(&[40]);
    assert!(whole == run(&[40]), "a rerun differs");
    assert!(whole == run(&[1, 7, 32]), "batches differ");
    assert!(whole != run(&[39]), "nothing happens");
}

/// Walls feel nothing and stay; what they do to a fluid comes of its own pressure.
#[test]
fn walls_stay_where_they_are() {
    let particles = cloud(100, true, true);
    let mut simulation = cpu_in(&open(true), &particles, vec![fluid(&[])], "leapfrog", 0.002);
    simulation.step(20).expect("steps");
    let host = simulation.backend().host();
    let (Some(Array::Vec4(x)), Some(Array::Vec4(v))) = (host.get(POSITION.name), host.get(VELOCITY.name)) else {
        panic!("places")
    };
    for (i, x) in x.iter().enumerate() {
        let held = i % 5 == 2;
        assert_eq!(held, x.truncate() == particles.position()[i], "{i}");
        assert_eq!(held, v[i].with_w(0.0) == DVec4::ZERO, "{i}");
    }
}
