//! The end of the density solve.

use std::sync::Arc;

use glam::Vec4;

use super::{Dfsph, KAPPA, PUSHES, STIFFNESS, UNKNOWN, UNKNOWNS};
use crate::error::Error;
use crate::kernel::{ACCELERATION, Host, Kernel};
use crate::sph::PRESSURE;

/// The kernel.
pub fn kernel(of: &Dfsph<'_>) -> Result<Kernel, Error> {
    let (medium, slots) = (of.medium, of.slots());
    let [unknowns, pushes] = [UNKNOWNS, PUSHES].map(|name| of.name(name));
    let reference = move |host: &Host| {
        let (unknowns, pushes) = (host.reading::<f32>(&unknowns)?, host.reading::<Vec4>(&pushes)?);
        let (mut kappa, mut pressure) = (host.writing::<f32>(KAPPA)?, host.write(PRESSURE)?);
        let mut acceleration = host.write(ACCELERATION)?;
        for (k, id) in slots(host)?.into_iter().enumerate() {
            let mine = unknowns[UNKNOWN * k];
            if mine >= 0.0 {
                kappa[STIFFNESS * id + 1] = mine;
                pressure[id] = medium.density * (kappa[STIFFNESS * id] + mine);
                acceleration[id] += pushes[k].truncate().extend(0.0);
            }
        }
        Ok(())
    };
    let files = [crate::shader!("sph/dfsph/finish.wgsl")];
    of.plain("fluid finish", &files, &[], of.problem.capacity, Arc::new(reference))
}
