//! How far a fluid that is too dense must move, until it is at rest.

use std::collections::BTreeMap;

use glam::DVec3;

use super::Medium;

/// A particle thinner than that has no neighbours on one side, and makes no room for others.
const SURFACE: f64 = 0.9;
/// The parts of the longest side, at most.
const FINEST: f64 = 65536.0;

/// How far the fastest particle must move, at least, so that none is too dense any more \[spacings\]; particles are places, masses and densities.
///
/// What is at a density ρ takes the volume m / ρ, and m / ρ₀ at rest: in a part of space the fluid lacks Σ m (1/ρ₀ − 1/ρ). That much
/// leaves by the part's faces, of an area A, whatever happens inside (Gauss): somewhere by Σ / A, or more. Parts are the box around
/// the fluid, and what comes of dividing it into 2, 4, 8, … along its longest side and as many as make cubes along the others; what
/// walls close of their faces only makes the way longer.
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
