//! The maximum rates of oscillation and damping of a fluid at rest: waves on its cubic lattice (von Neumann's analysis; for smoothed
//! particles Morris 1996). These are the stability limits of explicit steps.

use glam::DVec3;

use super::{Form, Friction, Medium};

/// The fastest modes of a fluid at rest.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Rates {
    /// ω of the fastest sound wave, c |Σ V ∇W sin(k·r)| \[1 / time\].
    pub sound: f64,
    /// The largest rate at which viscosities damp \[1 / time\].
    pub friction: f64,
    /// The maximum part of a velocity that XSPH removes in each step, whatever its length.
    pub drawn: f64,
}

/// The number of waves from wave number zero to the largest on a lattice, π / d: more of them change no significant digit.
const WAVES: u32 = 64;

impl Rates {
    /// For waves along an edge of the lattice and along its diagonals.
    #[must_use]
    pub fn of(medium: &Medium, friction: Friction, xsph: f64) -> Self {
        let (volume, length) = (medium.volume(), 0.5 * medium.range());
        let (lattice, smoothed) = (lattice(medium), medium.smoothed());
        let central = 2.0 * f64::from(medium.dimensions + 2);
        let mut most = Self::default();
        for way in [DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::ONE] {
            let way = if medium.dimensions == 2 { way.with_z(0.0) } else { way };
            let along = way.normalize();
            for wave in 1..=WAVES {
                let k = way * (std::f64::consts::PI * f64::from(wave) / f64::from(WAVES) / medium.spacing);
                let (mut sound, mut viscous, mut artificial, mut drawn) = (DVec3::ZERO, 0.0, 0.0, 0.0);
                for r in &lattice {
                    let (slope, apart) = (volume * smoothed.gradient(*r), 1.0 - libm::cos(k.dot(*r)));
                    let near = r.length_squared() + 0.01 * length * length;
                    sound += slope * libm::sin(k.dot(*r)) * *r;
                    // Of the waves of a central force the longitudinal ones are damped fastest.
                    viscous -= match friction.form {
                        Form::Central => central * slope * r.dot(along).powi(2) / r.length_squared() * apart,
                        Form::Morris => 2.0 * slope * apart,
                    };
                    artificial -= slope * length * r.dot(along).powi(2) / near * apart;
                    drawn += volume * smoothed.kernel(*r) * apart;
                }
                // Artificial viscosity acts on pairs that come closer, which are half of the pairs at any time.
                let damped = friction.viscosity * viscous + 0.5 * friction.alpha * medium.sound * artificial;
                most.sound = most.sound.max(medium.sound * sound.length());
                most.friction = most.friction.max(damped);
                most.drawn = most.drawn.max(xsph * drawn);
            }
        }
        most
    }
}

/// All other points of the lattice within range of a central one.
fn lattice(medium: &Medium) -> Vec<DVec3> {
    let steps =
        || std::iter::successors(Some(-medium.support.ceil()), |x| (*x < medium.support.ceil()).then_some(x + 1.0));
    let mut all = Vec::new();
    for x in steps() {
        for y in steps() {
            for z in steps().filter(|z| medium.dimensions != 2 || *z == 0.0) {
                let r = DVec3::new(x, y, z) * medium.spacing;
                if r != DVec3::ZERO && r.length() < medium.range() {
                    all.push(r);
                }
            }
        }
    }
    all
}
