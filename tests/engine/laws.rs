//! Laws: what every force must obey, whatever it is called; and numbers by hand for those that are there.

use std::f64::consts::TAU;

use crate::support::choices::{self, nudged};
use crate::support::machines;
use crate::support::states::{accelerations, evaluated, evaluated_after, force, one, torques, vector, word};
use glam::{DVec3, DVec4};
use motes::State;
use motes::forces::{self, Component, Entry, Law, Over};
use motes::kernel::{Access, Machine, World};
use motes::settings::{Kind, Settings, Value};

const TIME: f64 = 0.83;

/// Every force of the register in all its variants, and fluids.
fn every(mut look: impl FnMut(&str, &'static Entry, &Settings, Box<dyn Component>)) {
    for entry in choices::lawful() {
        for settings in choices::variants(entry.keys) {
            look(&format!("{} {:?}", entry.name, settings.0), entry, &settings, (entry.build)(&settings));
        }
    }
    let entry = forces::entry("fluid").expect("fluids");
    for settings in choices::fluids() {
        look(&format!("fluid {:?}", settings.0), entry, &settings, (entry.build)(&settings));
    }
}

fn is_reciprocal(force: &dyn Component) -> bool {
    force.laws().iter().any(|law| law.reciprocal)
}

/// Σ m w: each of a pair holds its half.
fn potential(force: &[Box<dyn Component>], particles: &State) -> f64 {
    accelerations(force, particles, TIME).iter().zip(particles.mass()).map(|(a, m)| a.w * m).sum()
}

/// Either a force has a potential, and is F = −∇U of it whatever the velocity; or it has none, and depends on velocity or
/// chance, or is one that some do to others and not others to them. What keeps history of pairs may have both: a contact has springs, of
/// which it says the energy, and dashpots, see `tests/physics/matter/energy.rs`.
#[test]
fn forces_are_gradients_or_depend_on_velocity() {
    let (mut gradients, mut others) = (0, 0);
    every(|name, _, _, force| {
        let laws = force.laws();
        if laws.is_empty() || laws.iter().any(Law::remembers) {
            return;
        }
        let one_sided = laws.iter().any(|law| law.over != Over::Each && !law.reciprocal);
        let force = [force];
        let particles = crate::support::elastic(crate::support::cloud(40, 3));
        let a = accelerations(&force, &particles, TIME);
        assert!(a.iter().all(|a| a.is_finite()), "{name}: {a:?}");
        assert!(a.iter().filter(|a| a.truncate().length() > 0.0).count() > 5, "{name} does next to nothing: {a:?}");
        let mut faster = particles.clone();
        faster.velocity_mut().iter_mut().for_each(|v| *v = *v * 1.7 + DVec3::new(0.1, 0.2, -0.3));
        let moved = accelerations(&force, &faster, TIME);
        if a.iter().all(|a| a.w == 0.0) {
            others += 1;
            let later = World { time: TIME, dt: 0.01, step: 5, ..World::default() };
            let by_chance = evaluated(&force, &particles, later).0 != a;
            assert!(one_sided || by_chance || a != moved, "{name}: no potential, although velocity is nothing to it");
            return;
        }
        gradients += 1;
        assert_eq!(a, moved, "{name}: a potential, although it depends on velocity");
        // Wide, and so close that some are within any softening.
        let cusp = choices::ATOMS.iter().any(|atoms| name.starts_with(atoms));
        gradient(name, &force, &crate::support::elastic(crate::support::cloud(6, 3)), cusp);
        let mut close = crate::support::elastic(crate::support::cloud(12, 3));
        close.position_mut().iter_mut().for_each(|x| *x *= 0.3);
        gradient(name, &force, &close, cusp);
    });
    assert!(gradients >= 6 && others >= 3, "{gradients} with a potential and {others} without are too few to be all");
}

/// m a = −∂U/∂x for every particle and direction, by central differences. With a `cusp` a force does not end at r = 0, where it turns round.
fn gradient(name: &str, force: &[Box<dyn Component>], particles: &State, cusp: bool) {
    let h = 1e-5;
    let all = accelerations(force, particles, TIME);
    let places = particles.position();
    let shortest = |i: usize| {
        let others = places.iter().enumerate().filter(|(j, _)| *j != i);
        others.map(|(_, x)| (*x - places[i]).length()).fold(f64::INFINITY, f64::min)
    };
    for (i, acceleration) in all.iter().enumerate() {
        // Across the way to the nearest one F″ is F / r².
        let turning = if cusp { (h / shortest(i)).powi(2) * acceleration.truncate().length() } else { 0.0 };
        let turning = turning * particles.mass()[i];
        for k in 0..3 {
            let at = |side: f64| {
                let mut there = particles.clone();
                there.position_mut()[i][k] += side * h;
                potential(force, &there)
            };
            let want = -(at(1.0) - at(-1.0)) / (2.0 * h);
            let got = particles.mass()[i] * acceleration[k];
            // Rounding, 1e-16 U / h = 1e-11 U, tenfold; and the third derivative, h² F″ / 6 with F″ up to F / ε², where ε is
            // 0.17, or the shortest side of a joint, a hundredth.
            let allowed = 1e-10 * potential(force, particles).abs().max(1.0) + 1e-6 * got.abs() + turning;
            assert!((got - want).abs() < allowed, "{name}: particle {i}, component {k}: {got} is not {want}");
        }
    }
}

/// Friction at the centres of pedestrians is a torque on the whole, and λ = 1.47, to which its default is nudged, is refused:
/// `tests/physics/crowds/forces.rs`.
const NOT_CENTRAL: &str = "social_force";

/// What pairs do to each other adds up to nothing: no force on the whole, no torque.
#[test]
fn action_is_reaction() {
    let mut pairs = 0;
    every(|name, _, _, force| {
        if !is_reciprocal(force.as_ref()) || name.starts_with(NOT_CENTRAL) {
            return;
        }
        pairs += 1;
        let particles = crate::support::cloud(40, 3);
        let force = [force];
        let (a, torques) = (accelerations(&force, &particles, TIME), torques(&force, &particles, TIME));
        let (mut push, mut turn, mut size) = (DVec3::ZERO, DVec3::ZERO, 0.0);
        for ((a, x), m) in a.iter().zip(particles.position()).zip(particles.mass()) {
            push += *m * a.truncate();
            turn += *m * x.cross(a.truncate());
            size += m * a.truncate().length();
        }
        turn += torques.iter().sum::<DVec3>();
        size += torques.iter().map(|torque| torque.length()).sum::<f64>();
        // 40 sums of 40 terms, each rounded by 1e-16.
        let allowed = 40.0 * f64::EPSILON * size;
        assert!(push.length() < allowed && turn.length() < allowed, "{name}: {push} and {turn} of {size}");
        assert!(size > 1e-3, "{name} does nothing");
    });
    assert!(pairs >= 2);
}

fn other_species(value: &Value) -> Value {
    if let Value::Number(n) = value { Value::Number(n - 1.0) } else { Value::Number(1.0) }
}

/// A key that is not read, or a name mistyped, changes nothing.
#[test]
fn every_key_is_read() {
    // A step downhill shows neither where particles rest nor how long steps grow: `tests/physics/molecular/minimum.rs`.
    // A barostat needs a box: `tests/physics/molecular/barostats.rs`.
    let alone = ["minimize", "berendsen_pressure", "cell_rescaling"];
    for entry in choices::lawful().filter(|entry| !alone.contains(&entry.name)) {
        let variants = choices::variants(entry.keys);
        // Collisions with a bath are rare in a short step.
        let dt = if entry.name == "andersen" { 1.0 } else { 0.01 };
        let world = World { time: TIME, dt, ..World::default() };
        let cloud = crate::support::cloud(100, 3);
        // Some with accelerations of a step before, and some without: by them, or by angles alone, a tree decides what is far.
        let before: Vec<_> = cloud.position().iter().map(|x| DVec4::X * if x.x > 0.0 { 0.3 } else { 0.0 }).collect();
        let at = |settings: &Settings| {
            let force = || [(entry.build)(settings)];
            (evaluated_after(&force(), &cloud, world, &before), torques(&force(), &cloud, TIME))
        };
        // What wants a box of its own has tests of its own; pairs that bonds leave out are those of `neighbors/exclusions.rs`.
        let periodic = ["accuracy", "exclude", "hubble", "omega_matter", "omega_lambda", "redshift"];
        for key in entry
            .keys
            .iter()
            .filter(|key| !matches!(key.kind, Kind::Choice(["nearest", "ewald"])) && !periodic.contains(&key.name))
        {
            assert!(
                !["kind", "wgsl"].contains(&key.name),
                "{}: a scene says `{}` of which force it is",
                entry.name,
                key.name
            );
            let others = |settings: &Settings| -> Vec<Settings> {
                let value = &settings.0[key.name];
                match key.kind {
                    Kind::Choice(words) => {
                        let other = words.iter().filter(|w| *w != &settings.text(key.name));
                        other.map(|w| settings.clone().with(key.name, Value::Text((*w).into()))).collect()
                    }
                    Kind::Species => vec![settings.clone().with(key.name, other_species(value))],
                    kind => vec![settings.clone().with(key.name, nudged(kind, value))],
                }
            };
            // One variant in which it matters is enough: a softening says nothing to a spring.
            let all: Vec<_> = variants.iter().flat_map(|v| others(v).into_iter().map(move |o| (v, o))).collect();
            // Pairs in range are the same however they are found.
            // Spheres touch as far as their radii reach.
            let touches = ["contact", "social_force"].contains(&entry.name) && key.name == "range";
            // A table of all pairs leaves none to mix.
            let only_word = touches
                // The ends of a chain of thermostats reach particles after some steps: `tests/physics/matter/thermostat.rs`.
                || ["skin", "mixing", "chain"].contains(&key.name)
                || matches!(key.kind, Kind::Choice([_] | ["near", "list", "auto", "within"]));
            let read = all.iter().any(|(one, other)| at(one) != at(other));
            assert!(read || only_word, "{}: the key `{}` changes nothing", entry.name, key.name);
        }
    }
}

/// Two bodies at a distance, and the acceleration of the first.
fn gravity(kernel: &'static str, softening: f64, distance: f64) -> DVec4 {
    let mut two = one(DVec3::ZERO, DVec3::ZERO);
    two.push(DVec3::new(0.0, distance, 0.0), DVec3::ZERO, 3.0, 0.0);
    let settings = [("g", Value::Number(0.7)), ("kernel", word(kernel)), ("softening", Value::Number(softening))];
    // Each holds half of the potential.
    accelerations(&[force("gravity", &settings)], &two, 0.0)[0] * DVec4::new(1.0, 1.0, 1.0, 2.0)
}

#[test]
fn the_spline_is_newton_outside_and_smooth_inside() {
    let (gm, softening) = (0.7 * 3.0, 0.4);
    let h = 2.8 * softening;
    for distance in [h, 1.01 * h, 3.0 * h] {
        let (soft, newton) = (gravity("spline", softening, distance), gravity("plummer", 0.0, distance));
        assert!((soft - newton).length() < 1e-14 * newton.length(), "{distance}: {soft} is not {newton}");
        assert!((newton.y - gm / distance.powi(2)).abs() < 1e-14 && (newton.w + gm / distance).abs() < 1e-14);
    }
    // In the middle the potential is that of Plummer's law, −G m / ε, which is what makes the two ε one.
    let (middle, plummer) = (gravity("spline", softening, 1e-9), gravity("plummer", softening, 1e-9));
    assert!((middle.w + gm / softening).abs() < 1e-14 && (plummer.w + gm / softening).abs() < 1e-14);
    assert!(middle.y.abs() < 1e-7, "no force in the middle");
    // Across the seams value and slope continue: what is left is the second derivative times the way.
    for seam in [0.5 * h, h] {
        let way = 1e-7;
        let (below, above) = (gravity("spline", softening, seam - way), gravity("spline", softening, seam + way));
        let steepest = gm / (softening * softening * softening);
        assert!((above.y - below.y).abs() < 2.0 * way * steepest, "the force leaps at {seam}: {below} {above}");
        assert!((above.w - below.w - 2.0 * way * below.y).abs() < way * way * steepest * 4.0, "φ leaps at {seam}");
    }
    // At u = 1/4, by hand: force 32/3 + (8 − 38.4) / 16, potential −2.8 + (16/3 + (1.6 − 9.6) / 16) / 16.
    let quarter = gravity("spline", softening, h / 4.0);
    let (pull, potential) = (32.0 / 3.0 - 30.4 / 16.0, -2.8 + (16.0 / 3.0 - 0.5) / 16.0);
    assert!((quarter.y - gm * pull * (h / 4.0) / h.powi(3)).abs() < 1e-13, "{quarter}");
    assert!((quarter.w - gm * potential / h).abs() < 1e-13, "{quarter} {}", gm * potential / h);
}

#[test]
fn numbers_by_hand() {
    let at =
        |force, x: [f64; 3], v: [f64; 3], time| accelerations(&[force], &one(DVec3::from(x), DVec3::from(v)), time)[0];
    let number = Value::Number;
    let near = |got: DVec4, want: [f64; 4]| {
        assert!(
            (got - DVec4::from(want)).length() < 1e-14 * DVec4::from(want).length().max(1.0),
            "{got}, not {want:?}"
        );
    };
    // φ = −g · x
    near(
        at(force("uniform", &[("acceleration", vector(2.0, -3.0, 0.5))]), [4.0, 2.0, -6.0], [9.0; 3], 7.0),
        [2.0, -3.0, 0.5, 1.0],
    );
    // u = (3, 0, 4), |u| = 5, γ + c |u| = 0.2 + 0.5
    let drag = [("linear", number(0.2)), ("quadratic", number(0.1)), ("wind", vector(-1.0, 2.0, 0.0))];
    near(at(force("drag", &drag), [9.0; 3], [2.0, 2.0, 4.0], 7.0), [-2.1, 0.0, -2.8, 0.0]);
    // A quarter of a period less a sixth: sin 2π (1/4 − 1/6) = sin 30° = 1/2; the wind is 1 + 0.4 / 2 times (3, 0, 4).
    let wind = [
        ("velocity", vector(3.0, 0.0, 4.0)),
        ("rate", number(0.5)),
        ("gust", number(0.4)),
        ("period", number(8.0)),
        ("wavelength", number(6.0)),
    ];
    near(at(force("wind", &wind), [3.0, 7.0, -1.0], [0.6, 0.2, 0.0], 2.0), [1.5, -0.1, 2.4, 0.0]);
    // Two periods later, and a wavelength further on, it is the same.
    near(at(force("wind", &wind), [6.6, 7.0, 3.8], [0.6, 0.2, 0.0], 18.0), [1.5, -0.1, 2.4, 0.0]);
    // r = 2 from the axis, core 1: |u| = Γ 2 / 2π 5 = 2 for Γ = 10 π; the axis may have any length; along it nothing happens.
    let vortex = [
        ("center", vector(1.0, 1.0, 1.0)),
        ("axis", vector(0.0, 0.0, 7.0)),
        ("circulation", number(5.0 * TAU)),
        ("core", number(1.0)),
        ("rate", number(0.5)),
    ];
    near(at(force("vortex", &vortex), [3.0, 1.0, 9.0], [0.0, 0.0, 2.0], 7.0), [0.0, 1.0, -1.0, 0.0]);
    // The centre has come to (1, 0, 0), d = (0, 3, 4); ε² = 11, d² + ε² = 36.
    let attractor = |profile| {
        force(
            "attractor",
            &[
                ("position", vector(-1.0, 0.0, 0.0)),
                ("velocity", vector(1.0, 0.0, 0.0)),
                ("profile", word(profile)),
                ("strength", number(72.0)),
                ("softening", number(11f64.sqrt())),
            ],
        )
    };
    let pulled = |profile| at(attractor(profile), [1.0, 3.0, 4.0], [9.0; 3], 2.0);
    near(pulled("point"), [0.0, -1.0, -4.0 / 3.0, -12.0]);
    near(pulled("harmonic"), [0.0, -216.0, -288.0, 900.0]);
    near(pulled("logarithmic"), [0.0, -6.0, -8.0, 36.0 * 36f64.ln()]);
    // ρ = (0, 1, 0) and w = 2: U e^−½ deep, and the pull is the greatest, 2 U / (√e w). Along the beam nothing happens; the axis may have any length.
    let tweezers = |depth| {
        let settings = [
            ("position", vector(5.0, 1.0, 1.0)),
            ("axis", vector(3.0, 0.0, 0.0)),
            ("waist", number(2.0)),
            ("depth", number(depth)),
        ];
        force("tweezers", &settings)
    };
    let root = (-0.5f64).exp();
    near(at(tweezers(10.0), [-8.0, 2.0, 1.0], [9.0; 3], 2.0), [0.0, -10.0 * root, 0.0, -10.0 * root]);
    near(
        at(tweezers(-10.0), [-8.0, 1.0, -1.0], [9.0; 3], 2.0),
        [0.0, 0.0, -20.0 * (-2.0f64).exp(), 10.0 * (-2.0f64).exp()],
    );
}

/// WebGPU allows eight storage buffers in a stage, whatever the law looks at and through which search.
#[test]
fn no_law_binds_more_than_is_allowed() {
    let mut most = 0;
    every(|name, _, _, force| {
        for machine in [(false, 0), (true, 0), (true, 8)] {
            let machine = Machine { software: machine.0, subgroup: machine.1, invocations: 1, ..Machine::HOST };
            for kernel in machines::kernels(
                force.as_ref(),
                &forces::Problem::new(1000, machine).tied(&crate::support::links(1000), &[]),
            ) {
                for pass in &kernel.passes {
                    let storage = pass.bindings().filter(|(_, b)| b.access != Access::Uniform).count();
                    assert!(storage <= 8, "{name}: {storage} storage buffers");
                    most = most.max(storage);
                }
            }
        }
    });
    assert!(most > 5, "{most} are too few to be all");
}
