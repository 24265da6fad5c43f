//! How two spheres meet: what a contact reads of them.

use glam::DVec3;

use super::{moment, reduced};

/// A sphere, as a contact reads it.
#[derive(Debug, Clone, Copy)]
pub struct Ball {
    /// Its velocity \[length / time\].
    pub velocity: DVec3,
    /// Its angular velocity \[1 / time\].
    pub spin: DVec3,
    /// \[length\].
    pub radius: f64,
    /// \[mass\].
    pub mass: f64,
}

/// How two spheres, or a sphere and a wall, meet.
#[derive(Debug, Clone, Copy)]
pub struct Meeting {
    /// The unit vector out of the sphere.
    pub n: DVec3,
    /// δ \[length\].
    pub overlap: f64,
    /// From the centre to the middle of the overlap, along n \[length\].
    pub arm: f64,
    /// The velocity at the contact, relative to the other \[length / time\].
    pub v: DVec3,
    /// The reduced radius \[length\].
    pub radius: f64,
    /// The smaller radius; that of the sphere at a wall \[length\].
    pub smaller: f64,
    /// The angular velocity, relative to the other \[1 / time\].
    pub spin: DVec3,
    /// The reduced mass \[mass\].
    pub mass: f64,
    /// The reduced moment about the contact \[mass length²\].
    pub rest: f64,
}

impl Meeting {
    /// Of two spheres, with r from the first to the second; `None` where one has no radius, or both are at the same position: then there
    /// is no direction between them.
    #[must_use]
    pub fn between(me: &Ball, you: &Ball, r: DVec3) -> Option<Self> {
        let distance = r.length();
        let touch = distance > 0.0 && me.radius > 0.0 && you.radius > 0.0;
        touch.then(|| {
            let overlap = me.radius + you.radius - distance;
            let n = r / distance;
            let [arm, other] = [me.radius - 0.5 * overlap, you.radius - 0.5 * overlap];
            Self {
                n,
                overlap,
                arm,
                v: me.velocity - you.velocity + (arm * me.spin + other * you.spin).cross(n),
                radius: reduced(me.radius, you.radius),
                smaller: me.radius.min(you.radius),
                spin: me.spin - you.spin,
                mass: reduced(me.mass, you.mass),
                rest: reduced(moment(me.mass, me.radius), moment(you.mass, you.radius)),
            }
        })
    }
}
