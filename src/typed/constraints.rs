//! Constraints, written from the register.

use std::borrow::Cow;

use glam::DVec3;

use super::{Field, typed};
use crate::settings::Settings;

typed! {
    force;
    /// The minimum and the maximum speed of a species.
    SpeedLimit "speed_limit" speed_limit(max: f64) {
        /// The minimum speed; a particle at rest sets off along x \[length / time\].
        min: f64,
        /// The maximum speed \[length / time\].
        max: f64,
        /// The species that it acts on, or "all".
        species: Option<u32>,
    }
    /// An obstacle or a container: a sphere, a box, a plane or a capsule, with restitution and friction.
    Solid "solid" solid() {
        /// Its shape: sphere, box, plane, capsule.
        shape: Cow<'static, str>,
        /// Its centre, or a point on the plane \[length\].
        position: DVec3,
        /// Sphere and capsule: the radius \[length\].
        radius: f64,
        /// Box: its sides \[length\].
        size: DVec3,
        /// Plane: the direction to the free side.
        normal: DVec3,
        /// Capsule: from the centre of one end to the other's \[length\].
        axis: DVec3,
        /// The minimum distance of particle centres from the surface \[length\].
        thickness: f64,
        /// The coefficient of restitution, 0 to 1.
        restitution: f64,
        /// Coulomb's coefficient of friction.
        friction: f64,
        /// Whether it is a container that keeps particles inside.
        inside: bool,
        /// The motion that moves it, if any.
        motion: Cow<'static, str>,
        /// The species that it acts on, or "all".
        species: Option<u32>,
        /// What is evaluated: single particles.
        over: Cow<'static, str>,
    }
    /// Rigid rods in chains keep their lengths, whatever the other forces do (RATTLE: Andersen 1983).
    Rod "rod" rod() {
    }
    /// An upper limit of the strain of springs (Provot 1995).
    StrainLimit "strain_limit" strain_limit() {
        /// The largest strain of a spring: its extension over its rest length.
        strain: f64,
        /// Iterations over all springs after a drift: more bring long chains closer to the limit.
        sweeps: u32,
        /// What is limited: springs and ropes.
        over: Cow<'static, str>,
    }
}
