//! Two rods: the double pendulum, which is chaotic, and known to many digits for a while.

use crate::support::states::phase;
use motes::integrators::INTEGRATORS;

use crate::rods::{angles, device, extrapolated, forces, pendulum, read, references, state, stretch};

/// Both at 90° at rest, g = 9.81, masses and lengths 1: θ₁, θ₂, θ₁′, θ₂′. By a Taylor series of 24 digits, and (the last row)
/// by a Runge–Kutta method of order 8 with tolerance 1e-13, which agrees with it elsewhere.
#[expect(clippy::unreadable_literal, reason = "as it was computed")]
const TABLE: [(u32, [f64; 4]); 3] = [
    (1, [-0.6250876998063906, -1.034585085680012, -3.922279572887977, -1.303099248696331]),
    (2, [-0.4829715342517544, -1.324048712302363, 3.065288192073401, 2.949271547571619]),
    (5, [-0.62718670507, -1.30131555021, 2.12540867384, 3.88188872726]),
];

fn right() -> motes::State {
    pendulum(&[90.0, 90.0].map(f64::to_radians))
}

#[test]
fn it_is_where_it_should_be() {
    let shared = crate::support::device();
    for (time, want) in TABLE {
        let flat = |rows: &[[f64; 2]]| [rows[0][0], rows[1][0], rows[0][1], rows[1][1]];
        let (x, v) = extrapolated(&right(), f64::from(time), time * 800);
        let got = flat(&angles(&x, &v));
        for (got, want) in got.into_iter().zip(want) {
            // h⁶ times the seventh derivatives, which are about 20⁷; at the end an error of before has grown tenfold.
            assert!((got - want).abs() < 2e-8, "after {time}: {got}, not {want}: {:e}", got - want);
        }

        let (steps, dt) = (time * 1000, 1e-3);
        let (x, v) = state(&right(), "leapfrog", f64::from(time), steps);
        let reference = flat(&angles(&x, &v));
        let mut simulation = device(&shared, &right(), forces(), "leapfrog", dt);
        simulation.step(steps).expect("steps");
        let (x, v) = read(&mut simulation);
        let got = flat(&angles(&x, &v));
        for ((got, reference), want) in got.into_iter().zip(reference).zip(want) {
            // 6e-8 in each of n steps, added up at random and in phase: n √n times that less a few; and thirteenfold by t = 5.
            assert!((got - reference).abs() < 5e-4, "after {time}: {got} on the device, {reference} by the references");
            // What the method leaves is h² times numbers of about 100.
            assert!((got - want).abs() < 2e-3, "after {time}: {got}, not {want}");
        }
        assert!(stretch(&right(), &x) < 3e-7);
    }
}

#[test]
fn with_rods_no_method_is_of_more_than_order_2() {
    let time = 0.9;
    let exact = extrapolated(&right(), time, 2000);
    for entry in INTEGRATORS {
        let order = entry.by_default().order().min(2);
        let error = |steps| {
            let (x, v) = state(&right(), entry.name, time, steps);
            let parts = x.iter().zip(&exact.0).chain(v.iter().zip(&exact.1));
            parts.map(|(a, b)| (*a - *b).truncate().length_squared()).sum::<f64>().sqrt()
        };
        let steps = if order == 1 { 4000 } else { 400 };
        let errors = [steps, 2 * steps].map(error);
        let slope = (errors[0] / errors[1]).log2();
        // The next order bends it by a part of h times the rates, 1e-2, of a few.
        assert!((slope - f64::from(order)).abs() < 0.15, "{}: slope {slope} is not {order}: {errors:?}", entry.name);
    }
}

#[test]
fn there_and_back() {
    let shared = crate::support::device();
    let start = right();
    let steps = 600;
    for name in ["leapfrog", "forest_ruth", "pefrl"] {
        let mut simulation = references(&start, forces(), name, 1e-3);
        simulation.step(steps).expect("steps");
        let (x, v) = phase(&mut simulation);
        assert!(x[2].truncate().distance(start.position()[2]) > 0.5, "{name}: {x:?} is no way away");
        let mut back = start.clone();
        back.position_mut().copy_from_slice(&x.iter().map(|x| x.truncate()).collect::<Vec<_>>());
        back.velocity_mut().copy_from_slice(&v.iter().map(|v| -v.truncate()).collect::<Vec<_>>());
        let mut simulation = references(&back, forces(), name, 1e-3);
        simulation.step(steps).expect("steps");
        let (x, _) = phase(&mut simulation);
        // Lengths are exact to rounding, and 1200 roundings of speeds, 1e-15 each, go 0.6 far.
        let error = (0..3).map(|i| x[i].truncate().distance(start.position()[i])).fold(0.0, f64::max);
        assert!(error < 1e-11, "{name}: {error:e} from where it began");
    }
    let mut simulation = device(&shared, &start, forces(), "leapfrog", 1e-3);
    simulation.step(steps).expect("steps");
    let velocity = pollster::block_on(simulation.read(motes::VELOCITY)).expect("velocities");
    let flipped: Vec<_> = velocity.iter().map(|v| *v * glam::Vec4::new(-1.0, -1.0, -1.0, 1.0)).collect();
    simulation.write(motes::VELOCITY, &flipped).expect("velocities");
    simulation.step(steps).expect("steps");
    let (x, _) = read(&mut simulation);
    let error = (0..3).map(|i| x[i].truncate().distance(start.position()[i])).fold(0.0, f64::max);
    // 1200 roundings of places and speeds, 6e-8 and a few of them each, and three times more on the way.
    assert!(error < 1e-4, "{error:e} from where it began, in f32");
}
