//! What strains a tree: a cusp, and clumps of clumps.

use motes::State;
use rayon::prelude::*;

use crate::shapes::make;
use crate::shapes::models::{gravity, lengths, mean, near, share};

/// Hernquist's radial dispersion for G = M = a = 1 (1990, equation 10), by a series where that loses its digits.
fn dispersion2(r: f64) -> f64 {
    if r > 50.0 {
        return (0.2 - 0.1 / r) / r;
    }
    let closed = 12.0 * r * (r + 1.0).powi(3) * ((r + 1.0) / r).ln();
    (closed - r / (r + 1.0) * (25.0 + r * (52.0 + r * (42.0 + 12.0 * r)))) / 12.0
}

#[test]
fn hernquist_has_its_radii() {
    let p = make("hernquist", &[("count", 20_000.0), ("cutoff", 0.99), ("scale", 2.0)]);
    let radii = lengths(p.position());
    // M(r)/M = (r / (r + a))² of the endless model; the centre of mass is moved by some 2 a / √N · 10.
    for mass in [0.1_f64, 0.25, 0.5, 0.75, 0.9] {
        let radius = 2.0 * mass.sqrt() / (1.0 - mass.sqrt());
        share(&format!("hernquist within {radius}"), &radii, radius, mass / 0.99);
    }
    let edge = radii.iter().copied().fold(0.0, f64::max);
    assert!((100.0..2.0 * 200.0).contains(&edge), "edge {edge}");
}

#[test]
fn hernquist_is_in_equilibrium() {
    let (mass, scale, g) = (2.0, 3.0, 0.7);
    // To rest at the centre of mass, the cusp is moved by r / √N: by 0.001 to 0.04 a, as the cut lies at 0.2 to 18 a.
    for (cutoff, low, high) in [(0.03, 0.05, 0.1), (0.3, 0.1, 0.5), (0.9, 0.5, 2.0), (0.9, 2.0, 6.0), (0.9, 6.0, 17.0)]
    {
        let values = [("count", 20_000.0), ("mass", mass), ("scale", scale), ("g", g), ("cutoff", cutoff)];
        let p = make("hernquist", &values);
        // The endless model, of which this is the inner part.
        let unit = g * mass / cutoff / scale;
        let inside = |i: &usize| (low..high).contains(&(p.position()[*i].length() / scale));
        let ids: Vec<usize> = (0..p.len()).filter(inside).collect();
        let wanted = |i: usize| unit * dispersion2(p.position()[i].length() / scale);
        let radial = |i: usize| p.velocity()[i].dot(p.position()[i].normalize()).powi(2);
        let all = |i: usize| p.velocity()[i].length_squared();
        near(&format!("{low} σ²"), mean(ids.iter().map(|i| all(*i) / wanted(*i))), 3.0, 0.01);
        near(&format!("{low} radial σ²"), mean(ids.iter().map(|i| radial(*i) / wanted(*i))), 1.0, 0.01);
        // No particle is beyond the escape speed, v² = 2 ψ, up to that displacement.
        let bound = |i: usize| 0.5 * all(i) / unit * (1.0 + p.position()[i].length() / scale);
        assert!((0..p.len()).all(|i| bound(i) < 1.05), "escapers");
    }
}

#[test]
fn hernquist_is_in_virial_balance() {
    let p = make("hernquist", &[("count", 6000.0), ("seed", 3.0)]);
    let phi = gravity(&p, 0.0);
    let (w, error) = mean(phi.iter().map(|(_, phi)| *phi));
    // W = -G M² / 6a and K = -W / 2 of the endless model, of mass M = 1 / 0.99; beyond the cut lie 1e-4 of both.
    let endless = 1.0 / (0.99 * 0.99);
    near("W", (0.5 * w, 2.0 * error), -0.5 * endless, 0.0);
    let kinetic = mean(p.velocity().iter().map(|v| 0.5 * v.length_squared()));
    near("K", kinetic, 0.25 * endless * 0.99, 0.0);
}

/// Pairs nearer than each distance.
fn pairs(p: &State, distances: [f64; 2]) -> [f64; 2] {
    let within = |i: usize| {
        let near = |r: f64| (0..i).filter(|j| p.position()[i].distance_squared(p.position()[*j]) < r * r).count();
        distances.map(near)
    };
    let all = (0..p.len()).into_par_iter().map(within).reduce(|| [0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
    #[expect(clippy::cast_precision_loss, reason = "some millions")]
    all.map(|n| n as f64)
}

/// The correlation dimension between two distances (Grassberger & Procaccia 1983), and its standard error, over seeds.
fn dimension(shape: &str, values: &[(&'static str, f64)], distances: [f64; 2]) -> (f64, f64) {
    let slope = |seed: u32| {
        let all = [values, &[("count", 4096.0), ("seed", f64::from(seed))]].concat();
        let [few, many] = pairs(&make(shape, &all), distances);
        (many / few).ln() / (distances[1] / distances[0]).ln()
    };
    mean((1..=16).map(slope))
}

#[test]
fn clusters_have_their_dimension() {
    // What is measured has its own test: of a uniform ball the share of pairs within r is r³ (1 - 9/16 r + r³/32).
    let within = |r: f64| r.powi(3) * (1.0 - 0.5625 * r + r.powi(3) / 32.0);
    let even = (within(0.2) / within(0.1)).log2();
    near("a ball", dimension("sphere", &[], [0.1, 0.2]), even, 0.0);
    for (children, wanted) in [(2.0, 1.23), (4.0, 2.0), (3.0, 0.7)] {
        let shrink: f64 = (f64::ln(children) / wanted).exp();
        // Whole levels apart, so that what is between two levels cancels.
        let distances = [5, 3].map(|level| 2.0 * shrink.powi(-level));
        let got = dimension("clusters", &[("children", children), ("dimension", wanted)], distances);
        // Neighbours in clumps above the largest are missing: shares of (η / λ³)⁴ and (η / λ³)⁶, 0.06 and 0.02 for D = 2.
        near(&format!("{children} clumps in a clump"), got, wanted, 0.03);
    }
}
