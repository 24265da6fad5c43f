//! No particle is lost, none comes back, and what is summed is what is active.

use glam::DVec3;
use motes::life::{Drain, Life};
use motes::settings::Value;
use motes::solids::Solid;
use motes::{ACCELERATION, Bounds, Cpu, Energy, LIFE, POSITION, Simulation, VELOCITY};

use crate::births::{jet, pool, setup, state};
use crate::support::states::force;
use crate::support::{self, machines};

pub fn drains() -> Vec<Drain> {
    let ball = Solid::Sphere(0.25);
    let near = Drain { solid: ball, position: DVec3::new(0.1, 0.1, 0.0), outside: false, species: None };
    let right = Solid::Plane(DVec3::NEG_X);
    vec![near, Drain { solid: right, position: DVec3::new(1.15, 0.0, 0.0), ..near }]
}

#[test]
fn the_dead_stay_dead_and_ids_are_never_reused() {
    let setup = pool(drains());
    let count = setup.state.len();
    let shared = support::device();
    let mut simulation = Simulation::on(machines::gpu(&shared, count), &setup).expect("a run");
    let mut last = state(&mut simulation);
    let mut seen = [0; 2];
    for _ in 0..12 {
        simulation.step(7).expect("steps");
        let snapshot = state(&mut simulation);
        let (now, energies) = (&snapshot, snapshot.energies().expect("energies"));
        for (id, energy) in energies.iter().enumerate().take(count) {
            let (then, is) = (last.life()[id], now.life()[id]);
            // Life continues, and never back.
            assert!(then.word() <= is.word(), "{id}: {then:?} and then {is:?}");
            seen[0] += usize::from(then == Life::Pending && is != then);
            seen[1] += usize::from(is == Life::Removed && is != then);
            if then == Life::Removed || is == Life::Pending {
                assert_eq!(now.position()[id], last.position()[id], "{id} stays");
            }
            if is != Life::Active {
                assert_eq!((now.velocity()[id], now.mass()[id], *energy), (DVec3::ZERO, 0.0, 0.0), "{id} rests");
            }
        }
        let of = now.population();
        assert_eq!(of, pollster::block_on(simulation.population()).expect("a count"));
        assert_eq!(of.pending + of.active + of.removed, count as u64);
        // The ledger's sums are those over active particles, with their own masses.
        let own = |id: usize| {
            setup.state.births.iter().find(|b| b.id as usize == id).map_or(setup.state.mass()[id], |b| b.mass)
        };
        let alive = || (0..count).filter(|id| now.life()[*id] == Life::Active);
        let mass: f64 = alive().map(own).sum();
        let momentum: DVec3 = alive().map(|id| own(id) * now.velocity()[id]).sum();
        let measure = Energy::of(&snapshot).expect("energies");
        // Masses are those that f32 holds, to 6e-8.
        assert!((now.mass().iter().sum::<f64>() / mass - 1.0).abs() < 1e-7);
        assert!((measure.momentum - momentum).length() < 1e-6 * mass);
        last = now.clone();
    }
    assert!(seen[0] > 20 && seen[1] > 10, "births and deaths were seen: {seen:?}");
}

/// Particles that are not active are in no pair: the others move as if there were no others, bit for bit.
#[test]
fn inactive_particles_are_in_no_pair() {
    let alone = pool(Vec::new());
    let n = alone.state.len() - alone.state.births.len();
    let run = |particles| {
        let setup = crate::births::Setup { state: particles, ..pool(Vec::new()) };
        let count = u32::try_from(setup.state.len()).expect("few");
        let mut simulation = Simulation::on(Cpu::new(count).expect("some"), &setup).expect("a run");
        simulation.step(3).expect("steps");
        pollster::block_on(simulation.read(POSITION)).expect("positions")[..n].to_vec()
    };
    let mut some = alone.state.clone();
    // In the midst of the pool, some of them removed.
    for k in n..some.len() {
        some.position_mut()[k] = some.position()[k % n] + DVec3::new(0.013, 0.021, 0.0);
        some.set_life(k, [Life::Pending, Life::Removed][k % 2]);
        some.velocity_mut()[k] = DVec3::X;
        some.mass_mut()[k] = 3.0;
    }
    some.births.clear();
    let mut few = some.picked(&(0..n).collect::<Vec<_>>());
    few.remove("life");
    assert_eq!(run(some), run(few));
}

