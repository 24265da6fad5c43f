//! The two halves of an iteration: accelerations by pressure, and pressure by what these would compress.

use std::sync::Arc;

use glam::{DVec3, Vec4};

use super::{Dfsph, ERRORS, PUSHES, STATE, STATES, Solve, UNKNOWN, UNKNOWNS, WALL, with};
use crate::error::Error;
use crate::fluids::Medium;
use crate::kernel::{Host, Kernel, Name};
use crate::visit::{Candidate, gathered};

/// Accelerations by pressure.
pub fn push(of: &Dfsph<'_>, solve: Solve) -> Result<Kernel, Error> {
    let (medium, slots) = (of.medium, of.slots());
    let [unknowns, pushes] = [UNKNOWNS, PUSHES].map(|name| of.name(name));
    let twin = move |host: &Host| {
        let (ids, unknowns) = (slots(host)?, host.reading::<f32>(&unknowns)?);
        let count = host.world().count as usize;
        let (mut kappa, mut solved) = (vec![WALL; count], vec![false; count]);
        let all = || ids.iter().zip(unknowns.chunks_exact(UNKNOWN)).filter(|(_, unknown)| unknown[0] >= 0.0);
        all().for_each(|(id, unknown)| (kappa[*id], solved[*id]) = (unknown[0], true));
        let sums = gathered(
            host,
            medium.range(),
            |me| solved[me.index],
            |me, you, r, sum: &mut DVec3| {
                let yours = if kappa[you.index] < 0.0 { kappa[me.index] } else { kappa[you.index] };
                *sum += you.mass / medium.density * (kappa[me.index] + yours) * medium.gradient(r) * r;
            },
        )?;
        let mut pushes = host.writing::<Vec4>(&pushes)?;
        for ((push, id), unknown) in pushes.iter_mut().zip(&ids).zip(unknowns.chunks_exact(UNKNOWN)) {
            if let Some(sum) = sums[*id].filter(|_| unknown[0] >= 0.0) {
                *push = sum.extend(1.0);
            }
        }
        Ok(())
    };
    let candidate = Candidate {
        particle: crate::shader!("fluids/dfsph/stiff.wgsl"),
        broadcast: crate::shader!("fluids/dfsph/stiff_broadcast.wgsl"),
    };
    let (name, files) = (format!("fluid {} push", solve.name()), vec![crate::shader!("fluids/dfsph/push.wgsl")]);
    of.sweep(name, candidate, files, Arc::new(twin))
}

/// What a search of accelerations loads of a neighbour.
pub const PUSHED: Candidate = Candidate {
    particle: crate::shader!("fluids/dfsph/pushed.wgsl"),
    broadcast: crate::shader!("fluids/dfsph/pushed_broadcast.wgsl"),
};

/// How fast accelerations make the density grow, as a part of that at rest, by slot; of those that are solved for.
pub fn changes(host: &Host, medium: &Medium, ids: &[usize], pushes: &Name) -> Result<Vec<Option<f64>>, Error> {
    let mut felt = vec![glam::DVec4::ZERO; host.world().count as usize];
    let pushes = host.reading::<Vec4>(pushes)?;
    for (id, push) in ids.iter().zip(pushes.iter()) {
        // Who stands nowhere any more says nothing of who stands elsewhere.
        if push.w > 0.0 || felt[*id].w <= 0.0 {
            felt[*id] = *push;
        }
    }
    let changes = gathered(
        host,
        medium.range(),
        |me| felt[me.index].w > 0.0,
        |me, you, r, sum: &mut f64| {
            let way = (felt[you.index] - felt[me.index]).truncate();
            *sum += you.mass / medium.density * medium.gradient(r) * way.dot(r);
        },
    )?;
    Ok(ids.iter().zip(pushes.iter()).map(|(id, push)| changes[*id].filter(|_| push.w > 0.0)).collect())
}

/// Pressure by what they compress.
pub fn correct(of: &Dfsph<'_>, solve: Solve) -> Result<Kernel, Error> {
    let (medium, slots) = (of.medium, of.slots());
    let [unknowns, pushes, errors] = [UNKNOWNS, PUSHES, ERRORS].map(|name| of.name(name));
    let twin = move |host: &Host| {
        let (ids, dt) = (slots(host)?, host.world().dt);
        let turn = host.reading::<f32>(STATES)?[STATE * solve as usize];
        let onward = turn / (turn + 3.0);
        let changes = changes(host, &medium, &ids, &pushes)?;
        let (mut unknowns, mut errors) = (host.writing::<f32>(&unknowns)?, host.writing::<f32>(&errors)?);
        for ((unknown, error), change) in unknowns.chunks_exact_mut(UNKNOWN).zip(errors.iter_mut()).zip(changes) {
            if let Some(change) = change {
                let [before, reached, relaxation, source] = [0, 1, 2, 3].map(|member| unknown[member]);
                let residual = source - dt * dt * change;
                let next = (before - relaxation * residual).max(0.0);
                unknown[0] = (next + onward * (next - reached)).max(0.0);
                unknown[1] = next;
                *error = match relaxation {
                    0.0 => (-residual).max(0.0),
                    _ => (next - before).abs() / relaxation,
                };
            }
        }
        Ok(())
    };
    let files = vec![crate::shader!("fluids/dfsph/change.wgsl"), crate::shader!("fluids/dfsph/correct.wgsl")];
    let kernel = of.sweep(format!("fluid {} correct", solve.name()), PUSHED, files, Arc::new(twin))?;
    Ok(with(kernel, &[("SOLVE", f64::from(solve as u32))]))
}
