//! The models' published numbers, within sampling error.

use glam::DVec3;
use motes::State;
use motes::settings::Value;
use motes::shapes::shape;
use rayon::prelude::*;

use crate::shapes::{made, make, settings, totals};

/// Acceleration and potential of every particle, G = 1, Plummer softening, direct sum.
pub fn gravity(p: &State, softening: f64) -> Vec<(DVec3, f64)> {
    (0..p.len())
        .into_par_iter()
        .map(|i| {
            let (mut a, mut phi) = (DVec3::ZERO, 0.0);
            for j in (0..p.len()).filter(|j| *j != i) {
                let r = p.position()[j] - p.position()[i];
                let inverse = 1.0 / (r.length_squared() + softening * softening).sqrt();
                a += r * (p.mass()[j] * inverse * inverse * inverse);
                phi -= p.mass()[j] * inverse;
            }
            (a, phi)
        })
        .collect()
}

/// Mean and its standard error.
pub fn mean(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (n, sum, squares) = values.fold((0.0, 0.0, 0.0), |(n, s, q), x| (n + 1.0, s + x, q + x * x));
    let mean = sum / n;
    (mean, ((squares / n - mean * mean) / n).sqrt())
}

/// `got`, a mean with its standard error, lies within four of them of `wanted`; `slack` is the model's own error.
#[track_caller]
pub fn near(what: &str, got: (f64, f64), wanted: f64, slack: f64) {
    let room = 4.0 * got.1 + slack * wanted.abs();
    assert!((got.0 - wanted).abs() <= room, "{what}: {} is not {wanted} ± {room}", got.0);
    assert!(room < 0.2 * wanted.abs(), "{what}: the test is too weak, ± {room} of {wanted}");
}

/// The share of values below a bound, within four standard errors of a binomial distribution.
#[track_caller]
pub fn share(what: &str, values: &[f64], bound: f64, wanted: f64) {
    #[expect(clippy::cast_precision_loss, reason = "a few thousand")]
    let n = values.len() as f64;
    #[expect(clippy::cast_precision_loss, reason = "a few thousand")]
    let got = values.iter().filter(|x| **x < bound).count() as f64 / n;
    near(what, (got, (wanted * (1.0 - wanted) / n).sqrt()), wanted, 0.0);
}

pub fn lengths(vectors: &[DVec3]) -> Vec<f64> {
    vectors.iter().map(|v| v.length()).collect()
}

#[test]
fn plummer_has_its_lagrangian_radii() {
    let p = make("plummer", &[("count", 20_000.0), ("cutoff", 0.999)]);
    let radii = lengths(p.position());
    // Radii of the endless model for G = M = 1, E = -1/4; of what is left after the cut, each holds a little more.
    for (radius, mass) in [
        (0.233_425, 0.05),
        (0.308_678, 0.10),
        (0.477_806, 0.25),
        (0.768_571, 0.50),
        (1.281_104, 0.75),
        (2.183_670, 0.90),
    ] {
        share(&format!("plummer within {radius}"), &radii, radius, mass / 0.999);
    }
    let edge = radii.iter().copied().fold(0.0, f64::max);
    assert!((10.0..0.589_049 / (0.999_f64.powf(-2.0 / 3.0) - 1.0).sqrt() * 1.001).contains(&edge), "edge {edge}");
}

#[test]
fn plummer_is_in_equilibrium() {
    let p = make("plummer", &[("count", 4000.0), ("seed", 3.0)]);
    let phi = gravity(&p, 0.0);
    let kinetic = mean(p.velocity().iter().map(|v| 0.5 * v.length_squared()));
    // W = Σ m φ / 2 is a mean over pairs: its standard error is that of φ.
    let (w, error) = mean(phi.iter().map(|(_, phi)| *phi));
    near("K", kinetic, 0.25, 0.0);
    near("W", (0.5 * w, error), -0.5, 1e-3); // the cut
    // The radial and both tangential parts hold a third each: isotropic.
    let radial = p.position().iter().zip(p.velocity()).map(|(x, v)| 1.5 * v.dot(x.normalize()).powi(2));
    near("radial", mean(radial), 0.25, 0.0);
}

#[test]
fn a_sphere_is_uniform_and_has_its_dispersion() {
    let p = make("sphere", &[("count", 4000.0), ("virial", 0.2), ("mass", 2.0), ("radius", 3.0)]);
    let radii = lengths(p.position());
    share("half radius", &radii, 1.5, 0.125);
    share("80 % radius", &radii, 2.4, 0.512);
    assert!(radii.iter().all(|r| *r < 3.1)); // the centre of mass is moved by 3 √(3 / 5 · 4000)
    let (w, error) = mean(gravity(&p, 0.0).iter().map(|(_, phi)| *phi));
    near("W", (w, 2.0 * error), -0.6 * 2.0 * 2.0 / 3.0, 0.0);
    near("K", mean(p.velocity().iter().map(|v| v.length_squared())), 0.2 * 0.6 * 2.0 * 2.0 / 3.0, 0.0);

    let spin = DVec3::new(0.1, -0.2, 0.3);
    let cold = settings("sphere", &[("count", 4000.0)]).with("spin", Value::Vector(spin));
    let p = made("sphere", &cold);
    // L = 2/5 M R² ω, and nothing but the turning in it.
    near(
        "L",
        mean(p.position().iter().zip(p.velocity()).map(|(x, v)| x.cross(*v).dot(spin) / spin.length_squared())),
        0.4,
        0.0,
    );
    assert!(p.position().iter().zip(p.velocity()).all(|(x, v)| (spin.cross(*x) - *v).length() < 0.02));
}

