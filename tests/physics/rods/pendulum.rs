//! One rod: the mathematical pendulum, whose swing is an elliptic function.

use crate::rods::{G, angles, device, extrapolated, forces, pendulum, read, state};

/// 2 K(sin² θ₀/2) / π = T / T₀, for T₀ = 2π √(L / g), to 15 digits.
const PERIODS: [(f64, f64); 4] = [
    (5.0, 1.000_476_172_485_987),
    (45.0, 1.039_973_343_196_804),
    (90.0, 1.180_340_599_016_096),
    (170.0, 2.439_362_719_673_884),
];

#[test]
fn its_period_is_the_elliptic_integral() {
    let shared = crate::support::device();
    for (degrees, ratio) in PERIODS {
        let start = pendulum(&[f64::to_radians(degrees)]);
        let period = ratio * std::f64::consts::TAU / G.sqrt();
        // After a quarter of a period, and a whole one more, it passes the lowest place.
        let time = 1.25 * period;
        let (x, v) = extrapolated(&start, time, 1000);
        let [angle, rate] = angles(&x, &v)[0];
        // h = time / 1000 is 3e-3 to 6e-3 in units of 1 / ω; the sixth power of that, times numbers of the series.
        assert!((angle / rate / period).abs() < 1e-10, "{degrees}: {:e} of a period late", angle / rate / period);
        assert!((rate.abs() - (2.0 * G * (1.0 - degrees.to_radians().cos())).sqrt()).abs() < 1e-9, "{rate}");

        // f32: what 1000 steps round away, next to what the references do in the same steps.
        let steps = 1000;
        let (x, v) = state(&start, "leapfrog", time, steps);
        let mut simulation = device(&shared, &start, forces(), "leapfrog", time / f64::from(steps));
        simulation.step(steps).expect("steps");
        let (want, (x, v)) = (angles(&x, &v)[0], read(&mut simulation));
        let got = angles(&x, &v)[0];
        // 6e-8 in each step, in places and (times h) speeds, which grow with the steps while the phase does; near the top
        // a fall begins e^(ωt) times as far away.
        let allowed = if degrees < 100.0 { 2e-5 } else { 4e-4 };
        assert!((got[0] - want[0]).abs() < allowed, "{degrees}: {got:?} is not {want:?}");
        let late = got[0] / got[1] / period;
        assert!(late.abs() < 1e-4, "{degrees}: {late:e} of a period late");
    }
}

/// θ(t) = 2 asin(k cd(t √(g / L), k)) with k = sin θ₀/2.
#[expect(clippy::unreadable_literal, reason = "as it was computed, to 15 digits")]
const SWINGS: [(f64, f64, f64); 6] = [
    (90.0, 0.5, 0.401770849808083),
    (90.0, 1.0, -1.40502731152480),
    (90.0, 2.0, 0.916647589663245),
    (90.0, 5.0, 1.22945181138540),
    (45.0, 1.0, -0.778953892885151),
    (170.0, 1.0, 1.29238031352646),
];

#[test]
fn it_is_where_it_should_be() {
    for (degrees, time, want) in SWINGS {
        let (x, v) = extrapolated(&pendulum(&[f64::to_radians(degrees)]), time, 1000);
        let got = angles(&x, &v)[0][0];
        // The last digit that is given, and h⁶ = (5 / 1000 · ω)⁶ = 1e-11 for the longest.
        assert!((got - want).abs() < 1e-10, "{degrees} after {time}: {got}, not {want}: {:e}", got - want);
    }
}
