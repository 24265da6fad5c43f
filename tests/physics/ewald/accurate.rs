//! The accuracy that is asked for.

use glam::{DVec3, DVec4};

use crate::ewald::refusals::refused;
use crate::ewald::worlds::{G, SIDE, on_device};
use crate::ewald::{SPLITTING, accurate, cube, exact, exact_sum, softened};
use crate::support::states::{accelerations_in, one};
use crate::support::{self, Random, machines};

/// The accelerations of test masses by a unit mass in a cube of side 1, at such places from it.
fn field(accuracy: f64, places: &[DVec3]) -> Vec<DVec4> {
    softened_field(accuracy, 0.0, places)
}

/// The same, softened.
fn softened_field(accuracy: f64, softening: f64, places: &[DVec3]) -> Vec<DVec4> {
    let bounds = cube(1.0);
    let mut all = one(bounds.low + 0.3, DVec3::ZERO);
    for r in places {
        all.push(all.position()[0] + *r, DVec3::ZERO, 0.0, 0.0);
    }
    accelerations_in(&bounds, &softened(1.0, accuracy, softening, "pairs"), &all, 0.0).split_off(1)
}

/// The published field of a lattice (two splittings that agree to 1e-12), to the accuracy of the reference.
#[test]
fn numbers_of_the_unit_cube_to_ten_digits() {
    let places = [DVec3::X * 0.25, DVec3::new(0.1, 0.2, 0.3), DVec3::splat(0.5), DVec3::X * 0.05];
    let got = field(1e-10, &places);
    // The acceleration towards the mass; half of the potential belongs to each of a pair.
    let known = [
        (got[0].x, -14.753_540_423_540),
        (got[1].x, -1.696_109_091_551),
        (got[1].y, -3.253_569_312_179),
        (got[1].z, -4.428_951_031_968),
        (2.0 * got[1].w, -0.113_009_898_248),
        (got[2].x, 0.0),
        (2.0 * got[2].w, 0.801_935_970_028),
        (got[3].x, -399.789_005_281),
    ];
    for (got, want) in known {
        // Three times the mean error, a position that is rounded to 1e-16 where the force changes by 2 F / r, and the digits of the last number.
        assert!(
            (got - want).abs() < 3e-10 + 1e-14 * want.abs() * 40.0 + 5e-10 * f64::from(want < -300.0),
            "{got} is not {want}"
        );
    }
    let alone = accelerations_in(&cube(1.0), &accurate(1.0, 1e-10, "pairs"), &one(DVec3::splat(0.2), DVec3::ZERO), 0.0);
    assert!((2.0 * alone[0].w - 2.837_297_479_48).abs() < 1e-10, "{}", alone[0].w);
}

/// The error is what was asked for, and no more work is done than that takes.
#[test]
fn the_error_is_the_one_that_is_asked_for() {
    let mut random = Random::new(9);
    let places: Vec<DVec3> = (0..600).map(|_| random.vector() * 0.5).filter(|r| r.length() > 0.1).collect();
    let exact: Vec<DVec4> =
        places.iter().map(|r| exact::field(*r, SPLITTING) * DVec4::new(1.0, 1.0, 1.0, 0.5)).collect();
    for accuracy in [1.4e-4, 3e-5, 1e-6, 3e-8, 1e-9, 1e-10] {
        let errors: Vec<DVec4> = field(accuracy, &places).iter().zip(&exact).map(|(got, want)| *got - *want).collect();
        let square: f64 = errors.iter().map(|e| e.truncate().length_squared()).sum();
        let mean = (square / errors.len() as f64).sqrt();
        let most = errors.iter().map(|e| e.truncate().length()).fold(0.0, f64::max);
        let potential = errors.iter().map(|e| 2.0 * e.w.abs()).fold(0.0, f64::max);
        println!("{accuracy:e}: {mean:e}, at most {most:e}, potential {potential:e}");
        assert!(
            mean < accuracy && most < 5.0 * accuracy && potential < accuracy,
            "{accuracy:e}: {mean:e}, {most:e}, {potential:e}"
        );
        assert!(mean > accuracy / 12.0, "{accuracy:e}: {mean:e} is too good");
    }
}

/// Softening changes the force of the nearest image alone, by what Plummer's law differs from Newton's.
#[test]
fn softening_takes_no_accuracy() {
    let (mut random, softening) = (Random::new(4), 0.01);
    let places = (0..300).map(|_| random.vector() * 0.5).filter(|r| (0.02..0.49).contains(&r.length()));
    let places: Vec<DVec3> = places.collect();
    for (r, got) in places.iter().zip(softened_field(1e-8, softening, &places)) {
        let (s, d) = (r.length_squared() + softening * softening, r.length());
        let more = (-*r * (s.powf(-1.5) - d.powi(-3))).extend(-(s.powf(-0.5) - 1.0 / d));
        let want = (exact::field(*r, SPLITTING) + more) * DVec4::new(1.0, 1.0, 1.0, 0.5);
        assert!((got - want).abs().max_element() < 5e-8, "{r}: {got} is not {want}");
    }
}

/// Sums of two accuracies would need waves of their own each.
#[test]
fn two_accuracies_are_refused() {
    let problem = motes::forces::Problem::new(100, motes::kernel::Machine::HOST).at(&[], cube(1.0));
    let mut plan = motes::kernel::Plan::default();
    let mut add = |accuracy: f64, earlier| {
        let force = accurate(1.0, accuracy, "pairs").swap_remove(0);
        force.stage(motes::forces::Stage::Evaluate { earlier }, &mut plan, &problem).map_err(|error| error.to_string())
    };
    assert_eq!(add(1e-6, 0), Ok(()));
    assert_eq!(add(1e-6, 1), Ok(()));
    let text = add(1e-4, 2).expect_err("another accuracy");
    assert!(text.contains("1e-4") && text.contains("474") && text.contains("the same accuracy"), "{text}");
}

/// On a device, in single precision.
#[test]
fn a_device_is_as_accurate_as_its_words() {
    let shared = support::device();
    for accuracy in [3e-6, 1e-7] {
        let (cloud, got) = on_device(&shared, None, 65, accurate(G, accuracy, "pairs"));
        let want = exact_sum(&cloud, SIDE, G);
        // Errors of the forces of all masses add up at random.
        let unit = G * cloud.mass().iter().map(|m| m * m).sum::<f64>().sqrt() / (SIDE * SIDE);
        let errors = got.iter().zip(&want).map(|(got, want)| (*got - *want).truncate().length() / unit);
        let mean = (errors.map(|error| error * error).sum::<f64>() / got.len() as f64).sqrt();
        // Sines and cosines are right to 1e-6, and waves of a unit mass sum to some ten; forces of near ones, of up to 40 units, are rounded to 1e-7.
        println!("{accuracy:e}: {mean:e}");
        assert!(mean < 2e-5, "{accuracy:e}: {mean:e}");
    }
    // Several particles to a block of the structure factor.
    on_device(&shared, None, 1500, accurate(G, 1e-6, "pairs"));
    if machines::subgroups_of_eight(&shared) {
        on_device(&shared, None, 1500, accurate(G, 1e-6, "tree"));
    }
}

/// Less than doubles hold is refused.
#[test]
fn no_sum_is_more_accurate_than_its_numbers() {
    let force = accurate(1.0, 1e-11, "pairs").swap_remove(0);
    let text = refused(force.as_ref(), cube(1.0)).unwrap_or_default();
    assert!(text.contains("accuracy of 1e-11") && text.contains("1e-10"), "{text}");
}
