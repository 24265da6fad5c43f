//! Between the two solves.

use std::sync::Arc;

use glam::Vec4;

use super::push::{PUSHED, changes};
use super::{
    Dfsph, KAPPA, PUSHES, RESPONSE, RESPONSES, STATE, STATES, STIFFNESS, UNKNOWN, UNKNOWNS, WARM, WARM_START, with,
};
use crate::error::Error;
use crate::kernel::{ACCELERATION, Host, Kernel};

/// The first is taken.
pub fn collect(of: &Dfsph<'_>) -> Result<Kernel, Error> {
    let slots = of.slots();
    let [unknowns, pushes] = [UNKNOWNS, PUSHES].map(|name| of.name(name));
    let twin = move |host: &Host| {
        let unknowns = host.reading::<f32>(&unknowns)?;
        let (mut pushes, mut acceleration) = (host.writing::<Vec4>(&pushes)?, host.write(ACCELERATION)?);
        let mut kappa = host.writing::<f32>(KAPPA)?;
        host.writing::<f32>(STATES)?[STATE..].fill(0.0);
        for (k, id) in slots(host)?.into_iter().enumerate() {
            if unknowns[UNKNOWN * k] >= 0.0 {
                kappa[STIFFNESS * id] = unknowns[UNKNOWN * k];
                acceleration[id] += pushes[k].truncate().extend(0.0);
                pushes[k] = acceleration[id].truncate().extend(1.0);
            }
        }
        Ok(())
    };
    let files = [crate::shader!("fluids/dfsph/collect.wgsl")];
    of.plain("fluid collect", &files, &[], of.problem.count, Arc::new(twin))
}

/// The second begins: what the density will be at the end of the step.
pub fn predict(of: &Dfsph<'_>) -> Result<Kernel, Error> {
    let (medium, slots) = (of.medium, of.slots());
    let relaxes = of.relaxation();
    let [unknowns, pushes, responses] = [UNKNOWNS, PUSHES, RESPONSES].map(|name| of.name(name));
    let twin = move |host: &Host| {
        let (ids, dt) = (slots(host)?, host.world().dt);
        let changes = changes(host, &medium, &ids, &pushes)?;
        let (responses, kept) = (host.reading::<f32>(&responses)?, host.reading::<f32>(WARM_START)?);
        let mut unknowns = host.writing::<f32>(&unknowns)?;
        for (k, id) in ids.into_iter().enumerate() {
            let Some(change) = changes[k] else { continue };
            let response = &responses[RESPONSE * k..];
            let relaxation = relaxes * response[1] / (dt * dt);
            let source = -(response[0] + dt * (response[2] + dt * change));
            let kappa = if relaxation > 0.0 { WARM * kept[STIFFNESS * id + 1] } else { 0.0 };
            unknowns[UNKNOWN * k..UNKNOWN * (k + 1)].copy_from_slice(&[kappa, kappa, relaxation, source]);
        }
        Ok(())
    };
    let files = vec![crate::shader!("fluids/dfsph/change.wgsl"), crate::shader!("fluids/dfsph/predict.wgsl")];
    let kernel = of.sweep("fluid predict".to_owned(), PUSHED, files, Arc::new(twin))?;
    Ok(with(kernel, &[("WARM", WARM), ("RELAXATION", relaxes)]))
}
