//! `contact`: impacts, rolling and sliding against their closed forms, momenta that are kept, and lockstep.

use std::f64::consts::PI;

use glam::DVec3;
use motes::kernel::Array;
use motes::motion::{Held, Hold};
use motes::settings::Value;
use motes::{Bounds, Cpu, Error, Setup, Side, Simulation, State};
use pollster::block_on;

use super::{agrees, on_cpu, setup, side};
use crate::support::Random;
use crate::support::states::{force, vector};

const STIFFNESS: f64 = 5000.0;

/// A sphere.
#[derive(Clone, Copy)]
pub struct Grain {
    pub position: DVec3,
    pub velocity: DVec3,
    pub spin: DVec3,
    pub mass: f64,
    pub radius: f64,
    /// Its moment of inertia, as a part of m R²: 2 / 5, or 0 where it does not turn.
    pub inertia: f64,
}

pub const GRAIN: Grain =
    Grain { position: DVec3::ZERO, velocity: DVec3::ZERO, spin: DVec3::ZERO, mass: 1.0, radius: 0.5, inertia: 0.4 };

pub fn state(grains: &[Grain]) -> State {
    let mut state = State::default();
    grains.iter().for_each(|grain| state.push(grain.position, grain.velocity, grain.mass, grain.radius));
    let all = |of: &dyn Fn(&Grain) -> DVec3| Array::Vec3(grains.iter().map(of).collect());
    for column in contact::<f64>(&[]).columns() {
        state.declare(&column).expect("a column");
    }
    state.set("radius", Array::Float(grains.iter().map(|grain| grain.radius).collect())).expect("radii");
    state.set("angular_velocity", all(&|grain| grain.spin)).expect("spins");
    let moment = |grain: &Grain| DVec3::splat(grain.inertia * grain.mass * grain.radius.powi(2));
    state.set("inertia", all(&moment)).expect("moments");
    state
}

