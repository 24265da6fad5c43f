//! The solve for a velocity that does not compress begins.

use std::sync::Arc;

use glam::{DVec4, Vec4};

use super::{
    Dfsph, ERRORS, KEPT, PUSHES, RESPONSE, RESPONSES, STATE, STATES, STIFFNESS, UNKNOWN, UNKNOWNS, WARM, with,
};
use crate::error::Error;
use crate::kernel::{Host, Kernel};

/// What source says that anything may be.
const ANYTHING: f64 = 1000.0;
/// The κ of walls.
const WALL: f64 = -1.0;

/// The kernel.
pub fn kernel(of: &Dfsph<'_>) -> Result<Kernel, Error> {
    let (holding, tables) = of.problem.holding();
    let (who, slots, fewest) = (of.problem.clone(), of.slots(), of.fewest());
    let relaxes = of.relaxation();
    let names = [RESPONSES, UNKNOWNS, PUSHES, ERRORS].map(|name| of.name(name));
    let twin = move |host: &Host| {
        let dt = host.world().dt;
        let [responses, unknowns, pushes, errors] = &names;
        let (responses, kept) = (host.reading::<f32>(responses)?, host.reading::<f32>(KEPT)?);
        let (mut unknowns, mut pushes) = (host.writing::<f32>(unknowns)?, host.writing::<Vec4>(pushes)?);
        host.writing::<f32>(errors)?.fill(0.0);
        host.writing::<f32>(STATES)?[..STATE].fill(0.0);
        for (k, id) in slots(host)?.into_iter().enumerate() {
            let response = &responses[RESPONSE * k..];
            let enough = response[3] >= fewest;
            let relaxation = if enough { relaxes * response[1] / (dt * dt) } else { 0.0 };
            let kappa = if relaxation > 0.0 { WARM * kept[STIFFNESS * id] } else { 0.0 };
            let source = if enough { -dt * response[2] } else { ANYTHING };
            let solved = if who.is_held(id) { 0.0 } else { 1.0 };
            let unknown = if who.is_held(id) { [WALL, 0.0, 0.0, 0.0] } else { [kappa, kappa, relaxation, source] };
            unknowns[UNKNOWN * k..UNKNOWN * (k + 1)].copy_from_slice(&unknown);
            pushes[k] = DVec4::W * solved;
        }
        Ok(())
    };
    let files = [holding, crate::shader!("fluids/dfsph/begin.wgsl")];
    let kernel = of.plain("fluid begin", &files, &[], of.problem.count, Arc::new(twin))?;
    Ok(Kernel { tables, ..with(kernel, &[("FEWEST", fewest), ("WARM", WARM), ("RELAXATION", relaxes)]) })
}
