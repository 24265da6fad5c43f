//! The three verbs of an explicit Runge–Kutta step.

use std::sync::Arc;

use glam::{DVec4, Vec4};

use crate::error::Error;
use crate::kernel::{ACCELERATION, Field, Host, Kernel, POSITION, Shader, VELOCITY};

const START_POSITION: Field<Vec4> = Field::new("start_position");
const START_VELOCITY: Field<Vec4> = Field::new("start_velocity");
const SLOPE_POSITION: Field<Vec4> = Field::new("slope_position");
const SLOPE_VELOCITY: Field<Vec4> = Field::new("slope_velocity");

fn shader(file: crate::kernel::Source) -> Result<Arc<Shader>, Error> {
    Shader::join(&[crate::shader!("world.wgsl"), file])
}

fn vector(v: DVec4) -> DVec4 {
    v.with_w(0.0)
}

/// Saves the start of the step.
pub fn save(count: u32) -> Result<Kernel, Error> {
    let reference = |host: &Host| {
        host.write(START_POSITION)?.copy_from_slice(&host.read(POSITION)?);
        host.write(START_VELOCITY)?.copy_from_slice(&host.read(VELOCITY)?);
        host.write(SLOPE_POSITION)?.fill(DVec4::ZERO);
        host.write(SLOPE_VELOCITY)?.fill(DVec4::ZERO);
        Ok(())
    };
    Ok(Kernel::new(
        "rk_save",
        shader(crate::shader!("integrators/rk_save.wgsl"))?,
        Vec::new(),
        count,
        Arc::new(reference),
    )
    .alone())
}

/// A stage: adds `weight` times the slopes to the sum, and advances to `factor` of the step from its start for the next slopes.
pub fn stage(count: u32, weight: f64, factor: f64) -> Result<Kernel, Error> {
    let reference = move |host: &Host| {
        let dt = factor * host.world().dt;
        let (x0, v0) = (host.read(START_POSITION)?, host.read(START_VELOCITY)?);
        let (mut x, mut v, a) = (host.write(POSITION)?, host.write(VELOCITY)?, host.read(ACCELERATION)?);
        let (mut sum_x, mut sum_v) = (host.write(SLOPE_POSITION)?, host.write(SLOPE_VELOCITY)?);
        for i in 0..x.len() {
            let (slope_x, slope_v) = (vector(v[i]), vector(a[i]));
            sum_x[i] += weight * slope_x;
            sum_v[i] += weight * slope_v;
            x[i] = x0[i] + dt * slope_x;
            v[i] = v0[i] + dt * slope_v;
        }
        Ok(())
    };
    let constants = vec![("WEIGHT", weight), ("FACTOR", factor)];
    Ok(Kernel::new(
        "rk_stage",
        shader(crate::shader!("integrators/rk_stage.wgsl"))?,
        constants,
        count,
        Arc::new(reference),
    )
    .alone())
}

/// The end of the step, with the weight of the last slopes.
pub fn finish(count: u32, weight: f64) -> Result<Kernel, Error> {
    let reference = move |host: &Host| {
        let dt = host.world().dt;
        let (x0, v0) = (host.read(START_POSITION)?, host.read(START_VELOCITY)?);
        let (mut x, mut v, a) = (host.write(POSITION)?, host.write(VELOCITY)?, host.read(ACCELERATION)?);
        let (sum_x, sum_v) = (host.read(SLOPE_POSITION)?, host.read(SLOPE_VELOCITY)?);
        for i in 0..x.len() {
            x[i] = x0[i] + dt * vector(sum_x[i] + weight * v[i]);
            v[i] = v0[i] + dt * vector(sum_v[i] + weight * a[i]);
        }
        Ok(())
    };
    let constants = vec![("WEIGHT", weight)];
    Ok(Kernel::new(
        "rk_finish",
        shader(crate::shader!("integrators/rk_finish.wgsl"))?,
        constants,
        count,
        Arc::new(reference),
    )
    .alone())
}
