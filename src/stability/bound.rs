//! An upper bound of a network's stiffness: the disks of Gershgorin (1931) about the blocks of M^(−1/2) K M^(−1/2).

use crate::links::Link;

/// The particle whose springs weigh most upon it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Row {
    /// The bound: of ω² \[1 / time²\] or of c \[1 / time\].
    pub sum: f64,
    /// The particle.
    pub particle: u32,
    /// The one of its springs with the largest contribution, by its index in the list.
    pub spring: usize,
}

/// Bounds of a network of springs: no mode of it swings faster, and none is damped more.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Bound {
    /// ω² ≤ maxᵢ Σⱼ k (1 / mᵢ + 1 / √(mᵢ mⱼ))
    pub stiffness: Row,
    /// The same with the springs' damping.
    pub damping: Row,
}

impl Bound {
    /// Of springs between particles of these masses; fixed particles are infinitely heavy ([`f64::INFINITY`]), and so has no row.
    /// Springs with an end that is not in the list of masses count for nothing.
    #[must_use]
    pub fn of(springs: &[Link], masses: &[f64]) -> Self {
        let weight = |mine: f64, other: f64| 1.0 / mine + 1.0 / (mine * other).sqrt();
        let row = |value: fn(&Link) -> f64| {
            let mut sums = vec![(0.0, 0, 0.0); masses.len()];
            for (place, spring) in springs.iter().enumerate() {
                let [i, j] = spring.ends.map(|id| id as usize);
                let (Some(a), Some(b)) = (masses.get(i), masses.get(j)) else { continue };
                for (own, part) in [(i, value(spring) * weight(*a, *b)), (j, value(spring) * weight(*b, *a))] {
                    let (sum, stiffest, most) = &mut sums[own];
                    *sum += part;
                    if part > *most {
                        (*stiffest, *most) = (place, part);
                    }
                }
            }
            let mut worst = Row::default();
            for ((sum, spring, _), particle) in sums.into_iter().zip(0..) {
                if sum > worst.sum {
                    worst = Row { sum, particle, spring };
                }
            }
            worst
        };
        Self { stiffness: row(|s| s.stiffness), damping: row(|s| s.damping) }
    }
}
