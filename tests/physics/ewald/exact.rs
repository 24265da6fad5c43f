//! The field of a unit mass in a periodic cube of side 1 and in the background that makes the mean density nothing, summed
//! in f64 (Ewald 1921; Hernquist, Bouchet & Suto 1991): as exact as f64, and slow.

use std::f64::consts::PI;

use glam::{DVec3, DVec4};

/// The complementary error function, to 1e-15: by its series, and far out by its continued fraction.
pub fn erfc(x: f64) -> f64 {
    let gauss = (-x * x).exp() * 2.0 / PI.sqrt();
    if x < 2.5 {
        let (mut term, mut sum, mut n) = (x, x, 0.0);
        while f64::abs(term) > 1e-18 * f64::abs(sum) {
            n += 1.0;
            term *= 2.0 * x * x / (2.0 * n + 1.0);
            sum += term;
        }
        return 1.0 - gauss * sum;
    }
    let fraction = (1..=60).rev().fold(x, |below, n| x + 0.5 * f64::from(n) / below);
    0.5 * gauss / fraction
}

/// Acceleration and potential at a place, by a splitting: images to ±3, and waves to ±4.
pub fn field(r: DVec3, splitting: f64) -> DVec4 {
    image_field(r, splitting, false)
}

/// The potential of all images at the place of the mass itself, without its own.
pub fn alone(splitting: f64) -> f64 {
    image_field(DVec3::ZERO, splitting, true).w
}

fn image_field(r: DVec3, splitting: f64, without: bool) -> DVec4 {
    let b = splitting;
    let mut field = DVec4::new(0.0, 0.0, 0.0, PI / (b * b));
    let steps = |most: i32| (-most..=most).map(f64::from);
    let all = |most| {
        steps(most).flat_map(move |x| steps(most).flat_map(move |y| steps(most).map(move |z| DVec3::new(x, y, z))))
    };
    for n in all(3) {
        let d = r - n;
        let s = d.length();
        if without && n == DVec3::ZERO {
            // erfc(b s) / s − 1 / s where s is nothing.
            field.w += 2.0 * b / PI.sqrt();
        } else {
            let tail = erfc(b * s);
            let force = (2.0 * b / PI.sqrt() * (-b * b * s * s).exp() + tail / s) / (s * s);
            field -= (force * d).extend(tail / s);
        }
    }
    for k in all(4).filter(|k| *k != DVec3::ZERO) {
        let square = k.length_squared();
        let much = (-PI * PI * square / (b * b)).exp() / (PI * square);
        let (sine, cosine) = (2.0 * PI * k.dot(r)).sin_cos();
        field -= (much * 2.0 * PI * sine * k).extend(much * cosine);
    }
    field
}
