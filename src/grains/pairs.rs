//! Pairs of grains that touch, on the host: for measures, and for checks before a run.

use std::collections::HashMap;

use glam::{DVec3, I64Vec3};

use crate::kernel::Bounds;

/// Two grains that touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    /// Their rows, the lower one first.
    pub grains: [usize; 2],
    /// δ \[length\].
    pub overlap: f64,
}

/// The pairs of spheres that overlap, at their nearest images; spheres for which `is_there` is false are left out. In a periodic box spheres
/// are smaller than a quarter of it.
#[must_use]
pub fn touching(places: &[DVec3], radii: &[f64], bounds: &Bounds, is_there: impl Fn(usize) -> bool) -> Vec<Pair> {
    near(places, radii, 0.0, bounds, is_there)
}

/// The same with pairs that are as far apart as `reach`, relative to the smaller radius: their overlaps are below 0.
#[must_use]
pub fn near(
    places: &[DVec3],
    radii: &[f64],
    reach: f64,
    bounds: &Bounds,
    is_there: impl Fn(usize) -> bool,
) -> Vec<Pair> {
    let largest = radii.iter().copied().fold(0.0, f64::max);
    let count = places.len().min(radii.len());
    if !(largest > 0.0 && largest.is_finite()) {
        return Vec::new();
    }
    // Cells beyond all numbers are one.
    let far = DVec3::splat(1e18);
    let cell = |x: DVec3| (x / ((2.0 + reach) * largest)).floor().clamp(-far, far).as_i64vec3();
    let mut cells: HashMap<I64Vec3, Vec<usize>> = HashMap::new();
    let there: Vec<usize> = (0..count).filter(|i| is_there(*i) && places[*i].is_finite()).collect();
    there.iter().for_each(|i| cells.entry(cell(places[*i])).or_default().push(*i));
    let mut pairs = Vec::new();
    for i in there {
        for image in images(places[i], bounds.period()) {
            let near = (0..27).map(|n| cell(image) + I64Vec3::new(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1));
            for j in near.filter_map(|at| cells.get(&at)).flatten().copied().filter(|j| *j > i) {
                let overlap = radii[i] + radii[j] - (places[j] - image).length();
                if overlap > -reach * radii[i].min(radii[j]) {
                    pairs.push(Pair { grains: [i, j], overlap });
                }
            }
        }
    }
    pairs
}

/// A position, and its images next to the box along periodic axes.
fn images(x: DVec3, period: DVec3) -> Vec<DVec3> {
    (0..3).fold(vec![x], |all, axis| {
        let shift = DVec3::AXES[axis] * period[axis];
        if period[axis] > 0.0 { all.iter().flat_map(|x| [*x, *x - shift, *x + shift]).collect() } else { all }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::Side;

    /// A hundred spheres of several sizes in a box: the pairs are those that all pairs at their nearest images give.
    #[test]
    fn pairs_that_touch_are_all_found() {
        let mut word = 7_u32;
        let mut next = || {
            word = word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(word >> 8) / f64::from(1_u32 << 24)
        };
        let places: Vec<DVec3> = (0..100).map(|_| DVec3::new(next(), next(), next()) * 2.0 - 1.0).collect();
        let radii: Vec<f64> = (0..100).map(|_| 0.1 + 0.1 * next()).collect();
        let open = Bounds::default();
        let periodic = Bounds::new(DVec3::splat(-1.0), DVec3::splat(1.0), Side::Periodic);
        for bounds in [open, periodic] {
            let mut found = touching(&places, &radii, &bounds, |i| i != 13);
            found.sort_by_key(|pair| pair.grains);
            let mut all = Vec::new();
            for i in (0..100).filter(|i| *i != 13) {
                for j in (i + 1..100).filter(|j| *j != 13) {
                    let overlap = radii[i] + radii[j] - bounds.shortest(places[j] - places[i]).length();
                    if overlap > 0.0 {
                        all.push(Pair { grains: [i, j], overlap });
                    }
                }
            }
            assert!(all.len() > 40 && found.len() == all.len(), "{} {}", found.len(), all.len());
            for (a, b) in found.iter().zip(&all) {
                assert!(a.grains == b.grains && (a.overlap - b.overlap).abs() < 1e-12, "{a:?} {b:?}");
            }
        }
    }
}
