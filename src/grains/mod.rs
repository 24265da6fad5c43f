//! Granular matter: spheres that push, rub, roll and twist where they touch.
//!
//! A contact has conventions that differ between codes. Here:
//! * the overlap δ is what the radii exceed the distance by, and the contact lies in its middle: the torque arm is R − δ / 2 (the other choice: R);
//! * forces use the velocities of the evaluation, which are those of the half step under kicks and drifts;
//! * a contact ends where δ = 0. Near its end damping may pull; this is not cut, so that the coefficient of restitution is exact. The
//!   limits of friction, rolling and torsion are those of the normal force where it pushes, and 0 where it pulls;
//! * the tangential spring ξ is projected onto the tangent plane and keeps its length there otherwise. It is not reduced when the
//!   normal force decreases: its stiffness is the present one, so that its force decreases with the overlap;
//! * at Coulomb's limit ξ is set so that spring and damper together give the limit, and at those of rolling and torsion ψ is;
//! * history begins with zeros when a contact begins. What springs hold when it ends becomes heat in the step after, in which spheres are
//!   within a sixteenth of the reduced radius of each other: what parts by more in a step keeps this out of the sum of energies.

mod ball;
mod bridge;
mod force;
mod material;
mod meeting;
mod pairs;
mod touch;
mod wall;

pub use ball::{inside, volume};
pub use bridge::Bridge;
pub use force::{Balls, ContactForce, between};
pub(crate) use material::{
    BRIDGE_VOLUME, CONTACT_ANGLE, FRICTION, MODEL, NAMES, PAIRS, POISSON, RESTITUTION, ROLLING, ROLLING_DAMPING,
    ROLLING_MODEL, STIFFNESS, SURFACE_TENSION, TANGENTIAL_DAMPING, TANGENTIAL_STIFFNESS, TORSION, YOUNG, check, mixed,
};
pub use material::{Material, Model};
pub use meeting::{Ball, Meeting};
pub use pairs::{Pair, near, touching};
pub use touch::{MARGIN, Touch, WORDS, Wound, may_touch, moment, reduced};
pub use wall::{Surface, own};

use crate::kernel::{Column, Kind};
use crate::rotation;

/// The columns of grains: those of rigid bodies, a radius, beside the angular velocity in its buffer, and the energy that their contacts
/// have dissipated, beside the moments of inertia in theirs.
#[must_use]
pub fn columns() -> Vec<Column> {
    let radius = Column::new("radius", Kind::Scalar, "length", "of the sphere that others touch");
    let lost = Column::new(
        "dissipated",
        Kind::Scalar,
        "mass length² / time²",
        "what its contacts have dissipated, a half of each",
    );
    let rate =
        Column::new("dissipation", Kind::Scalar, "mass length² / time³", "the power that its contacts dissipate");
    let energy = [lost.within("inertia", 3).counting("dissipation"), rate.within("torque", 3).summed()];
    [rotation::columns(), vec![radius.within("angular_velocity", 3).required()], energy.to_vec()].concat()
}
