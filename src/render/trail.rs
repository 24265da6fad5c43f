//! The past positions of a few particles.

use glam::{DVec3, DVec4};

use super::camera::FEW;

/// Past positions of up to 64 particles; with more, nothing is stored. It can be pushed at any rate: when it is full, every second moment
/// is dropped, and from then on every second push.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Trail {
    count: usize,
    stride: u64,
    pushes: u64,
    points: Vec<DVec3>,
}

/// Moments that are kept, at most.
const MOMENTS: usize = 2048;

impl Trail {
    /// For `count` particles.
    #[must_use]
    pub fn new(count: usize) -> Self {
        Self { count, stride: 1, pushes: 0, points: Vec::new() }
    }
    /// Whether it keeps anything: else there is no need to read positions for it.
    #[must_use]
    pub fn wanted(&self) -> bool {
        (1..=FEW).contains(&self.count)
    }
    /// Adds a moment: the position of every particle.
    pub fn push(&mut self, positions: &[DVec3]) {
        if !self.wanted() || positions.len() != self.count {
            return;
        }
        if self.pushes.is_multiple_of(self.stride) {
            if self.points.len() >= MOMENTS * self.count {
                let kept: Vec<DVec3> = self.points.chunks(self.count).step_by(2).flatten().copied().collect();
                self.points = kept;
                self.stride *= 2;
            }
            if self.pushes.is_multiple_of(self.stride) {
                self.points.extend_from_slice(positions);
            }
        }
        self.pushes += 1;
    }
    /// Moments kept.
    #[must_use]
    pub fn moments(&self) -> usize {
        self.points.len() / self.count.max(1)
    }
    /// The number of pushes.
    #[must_use]
    pub fn pushes(&self) -> u64 {
        self.pushes
    }
    /// The trail as it was after `pushes` pushes.
    #[must_use]
    pub fn until(&self, pushes: u64) -> Self {
        let moments = usize::try_from(pushes.div_ceil(self.stride.max(1))).unwrap_or(usize::MAX).min(self.moments());
        let points = self.points[..moments * self.count].to_vec();
        Self { points, pushes: pushes.min(self.pushes), count: self.count, stride: self.stride }
    }
    /// All that it holds, in numbers, of which [`Trail::of`] makes it again: how far apart kept moments are, how often it was pushed, and
    /// the points.
    #[must_use]
    pub fn numbers(&self) -> Vec<f64> {
        let points = self.points.iter().flat_map(DVec3::to_array);
        [self.stride as f64, self.pushes as f64].into_iter().chain(points).collect()
    }
    /// The trail of `count` particles with these numbers, if they are valid.
    #[must_use]
    pub fn of(count: usize, numbers: &[f64]) -> Option<Self> {
        let (head, points) = numbers.split_at_checked(2)?;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "counts, or saturated")]
        let (stride, pushes) = (head[0] as u64, head[1] as u64);
        let whole = stride > 0 && points.len().is_multiple_of(3 * count.max(1));
        let points = points.chunks_exact(3).map(DVec3::from_slice).collect();
        whole.then_some(Self { count, stride, pushes, points })
    }
    /// All points: all particles at the first moment, at the second, and so on.
    pub fn points(&self) -> impl Iterator<Item = DVec3> {
        self.points.iter().copied()
    }
    /// The same for the device.
    pub(super) fn array(&self) -> Vec<DVec4> {
        self.points.iter().map(|x| x.extend(0.0)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_never_grows_beyond_its_size_and_stays_evenly_spaced() {
        let mut trail = Trail::new(3);
        for i in 0..50_000 {
            trail.push(&[f64::from(i), f64::from(i) + 0.25, f64::from(i) + 0.5].map(DVec3::splat));
            assert!(trail.moments() <= MOMENTS);
        }
        let first: Vec<f64> = trail.points().step_by(3).map(|x| x.x).collect();
        assert!(first.len() >= MOMENTS / 2 && first[0].abs() < 0.5, "{}", first.len());
        let stride = first[1];
        // Integers, exact in f64.
        assert!(first.windows(2).all(|w| (w[1] - w[0]).to_bits() == stride.to_bits()), "{stride}");
        assert!(first[first.len() - 1] > 50_000.0 - 2.0 * stride);
    }
    #[test]
    fn what_was_there_earlier_ends_there() {
        let mut trail = Trail::new(2);
        let mut earlier = Vec::new();
        for i in 0..100 {
            trail.push(&[DVec3::splat(f64::from(i)), DVec3::splat(f64::from(i) + 0.5)]);
            earlier.push(trail.clone());
        }
        for (i, then) in (1..).zip(&earlier) {
            assert!(trail.until(i) == *then);
        }
        assert!((trail.until(0).moments(), trail.until(1000)) == (0, trail.clone()));
        for i in 100..5000 {
            trail.push(&[DVec3::splat(f64::from(i)); 2]);
        }
        // Every fourth moment is left; of the first ten pushes, those of 0, 4 and 8.
        let last = trail.until(10).points().last();
        assert_eq!((trail.until(10).moments(), last), (3, Some(DVec3::splat(8.5))));
    }
    #[test]
    fn of_many_particles_nothing_is_kept() {
        let mut trail = Trail::new(FEW + 1);
        trail.push(&[DVec3::ONE; FEW + 1]);
        assert_eq!((trail.moments(), trail.wanted()), (0, false));
    }
}