fn contact<T: Clone + Into<Value>>(more: &[(&'static str, T)]) -> Box<dyn motes::forces::Component> {
    let given = [("range", 2.0), ("stiffness", STIFFNESS)].map(|(name, x)| (name, Value::Number(x)));
    let more = more.iter().map(|(name, x)| (*name, x.clone().into()));
    force("contact", &given.into_iter().chain(more).collect::<Vec<_>>())
}

fn grains<T: Clone + Into<Value>>(all: &[Grain], more: &[(&'static str, T)], dt: f64) -> Setup {
    setup(state(all), vec![contact(more)], Bounds::default(), dt)
}

pub fn after(setup: &Setup, time: f64) -> State {
    let mut simulation = on_cpu(setup);
    simulation.step((time / setup.dt).round() as u32).expect("steps");
    block_on(simulation.snapshot()).expect("a state")
}

/// Half a period of the damped spring of two masses m and M: the time that they touch.
fn touch(mass: f64, restitution: f64) -> f64 {
    let loss = -restitution.ln();
    let damping = loss / PI.hypot(loss);
    PI / ((STIFFNESS / mass) * (1.0 - damping * damping)).sqrt()
}

/// Head-on, spheres part at e times the speed at which they met, whatever their masses. A step finds the touch up to dt late, so
/// that the error falls at least as dt.
#[test]
fn impacts_have_their_coefficient_of_restitution() {
    for (restitution, masses) in [(0.8, [1.0, 1.0]), (0.3, [1.0, 1.0]), (0.55, [0.4, 2.5]), (1.0, [1.0, 3.0])] {
        let reduced = masses[0] * masses[1] / (masses[0] + masses[1]);
        let error = |steps: f64| {
            let mut two = [GRAIN, GRAIN];
            (two[0].mass, two[1].mass) = (masses[0], masses[1]);
            (two[0].velocity, two[1].velocity) = (DVec3::new(0.3, 0.4, 0.0) * 0.7, DVec3::new(-0.3, -0.4, 0.0));
            two[1].position = DVec3::new(0.6, 0.8, 0.0) * 1.0003;
            let dt = touch(reduced, restitution) / steps;
            let end = after(&grains(&two, &[("restitution", restitution)], dt), 2.0 * touch(reduced, restitution));
            let parting = (end.velocity()[1] - end.velocity()[0]).length();
            let met = (two[1].velocity - two[0].velocity).length();
            assert!(end.velocity()[0].dot(two[0].velocity) < 0.0 || masses[0] > 0.5, "{:?}", end.velocity());
            let momentum = |v: &[DVec3]| masses[0] * v[0] + masses[1] * v[1];
            let lost = momentum(end.velocity()) - momentum(&[two[0].velocity, two[1].velocity]);
            assert!(lost.length() < 1e-14, "{lost}");
            (parting / met - restitution).abs()
        };
        let errors = [100.0, 800.0].map(error);
        assert!(errors[0] < 0.04 && errors[1] < 0.005, "{restitution}: {errors:?}");
    }
}

/// A fixed sphere without mass counts as infinitely heavy, and what spins on it comes to rest.
#[test]
fn fixed_grains_are_walls() {
    for (mass, want, near) in [(0.0, 0.5, 0.02), (1e6, 0.5, 0.02), (1.0, 0.617, 0.02)] {
        let mut two = [GRAIN, GRAIN];
        two[0].mass = mass;
        two[1].position = DVec3::X;
        two[1].velocity = -DVec3::X;
        let mut all = grains(&two, &[("restitution", 0.5)], touch(0.5, 0.5) / 200.0);
        all.state.held = vec![Held { id: 0, by: Hold::Fixed }];
        let away = after(&all, 4.0 * touch(1.0, 0.5)).velocity()[1].x;
        assert!((away - want).abs() < near, "on mass {mass}: {away} is not {want}");
    }
    let spun = |damping: f64| {
        let mut two = [GRAIN, GRAIN];
        two[0].mass = 0.0;
        two[1].position = DVec3::Z * (1.0 - 1.0 / STIFFNESS);
        two[1].spin = DVec3::Z;
        let more = [("torsional_friction", 0.1), ("rolling_damping", damping), ("friction", 0.0)];
        let mut all = grains(&two, &more, 1e-3);
        all.state.held = vec![Held { id: 0, by: Hold::Fixed }];
        all.forces.push(force("uniform", &[("acceleration", vector(0.0, 0.0, -1.0))]));
        (0..5)
            .map(|k| after(&all, 10.0 + 0.03 * f64::from(k)))
            .map(|state| state.vector("angular_velocity").expect("spins")[1].z.abs())
            .fold(0.0, f64::max)
    };
    let (damped, free) = (spun(0.3), spun(0.0));
    assert!(damped < 1e-3 && free > 10.0 * damped, "{damped:e} with, {free:e} without damping");
}

/// A sphere on a sphere so large that it is a plane, in a weight that is inclined by the angle: what it gains in the second unit of
/// time of its speed down the slope, and of its spin. In the first one springs are wound up.
fn inclined(angle: f64, friction: f64, inertia: f64) -> (f64, f64) {
    let large = 2000.0;
    let sunk = 1.0 * angle.cos() / STIFFNESS;
    let mut two = [GRAIN, GRAIN];
    (two[0].radius, two[0].position) = (large, DVec3::new(0.0, 0.0, -large));
    two[1].position = DVec3::new(0.0, 0.0, 0.5 - sunk);
    two[1].inertia = inertia;
    let weight = force("uniform", &[("acceleration", vector(angle.sin(), 0.0, -angle.cos()))]);
    let more = [("range", 2.0 * large), ("skin", 0.5), ("friction", friction), ("restitution", 0.2)];
    let mut all = grains(&two, &more, 1e-3);
    all.state.held = vec![Held { id: 0, by: Hold::Fixed }];
    all.forces.push(weight);
    let [early, late] = [1.0, 2.0].map(|time| after(&all, time));
    let spin = |state: &State| state.vector("angular_velocity").expect("spins")[1].y;
    (late.velocity()[1].x - early.velocity()[1].x, spin(&late) - spin(&early))
}

/// On an incline of angle θ a sphere rolls with a = 5/7 g sin θ where μ > 2/7 tan θ, and slides with a = g (sin θ − μ cos θ) where
/// not, while it turns with α = 5/2 μ g cos θ / R. One that cannot turn stays where μ > tan θ.
#[test]
fn spheres_roll_slide_and_stick_on_an_incline() {
    let (angle, time) = (0.5_f64, 1.0);
    // The plane is bent by 4e-4 over the way, which turns the weight by as much.
    let near = |got: f64, want: f64| assert!((got / want - 1.0).abs() < 2e-3, "{got} is not {want}");
    let (speed, spin) = inclined(angle, 0.5, 0.4);
    near(speed, 5.0 / 7.0 * angle.sin() * time);
    near(spin * 0.5, speed);
    let (speed, spin) = inclined(angle, 0.1, 0.4);
    near(speed, (angle.sin() - 0.1 * angle.cos()) * time);
    near(spin, 2.5 * 0.1 * angle.cos() / 0.5 * time);
    let (speed, spin) = inclined(angle, 0.3, 0.0);
    near(speed, (angle.sin() - 0.3 * angle.cos()) * time);
    assert_eq!(spin, 0.0);
    let (speed, _) = inclined(angle, 0.7, 0.0);
    assert!(speed.abs() < 1e-3, "it sticks: {speed}");
}

/// An oblique impact that slides all the while: the tangential impulse is μ (1 + e) times the normal one of half of it,
/// Δvₜ = μ (1 + e) vₙ m / m₁, and each sphere turns by ω = 5/2 μ (1 + e) vₙ m / (m₁ R) (Walton & Braun 1986).
#[test]
fn an_oblique_impact_slides_by_coulomb() {
    let (friction, normal, across) = (0.2, 0.4, 1.2);
    // A hundred times as stiff they touch a tenth as long.
    let touch = |mass, restitution| 0.1 * touch(mass, restitution);
    let mut two = [GRAIN, GRAIN];
    two[0].velocity = DVec3::new(normal, across, 0.0);
    two[1].position = DVec3::new(1.000001, 0.0, 0.0);
    let dt = touch(0.5, 1.0) / 2000.0;
    let more = [("friction", friction), ("restitution", 1.0), ("stiffness", 100.0 * STIFFNESS)];
    let end = after(&grains(&two, &more, dt), 1.5 * touch(0.5, 1.0));
    let impulse = friction * 2.0 * normal * 0.5;
    let slid = across - end.velocity()[0].y;
    // They turn about each other by 0.004 while they touch, in the mean by half of that: 0.002 of the normal impulse, 1 %,
    // is across, and the way out takes v² / 2 R of the normal one, 0.6 %.
    assert!((slid / impulse - 1.0).abs() < 0.02, "{slid} is not {impulse}");
    let spins = end.vector("angular_velocity").expect("spins");
    for spin in spins {
        assert!((spin.z / (-2.5 * impulse / 0.5) - 1.0).abs() < 0.01, "{spin} is not {}", -2.5 * impulse / 0.5);
    }
    assert_eq!(spins[0], spins[1]);
}

fn momenta(state: &State) -> [DVec3; 2] {
    let (spins, moments) =
        (state.vector("angular_velocity").expect("spins"), state.vector("inertia").expect("moments"));
    let mut sums = [DVec3::ZERO; 2];
    for i in 0..state.len() {
        let p = state.mass()[i] * state.velocity()[i];
        sums[0] += p;
        sums[1] += state.position()[i].cross(p) + moments[i] * spins[i];
    }
    sums
}

fn heap(count: usize) -> Vec<Grain> {
    let mut random = Random::new(5);
    let single = |v: DVec3| v.as_vec3().as_dvec3();
    let side = side(count);
    (0..count)
        .map(|i| {
            let cell = DVec3::new((i % side) as f64, (i / side % side) as f64, (i / side / side) as f64);
            Grain {
                position: single(0.8 * cell + 0.06 * random.vector()),
                velocity: single(random.vector()),
                spin: single(3.0 * random.vector()),
                mass: f64::from((1.0 + 0.4 * random.next()) as f32),
                radius: f64::from((0.43 + 0.06 * random.next()) as f32),
                inertia: 0.4,
            }
        })
        .collect()
}

/// Forces and torques of all contacts add up to nothing, in every step: momentum and angular momentum are those of the start but for
/// rounding, while energy is lost.
#[test]
fn grains_keep_their_momenta_and_lose_energy() {
    keeps_momenta(&grains(&heap(27), &[("friction", 0.4)], 1e-3));
}

/// The same where rolling and torsion are resisted, by springs and by a constant torque: what one turns by, the other turns back.
#[test]
fn resistance_to_rolling_keeps_momenta() {
    for model in ["elastic_plastic", "constant"] {
        keeps_momenta(&grains(&heap(27), &sticky(model), 1e-3));
    }
}

/// Hertz's model with resistance to rolling and torsion.
fn sticky(rolling: &'static str) -> Vec<(&'static str, Value)> {
    let numbers =
        [("friction", 0.4), ("young_modulus", 30_000.0), ("rolling_friction", 0.2), ("torsional_friction", 0.3)];
    let numbers = numbers.map(|(name, x)| (name, Value::Number(x)));
    [("model", "hertz".into()), ("rolling_model", rolling.into())].into_iter().chain(numbers).collect()
}

fn keeps_momenta(all: &Setup) {
    let energy = |state: &State| -> f64 {
        let linear: f64 = state.velocity().iter().zip(state.mass()).map(|(v, m)| m * v.length_squared()).sum();
        let (spins, moments) =
            (state.vector("angular_velocity").expect("spins"), state.vector("inertia").expect("moments"));
        0.5 * (linear + spins.iter().zip(moments).map(|(w, i)| (*i * *w).dot(*w)).sum::<f64>())
    };
    let end = after(all, 1.0);
    let (start, now) = (momenta(&all.state), momenta(&end));
    for (start, now) in start.into_iter().zip(now) {
        // A thousand steps of 27 terms of size 10, rounded by 1e-16: 1e-12, tenfold.
        assert!((start - now).length() < 1e-11, "{start} {now}");
    }
    let turned =
        end.vector("angular_velocity").expect("spins")[13] - all.state.vector("angular_velocity").expect("spins")[13];
    assert!(turned.length() > 0.1, "{turned}");
    // Springs that were compressed at the start have opened.
    let later = after(all, 2.0);
    assert!(energy(&later) <= energy(&end) + 1e-9, "{} {}", energy(&later), energy(&end));
}

#[test]
fn contacts_agree_with_their_reference() {
    for count in [2, 63, 64, 65, 333] {
        let side = DVec3::splat(0.8 * side(count) as f64);
        let periodic = Bounds::new(DVec3::splat(-0.4), side - 0.4, Side::Periodic);
        for bounds in [Bounds::default(), periodic] {
            if bounds != Bounds::default() && count < 333 {
                continue;
            }
            // Friction that holds, that gives way, and none; a spring or none.
            for (friction, spring) in [(0.5, 0.3), (0.05, 0.3), (0.3, 0.0)] {
                let more = [("range", 1.0), ("friction", friction), ("tangential_stiffness", spring)];
                let mut setup = grains(&heap(count), &more, 1.0 / 512.0);
                setup.bounds = bounds;
                // An overlap is the small difference of radii and a distance, which the device has to 2 units in its last place, 1.2e-7, and
                // the spring of a contact that slides is μ / 0.3 times that: 4e-7 where 1e-5 of usual springs, 0.02, are allowed.
                agrees(&setup, 4, 3.0, &["contact"]);
            }
        }
    }
}

/// Both models of rolling, with torsion, by Hertz, and a table of species.
#[test]
fn grains_that_stick_agree_with_their_reference() {
    for model in ["elastic_plastic", "constant"] {
        let keys = motes::forces::entry("contact").expect("it").keys;
        let pairs = keys.iter().find(|key| key.name == "pairs").expect("pairs");
        let motes::settings::Kind::Pairs(pairs) = pairs.kind else { panic!("pairs") };
        let table = ("pairs", Value::Pairs(crate::support::choices::table(pairs)));
        let more: Vec<_> = sticky(model).into_iter().chain([("range", 1.0.into()), table]).collect();
        let mut setup = grains(&heap(333), &more, 1.0 / 512.0);
        setup.state.species_mut().copy_from_slice(&crate::support::species(333));
        // As above; the root of an overlap and the stiffness of the rolling spring lose one digit more.
        agrees(&setup, 4, 10.0, &["contact"]);
    }
}

/// Of two materials the pair is that of springs in series, and its coefficients are geometric means, unless a row gives it.
#[test]
fn unlike_grains_touch_by_both_materials() {
    let row = |species: [u32; 2], friction: f64, stiffness: f64| {
        let named = [
            "stiffness",
            "young_modulus",
            "poisson_ratio",
            "restitution",
            "friction",
            "rolling_friction",
            "torsional_friction",
            "surface_tension",
        ];
        let value = |name: &str| match name {
            "friction" => friction,
            "stiffness" => stiffness,
            _ => 1.0,
        };
        motes::settings::Pair { species, values: named.map(|name| (name.to_owned(), value(name))).to_vec() }
    };
    let push = |rows: Vec<motes::settings::Pair>| {
        let mut two = [GRAIN, GRAIN];
        two[1].position = DVec3::X * 0.9;
        let mut all = grains(&two, &[("pairs", Value::Pairs(rows))], 1e-4);
        all.state.species_mut().copy_from_slice(&[0, 1]);
        after(&all, 1e-4).velocity()[1].x
    };
    let alike = push(Vec::new());
    let mixed = push(vec![row([0, 0], 1.0, 1.0), row([1, 1], 1.0, 0.25)]);
    // 2 · 1 · 0.25 / 1.25, but for what half a step of damping takes.
    assert!((mixed / alike - 0.4).abs() < 0.01, "{mixed} {alike}");
    let given = push(vec![row([0, 0], 1.0, 1.0), row([1, 1], 1.0, 0.25), row([1, 0], 1.0, 2.0)]);
    assert!((given / alike - 2.0).abs() < 0.01, "{given} {alike}");
    let bounds = Bounds::default();
    let beyond = motes::settings::Pair { species: [0, 0], values: row([0, 0], 1.0, 1.0).values };
    let beyond = motes::settings::Pair {
        values: beyond
            .values
            .into_iter()
            .map(|(name, x)| if name == "restitution" { (name, 1.5) } else { (name, x) })
            .collect(),
        ..beyond
    };
    let wrong = contact(&[("pairs", Value::Pairs(vec![beyond]))]).check(&bounds).expect_err("1.2").to_string();
    assert!(wrong.contains("restitution is 1.2"), "{wrong}");
}

#[test]
fn radii_beyond_the_range_are_refused() {
    let mut two = [GRAIN, GRAIN];
    two[1].position = DVec3::X * 5.0;
    two[1].radius = 1.5;
    let all = grains::<f64>(&two, &[], 0.01);
    match Simulation::on(Cpu::new(2).expect("two"), &all).map(|_| ()) {
        Err(Error::Scene(why)) => {
            assert!(
                why.contains("particle 1 has the radius 1.5") && why.contains("the largest that a force allows is 1"),
                "{why}"
            );
        }
        other => panic!("{other:?}"),
    }
    two[1].radius = 1.0;
    assert!(Simulation::on(Cpu::new(2).expect("two"), &grains::<f64>(&two, &[], 0.01)).is_ok());
}
