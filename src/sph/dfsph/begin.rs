//! The start of the divergence solve.

use std::sync::Arc;

use glam::{DVec4, Vec4};

use super::{
    Dfsph, ERRORS, PUSHES, RESPONSE, RESPONSES, STATE, STATES, STIFFNESS, UNKNOWN, UNKNOWNS, WALL, WARM, WARM_START,
    with,
};
use crate::error::Error;
use crate::kernel::{Host, Kernel};

/// What source says that anything may be.
const ANYTHING: f64 = 1000.0;

/// The kernel.
pub fn kernel(of: &Dfsph<'_>) -> Result<Kernel, Error> {
    let (slots, fewest) = (of.slots(), of.fewest());
    let relaxes = of.relaxation();
    let names = [UNKNOWNS, PUSHES, ERRORS].map(|name| of.name(name));
    let reference = move |host: &Host| {
        let dt = host.world().dt;
        let [unknowns, pushes, errors] = &names;
        let (responses, kept) = (host.reading::<f32>(RESPONSES)?, host.reading::<f32>(WARM_START)?);
        let (mut unknowns, mut pushes) = (host.writing::<f32>(unknowns)?, host.writing::<Vec4>(pushes)?);
        host.writing::<f32>(errors)?.fill(0.0);
        host.writing::<f32>(STATES)?[..STATE].fill(0.0);
        for (unknown, push) in unknowns.chunks_exact_mut(UNKNOWN).zip(pushes.iter_mut()) {
            unknown.copy_from_slice(&[WALL, 0.0, 0.0, 0.0]);
            *push = DVec4::ZERO;
        }
        for (k, id) in slots(host)?.into_iter().enumerate() {
            let response = &responses[RESPONSE * id..];
            let enough = response[3] >= fewest;
            let relaxation = if enough { relaxes * response[1] / (dt * dt) } else { 0.0 };
            let kappa = if relaxation > 0.0 { WARM * kept[STIFFNESS * id] } else { 0.0 };
            let source = if enough { -dt * response[2] } else { ANYTHING };
            unknowns[UNKNOWN * k..UNKNOWN * (k + 1)].copy_from_slice(&[kappa, kappa, relaxation, source]);
            pushes[k] = DVec4::W;
        }
        Ok(())
    };
    let files = [crate::shader!("sph/dfsph/begin.wgsl")];
    let kernel = of.plain("fluid begin", &files, &[], of.problem.capacity, Arc::new(reference))?;
    Ok(with(kernel, &[("FEWEST", fewest), ("WARM", WARM), ("RELAXATION", relaxes)]))
}
