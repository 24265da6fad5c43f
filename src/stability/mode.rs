//! A lower bound of a network's stiffness: the fastest mode at given positions, by power iteration (von Mises & Pollaczek-Geiringer 1929).
//! The Rayleigh quotient is below the true eigenvalue, however early the iteration stops.

use glam::DVec3;

use crate::kernel::Bounds;
use crate::links::Link;

/// A network at some positions: its springs' directions, and their transverse stiffness.
pub struct Network<'a> {
    springs: &'a [Link],
    /// 1 / √m; 0 for fixed particles.
    light: Vec<f64>,
    /// The direction of a spring, and max(0, 1 − L / l): its resistance across, in parts of that along it. The exact one
    /// is negative where a spring is pressed: it buckles, and does not swing.
    along: Vec<(DVec3, f64)>,
}

/// Something that swings, or creeps.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Mode {
    /// ω² \[1 / time²\]
    pub stiffness: f64,
    /// c \[1 / time\]
    pub damping: f64,
}

/// Enough for nine tenths of ω² on sheets of cloth, whose quickest modes are many.
const ITERATIONS: usize = 40;

impl<'a> Network<'a> {
    /// For springs between particles of these masses (infinite for fixed ones) and positions.
    #[must_use]
    pub fn new(springs: &'a [Link], masses: &[f64], positions: &[DVec3], bounds: &Bounds) -> Self {
        let light = masses.iter().map(|m| 1.0 / m.sqrt()).collect();
        let along = |spring: &Link| {
            let [Some(a), Some(b)] = spring.ends.map(|id| positions.get(id as usize)) else {
                return (DVec3::ZERO, 0.0);
            };
            let r = bounds.shortest(*b - *a);
            let length = r.length();
            if spring.rest == 0.0 {
                return (r.normalize_or_zero(), 1.0);
            }
            if spring.rope && length < spring.rest {
                return (DVec3::ZERO, 0.0);
            }
            (r.normalize_or_zero(), (1.0 - spring.rest / length).max(0.0))
        };
        Self { springs, light, along: springs.iter().map(along).collect() }
    }
    /// The mode that swings fastest, and how it is damped.
    #[must_use]
    pub fn quickest(&self) -> Mode {
        self.largest(true)
    }
    /// The mode that is damped most, and how it swings.
    #[must_use]
    pub fn most_damped(&self) -> Mode {
        self.largest(false)
    }
    /// K x, in coordinates √m x: what the springs' stiffness makes of a shape.
    #[must_use]
    pub fn product_of(&self, shape: &[DVec3]) -> Vec<DVec3> {
        self.product(shape, true)
    }
    fn largest(&self, swings: bool) -> Mode {
        let mut shape: Vec<DVec3> = (0..self.light.len()).map(scattered).collect();
        let mut mode = Mode::default();
        for _ in 0..ITERATIONS {
            let size = shape.iter().map(|v| v.length_squared()).sum::<f64>().sqrt();
            if size == 0.0 || !size.is_finite() {
                break;
            }
            for v in &mut shape {
                *v /= size;
            }
            let (stiff, damped) = (self.product(&shape, true), self.product(&shape, false));
            let quotient = |image: &[DVec3]| shape.iter().zip(image).map(|(a, b)| a.dot(*b)).sum::<f64>();
            mode = Mode { stiffness: quotient(&stiff), damping: quotient(&damped) };
            shape = if swings { stiff } else { damped };
        }
        mode
    }
    /// The product of the springs' stiffness matrix, or of their damping matrix, with a shape, in coordinates √m x.
    fn product(&self, shape: &[DVec3], stiffness: bool) -> Vec<DVec3> {
        let mut image = vec![DVec3::ZERO; shape.len()];
        for (spring, (u, across)) in self.springs.iter().zip(&self.along) {
            let [i, j] = spring.ends.map(|id| id as usize);
            let (Some(a), Some(b)) = (shape.get(i), shape.get(j)) else { continue };
            let d = *b * self.light[j] - *a * self.light[i];
            let part = *u * u.dot(d);
            let pull = if stiffness {
                spring.stiffness * (part + *across * (d - part))
            } else {
                // Damping acts along a spring alone.
                spring.damping * part
            };
            image[i] -= pull * self.light[i];
            image[j] += pull * self.light[j];
        }
        image
    }
}

/// Directions with no pattern (Weyl's sequence of irrational steps), so that every mode has its part in the first shape.
fn scattered(i: usize) -> DVec3 {
    let turn = |step: f64| (i as f64 * step + 0.25).fract() - 0.5;
    DVec3::new(turn(0.754_877_666_246_692_8), turn(0.569_840_290_998_053_3), turn(0.430_159_709_001_946_7))
}
