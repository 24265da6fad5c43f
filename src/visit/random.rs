//! Counter-based random numbers: the reference of `shaders/law/random.wgsl`, word by word.

/// Four random words for a counter (pcg4d; Jarzynski & Olano, Journal of Computer Graphics Techniques 9(3), 2020). Laws use id, step and
/// seed as the counter, so that there is no state and the order of particles does not matter.
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

/// A word as a number in [0, 1); exact in f32.
#[must_use]
pub fn fraction(word: u32) -> f64 {
    f64::from(word >> 8) / 16_777_216.0
}

/// The two words of a seed.
#[must_use]
pub fn words(seed: u64) -> [u32; 2] {
    #[expect(clippy::cast_possible_truncation, reason = "the lower half")]
    let low = seed as u32;
    [low, u32::try_from(seed >> 32).unwrap_or(u32::MAX)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_those_of_the_paper() {
        // Its formula, by an independent program.
        assert_eq!(pcg4d([0, 0, 0, 0]), [0x0f02_f829, 0x2d56_8769, 0x32b0_c43b, 0xd325_48ea]);
        assert_eq!(pcg4d([1, 2, 3, 4]), [0x3622_cd16, 0xf114_71d8, 0xe110_9b3f, 0x02b9_4c2f]);
        assert_eq!(pcg4d([u32::MAX, 7, 1 << 31, 12345]), [0xef91_5379, 0xd05f_9fcb, 0x52c5_ef09, 0xeadb_4cc0]);
        assert_eq!(words(0x0012_3456_89ab_cdef), [0x89ab_cdef, 0x0012_3456]);
        assert!((fraction(1 << 31) - 0.5).abs() < 1e-15 && fraction(0).abs() < 1e-15 && fraction(u32::MAX) < 1.0);
    }

    /// Neighbouring counters give uncorrelated numbers.
    #[test]
    fn neighbours_are_strangers() {
        const COUNT: u32 = 1 << 16;
        let number = |counter, place: usize| fraction(pcg4d(counter)[place]) - 0.5;
        // Of n products of two numbers of variance 1/12: a standard deviation of 1 / 12 √n; four of them.
        let allowed = 4.0 / 12.0 / f64::from(COUNT).sqrt();
        for place in 0..4 {
            let mean = |other: &dyn Fn(u32) -> f64| {
                (0..COUNT).map(|i| number([i, 5, 1, 0], place) * other(i)).sum::<f64>() / f64::from(COUNT)
            };
            assert!((mean(&|i| number([i, 5, 1, 0], place)) - 1.0 / 12.0).abs() < allowed, "variance");
            assert!(mean(&|_| 1.0).abs() < 4.0 / 12f64.sqrt() / f64::from(COUNT).sqrt(), "mean");
            for (what, step) in
                [("id", [1, 0, 0, 0]), ("step", [0, 1, 0, 0]), ("seed", [0, 0, 1, 0]), ("seed", [0, 0, 0, 1])]
            {
                let next = |i: u32| [i + step[0], 5 + step[1], 1 + step[2], step[3]];
                for other in 0..4 {
                    let c = mean(&|i| number(next(i), other));
                    assert!(c.abs() < allowed, "words {place} and {other} of the next {what}: {c:e} of {allowed:e}");
                }
            }
        }
    }
}
