//! The generators: same bits for ever, the totals they promise, and the models' published numbers within sampling error.

use std::borrow::Cow;

use glam::DVec3;
use motes::error::Error;
use motes::particles::{Particles, SHAPES, shape};
use motes::settings::{Kind, Settings, Value};
use rayon::prelude::*;

fn settings(name: &str, values: &[(&'static str, f64)]) -> Settings {
    let start = Settings::defaults(shape(name).expect("a shape").keys)
        .with("size", Value::Vector(DVec3::new(3.0, 4.0, 5.0)));
    values.iter().fold(start, |all, (key, x)| all.with(key, Value::Number(*x)))
}

fn made(name: &str, settings: &Settings) -> Particles {
    (shape(name).expect("a shape").build)(settings).expect("good settings")
}

fn make(name: &str, values: &[(&'static str, f64)]) -> Particles {
    made(name, &settings(name, values))
}

/// FNV-1a over the bits of all numbers.
fn hash(particles: &Particles) -> u64 {
    let vectors = particles.position.iter().chain(&particles.velocity).flat_map(DVec3::to_array);
    let numbers = vectors.chain(particles.mass.iter().copied()).chain(particles.radius.iter().copied());
    numbers.flat_map(|x| x.to_bits().to_le_bytes()).fold(0xcbf2_9ce4_8422_2325, |hash: u64, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// Sum of mass, centre of mass, its velocity.
fn totals(p: &Particles) -> (f64, DVec3, DVec3) {
    let mass: f64 = p.mass.iter().sum();
    let x: DVec3 = p.position.iter().zip(&p.mass).map(|(x, m)| *x * *m).sum();
    let v: DVec3 = p.velocity.iter().zip(&p.mass).map(|(v, m)| *v * *m).sum();
    (mass, x / mass, v / mass)
}

/// Acceleration and potential of every particle, G = 1, Plummer softening, direct sum.
fn gravity(p: &Particles, softening: f64) -> Vec<(DVec3, f64)> {
    (0..p.len())
        .into_par_iter()
        .map(|i| {
            let (mut a, mut phi) = (DVec3::ZERO, 0.0);
            for j in (0..p.len()).filter(|j| *j != i) {
                let r = p.position[j] - p.position[i];
                let inverse = 1.0 / (r.length_squared() + softening * softening).sqrt();
                a += r * (p.mass[j] * inverse * inverse * inverse);
                phi -= p.mass[j] * inverse;
            }
            (a, phi)
        })
        .collect()
}

/// Mean and its standard error.
fn mean(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (n, sum, squares) = values.fold((0.0, 0.0, 0.0), |(n, s, q), x| (n + 1.0, s + x, q + x * x));
    let mean = sum / n;
    (mean, ((squares / n - mean * mean) / n).sqrt())
}

/// `got`, a mean with its standard error, lies within four of them of `wanted`; `slack` is the model's own error.
#[track_caller]
fn near(what: &str, got: (f64, f64), wanted: f64, slack: f64) {
    let room = 4.0 * got.1 + slack * wanted.abs();
    assert!((got.0 - wanted).abs() <= room, "{what}: {} is not {wanted} ± {room}", got.0);
    assert!(room < 0.2 * wanted.abs(), "{what}: the test is too weak, ± {room} of {wanted}");
}

/// The share of values below a bound, within four standard errors of a binomial distribution.
#[track_caller]
fn share(what: &str, values: &[f64], bound: f64, wanted: f64) {
    #[expect(clippy::cast_precision_loss, reason = "a few thousand")]
    let n = values.len() as f64;
    #[expect(clippy::cast_precision_loss, reason = "a few thousand")]
    let got = values.iter().filter(|x| **x < bound).count() as f64 / n;
    near(what, (got, (wanted * (1.0 - wanted) / n).sqrt()), wanted, 0.0);
}

fn lengths(vectors: &[DVec3]) -> Vec<f64> {
    vectors.iter().map(|v| v.length()).collect()
}

#[test]
fn the_bits_never_change() {
    let stored = [
        ("plummer", 0),
        ("sphere", 0),
        ("disk", 0),
        ("lattice", 0),
        ("box", 0),
    ];
    assert_eq!(stored.map(|(name, _)| name).as_slice(), SHAPES.iter().map(|s| s.name).collect::<Vec<_>>());
    let values = [("count", 100.0), ("seed", 7.0), ("virial", 0.3), ("jitter", 0.2), ("speed", 0.5)];
    let made = stored.map(|(name, _)| (name, hash(&make(name, &values))));
    assert_eq!(made, stored, "a platform or a generator has changed");
    for (name, _) in stored {
        let other = [("count", 100.0), ("seed", 8.0), ("virial", 0.3), ("jitter", 0.2), ("speed", 0.5)];
        assert_ne!(make(name, &values), make(name, &other), "{name} does not look at its seed");
    }
}

#[test]
fn every_key_matters() {
    for shape in SHAPES {
        let base = settings(shape.name, &[("count", 40.0), ("virial", 0.2), ("jitter", 0.1), ("speed", 0.1)]);
        let before = hash(&made(shape.name, &base));
        for key in shape.keys {
            let other = match key.kind {
                Kind::Vector | Kind::Direction => Value::Vector(DVec3::new(2.0, 3.0, 4.0)),
                Kind::Count | Kind::Whole => Value::Number(37.0),
                _ => Value::Number(base.number(key.name) * 0.7 + 0.05),
            };
            let after = hash(&made(shape.name, &base.clone().with(key.name, other)));
            assert_ne!(before, after, "{}: {} changes nothing", shape.name, key.name);
        }
    }
}

#[test]
fn totals_are_exact() {
    let (center, velocity) = (DVec3::new(3.0, -2.0, 1.0), DVec3::new(-0.5, 0.25, 4.0));
    for (name, mass) in [("plummer", 2.5), ("sphere", 2.5), ("disk", 7.0), ("box", 500.0 * 2.5)] {
        let p = made(
            name,
            &settings(name, &[("count", 500.0), ("mass", 2.5), ("virial", 0.4), ("speed", 1.0), ("particle_radius", 0.1)])
                .with("center", Value::Vector(center))
                .with("velocity", Value::Vector(velocity)),
        );
        let (total, x, v) = totals(&p);
        assert_eq!((p.len(), p.radius.as_slice()), (500, [0.1; 500].as_slice()), "{name}");
        // 500 roundings of 1e-16.
        assert!((total / mass - 1.0).abs() < 1e-13, "{name}: mass {total}");
        assert!((v - velocity).length() < 1e-13, "{name}: velocity {v}");
        // A box is placed, not balanced: a side of 5 has the standard error 5 / √(12 · 500).
        let room = if name == "box" { 0.3 } else { 1e-13 };
        assert!((x - center).length() < room, "{name}: centre {x}");
    }
}

#[test]
fn plummer_has_its_lagrangian_radii() {
    let p = make("plummer", &[("count", 20_000.0), ("cutoff", 0.999)]);
    let radii = lengths(&p.position);
    // Radii of the endless model for G = M = 1, E = -1/4; of what is left after the cut, each holds a little more.
    for (radius, mass) in [
        (0.129_959, 0.01),
        (0.233_425, 0.05),
        (0.308_678, 0.10),
        (0.477_806, 0.25),
        (0.768_571, 0.50),
        (1.281_104, 0.75),
        (2.183_670, 0.90),
    ] {
        if mass > 0.02 {
            share(&format!("plummer within {radius}"), &radii, radius, mass / 0.999);
        }
    }
    let edge = radii.iter().copied().fold(0.0, f64::max);
    assert!((10.0..0.589_049 / (0.999_f64.powf(-2.0 / 3.0) - 1.0).sqrt() * 1.001).contains(&edge), "edge {edge}");
}

#[test]
fn plummer_is_in_equilibrium() {
    let p = make("plummer", &[("count", 4000.0), ("seed", 3.0)]);
    let phi = gravity(&p, 0.0);
    let kinetic = mean(p.velocity.iter().map(|v| 0.5 * v.length_squared()));
    // W = Σ m φ / 2 is a mean over pairs: its standard error is that of φ.
    let (w, error) = mean(phi.iter().map(|(_, phi)| *phi));
    near("K", kinetic, 0.25, 0.0);
    near("W", (0.5 * w, error), -0.5, 1e-3); // the cut
    // The radial and both tangential parts hold a third each: isotropic.
    let radial = p.position.iter().zip(&p.velocity).map(|(x, v)| 1.5 * v.dot(x.normalize()).powi(2));
    near("radial", mean(radial), 0.25, 0.0);
}

#[test]
fn a_sphere_is_uniform_and_as_warm_as_told() {
    let p = make("sphere", &[("count", 4000.0), ("virial", 0.2), ("mass", 2.0), ("radius", 3.0)]);
    let radii = lengths(&p.position);
    share("half radius", &radii, 1.5, 0.125);
    share("80 % radius", &radii, 2.4, 0.512);
    assert!(radii.iter().all(|r| *r < 3.1)); // the centre of mass is moved by 3 √(3 / 5 · 4000)
    let (w, error) = mean(gravity(&p, 0.0).iter().map(|(_, phi)| *phi));
    near("W", (w, 2.0 * error), -0.6 * 2.0 * 2.0 / 3.0, 0.0);
    near("K", mean(p.velocity.iter().map(|v| v.length_squared())), 0.2 * 0.6 * 2.0 * 2.0 / 3.0, 0.0);

    let spin = DVec3::new(0.1, -0.2, 0.3);
    let cold = settings("sphere", &[("count", 4000.0)]).with("spin", Value::Vector(spin));
    let p = made("sphere", &cold);
    // L = 2/5 M R² ω, and nothing but the turning in it.
    near("L", mean(p.position.iter().zip(&p.velocity).map(|(x, v)| x.cross(*v).dot(spin) / spin.length_squared())), 0.4, 0.0);
    assert!(p.position.iter().zip(&p.velocity).all(|(x, v)| (spin.cross(*x) - *v).length() < 0.02));
}

#[test]
fn a_lattice_is_straight_and_x_runs_fastest() {
    let straight = settings("lattice", &[("spacing", 0.5), ("mass", 3.0)]).with("center", Value::Vector(DVec3::X));
    let p = made("lattice", &straight);
    assert_eq!((p.len(), p.mass[59]), (60, 3.0));
    assert_eq!(p.position[0], DVec3::new(0.5, -0.75, -1.0));
    assert_eq!(p.position[1 + 3 * (2 + 4 * 3)], DVec3::new(1.0, 0.25, 0.5));
    let bent = made("lattice", &straight.with("jitter", Value::Number(0.25)));
    let moved: Vec<DVec3> = p.position.iter().zip(&bent.position).map(|(a, b)| *b - *a).collect();
    let worst = moved.iter().map(|d| d.abs().max_element()).fold(0.0, f64::max);
    assert!((0.11..0.125).contains(&worst), "{worst}"); // a quarter of 0.5
}

#[test]
fn a_box_is_filled_evenly() {
    let p = make("box", &[("count", 4000.0), ("speed", 2.0)]);
    for axis in 0..3 {
        let side = [3.0, 4.0, 5.0][axis];
        let along: Vec<f64> = p.position.iter().map(|x| x[axis]).collect();
        assert!(along.iter().all(|x| x.abs() < 0.5 * side));
        share("a quarter", &along, -0.25 * side, 0.25);
        share("the middle", &along, 0.0, 0.5);
        near("speed²", mean(p.velocity.iter().map(|v| v[axis] * v[axis])), 4.0, 0.0);
    }
}

#[test]
fn bad_settings_are_errors() {
    for (name, key, value, words) in [
        ("plummer", "count", Value::Number(0.0), "count is 0"),
        ("plummer", "scale", Value::Number(-1.0), "scale is -1; it must be above 0"),
        ("plummer", "mass", Value::Number(f64::NAN), "mass is NaN"),
        ("plummer", "cutoff", Value::Number(1.5), "cutoff is 1.5; it must be above 0 and at most 1"),
        ("plummer", "scale", Value::Number(1e-320), "too far apart"),
        ("plummer", "center", Value::Vector(DVec3::INFINITY), "center"),
        ("plummer", "count", Value::Number(1e10), "10000000000 particles need ids beyond"),
        ("sphere", "virial", Value::Number(-0.1), "virial is -0.1; it must be 0 or above"),
        ("sphere", "radius", Value::Text(Cow::Borrowed("big")), "radius is 0"),
        ("disk", "halo_fraction", Value::Number(1.0), "halo_fraction is 1; it must be 0 or above and below 1"),
        ("disk", "halo_fraction", Value::Number(0.0), "no particle is left for the halo"),
        ("disk", "halo_fraction", Value::Number(0.999), "no particle is left for the disk"),
        ("disk", "normal", Value::Vector(DVec3::ZERO), "a direction must not be zero"),
        ("disk", "disk_scale", Value::Number(0.0), "disk_scale is 0"),
        ("lattice", "size", Value::Vector(DVec3::new(2.0, 2.5, 2.0)), "three whole numbers"),
        ("lattice", "size", Value::Vector(DVec3::splat(1e6)), "particles need ids beyond the 4294967295"),
        ("box", "size", Value::Vector(DVec3::NEG_X), "a side must be 0 or above"),
    ] {
        let bad = settings(name, &[("count", 50.0)]).with(key, value);
        let error = (shape(name).expect("a shape").build)(&bad).expect_err(key);
        let limit = words.contains("ids");
        assert!(matches!(error, Error::Scene(_)) != limit && matches!(error, Error::Limit(_)) == limit, "{error:?}");
        assert!(error.to_string().contains(words), "{name}.{key}: `{error}` does not say `{words}`");
        assert!(error.to_string().contains(name));
    }
}
