//! Saving and restoring around the evaluation of a measurement, so that it changes no bit of the run.

use std::sync::Arc;

use glam::Vec4;

use crate::error::Error;
use crate::kernel::{ACCELERATION, Field, Host, Kernel, Shader};

const KEPT: Field<Vec4> = Field::new("kept_acceleration");

/// Copies a field of one vector for each particle to another, under a name.
pub fn copy(count: u32, name: &str, from: Field<Vec4>, to: Field<Vec4>) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("integrators/keep.wgsl")])?;
    let reference = move |host: &Host| {
        host.write(to)?.copy_from_slice(&host.read(from)?);
        Ok(())
    };
    let mut kernel = Kernel::new(name, shader, Vec::new(), count, Arc::new(reference)).alone();
    let fields = [("acceleration", from.name.into()), ("kept_acceleration", to.name.into())];
    kernel.passes = kernel.passes.into_iter().map(|pass| pass.on(&fields)).collect();
    Ok(kernel)
}

/// Saves the forces that the next step uses.
pub fn keep(count: u32) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("integrators/keep.wgsl")])?;
    let reference = |host: &Host| {
        host.write(KEPT)?.copy_from_slice(&host.read(ACCELERATION)?);
        Ok(())
    };
    Ok(Kernel::new("keep", shader, Vec::new(), count, Arc::new(reference)).alone())
}

/// Restores them.
pub fn restore(count: u32) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("integrators/restore.wgsl")])?;
    let reference = |host: &Host| {
        host.write(ACCELERATION)?.copy_from_slice(&host.read(KEPT)?);
        Ok(())
    };
    Ok(Kernel::new("restore", shader, Vec::new(), count, Arc::new(reference)).alone())
}
