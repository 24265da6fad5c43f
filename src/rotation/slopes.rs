//! The slopes of a turning body, for Runge–Kutta steps.

use std::sync::Arc;

use glam::{DQuat, Vec4};

use super::{Body, facing, kernel, lightness, moving};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Name, Problem};

impl Body {
    /// The buffer of q'.
    #[must_use]
    pub fn rate(&self) -> Name {
        format!("rate_{}", self.orientation).into()
    }
    /// The buffer of ω', in space.
    #[must_use]
    pub fn acceleration(&self) -> Name {
        format!("rate_{}", self.angular_velocity).into()
    }
}

/// The kernel that computes q' and ω'.
///
/// # Errors
/// When a shader does not compile.
pub fn slopes(body: &Body, problem: &Problem) -> Result<Kernel, Error> {
    let names = body.clone();
    let reference = move |host: &Host| {
        let (inertia, torque) = (host.reading::<Vec4>(&names.inertia)?, host.reading::<Vec4>(&names.torque)?);
        let (orientation, spin) =
            (host.reading::<Vec4>(&names.orientation)?, host.reading::<Vec4>(&names.angular_velocity)?);
        let mut rate = host.writing::<Vec4>(&names.rate())?;
        let mut acceleration = host.writing::<Vec4>(&names.acceleration())?;
        for i in 0..orientation.len() {
            let (q, moments, space) = (facing(orientation[i]), inertia[i].truncate(), spin[i].truncate());
            let own = q.inverse() * space;
            let change = lightness(moments) * (q.inverse() * torque[i].truncate() - own.cross(moments * own));
            let turn = DQuat::from_xyzw(space.x, space.y, space.z, 0.0) * DQuat::from_vec4(orientation[i]);
            rate[i] = (turn * 0.5).into();
            acceleration[i] = (q * change).extend(0.0);
        }
        Ok(())
    };
    let slopes = kernel("slopes", body, crate::shader!("rotation/slopes.wgsl"), None, problem, Arc::new(reference))?;
    // They are recomputed each time.
    let count = u64::from(problem.capacity);
    Ok(Kernel { sizes: vec![(body.rate(), count), (body.acceleration(), count)], ..slopes })
}

/// The kernel that brings orientations back onto the unit quaternions.
///
/// # Errors
/// When a shader does not compile.
pub fn unit(body: &Body, problem: &Problem) -> Result<Kernel, Error> {
    let (names, all) = (body.clone(), problem.clone());
    let reference = move |host: &Host| {
        let moving = moving(&all, host)?;
        let mut orientation = host.writing::<Vec4>(&names.orientation)?;
        for i in (0..orientation.len()).filter(moving) {
            orientation[i] = facing(orientation[i]).into();
        }
        Ok(())
    };
    kernel("unit", body, crate::shader!("rotation/unit.wgsl"), None, problem, Arc::new(reference))
}
