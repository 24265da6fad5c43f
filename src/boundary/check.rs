//! Validation of boxes, and of the particles in them.

use glam::DVec3;

use crate::error::Error;
use crate::kernel::{Bounds, Side};

const AXES: [&str; 3] = ["x", "y", "z"];
/// Four times as much is the largest f32: sums and doubles of what a box is made of must not overflow.
const FARTHEST: f64 = 8.5e37;

#[expect(clippy::cast_possible_truncation, reason = "as the device holds it")]
fn narrow(x: f64) -> f64 {
    f64::from(x as f32)
}

/// Whether there can be such a box.
///
/// # Errors
/// [`Error::Scene`] when it has not 2 or 3 dimensions, when 2 dimensions are closed along z, when a corner is NaN
/// or too far out, or when along a closed axis the box does not end above where it begins, in single precision.
pub fn check(bounds: &Bounds) -> Result<(), Error> {
    if !(2..=3).contains(&bounds.dimensions) {
        return Err(Error::Scene(format!("the box has {} dimensions: it must have 2 or 3", bounds.dimensions)));
    }
    for (axis, name) in AXES.into_iter().enumerate() {
        let (low, high, side) = (bounds.low[axis], bounds.high[axis], bounds.sides[axis]);
        let from_to = format!("the box reaches along {name} from {low:?} to {high:?}");
        if !(low.abs() <= FARTHEST && high.abs() <= FARTHEST) {
            return Err(Error::Scene(format!("{from_to}: both must be numbers of at most {FARTHEST:e}")));
        }
        if side == Side::Open {
            continue;
        }
        // One over the length must be a number too.
        if narrow(high) - narrow(low) < f64::from(f32::MIN_POSITIVE) {
            let text = format!(
                "{from_to}, and is {} there: it must end above where it begins, in single precision; or make it open along {name}",
                side.name()
            );
            return Err(Error::Scene(text));
        }
        if bounds.dimensions == 2 && axis == 2 {
            let text = format!(
                "in 2 dimensions the box cannot be {} along z: make it open along z, or set dimensions = 3",
                side.name()
            );
            return Err(Error::Scene(text));
        }
    }
    Ok(())
}

/// Whether a box can hold these particles. A particle outside of a periodic box is in it by an image.
///
/// # Errors
/// [`Error::Scene`] that names the first particle out of the plane of 2 dimensions, or beyond a reflecting side.
pub fn holds(bounds: &Bounds, position: &[DVec3], velocity: &[DVec3]) -> Result<(), Error> {
    if bounds.dimensions == 2 {
        let out = position.iter().zip(velocity).position(|(x, v)| x.z != 0.0 || v.z != 0.0);
        if let Some(id) = out {
            let (z, vz) = (position[id].z, velocity[id].z);
            return Err(Error::Scene(format!(
                "particle {id} is at z = {z} and moves along z with {vz}, and in 2 dimensions all particles are in the plane z = 0: \
                 set both to 0, or set dimensions = 3"
            )));
        }
    }
    for axis in (0..3).filter(|axis| bounds.sides[*axis] == Side::Reflecting) {
        let (low, high, name) = (bounds.low[axis], bounds.high[axis], AXES[axis]);
        // In single precision, which is what files of earlier runs hold.
        let within = |x: &DVec3| (narrow(low)..=narrow(high)).contains(&narrow(x[axis]));
        if let Some(id) = position.iter().position(|x| !within(x)) {
            let x = position[id][axis];
            return Err(Error::Scene(format!(
                "particle {id} is at {name} = {x}, outside of the reflecting box, which reaches from {low:?} to {high:?} there: \
                 move it inside, or make the box larger"
            )));
        }
    }
    Ok(())
}
