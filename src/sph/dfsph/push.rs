//! The two halves of an iteration: accelerations by pressure, and pressure by what these would compress.

use glam::{DVec3, DVec4};

use super::{Dfsph, ERRORS, PUSHES, STATE, STATES, Solve, UNKNOWNS};
use crate::error::Error;
use crate::kernel::{Kernel, World};
use crate::sph::Medium;
use crate::visit::{Candidate, Law, Outcome, Particle};

/// Accelerations by pressure.
pub fn push(of: &Dfsph<'_>, solve: Solve) -> Result<Kernel, Error> {
    let (medium, smoothed) = (of.medium, of.medium.smoothed());
    let stiffness = |one: &Particle| one.numbers(UNKNOWNS)[0];
    let gather = move |me: &Particle, you: &Particle, r, _: &World, sum: &mut DVec3| {
        let [mine, yours] = [me, you].map(stiffness);
        let yours = if yours < 0.0 { mine } else { yours };
        *sum += you.mass / medium.density * (mine + yours) * smoothed.gradient(r) * r;
    };
    let finish = move |me: &Particle, sum: &DVec3, _: &World, outcome: &mut Outcome| {
        if stiffness(me) >= 0.0 {
            outcome.set(PUSHES, sum.extend(1.0));
        }
    };
    let candidate = Candidate {
        particle: crate::shader!("sph/dfsph/stiff.wgsl"),
        broadcast: crate::shader!("sph/dfsph/stiff_broadcast.wgsl"),
        listed: None,
    };
    let (name, search) = (format!("fluid {} push", solve.name()), of.searching(candidate, &[UNKNOWNS, PUSHES]));
    let wgsl = crate::shader!("sph/dfsph/push.wgsl");
    of.sweep(Law::searching(&name, &of.grid, search, wgsl, &[PUSHES], gather, finish))
}

/// The data of a neighbour that a search for accelerations loads.
pub const PUSHED: Candidate = Candidate {
    particle: crate::shader!("sph/dfsph/pushed.wgsl"),
    broadcast: crate::shader!("sph/dfsph/pushed_broadcast.wgsl"),
    listed: None,
};

/// The acceleration of a particle, and whether it is solved for.
pub fn pushed(of: &Particle) -> DVec4 {
    of.vector(PUSHES).unwrap_or(DVec4::NAN)
}

/// The rate of the density due to accelerations, relative to the rest density.
pub fn change(medium: Medium) -> impl Fn(&Particle, &Particle, DVec3, &World, &mut f64) + Send + Sync + 'static {
    let smoothed = medium.smoothed();
    move |me, you, r, _, sum| {
        let way = (pushed(you) - pushed(me)).truncate();
        *sum += you.mass / medium.density * smoothed.gradient(r) * way.dot(r);
    }
}

/// Pressure by what they compress.
pub fn correct(of: &Dfsph<'_>, solve: Solve) -> Result<Kernel, Error> {
    let finish = move |me: &Particle, change: &f64, world: &World, outcome: &mut Outcome| {
        if pushed(me).w <= 0.0 {
            return;
        }
        let turn = me.all(STATES)[STATE * solve as usize];
        let unknown = me.numbers(UNKNOWNS);
        let [before, reached, relaxation, source] = [0, 1, 2, 3].map(|member| unknown[member]);
        let residual = source - world.dt * world.dt * change;
        let next = (before - relaxation * residual).max(0.0);
        let onward = (next + turn / (turn + 3.0) * (next - reached)).max(0.0);
        outcome.set(UNKNOWNS, DVec4::new(onward, next, relaxation, source));
        let error = if relaxation == 0.0 { (-residual).max(0.0) } else { (next - before).abs() / relaxation };
        outcome.set(ERRORS, error);
    };
    let mut search = of.searching(PUSHED, &[UNKNOWNS, PUSHES, ERRORS]);
    search.files.push(crate::shader!("sph/dfsph/change.wgsl"));
    search.constants.push(("SOLVE", f64::from(solve as u32)));
    let (name, wgsl) = (format!("fluid {} correct", solve.name()), crate::shader!("sph/dfsph/correct.wgsl"));
    let gather = change(of.medium);
    of.sweep(Law::searching(&name, &of.grid, search, wgsl, &[UNKNOWNS, ERRORS], gather, finish))
}
