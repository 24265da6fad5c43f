//! What each integrator does to a spring: the matrix of one step says all of it (Hairer, Lubich & Wanner 2006, chapter I).

use crate::support::states::{cpu, force, one, phase, word};
use glam::DVec3;
use motes::forces::Component;
use motes::settings::Value;

/// ω², not 1.
const STRENGTH: f64 = 1.69;

/// The step of x″ = −ω² x − c x′ as a matrix on (x, v / ω), for hω = y.
fn matrix(name: &str, y: f64, damping: f64) -> [[f64; 2]; 2] {
    let omega = STRENGTH.sqrt();
    let column = |x: f64, v: f64| {
        let mut simulation = cpu(&one(DVec3::X * x, DVec3::X * v * omega), spring(damping), name, y / omega);
        simulation.step(1).expect("a step");
        let (x, v) = phase(&mut simulation);
        [x[0].x, v[0].x / omega]
    };
    let (a, b) = (column(1.0, 0.0), column(0.0, 1.0));
    [[a[0], b[0]], [a[1], b[1]]]
}

fn spring(damping: f64) -> Vec<Box<dyn Component>> {
    let spring = force("attractor", &[("profile", word("harmonic")), ("strength", Value::Number(STRENGTH))]);
    let drag = force("drag", &[("linear", Value::Number(damping))]);
    if damping > 0.0 { vec![spring, drag] } else { vec![spring] }
}

fn trace_and_determinant(m: [[f64; 2]; 2]) -> (f64, f64) {
    (m[0][0] + m[1][1], m[0][0] * m[1][1] - m[0][1] * m[1][0])
}

/// The larger |eigenvalue|.
fn radius(m: [[f64; 2]; 2]) -> f64 {
    let (trace, determinant) = trace_and_determinant(m);
    let root = trace * trace / 4.0 - determinant;
    if root < 0.0 { determinant.sqrt() } else { trace.abs() / 2.0 + root.sqrt() }
}

/// Numerical frequency over the true one.
fn frequency(name: &str, y: f64) -> f64 {
    let (trace, determinant) = trace_and_determinant(matrix(name, y, 0.0));
    (trace / 2.0 / determinant.sqrt()).acos() / y
}

/// The largest stable y, by bisection. The matrix of a symplectic step has determinant 1, so that its |eigenvalue| leaves
/// the unit circle as √(distance from the limit): 1e-7 above 1 stands for 1e-14 in y.
fn limit(name: &str) -> f64 {
    let stable = |y: f64| radius(matrix(name, y, 0.0)) < 1.0 + 1e-7;
    let (mut low, mut high) = (1.0, 3.5);
    assert!(stable(low) && !stable(high), "{name}: no limit between 1 and 3.5");
    for _ in 0..50 {
        let middle = f64::midpoint(low, high);
        if stable(middle) { low = middle } else { high = middle }
    }
    low
}

#[test]
fn limits_of_stability() {
    // 2√2 for Runge–Kutta 4 (Hairer & Wanner 1996, §IV.2), whose |eigenvalue| crosses 1 with a slope: there 1e-7 counts.
    let limits = [
        ("symplectic_euler", 2.0, 1e-9),
        ("leapfrog", 2.0, 1e-9),
        ("rk4", 8f64.sqrt(), 1e-6),
        ("forest_ruth", 1.573_401_947_435, 1e-9),
        ("pefrl", 2.989_449_545_907, 1e-9),
    ];
    for (name, want, allowed) in limits {
        let got = limit(name);
        assert!((got - want).abs() < allowed, "{name}: stable up to {got:.12}, not {want:.12}");
        // And over many steps: bounded just below, gone just above.
        for (factor, stays) in [(0.99, true), (1.01, false)] {
            let mut simulation = cpu(&one(DVec3::X, DVec3::Y), spring(0.0), name, factor * want / STRENGTH.sqrt());
            simulation.step(1000).expect("steps");
            let (x, _) = phase(&mut simulation);
            // The ellipse of the invariant is at most 1 / √(1 − 0.99²) = 7 times longer than wide, about 10 with both axes.
            assert_eq!(x[0].truncate().length() < 100.0, stays, "{name} at {factor} of its limit: {}", x[0]);
        }
    }
    // No limit at all: these grow at any step.
    for name in ["forward_euler", "midpoint", "heun"] {
        assert!(radius(matrix(name, 0.1, 0.0)) > 1.0 + 1e-6, "{name}");
    }
}

