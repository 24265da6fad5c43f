//! Random numbers by counting: the twin of `shaders/law/random.wgsl`, word by word.

/// Four random words for a counter (pcg4d; Jarzynski & Olano, Journal of Computer Graphics Techniques 9(3), 2020). Laws
/// count with id, step and seed, so that nothing is kept from step to step and no order of particles matters.
#[must_use]
pub fn pcg4d(counter: [u32; 4]) -> [u32; 4] {
    let v = counter.map(|word| word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    mixed(mixed(v).map(|word| word ^ word >> 16))
}

fn mixed([mut x, mut y, mut z, mut w]: [u32; 4]) -> [u32; 4] {
    x = x.wrapping_add(y.wrapping_mul(w));
    y = y.wrapping_add(z.wrapping_mul(x));
    z = z.wrapping_add(x.wrapping_mul(y));
    w = w.wrapping_add(y.wrapping_mul(z));
    [x, y, z, w]
}

/// A word as a number between 0 and 1, never either; f32 holds it.
#[must_use]
pub fn fraction(word: u32) -> f64 {
    (f64::from(word >> 9) + 0.5) / 8_388_608.0
}

/// The two words of a seed.
#[must_use]
pub fn words(seed: u64) -> [u32; 2] {
    #[expect(clippy::cast_possible_truncation, reason = "the lower half")]
    let low = seed as u32;
    [low, u32::try_from(seed >> 32).unwrap_or(u32::MAX)]
}
