//! `social_force` and `walk`: numbers by hand, decay of sliding, dissipation, lockstep.

use glam::DVec3;
use motes::Side;
use motes::crowds::Press;
use motes::forces::Component;
use motes::settings::Value;

use super::{PERSON, Person, crowd, setup, state};
use crate::matter::{agrees, on_cpu};
use crate::support::Random;
use crate::support::states::{accelerations, force, vector, word};

fn social(more: &[(&'static str, f64)]) -> Box<dyn Component> {
    let more: Vec<_> = more.iter().map(|(name, x)| (*name, Value::Number(*x))).collect();
    force("social_force", &more)
}

/// Two pedestrians at a distance along (0.6, 0.8), and the force on the first.
fn on_first(distance: f64, velocities: [DVec3; 2], more: &[(&'static str, f64)]) -> DVec3 {
    let mut two = [PERSON, PERSON];
    two[1].position = distance * DVec3::new(0.6, 0.8, 0.0);
    (two[0].velocity, two[1].velocity) = (velocities[0], velocities[1]);
    (two[1].mass, two[1].radius) = (60.0, 0.25);
    PERSON.mass * accelerations(&[social(more)], &state(&two), 0.0)[0].truncate()
}

/// n = −(0.6, 0.8); at o = −0.16 the repulsion is 2000 e⁻², at o = 0.05 it is 2000 e^0.625 and the body force 6000; the other slides by
/// 0.5 along t = (0.8, −0.6) and comes nearer by 2, so that friction is 2.4e5 · 0.05 · 0.5.
#[test]
fn forces_by_hand() {
    let (n, t) = (-DVec3::new(0.6, 0.8, 0.0), DVec3::new(0.8, -0.6, 0.0));
    let near = |got: DVec3, want: DVec3| assert!((got - want).length() < 1e-12 * want.length(), "{got} is not {want}");
    near(on_first(0.55 + 0.16, [DVec3::ZERO; 2], &[]), 2000.0 * (-2.0_f64).exp() * n);
    let other = 0.5 * t + 2.0 * n;
    let push = 2000.0 * 0.625_f64.exp() + 6000.0;
    near(on_first(0.5, [DVec3::ZERO, other], &[]), push * n + 6000.0 * t);
    // Straight behind λ of it, beside half of it and λ / 2; the body force stays as it is.
    let social = |v: DVec3| on_first(0.5, [v, v], &[("anisotropy", 0.2)]);
    let at = |weight: f64| (weight * 2000.0 * 0.625_f64.exp() + 6000.0) * n;
    near(social(-1.3 * n), at(1.0));
    near(social(1.3 * n), at(0.2));
    near(social(0.7 * t), at(0.6));
    near(social(DVec3::ZERO), at(1.0));
    // None at the same place, by a particle without mass, or beyond the range.
    assert_eq!(on_first(0.0, [DVec3::ZERO; 2], &[]), DVec3::ZERO);
    assert_eq!(on_first(2.01, [DVec3::ZERO; 2], &[]), DVec3::ZERO);
}

/// The sliding velocity of two that overlap by g after the time t: it decays at the rate 2 κ g / m. The steps of leapfrog are of order 2
/// for a rate that does not change; velocities are so small that g does not.
#[test]
fn sliding_decays_as_the_closed_form() {
    for (overlap, friction, mass) in [(0.05, 240.0, 80.0), (0.02, 900.0, 65.0)] {
        let slow = 1e-7;
        let mut two = [Person { mass, ..PERSON }; 2];
        two[1].position = DVec3::X * (0.6 - overlap);
        (two[0].velocity, two[1].velocity) = (DVec3::Y * slow, DVec3::Y * -slow);
        let forces = || vec![social(&[("repulsion", 0.0), ("stiffness", 0.0), ("friction", friction)])];
        let rate = 2.0 * friction * overlap / mass;
        let error = |steps: u32| {
            let time = 0.9 / rate;
            let mut simulation = on_cpu(&setup(state(&two), forces(), time / f64::from(steps)));
            simulation.step(steps).expect("steps");
            let end = pollster::block_on(simulation.snapshot()).expect("a state");
            let left = (end.velocity()[0].y - end.velocity()[1].y) / (2.0 * slow);
            (left - (-rate * time).exp()).abs()
        };
        let errors = [50, 100].map(error);
        // Of (1 − h / 2) / (1 + h / 2) or of 1 − h, with h = 0.9 / steps: at most t h / 2.
        assert!(errors[0] < 0.0045 && errors[1] < 0.55 * errors[0], "{overlap} {friction}: {errors:?}");
    }
}

/// Σ F·v of friction, over random pairs that overlap: below 0 for every one, whatever their masses and radii. With the other sign, or
/// with the size of the sliding velocity in place of it, as in other programs, pairs gain energy.
#[test]
fn friction_takes_energy_from_every_pair() {
    let rubs = |v: DVec3, n: DVec3| {
        Press { repulsion: 0.0, decay: 0.08, stiffness: 0.0, friction: 2.4e5 }.force(0.03, n, v, 1.0)
    };
    let reversed = |v: DVec3, n: DVec3| -rubs(v, n);
    let sized = |v: DVec3, n: DVec3| {
        let t = DVec3::new(-n.y, n.x, 0.0);
        2.4e5 * 0.03 * v.dot(t).abs() * t
    };
    let mut gains = [0; 3];
    for seed in 1..=3 {
        let mut random = Random::new(seed);
        for _ in 0..500 {
            let mut flat = || random.vector().with_z(0.0);
            let (n, mine, yours) = (flat().normalize(), 2.0 * flat(), 2.0 * flat());
            let power =
                |f: &dyn Fn(DVec3, DVec3) -> DVec3| f(yours - mine, n).dot(mine) + f(mine - yours, -n).dot(yours);
            for (gain, law) in gains.iter_mut().zip([&rubs as &dyn Fn(DVec3, DVec3) -> DVec3, &reversed, &sized]) {
                *gain += u32::from(power(law) > 0.0);
            }
        }
        // The same by the component, for all pairs of a crowd in which they press.
        let people = crowd(60, 4.0, seed);
        let only = social(&[("repulsion", 0.0), ("stiffness", 0.0)]);
        let a = accelerations(&[only], &people, 0.0);
        let power: f64 =
            a.iter().zip(people.velocity()).zip(people.mass()).map(|((a, v), m)| m * a.truncate().dot(*v)).sum();
        assert!(power < -1e3, "seed {seed}: {power}");
        // Equal and opposite forces add up to nothing: 60 sums of 60 terms, each rounded by 1e-16. With λ = 0.5 they do not.
        let sum = |anisotropy: f64| {
            let a = accelerations(&[social(&[("anisotropy", anisotropy)])], &people, 0.0);
            let forces: Vec<DVec3> = a.iter().zip(people.mass()).map(|(a, m)| *m * a.truncate()).collect();
            let size: f64 = forces.iter().map(|force| force.length()).sum();
            forces.iter().sum::<DVec3>().length() / size
        };
        assert!(sum(1.0) < 60.0 * f64::EPSILON && sum(0.5) > 1e-6, "seed {seed}: {} {}", sum(1.0), sum(0.5));
    }
    assert!(gains[0] == 0 && gains[1] == 1500 && gains[2] > 300, "{gains:?}");
}

/// v = v₀ (1 − e^(−t / τ)) along a direction; at a target pedestrians come to rest.
#[test]
fn walking_takes_up_the_desired_velocity() {
    let after = |force: Box<dyn Component>, time: f64, dt: f64| {
        let mut simulation = on_cpu(&setup(state(&[PERSON]), vec![force], dt));
        simulation.step((time / dt).round() as u32).expect("steps");
        let end = pollster::block_on(simulation.snapshot()).expect("a state");
        (end.position()[0], end.velocity()[0])
    };
    let along = force("walk", &[("direction", vector(3.0, -4.0, 0.0)), ("relaxation_time", Value::Number(0.4))]);
    let (x, v) = after(along, 1.0, 1e-3);
    let part = 1.0 - (-2.5_f64).exp();
    let way = DVec3::new(0.6, -0.8, 0.0);
    // The steps are of order 1 for what depends on velocity: dt / 2 τ of the velocity.
    assert!(
        (v - 1.34 * part * way).length() < 2e-3 && (x - 1.34 * (1.0 - 0.4 * part) * way).length() < 2e-3,
        "{x} {v}"
    );
    let to = force("walk", &[("to", word("target")), ("target", vector(0.5, 1.2, 0.0))]);
    let (x, _) = after(to, 20.0, 5e-3);
    // About the target it swings by what it walks in a relaxation time, at most.
    assert!((x - DVec3::new(0.5, 1.2, 0.0)).length() < 0.67, "{x}");
}

/// Each kernel agrees with its reference through every search, also across a periodic box, where some are of another species.
#[test]
fn lockstep() {
    for (seed, over) in [(1, "near"), (2, "list"), (3, "within"), (4, "near")] {
        let mut social = vec![("over", word(over)), ("anisotropy", Value::Number(0.3))];
        let mut walk = vec![("relaxation_time", Value::Number(0.4))];
        if seed > 2 {
            social.push(("species", Value::Number(1.0)));
            walk.extend([("species", Value::Number(1.0)), ("to", word("target")), ("target", vector(0.3, 0.2, 0.0))]);
        }
        for count in [63, 250] {
            let side = (count as f64 * 0.6).sqrt();
            let mut setup =
                setup(crowd(count, side, seed), vec![force("walk", &walk), force("social_force", &social)], 1e-3);
            if seed == 4 {
                let half = DVec3::new(0.5 * side + 0.7, 0.5 * side + 0.7, 0.0);
                setup.bounds = motes::Bounds { dimensions: 2, ..motes::Bounds::new(-half, half, Side::Periodic) };
            }
            agrees(&setup, 3, 1.0, &["social_force", "walk"]);
        }
    }
}

#[test]
fn settings_that_make_no_sense_are_refused() {
    let why = |forces: Vec<Box<dyn Component>>, radius: f64| {
        let people = state(&[Person { radius, ..PERSON }]);
        setup(people, forces, 1e-3).check().expect_err("it makes no sense").to_string()
    };
    assert!(why(vec![social(&[("anisotropy", 1.5)])], 0.3).contains("anisotropy = 1.5"));
    assert!(why(vec![social(&[])], 1.1).contains("its range is the largest sum of two radii"));
    assert!(why(vec![social(&[("decay", 0.001)])], 0.3).contains("single precision"));
    assert!(why(vec![force("walk", &[("direction", vector(0.0, 0.0, 1.0))])], 0.3).contains("out of the plane"));
    let mut bare = motes::State::default();
    bare.push(DVec3::ZERO, DVec3::ZERO, 80.0, 0.3);
    for (name, column) in [("walk", "desired_speed"), ("social_force", "radius")] {
        let none = setup(bare.clone(), vec![force(name, &[])], 1e-3).check().expect_err("no values").to_string();
        assert!(none.contains(&format!("the column `{column}` has no initial value")), "{none}");
    }
}
