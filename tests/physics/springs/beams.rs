//! Rods with joints against the elastica (Euler 1744): a cantilever that bends under its own weight.

use glam::DVec3;
use motes::links::{Joint, Rod};
use motes::settings::Value;

use super::{at, fix};
use crate::support::states::{cpu, force, phase, vector};

/// Where the free end comes to rest: the drop and the reach, of a length of 1, for γ = q L³ / E I.
fn tip(pieces: u32, gamma: f64, base: f64) -> (f64, f64) {
    let ds = 1.0 / f64::from(pieces);
    // q = γ with E I = 1; half of a piece's weight is on either of its ends.
    let places: Vec<[f64; 3]> = (0..pieces + 2).map(|i| [ds * (f64::from(i) - 1.0), 0.0, 0.0]).collect();
    let mut beam = at(&places, ds);
    beam.mass_mut()[pieces as usize + 1] = 0.5 * ds;
    fix(&mut beam, [0, 1]);
    for i in 1..=pieces {
        beam.links.rods.push(Rod { ends: [i, i + 1], length: ds });
        let stiffness = if i == 1 { base / ds } else { 1.0 / ds };
        beam.links.joints.push(Joint { ids: [i - 1, i, i + 1], stiffness, rest: 0.0 });
    }
    let weight = [("acceleration", vector(0.0, 0.0, -gamma))];
    let all = vec![
        force("rod", &[]),
        force("joint", &[]),
        force("uniform", &weight),
        force("drag", &[("linear", Value::Number(7.0))]),
    ];
    // ω² is up to 16 / ds⁴, and the slowest mode has ω = 3.5.
    let dt = 0.3 * ds * ds;
    let mut simulation = cpu(&beam, all, "symplectic_euler", dt);
    simulation.step((7.0 / dt) as u32).expect("steps");
    let (x, v) = phase(&mut simulation);
    let still = v.iter().map(|v| v.truncate().length()).fold(0.0, f64::max);
    assert!(still < 2e-5, "it still moves, by {still:e}");
    let end: DVec3 = x[pieces as usize + 1].truncate();
    (-end.z, end.x)
}

#[test]
fn a_heavy_cantilever() {
    // Drop and reach by the boundary value problem, solved elsewhere.
    for (gamma, drop, reach) in
        [(1.0, 0.123_471_401_983, 0.991_246_395_347), (10.0, 0.700_199_715_514, 0.656_353_761_239)]
    {
        let errors: Vec<f64> =
            [6, 12].map(|n| tip(n, gamma, 2.0)).iter().map(|(z, x)| (z - drop).hypot(x - reach)).collect();
        // Of order 2 with a clamped joint of 2 E I / ds, and below 2 % with six pieces.
        assert!(errors[0] < 0.02 && errors[1] < 0.3 * errors[0], "γ = {gamma}: {errors:?}");
        let (z, x) = tip(12, gamma, 1.0);
        assert!((z - drop).hypot(x - reach) > 4.0 * errors[1], "γ = {gamma}: E I / ds at the base is of order 1");
    }
}
