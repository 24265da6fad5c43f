//! Between the two solves.

use std::sync::Arc;

use glam::{DVec4, Vec4};

use super::push::{PUSHED, change, pushed};
use super::{Dfsph, KAPPA, PUSHES, RESPONSES, STATE, STATES, STIFFNESS, UNKNOWN, UNKNOWNS, WARM, WARM_START};
use crate::error::Error;
use crate::kernel::{ACCELERATION, Host, Kernel, World};
use crate::visit::{Law, Outcome, Particle};

/// The first is taken.
pub fn collect(of: &Dfsph<'_>) -> Result<Kernel, Error> {
    let slots = of.slots();
    let [unknowns, pushes] = [UNKNOWNS, PUSHES].map(|name| of.name(name));
    let reference = move |host: &Host| {
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
    let files = [crate::shader!("sph/dfsph/collect.wgsl")];
    of.plain("fluid collect", &files, &[], of.problem.capacity, Arc::new(reference))
}

/// The second begins: what the density will be at the end of the step.
pub fn predict(of: &Dfsph<'_>) -> Result<Kernel, Error> {
    let relaxes = of.relaxation();
    let finish = move |me: &Particle, change: &f64, world: &World, outcome: &mut Outcome| {
        if pushed(me).w <= 0.0 {
            return;
        }
        let (response, kept, dt) = (me.numbers(RESPONSES), me.numbers(WARM_START), world.dt);
        let relaxation = relaxes * response[1] / (dt * dt);
        let source = -(response[0] + dt * (response[2] + dt * change));
        let kappa = if relaxation > 0.0 { WARM * kept[1] } else { 0.0 };
        outcome.set(UNKNOWNS, DVec4::new(kappa, kappa, relaxation, source));
    };
    let mut search = of.searching(PUSHED, &[UNKNOWNS, PUSHES]);
    search.files.push(crate::shader!("sph/dfsph/change.wgsl"));
    search.constants.extend([("WARM", WARM), ("RELAXATION", relaxes)]);
    let wgsl = crate::shader!("sph/dfsph/predict.wgsl");
    let gather = change(of.medium);
    of.sweep(Law::searching("fluid predict", &of.grid, search, wgsl, &[UNKNOWNS], gather, finish))
}
