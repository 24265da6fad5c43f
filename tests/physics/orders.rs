//! What each integrator is measured to be: its order as a slope, against orbits that are known exactly.

use crate::support::states::{self, cpu, force, one, vector, word};
use glam::DVec3;
use motes::forces::Component;
use motes::integrators::{Entry, INTEGRATORS};
use motes::settings::Value;

/// An ellipse about a centre with GM = 1, from pericentre, a = 1, e = 0.5; the centre moves. Exact, by Kepler's equation.
fn kepler(eccentricity: f64, time: f64) -> (DVec3, DVec3) {
    let e = eccentricity;
    let mut anomaly = time;
    for _ in 0..60 {
        anomaly -= (anomaly - e * anomaly.sin() - time) / (1.0 - e * anomaly.cos());
    }
    let (sin, cos) = anomaly.sin_cos();
    let rate = 1.0 / (1.0 - e * cos);
    let minor = (1.0 - e * e).sqrt();
    (DVec3::new(cos - e, minor * sin, 0.0), DVec3::new(-sin * rate, minor * cos * rate, 0.0))
}

/// The error of the whole phase, so that no single component can pass through zero and fake an order.
fn error(
    forces: Vec<Box<dyn Component>>,
    name: &str,
    start: (DVec3, DVec3),
    end: (DVec3, DVec3),
    time: f64,
    steps: u32,
) -> f64 {
    let mut simulation = cpu(&one(start.0, start.1), forces, name, time / f64::from(steps));
    simulation.step(steps).expect("steps");
    let (x, v) = states::phase(&mut simulation);
    ((x[0].truncate() - end.0).length_squared() + (v[0].truncate() - end.1).length_squared()).sqrt()
}

/// Integrators whose order shows as a slope; an order of 15 is lost in rounding, and has tests of its own.
fn with_a_slope() -> impl Iterator<Item = &'static Entry> {
    INTEGRATORS.iter().filter(|entry| entry.by_default().order() <= 4)
}

/// The slope between two step sizes. The next order of the error bends it by a part of about h: at the steps chosen here
/// by less than a fifth.
fn assert_order(of: &str, order: u32, coarse: f64, fine: f64) {
    let slope = (coarse / fine).log2();
    assert!((slope - f64::from(order)).abs() < 0.2, "{of}: slope {slope:.3} is not {order} ({coarse:e}, {fine:e})");
    assert!(fine > 1e-12, "{of}: {fine:e} is rounding, which has no order");
}

/// So many that an order shows, and so few that rounding does not: errors are about 1e-2 to 1e-9.
fn steps_for(order: u32) -> u32 {
    [0, 8192, 512, 256, 128][order as usize]
}

#[test]
fn orders_with_position_and_time() {
    // Off the period, where errors of a closed orbit do not cancel.
    let time = 2.3;
    for entry in with_a_slope() {
        let order = entry.by_default().order();
        let mut resting = 0.0;
        for speed in [DVec3::ZERO, DVec3::new(0.3, -0.2, 0.5)] {
            // A moving centre: what its position is at a stage depends on the stage's time.
            let centre = || vec![force("attractor", &[("velocity", Value::Vector(speed))])];
            let (start, end) = (kepler(0.5, 0.0), kepler(0.5, time));
            let start = (start.0, start.1 + speed);
            let end = (end.0 + speed * time, end.1 + speed);
            let errors = [1, 2].map(|k| error(centre(), entry.name, start, end, time, k * steps_for(order)));
            assert_order(&format!("{} with a centre that moves by {speed}", entry.name), order, errors[0], errors[1]);
            if speed == DVec3::ZERO {
                resting = errors[1];
            } else {
                // Every consistent method is the same in a frame that moves, but for rounding: 1e-16 in each of 2^14 steps.
                assert!(
                    (errors[1] - resting).abs() < 1e-11 + 1e-6 * resting,
                    "{}: {errors:?}, {resting:e}",
                    entry.name
                );
            }
        }
    }
}

#[test]
fn orders_with_velocity() {
    // v = v₀ exp(−γt), x = x₀ + v₀ (1 − exp(−γt)) / γ
    let (time, rate) = (1.3f64, 0.8);
    let start = (DVec3::new(0.3, -0.4, 0.2), DVec3::new(0.7, 0.5, -0.6));
    let end = (start.0 + start.1 * (1.0 - (-rate * time).exp()) / rate, start.1 * (-rate * time).exp());
    for entry in with_a_slope() {
        let order = entry.by_default().order_with_velocity();
        let drag = || vec![force("drag", &[("linear", Value::Number(rate))])];
        let steps = [0, 512, 128, 64, 32][order as usize];
        let errors = [steps, 2 * steps].map(|n| error(drag(), entry.name, start, end, time, n));
        assert_order(entry.name, order, errors[0], errors[1]);
    }
}

