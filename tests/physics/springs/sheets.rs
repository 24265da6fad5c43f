//! Sheets that hang: nets without rest length, which are linear at any amplitude, and cloth.

use motes::settings::Value;

use super::{forces, made};
use crate::support::states::{cpu, phase, vector, word};

/// A net with its edge fixed and one load on every node: sag · k / m g.
#[test]
fn a_net_under_its_load() {
    // The middle, and the node next to a corner.
    let known = [
        (5usize, 1.125, 0.6875),
        (9, 4.658_088_235_294_118, 1.137_867_647_058_823_4),
        (17, 18.802_116_244_203_454, 1.582_080_643_250_826_8),
    ];
    let (stiffness, mass, g) = (50.0, 0.02, 9.81);
    for (n, middle, corner) in known {
        let number = Value::Number;
        let mut net = made(
            "cloth",
            &[
                ("columns", number(n as f64)),
                ("rows", number(n as f64)),
                ("spacing", number(0.25)),
                ("mass", number(mass)),
                ("stretch", number(stiffness)),
                ("shear", number(0.0)),
                ("bend", number(0.0)),
                ("rest", number(0.0)),
                ("pins", word("rim")),
            ],
        );
        assert_eq!(net.held.len(), 4 * (n - 1));
        // From where it hangs about, so that there is less to swing.
        let sag = |i: usize| (1 + i % n).min(n - i % n).min(1 + i / n).min(n - i / n) - 1;
        for i in 0..n * n {
            net.position_mut()[i].z -= mass * g / stiffness * sag(i) as f64 * 2.0;
        }
        // The lowest mode is the slowest, 2 √(k/m) √2 sin (π / 2 (n − 1)); critically damped, e⁻³⁰ is left.
        let omega = 2.0 * (2.0 * stiffness / mass).sqrt() * (std::f64::consts::PI / (2.0 * (n as f64 - 1.0))).sin();
        let mut simulation = cpu(&net, forces(g, 2.0 * omega), "leapfrog", 0.008);
        simulation.step((45.0 / omega / 0.008) as u32).expect("steps");
        let (x, _) = phase(&mut simulation);
        for (id, want) in [(n * n / 2, middle), (n + 1, corner)] {
            let got = -x[id].z * stiffness / (mass * g);
            // f32 holds the mass and the weight to 6e-8.
            assert!((got - want).abs() < 3e-7 * want, "{n}, particle {id}: {got}, not {want}");
        }
    }
}

/// A square of cloth in its plane, hung by its two upper corners: the equilibrium found twice elsewhere, to 2e-14.
#[test]
fn cloth_that_hangs_by_two_corners() {
    let number = Value::Number;
    let cloth = made(
        "cloth",
        &[
            ("columns", number(9.0)),
            ("rows", number(9.0)),
            ("spacing", number(0.125)),
            ("down", vector(0.0, 0.0, -1.0)),
            ("center", vector(0.5, 0.0, -0.5)),
            ("mass", number(0.01)),
            ("stretch", number(100.0)),
            ("shear", number(50.0)),
            ("bend", number(10.0)),
            ("pins", word("corners")),
        ],
    );
    assert_eq!(cloth.links.springs.len(), 398);
    let mut simulation = cpu(&cloth, forces(9.81, 8.0), "leapfrog", 0.004);
    simulation.step(2500).expect("steps");
    let (x, v) = phase(&mut simulation);
    let still = v.iter().map(|v| v.truncate().length()).fold(0.0, f64::max);
    assert!(still < 1e-9, "it still moves, by {still:e}");
    let known = [
        (76, [0.5, -1.061_208_592_966_720_8]),
        (40, [0.5, -0.559_197_847_476_041_5]),
        (4, [0.5, -0.060_307_971_230_423_51]),
        (72, [-0.001_231_949_422_509_9, -1.057_335_274_245_296_2]),
    ];
    for (id, [a, b]) in known {
        let apart = (x[id].x - a).hypot(x[id].z - b);
        // Rest lengths of shear springs, the mass and the weight are held in f32, to 6e-8 of the depth.
        assert!(apart < 3e-7, "particle {id} is {apart:e} away: {}", x[id]);
    }
    let mut energy = 0.0;
    let mut longest = 0.0_f64;
    for link in &cloth.links.springs {
        let [a, b] = link.ends.map(|id| x[id as usize].truncate());
        energy += 0.5 * link.stiffness * (a.distance(b) - link.rest).powi(2);
        if link.stiffness > 50.0 {
            longest = longest.max(a.distance(b) / link.rest);
        }
    }
    assert!((energy - 0.199_796_767_352_381_6).abs() < 1e-6, "elastic energy {energy}");
    assert!((longest - 1.181_019_042_299_530_1).abs() < 1e-6, "largest stretch {longest}");
    let weight: f64 = x.iter().map(|x| 0.01 * 9.81 * x.z).sum();
    assert!((weight + 4.387_313_462_753_625).abs() < 1e-5, "energy of weight {weight}");
}
