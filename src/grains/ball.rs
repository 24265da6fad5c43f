//! The part of a sphere, or of a disc, that lies within a box.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

/// Places and weights of Gauss's rule with eight points between −1 and 1 (Abramowitz & Stegun 1964, 25.4).
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_3),
];

/// The volume of a sphere \[length³\], or the area of a disc in two dimensions \[length²\].
#[must_use]
pub fn volume(radius: f64, dimensions: u32) -> f64 {
    if dimensions == 2 { PI * radius * radius } else { 4.0 / 3.0 * PI * radius.powi(3) }
}

/// The part of the volume of a sphere around the origin that lies between two corners \[length³\]; in two dimensions that of the area of a
/// disc, and z does not count \[length²\]. It is exact where faces across one axis alone cut the sphere and in two dimensions; otherwise it
/// is an integral over exact areas by Gauss's rule, and off by less than 1e-7 of the sphere.
#[must_use]
pub fn inside(radius: f64, low: DVec3, high: DVec3, dimensions: u32) -> f64 {
    let (low, high) = (low.max(DVec3::splat(-radius)), high.min(DVec3::splat(radius)));
    let axes = if dimensions == 2 { 2 } else { 3 };
    let cuts = |axis: &usize| low[*axis] > -radius || high[*axis] < radius;
    if (0..axes).any(|axis| low[axis] >= high[axis]) || radius <= 0.0 {
        return 0.0;
    }
    if axes == 2 {
        return disc(radius, low.truncate(), high.truncate());
    }
    let cutting: Vec<usize> = (0..3).filter(cuts).collect();
    match cutting[..] {
        [] => volume(radius, 3),
        [axis] => {
            let below = |x: f64| PI * x * (radius * radius - x * x / 3.0);
            below(high[axis]) - below(low[axis])
        }
        _ => layers(radius, low, high),
    }
}

/// The area of a disc around the origin between two corners.
fn disc(radius: f64, low: DVec2, high: DVec2) -> f64 {
    let quarter = |x: f64, y: f64| {
        let [a, b] = [x.abs().min(radius), y.abs().min(radius)];
        let below =
            |x: f64| 0.5 * (x * (radius * radius - x * x).max(0.0).sqrt() + radius * radius * (x / radius).asin());
        let edge = (radius * radius - b * b).max(0.0).sqrt();
        let area = if a <= edge { a * b } else { edge * b + below(a) - below(edge) };
        area * x.signum() * y.signum()
    };
    quarter(high.x, high.y) - quarter(low.x, high.y) - quarter(high.x, low.y) + quarter(low.x, low.y)
}

/// The volume between two corners, layer by layer along z = R sin θ, between the heights at which an edge or a corner enters the sphere.
fn layers(radius: f64, low: DVec3, high: DVec3) -> f64 {
    let [x, y] = [[low.x, high.x], [low.y, high.y]];
    let faces = x.into_iter().chain(y);
    let edges = x.into_iter().flat_map(|x| y.into_iter().map(move |y| x.hypot(y)));
    let heights = faces.chain(edges).map(|d| (radius * radius - d * d).max(0.0).sqrt());
    let mut ends: Vec<f64> = heights.flat_map(|z| [z, -z]).filter(|z| *z > low.z && *z < high.z).collect();
    ends.extend([low.z, high.z]);
    ends.sort_by(f64::total_cmp);
    let angles: Vec<f64> = ends.iter().map(|z| (z / radius).clamp(-1.0, 1.0).asin()).collect();
    // Near an end a layer changes by powers of 3/2, of which t² makes cubes.
    let half = |end: f64, length: f64| {
        let at = |x: f64| {
            let t = 0.5 * (1.0 + x);
            let radius = radius * (end + length * t * t).cos();
            disc(radius, low.truncate(), high.truncate()) * radius * t
        };
        length.abs() * GAUSS.iter().map(|(x, weight)| weight * (at(*x) + at(-*x))).sum::<f64>()
    };
    let between = |ends: &[f64]| {
        let length = 0.5 * (ends[1] - ends[0]);
        half(ends[0], length) + half(ends[1], -length)
    };
    angles.windows(2).map(between).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Parts of a half, a quarter and an eighth; a cap h (3 R − h) π h² / 3; nothing beyond.
    #[test]
    fn simple_parts_are_exact() {
        let (far, whole) = (DVec3::splat(9.0), volume(1.5, 3));
        let zero = DVec3::ZERO;
        for (low, part) in [
            (-far, 1.0),
            (zero.with_x(-9.0).with_y(-9.0), 0.5),
            (zero.with_x(-9.0), 0.25),
            (zero, 0.125),
            (DVec3::new(-9.0, 1.6, -9.0), 0.0),
        ] {
            let got = inside(1.5, low, far, 3);
            assert!((got - part * whole).abs() < 1e-9 * whole, "{low}: {got}");
        }
        let cap = PI * 0.25 * (4.5 - 0.5) / 3.0;
        assert!((inside(1.5, DVec3::new(-9.0, 1.0, -9.0), far, 3) - cap).abs() < 1e-12);
        assert!((inside(1.5, zero, far, 2) - 0.25 * PI * 2.25).abs() < 1e-12);
    }

    /// Cells that fill a box around a sphere hold the whole of it, to 1e-7, wherever they cut it; and a cell holds as many of a fine
    /// lattice of points as its volume says, to 2e-3 of the sphere.
    #[test]
    fn cells_share_a_sphere() {
        let mut word = 5_u32;
        let mut next = || {
            word = word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(word >> 8) / f64::from(1_u32 << 24)
        };
        for _ in 0..40 {
            let radius = 0.5 + next();
            let cut = |u: f64| vec![-2.0, (2.0 * u - 1.0) * radius, (2.0 * u - 0.6) * radius, 2.0];
            let cuts = [cut(next()), cut(next()), cut(next())];
            let mut sum = 0.0;
            let mut worst = 0.0_f64;
            for cell in 0..27_usize {
                let of = |side: usize| {
                    let at = [cell % 3, cell / 3 % 3, cell / 9].map(|k| k + side);
                    DVec3::new(cuts[0][at[0]], cuts[1][at[1]], cuts[2][at[2]])
                };
                let (low, high) = (of(0), of(1));
                let part = inside(radius, low, high, 3);
                sum += part;
                let points = (0..64_000).filter(|n| {
                    let x = [n % 40, n / 40 % 40, n / 1600].map(|k| radius * ((f64::from(k) + 0.5) / 20.0 - 1.0));
                    let x = DVec3::from_array(x);
                    x.length() < radius && x.cmpge(low).all() && x.cmplt(high).all()
                });
                let counted = points.count() as f64 * (radius / 20.0).powi(3);
                worst = worst.max((part - counted).abs() / volume(radius, 3));
            }
            let off = (sum / volume(radius, 3) - 1.0).abs();
            assert!(off < 1e-7, "{radius} {cuts:?}: {off:e}");
            assert!(worst < 2e-2, "{radius} {cuts:?}: {worst}");
        }
    }
}