/// What a step multiplies the energy v² + ω²x² by; it is |eigenvalue|² for methods that turn and stretch.
#[test]
fn energy_factors() {
    for y in [0.1f64, 0.5, 1.0, 1.5] {
        let runge_kutta_2 = 1.0 + y.powi(4) / 4.0;
        let factors = [
            ("forward_euler", 1.0 + y * y),
            ("midpoint", runge_kutta_2),
            ("heun", runge_kutta_2),
            ("rk4", 1.0 - y.powi(6) / 72.0 + y.powi(8) / 576.0),
        ];
        for (name, want) in factors {
            let m = matrix(name, y, 0.0);
            for (x, v) in [(1.0, 0.0), (0.3, -0.8)] {
                let after = (m[0][0] * x + m[0][1] * v).powi(2) + (m[1][0] * x + m[1][1] * v).powi(2);
                let got = after / (x * x + v * v);
                // A dozen roundings of 1e-16.
                assert!((got - want).abs() < 4e-15, "{name} at {y}: {got}, not {want}");
            }
        }
        for name in ["symplectic_euler", "leapfrog", "forest_ruth", "pefrl"] {
            let (_, determinant) = trace_and_determinant(matrix(name, y, 0.0));
            assert!((determinant - 1.0).abs() < 4e-15, "{name} at {y} changes areas by {determinant}");
        }
    }
}

#[test]
fn invariants() {
    for (name, y) in [("symplectic_euler", 0.1f64), ("symplectic_euler", 1.3), ("leapfrog", 0.1), ("leapfrog", 1.3)] {
        let omega = STRENGTH.sqrt();
        let invariant = |x: f64, v: f64| match name {
            "leapfrog" => v * v + STRENGTH * x * x * (1.0 - y * y / 4.0),
            _ => v * v + STRENGTH * x * x - y * omega * x * v,
        };
        let mut simulation = cpu(&one(DVec3::X * 0.8, DVec3::X * 0.3), spring(0.0), name, y / omega);
        let first = invariant(0.8, 0.3);
        for _ in 0..300 {
            simulation.step(1).expect("a step");
            let (x, v) = phase(&mut simulation);
            let now = invariant(x[0].x, v[0].x);
            // 300 steps of a few roundings.
            assert!((now / first - 1.0).abs() < 1e-13, "{name} at {y}: {now} was {first}");
        }
    }
}

#[test]
fn phases() {
    for y in [0.1f64, 0.5, 1.0] {
        let verlet = 2.0 * (y / 2.0).asin() / y;
        let runge_kutta_2 = y.atan2(1.0 - y * y / 2.0) / y;
        let exact = [
            ("forward_euler", y.atan() / y),
            ("symplectic_euler", verlet),
            ("leapfrog", verlet),
            ("midpoint", runge_kutta_2),
            ("heun", runge_kutta_2),
            ("rk4", (y - y.powi(3) / 6.0).atan2(1.0 - y * y / 2.0 + y.powi(4) / 24.0) / y),
        ];
        for (name, want) in exact {
            let got = frequency(name, y);
            // acos loses 1e-16 / y in the angle, and 1 / y again in the quotient.
            assert!((got - want).abs() < 1e-13, "{name} at {y}: {got}, not {want}");
        }
    }
    // The leading coefficients (Omelyan, Mryglod & Folk 2002 give the methods); what comes behind is a part y² of them.
    for (name, coefficient, digits) in [("forest_ruth", -0.066_144_188_3, 1e-8), ("pefrl", -6.054e-5, 5e-9)] {
        let [coarse, fine] = [0.2f64, 0.1].map(|y| (frequency(name, y) - 1.0) / y.powi(4));
        // Two step sizes take the y² away; y⁴ is left: 0.0004 of about the coefficient.
        let got = (4.0 * fine - coarse) / 3.0;
        let allowed = digits + 2e-3 * f64::abs(coefficient);
        assert!((got - coefficient).abs() < allowed, "{name}: {got:e}, not {coefficient:e}");
    }
}

/// x″ = −ω² x − c x′ with explicit damping is stable while h²ω² + 2hc < 4. Leapfrog's kicks take the velocity of half a
/// step ago, which makes it the same method, half a step apart.
#[test]
fn damping_has_a_limit() {
    for y in [0.5f64, 1.0, 1.9, 1e-3] {
        // hc at the limit.
        let edge = (4.0 - y * y) / 2.0;
        for name in ["symplectic_euler", "leapfrog"] {
            for (factor, stays) in [(0.99, true), (1.01, false)] {
                let h = y / STRENGTH.sqrt();
                let damping = factor * edge / h;
                let mut simulation = cpu(&one(DVec3::X, DVec3::Y), spring(damping), name, h);
                simulation.step(2000).expect("steps");
                let (x, v) = phase(&mut simulation);
                let size = x[0].truncate().length() + v[0].truncate().length() * h;
                assert_eq!(size < 10.0, stays, "{name}, hω = {y}, hc = {factor} of {edge}: {size:e}");
            }
            if name == "symplectic_euler" {
                let below = radius(matrix(name, y, 0.999_999 * edge / (y / STRENGTH.sqrt())));
                let above = radius(matrix(name, y, 1.000_001 * edge / (y / STRENGTH.sqrt())));
                assert!(below < 1.0 && above > 1.0, "{y}: {below}, {above}");
            }
        }
    }
}
