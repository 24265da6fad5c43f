//! The distance of a fluid at rest from its wall.

use super::Smoothing;

/// The distance of the first layer of a fluid's lattice from the first of `layers` layers of walls \[spacings\] at which it has its rest
/// density: flat layers, sampled on the same lattice, of particles with the mass of the fluid that they replace (Akinci et al. 2012). By
/// bisection on the sum over the lattice. One layer is accurate only for a support of two spacings, where it is out of range of the second
/// layer of the fluid: for wider supports the error is smaller with as many layers as the support has spacings (after Adami, Hu & Adams
/// 2012).
#[must_use]
pub fn gap(smoothing: Smoothing, support: f64, layers: u32, dimensions: u32) -> f64 {
    let reach = whole(support.ceil());
    // The contribution of a layer at this distance, without the constant of the kernel, which is common to all.
    let layer = |height: f64| {
        let mut sum = 0.0;
        for x in -reach..=reach {
            for y in (-reach..=reach).filter(|y| dimensions != 2 || *y == 0) {
                let square = f64::from(x * x + y * y) + height * height;
                sum += smoothing.profile(square.sqrt() / support);
            }
        }
        sum
    };
    let layers = i32::try_from(layers.max(1)).unwrap_or(i32::MAX).min(reach + 1);
    let lattice: f64 = (-reach..=reach).map(|k| layer(f64::from(k))).sum();
    let fluid: f64 = (0..=reach).map(|k| layer(f64::from(k))).sum();
    // The number densities of walls, layer by layer, whose inverses are the volumes.
    let densities: Vec<f64> = (0..layers).map(|k| (0..layers).map(|j| layer(f64::from(k - j))).sum()).collect();
    let walls = |gap: f64| {
        let of = |(k, density): (i32, &f64)| lattice / density * layer(gap + f64::from(k));
        (0..layers).zip(&densities).map(of).sum::<f64>()
    };
    let (mut near, mut far) = (0.0, support);
    // Each halves the interval: to the last digit.
    for _ in 0..60 {
        let middle = 0.5 * (near + far);
        if fluid + walls(middle) > lattice { near = middle } else { far = middle }
    }
    0.5 * (near + far)
}

#[expect(clippy::cast_possible_truncation, reason = "supports are a few spacings; what is more saturates")]
fn whole(x: f64) -> i32 {
    x.clamp(1.0, 64.0) as i32
}