/// Gravity goes by mass, so that it needs no cell list to skip those without.
#[test]
fn removed_particles_attract_none() {
    let mut particles = support::cloud(40, 3);
    particles.links = motes::links::Links::default();
    let gravity = |particles| {
        let forces = vec![force("gravity", &[("softening", Value::Number(0.1))])];
        let mut simulation =
            Simulation::on(Cpu::new(40).expect("some"), &setup(particles, forces, Bounds::default())).expect("a run");
        simulation.step(1).expect("a step");
        pollster::block_on(simulation.read(ACCELERATION)).expect("accelerations")
    };
    let mut massless = particles.clone();
    (30..40).for_each(|id| massless.mass_mut()[id] = 0.0);
    (30..40).for_each(|id| particles.set_life(id, Life::Removed));
    let (dead, light) = (gravity(particles), gravity(massless));
    for id in 0..30 {
        assert!((dead[id] - light[id]).length() < 1e-6 * light[id].length(), "{id}");
    }
    assert!(dead[30..].iter().all(|a| *a == glam::Vec4::ZERO) && light[35].length() > 0.1);
}

#[test]
fn batches_make_no_difference() {
    let run = |steps: &[u32]| {
        let setup = pool(drains());
        let shared = support::device();
        let mut simulation = Simulation::on(machines::gpu(&shared, setup.state.len()), &setup).expect("a run");
        for n in steps {
            simulation.step(*n).expect("steps");
        }
        let bits = |list: Vec<glam::Vec4>| list.iter().flat_map(|v| v.to_array().map(f32::to_bits)).collect::<Vec<_>>();
        let position = pollster::block_on(simulation.read(POSITION)).expect("positions");
        let velocity = pollster::block_on(simulation.read(VELOCITY)).expect("velocities");
        (bits(position), bits(velocity), pollster::block_on(simulation.read(LIFE)).expect("lives"))
    };
    let (all, parts) = (run(&[50]), run(&[1, 3, 17, 29]));
    assert!(all == parts && all.2.contains(&0) && all.2.contains(&1) && all.2.contains(&2));
}

#[test]
fn without_births_nothing_is_added() {
    let machine = motes::kernel::Machine::HOST;
    let mut setup = pool(Vec::new());
    setup.state = {
        let mut p = jet(0.1);
        p.remove("life");
        p.births.clear();
        p.mass_mut().fill(1.0);
        p.position_mut().iter_mut().for_each(|x| *x = x.abs().with_z(0.0));
        p
    };
    let plans = setup.plans(machine).expect("plans");
    let plain = plans.step.to_string();
    assert!(plans.all().all(|plan| !plan.fields(6).contains_key("life")), "{plain}");
    setup.state.drains = drains();
    let more = setup.plans(machine).expect("plans").step.to_string();
    let rest = more.replace("rest | ", "").replace("tick | drain 1 | drain 2 | watch", "watch | tick");
    assert!(more != plain && rest == plain, "{more}\n{plain}");
    assert!(more.ends_with("tick | drain 1 | drain 2 | watch"), "{more}");
}

/// Rows that wait at one place are no fluid that would explode.
#[test]
fn pending_particles_are_no_part_of_a_start() {
    let mut setup = pool(drains());
    // Its solid stands in the middle of the fluid, and would press it together.
    assert!(setup.start().is_err_and(|why| why.to_string().contains("start inside of obstacles")));
    setup.forces.retain(|force| force.properties().pictured.is_none());
    let start = setup.start().expect("no explosion").expect("a fluid");
    assert_eq!(start.fluid as usize, 60);
}