#[test]
fn a_lattice_is_straight_and_x_runs_fastest() {
    let straight = settings("lattice", &[("spacing", 0.5), ("mass", 3.0)]).with("center", Value::Vector(DVec3::X));
    let p = made("lattice", &straight);
    assert_eq!((p.len(), p.mass()[59]), (60, 3.0));
    assert_eq!(p.position()[0], DVec3::new(0.5, -0.75, -1.0));
    assert_eq!(p.position()[1 + 3 * (2 + 4 * 3)], DVec3::new(1.0, 0.25, 0.5));
    let bent = made("lattice", &straight.with("jitter", Value::Number(0.25)));
    let moved: Vec<DVec3> = p.position().iter().zip(bent.position()).map(|(a, b)| *b - *a).collect();
    let worst = moved.iter().map(|d| d.abs().max_element()).fold(0.0, f64::max);
    assert!(moved.iter().any(|d| d.x < -0.1) && moved.iter().any(|d| d.x > 0.1), "to one side only");
    assert!((0.11..0.125).contains(&worst), "{worst}"); // a quarter of 0.5
}

#[test]
fn a_box_is_filled_evenly() {
    let p = make("box", &[("count", 4000.0), ("speed", 2.0)]);
    for axis in 0..3 {
        let side = [3.0, 4.0, 5.0][axis];
        let along: Vec<f64> = p.position().iter().map(|x| x[axis]).collect();
        assert!(along.iter().all(|x| x.abs() < 0.5 * side));
        share("a quarter", &along, -0.25 * side, 0.25);
        share("the middle", &along, 0.0, 0.5);
        near("speed²", mean(p.velocity().iter().map(|v| v[axis] * v[axis])), 4.0, 0.0);
    }
}

/// Neighbours of an atom in the middle of each structure: how many, and how far, in edges.
#[test]
fn crystals_have_their_density_neighbours_and_temperature() {
    for (structure, each, neighbours, distance) in [
        ("sc", 1, 6, 1.0),
        ("bcc", 2, 8, 0.75_f64.sqrt()),
        ("fcc", 4, 12, 0.5_f64.sqrt()),
        ("diamond", 8, 4, 0.1875_f64.sqrt()),
    ] {
        let numbers = [("density", 0.8), ("mass", 2.5), ("temperature", 0.7), ("seed", 3.0)];
        let velocity = DVec3::new(1.0, -2.0, 0.5);
        let settings = settings("crystal", &numbers)
            .with("structure", Value::Text(structure.into()))
            .with("center", Value::Vector(DVec3::X))
            .with("velocity", Value::Vector(velocity));
        let p = made("crystal", &settings);
        let count = p.len() as f64;
        assert_eq!(p.len(), each * 60, "{structure}");
        let edge = (each as f64 / 0.8).cbrt();
        let (mass, x, v) = totals(&p);
        assert!((mass / (2.5 * count) - 1.0).abs() < 1e-13);
        assert!((x - DVec3::X).length() < 1e-13 && (v - velocity).length() < 1e-13, "{structure}: {x} {v}");
        // In a box of its cells every atom is like any other: the first one, by nearest images.
        let sides = DVec3::new(3.0, 4.0, 5.0) * edge;
        let half = 0.5 * sides;
        assert!(p.position().iter().all(|x| (*x - DVec3::X).abs().cmple(half).all()), "{structure}");
        let way = |x: &DVec3| {
            let r = *x - p.position()[0];
            (r - sides * (r / sides).round()).length() / edge
        };
        let near = p.position()[1..].iter().map(way).filter(|r| *r < 1.001 * distance);
        let near: Vec<f64> = near.collect();
        assert_eq!(near.len(), neighbours, "{structure}");
        assert!(near.iter().all(|r| (r / distance - 1.0).abs() < 1e-12), "{structure}: {near:?}");
        let heat: f64 = p.velocity().iter().map(|v| 2.5 * (*v - velocity).length_squared()).sum();
        assert!((heat / (3.0 * count - 3.0) / 0.7 - 1.0).abs() < 1e-13, "{structure}: {heat}");
    }
    let mut massless = settings("crystal", &[("temperature", 1.0), ("mass", 0.0)]);
    let build = shape("crystal").expect("it").build;
    assert!(build(&massless).expect_err("no mass").to_string().contains("particles without mass have no temperature"));
    massless = massless.with("temperature", Value::Number(0.0));
    assert_eq!(build(&massless).expect("it is cold").velocity()[3], DVec3::ZERO);
}
