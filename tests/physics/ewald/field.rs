//! The field of one mass.

use glam::{DVec3, DVec4};
use motes::State;

use crate::ewald::{MOST, SPLITTING, cube, exact, exact_sum, gravity, scattered};
use crate::support::Random;
use crate::support::states::{accelerations_in, one};

/// Computed with two splittings by another program. Signs and the origin of the potential are those of a mean of nothing.
#[test]
fn numbers_of_the_unit_cube() {
    let at = |x: f64, y: f64, z: f64| exact::field(DVec3::new(x, y, z), SPLITTING);
    let known = [
        (at(0.25, 0.0, 0.0).truncate(), DVec3::new(-14.753_540_423_540, 0.0, 0.0)),
        (at(0.1, 0.2, 0.3).truncate(), DVec3::new(-1.696_109_091_551, -3.253_569_312_179, -4.428_951_031_968)),
        (at(0.5, 0.5, 0.5).truncate(), DVec3::ZERO),
        (at(0.05, 0.0, 0.0).truncate(), DVec3::new(-399.789_005_281, 0.0, 0.0)),
        (DVec3::X * at(0.1, 0.2, 0.3).w, DVec3::X * -0.113_009_898_248),
        (DVec3::X * at(0.5, 0.5, 0.5).w, DVec3::X * 0.801_935_970_028),
        (DVec3::X * exact::alone(SPLITTING), DVec3::X * 2.837_297_479_48),
    ];
    for (got, want) in known {
        // To the last digit that is printed; the fourth has nine.
        assert!((got - want).abs().max_element() < 1e-11 + 1e-12 * want.length(), "{got} is not {want}");
    }
}

#[test]
fn two_splittings_agree() {
    let mut random = Random::new(5);
    for _ in 0..40 {
        let r = random.vector() * 0.5;
        let (a, b) = (exact::field(r, 2.0), exact::field(r, SPLITTING));
        // The least splitting leaves erfc(2 · 3.5) of the images that are not summed, the largest exp(−π² 25 / 2.4²) of the
        // waves: nothing; what is left is rounding.
        assert!((a - b).abs().max_element() < 1e-12 * a.abs().max_element().max(1.0), "{a} is not {b}");
    }
}

/// The acceleration by a second mass, in a cube of side 1: that of the first of unit mass.
fn acceleration(r: DVec3, light: f64) -> DVec4 {
    let bounds = cube(1.0);
    let mut two = one(bounds.low + 0.3, DVec3::ZERO);
    two.push(two.position()[0] + r, DVec3::ZERO, light, 0.0);
    accelerations_in(&bounds, &gravity(1.0, 0.0, "pairs"), &two, 0.0)[1]
}

/// All over the cube, to the corners, the law and its waves are the exact sum but for the waves that are left out.
#[test]
fn the_waves_that_are_left_out_are_few() {
    let mut random = Random::new(9);
    let places = (0..1500).map(|i| {
        let r = random.vector() * 0.5;
        // Some on the diagonal, on an axis, on a face.
        [r, DVec3::splat(r.x), DVec3::X * r.x, r.with_y(0.5)][i % 4]
    });
    let (mut square, mut most, mut potential) = (0.0, 0.0_f64, 0.0_f64);
    let mut count = 0.0;
    for (i, r) in places.enumerate() {
        let error = acceleration(r, 0.0) - exact::field(r, SPLITTING) * DVec4::new(1.0, 1.0, 1.0, 0.5);
        if i % 4 == 0 {
            square += error.truncate().length_squared();
            count += 1.0;
        }
        most = most.max(error.truncate().length());
        potential = potential.max(2.0 * error.w.abs());
    }
    let mean = f64::sqrt(square / count);
    assert!(
        mean < 1.8e-4 && most < MOST && potential < 2.1e-5,
        "{mean:e} in the mean, {most:e} at most, {potential:e}"
    );
    // It is the fit that does this, and not more waves than are there.
    assert!(most > 1e-4, "{most:e}: say how good it is");
}

/// The energy of a mass alone is that of its images.
#[test]
fn a_mass_alone_has_the_energy_of_its_images() {
    for (side, mass, g) in [(1.0, 1.0, 1.0), (3.7, 2.3, 0.7)] {
        let mut alone = one(DVec3::splat(0.2), DVec3::ZERO);
        alone.mass_mut()[0] = mass;
        let a = accelerations_in(&cube(side), &gravity(g, 0.0, "pairs"), &alone, 0.0)[0];
        let want = 0.5 * exact::alone(SPLITTING) * g * mass / side;
        assert!((a.w - want).abs() < 1e-5 * want, "{} is not {want}", a.w);
        assert!(a.truncate().length() < 1e-14 * want, "it pulls itself: {a}");
    }
}

/// A cloud by the references, in a cube of another side, in another place, unwrapped.
#[test]
fn a_cloud_is_the_exact_sum() {
    let (side, g) = (3.5, 0.8);
    let bounds = cube(side);
    let mut cloud = scattered(12, &bounds, 3);
    let want = exact_sum(&cloud, side, g);
    for (i, x) in cloud.position_mut().iter_mut().enumerate() {
        *x += side * DVec3::new([0.0, 1.0, -2.0][i % 3], 0.0, (i / 6) as f64);
    }
    let got = accelerations_in(&bounds, &gravity(g, 0.0, "pairs"), &cloud, 0.0);
    let mass: f64 = cloud.mass().iter().sum();
    for (got, want) in got.iter().zip(&want) {
        let error = (*got - *want).truncate().length();
        assert!(error < MOST * g * mass / (side * side), "{got} is not {want}");
        assert!((got.w - want.w).abs() < 2e-5 * g * mass / side, "{got} is not {want}");
    }
    let net: DVec3 = got.iter().zip(cloud.mass()).map(|(a, m)| *m * a.truncate()).sum();
    // 12 sums of 137 terms.
    let size: f64 = got.iter().zip(cloud.mass()).map(|(a, m)| m * a.truncate().length()).sum();
    assert!(net.length() < 1e-13 * size, "it pulls itself along by {net}");
}

/// F = −∇U, softened or not, with images and waves.
#[test]
fn it_is_a_gradient() {
    let bounds = cube(2.0);
    for softening in [0.0, 0.23] {
        let force = gravity(0.9, softening, "pairs");
        let cloud = scattered(7, &bounds, 12);
        let potential = |particles: &State| -> f64 {
            accelerations_in(&bounds, &force, particles, 0.0).iter().zip(particles.mass()).map(|(a, m)| a.w * m).sum()
        };
        for (id, a) in accelerations_in(&bounds, &force, &cloud, 0.0).iter().enumerate() {
            for axis in 0..3 {
                let h = 1e-5;
                let at = |way: f64| {
                    let mut there = cloud.clone();
                    there.position_mut()[id][axis] += way;
                    potential(&there)
                };
                let (want, got) = (-(at(h) - at(-h)) / (2.0 * h), cloud.mass()[id] * a[axis]);
                // Rounding, 1e-16 U / h, tenfold; and h² F″ / 6 with F″ up to 12 F / r², r = 0.2.
                assert!((got - want).abs() < 1e-10 + 1e-7 * got.abs(), "{id}, {axis}: {got} is not {want}");
            }
        }
    }
}