#[test]
fn orders_with_velocity_and_time() {
    // Gusts and quadratic drag: no closed form, so the reference is the method of order 4 with steps 16 times finer.
    let gusts = || -> Vec<Box<dyn Component>> {
        vec![
            force(
                "wind",
                &[
                    ("velocity", vector(0.6, 0.2, -0.3)),
                    ("gust", Value::Number(0.7)),
                    ("period", Value::Number(0.9)),
                    ("wavelength", Value::Number(2.3)),
                ],
            ),
            force("drag", &[("quadratic", Value::Number(0.4))]),
        ]
    };
    let (time, start) = (1.3, (DVec3::new(0.3, -0.4, 0.2), DVec3::new(0.7, 0.5, -0.6)));
    let mut fine = cpu(&one(start.0, start.1), gusts(), "rk4", time / 2048.0);
    fine.step(2048).expect("steps");
    let (x, v) = states::phase(&mut fine);
    let end = (x[0].truncate(), v[0].truncate());
    for entry in with_a_slope() {
        let order = entry.by_default().order_with_velocity();
        let steps = [0, 1024, 128, 64, 64][order as usize];
        let errors = [steps, 2 * steps].map(|n| error(gusts(), entry.name, start, end, time, n));
        assert_order(entry.name, order, errors[0], errors[1]);
    }
}

/// What happens on a circle and an ellipse about GM = 1, in n steps for an orbit, by the textbook formulas in f64: the
/// distance from the exact place after one orbit and after ten, and the largest relative error of the energy until then.
/// Computed by an independent program (plain Python, checked by a second one), and given to the digits that both share.
struct Row {
    eccentricity: f64,
    name: &'static str,
    orbit: [f64; 2],
    ten: [f64; 2],
}

#[expect(clippy::unreadable_literal, reason = "as it was printed")]
const TABLE: &[Row] = &[
    Row {
        eccentricity: 0.0,
        name: "forward_euler",
        orbit: [3.585324e-1, 6.836036e-2],
        ten: [6.186605e-1, 3.328089e-1],
    },
    Row {
        eccentricity: 0.0,
        name: "symplectic_euler",
        orbit: [1.757028e-4, 3.947881e-5],
        ten: [1.757027e-3, 3.947881e-5],
    },
    Row { eccentricity: 0.0, name: "leapfrog", orbit: [8.268216e-5, 3.896189e-10], ten: [8.268216e-4, 3.896189e-10] },
    Row { eccentricity: 0.0, name: "midpoint", orbit: [1.455951e-4, 1.947878e-7], ten: [1.538561e-3, 1.947866e-6] },
    Row { eccentricity: 0.0, name: "heun", orbit: [3.343661e-4, 7.790861e-7], ten: [3.674054e-3, 7.790669e-6] },
    Row { eccentricity: 0.0, name: "rk4", orbit: [2.324649e-10, 1.7106e-12], ten: [3.049354e-9, 1.709e-11] },
    Row { eccentricity: 0.5, name: "forward_euler", orbit: [1.193491, 9.509909e-2], ten: [1.357662, 5.818698e-1] },
    Row {
        eccentricity: 0.5,
        name: "symplectic_euler",
        orbit: [4.348412e-3, 9.078130e-3],
        ten: [4.345892e-2, 9.078171e-3],
    },
    Row { eccentricity: 0.5, name: "leapfrog", orbit: [1.769537e-3, 1.073000e-4], ten: [1.769426e-2, 1.073000e-4] },
    Row { eccentricity: 0.5, name: "midpoint", orbit: [1.891219e-3, 1.272764e-4], ten: [1.401449e-2, 1.272764e-4] },
    Row { eccentricity: 0.5, name: "heun", orbit: [4.620506e-3, 2.686187e-4], ten: [5.709841e-2, 4.024103e-4] },
    Row { eccentricity: 0.5, name: "rk4", orbit: [3.154058e-8, 1.945338e-9], ten: [5.335586e-7, 4.618100e-9] },
];

#[test]
fn kepler_orbits_as_tabulated() {
    for row in TABLE {
        let start = kepler(row.eccentricity, 0.0);
        let forces = vec![force("attractor", &[("profile", word("point"))])];
        let mut simulation = cpu(&one(start.0, start.1), forces, row.name, std::f64::consts::TAU / 1000.0);
        let mut worst = 0.0f64;
        for step in 1..=10_000 {
            simulation.step(1).expect("a step");
            let (x, v) = states::phase(&mut simulation);
            let (x, v) = (x[0].truncate(), v[0].truncate());
            // E = −1 / 2a at the start.
            worst = worst.max((0.5 * v.length_squared() - 1.0 / x.length() + 0.5).abs() / 0.5);
            let want = match step {
                1_000 => row.orbit,
                10_000 => row.ten,
                _ => continue,
            };
            let got = [x.distance(start.0), worst];
            for (got, want) in got.into_iter().zip(want) {
                // Seven digits are given; rounding adds 1e-16 in each step, and the phase multiplies it by the steps.
                let allowed = 2e-6 * want + 3e-12 * (f64::from(step) / 1e4).powi(2) + 2e-14;
                assert!((got - want).abs() < allowed, "{} e={} {step}: {got:e}, {want:e}", row.name, row.eccentricity);
            }
        }
    }
}
