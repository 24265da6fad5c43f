//! Elastic moduli of lattices: homogenised, exact.

use glam::{DMat3, DVec3};
use motes::State;
use motes::settings::Value;

use super::{at, made, spring};
use crate::support::states::{accelerations, force, vector};

/// The elastic energy after every place x has gone to (1 + ε) x.
fn energy(mut particles: State, strain: DMat3) -> f64 {
    particles.position_mut().iter_mut().for_each(|x| *x += strain * *x);
    let got = accelerations(&[force("spring", &[])], &particles, 0.0);
    got.iter().zip(particles.mass()).map(|(a, m)| a.w * m).sum()
}

/// C₁₁ and C₄₄ out of the energies of a stretch and a shear of a volume.
fn moduli(particles: &State, volume: f64) -> (f64, f64) {
    let e = 1e-3;
    // The mean of both signs leaves out the third order.
    let mean = |strain: DMat3| f64::midpoint(energy(particles.clone(), strain), energy(particles.clone(), -strain));
    let stretch = mean(DMat3::from_diagonal(DVec3::X * e));
    let shear = mean(DMat3::from_cols(DVec3::Y * e / 2.0, DVec3::X * e / 2.0, DVec3::ZERO));
    (2.0 * stretch / (volume * e * e), 2.0 * shear / (volume * e * e))
}

/// Edges and face diagonals alike: C₁₁ = 3 k / a, C₁₂ = C₄₄ = k / a, which is isotropic, E = 2.5 k / a and ν = 1/4.
#[test]
fn jelly_is_the_same_stuff_throughout() {
    let (k, a) = (40.0, 0.25);
    for size in [[2.0, 2.0, 2.0], [4.0, 3.0, 5.0]] {
        let block = made(
            "jelly",
            &[
                ("size", vector(size[0], size[1], size[2])),
                ("spacing", Value::Number(a)),
                ("stiffness", Value::Number(k)),
                ("mass", Value::Number(0.5)),
            ],
        );
        let cells: f64 = size.iter().map(|n| n - 1.0).product();
        let (c11, c44) = moduli(&block, cells * a * a * a);
        // Beyond the second order there are strains squared, and f32 holds the diagonals to 6e-8 / 1e-3.
        assert!((c11 * a / k - 3.0).abs() < 3e-4, "{size:?}: C11 is {c11}");
        assert!((c44 * a / k - 1.0).abs() < 3e-4, "{size:?}: C44 is {c44}");
        assert!((block.mass().iter().sum::<f64>() - 0.5 * cells).abs() < 1e-9, "a mass for each cell");
        assert!(
            block.links.triangles.len()
                == 4 * ((size[0] - 1.0) * (size[1] - 1.0)
                    + (size[1] - 1.0) * (size[2] - 1.0)
                    + (size[2] - 1.0) * (size[0] - 1.0)) as usize
        );
    }
}

/// The bonds of one cell, spread out so that each is alone.
fn cell(bonds: &[([f64; 2], f64)]) -> State {
    let mut places = Vec::new();
    for (n, (way, _)) in bonds.iter().enumerate() {
        // A homogeneous strain does the same to a bond wherever it is.
        let from = [3.0 * n as f64, 1.0, 0.0];
        places.extend([from, [from[0] + way[0], from[1] + way[1], 0.0]]);
    }
    let mut particles = at(&places, 1.0);
    let bond = |(n, (way, k)): (usize, &([f64; 2], f64))| {
        let first = 2 * n as u32;
        spring([first, first + 1], way[0].hypot(way[1]), *k)
    };
    particles.links.springs = bonds.iter().enumerate().map(bond).collect();
    particles
}

/// A triangular lattice has E = 2 k / √3 and ν = 1/3; a square one with diagonals of half the stiffness E = 8/3 k₂, ν = 1/3.
#[test]
fn lattices_in_the_plane() {
    let (k, half, root) = (30.0, 0.5, 3f64.sqrt());
    let triangular = cell(&[([1.0, 0.0], k), ([half, half * root], k), ([-half, half * root], k)]);
    let (c11, c66) = moduli(&triangular, half * root);
    assert!((c11 / k - 0.75 * root).abs() < 3e-4 && (c66 / k - 0.25 * root).abs() < 3e-4, "{c11} {c66}");
    let c12 = c11 - 2.0 * c66;
    let (young, poisson) = (c11 - c12 * c12 / c11, c12 / c11);
    assert!((young / k - 2.0 / root).abs() < 1e-3 && (poisson - 1.0 / 3.0).abs() < 1e-3, "{young} {poisson}");

    let square = cell(&[([1.0, 0.0], k), ([0.0, 1.0], k), ([1.0, 1.0], k / 2.0), ([-1.0, 1.0], k / 2.0)]);
    let (c11, c66) = moduli(&square, 1.0);
    assert!((c11 / k - 1.5).abs() < 3e-4 && (c66 / k - 0.5).abs() < 3e-4, "{c11} {c66}");
}
