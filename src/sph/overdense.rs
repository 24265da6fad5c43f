//! The minimum displacement of an over-dense fluid before it is at rest.

use std::collections::BTreeMap;

use glam::DVec3;

use super::Medium;

/// A particle thinner than that has no neighbours on one side, and makes no room for others.
const SURFACE: f64 = 0.9;
/// The parts of the longest side, at most.
const FINEST: f64 = 65536.0;

/// The minimum displacement of the fastest particle after which none is too dense \[spacings\]; particles are positions, masses and densities.
///
/// Matter of density ρ has the volume m / ρ, and m / ρ₀ at rest: a region lacks the volume Σ m (1/ρ₀ − 1/ρ). This volume leaves through its
/// faces, of area A, whatever happens inside (Gauss): somewhere by Σ / A, or more. The regions are the box around the fluid, and its
/// divisions into 2, 4, 8, … along its longest side and into cubes along the others; faces that are closed by walls only increase the
/// displacement.
pub(super) fn thrust(medium: &Medium, particles: &[(DVec3, f64, f64)]) -> f64 {
    let flat = medium.dimensions == 2;
    let places = || particles.iter().map(|(x, ..)| *x);
    let half = DVec3::splat(0.5 * medium.spacing);
    let low = places().reduce(DVec3::min).unwrap_or_default() - half;
    let size = places().reduce(DVec3::max).unwrap_or_default() + half - low;
    let (mut most, mut parts) = (0.0f64, 1.0);
    while parts <= FINEST && size.max_element() / parts >= medium.range() {
        let mut numbers = (size / size.max_element() * parts).round().max(DVec3::ONE);
        if flat {
            numbers.z = 1.0;
        }
        let side = size / numbers;
        let area =
            if flat { 2.0 * (side.x + side.y) } else { 2.0 * (side.x * side.y + side.y * side.z + side.z * side.x) };
        let mut lacks = BTreeMap::<[u32; 3], f64>::new();
        for (x, mass, density) in particles.iter().filter(|(.., density)| *density > SURFACE * medium.density) {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below the number of parts")]
            let part = ((*x - low) / side).to_array().map(|part| part as u32);
            *lacks.entry(part).or_default() += mass * (1.0 / medium.density - 1.0 / density);
        }
        most = lacks.values().fold(most, |most, lack| most.max(lack / area));
        parts *= 2.0;
    }
    most / medium.spacing
}
