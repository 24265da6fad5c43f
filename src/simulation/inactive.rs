//! Which components are compatible with spawning and removal.

use crate::error::Error;
use crate::forces::{Component, Over};
use crate::integrators::Integrator;
use crate::interactions::gravity::SOFTENING_LENGTH;
use crate::kernel::{Column, Role, Shape};
use crate::state::State;

/// Checks whether forces and an integrator are compatible with inactive particles. Such a particle is in no cell list, has no mass, and its
/// velocity is set to zero after every evaluation: this suffices for searches of a grid, for forces on each particle alone, and for
/// attraction by mass. It does not suffice for links.
///
/// # Errors
/// [`Error::Scene`] that names the component that is not compatible.
pub fn serves(particles: &State, forces: &[Box<dyn Component>], integrator: &dyn Integrator) -> Result<(), Error> {
    let refuse = |text: String| Err(Error::Scene(text));
    let merges = forces.iter().any(|force| force.properties().removes);
    if !particles.has_inactive() && !merges {
        return Ok(());
    }
    if merges {
        serves_mergers(forces, integrator)?;
    }
    if integrator.is_implicit() {
        return refuse(
            "implicit integrators cannot be used where particles are spawned or removed: their equations contain all particles. Choose leapfrog".to_owned(),
        );
    }
    evaluate_active(forces)?;
    let links = &particles.links;
    let mut waits = vec![false; particles.len()];
    particles.births.iter().for_each(|birth| waits[birth.id as usize] = true);
    let springs = links.springs.iter().map(|link| link.ends).chain(links.rods.iter().map(|rod| rod.ends)).flatten();
    let corners = links.corners().flatten().copied();
    let idle = |id: &u32| waits.get(*id as usize).is_some_and(|waits| *waits) || !particles.is_active(*id as usize);
    let mut tied = springs.chain(corners);
    if !particles.drains.is_empty() && tied.next().is_some() {
        return refuse(
            "a drain removes particles, and some are linked: links cannot lose an end. Remove the drain or the links"
                .to_owned(),
        );
    }
    if merges && tied.next().is_some() {
        return refuse(
            "collide merges particles, and some are linked: links cannot lose an end. Set outcome = \"bounce\", or remove the links"
                .to_owned(),
        );
    }
    match tied.find(idle) {
        Some(id) => refuse(format!("particle {id} is linked, and is not active from the start: link other particles")),
        None => Ok(()),
    }
}

/// Refuses what a body that has merged would have of one of the two alone.
fn serves_mergers(forces: &[Box<dyn Component>], integrator: &dyn Integrator) -> Result<(), Error> {
    let refuse = |text: String| Err(Error::Scene(text));
    let of_each = |column: &Column| column.role == Role::State && column.shape == Shape::Particle;
    for force in forces.iter().filter(|force| force.properties().collides.is_none()) {
        // A softening is chosen, not conserved.
        if let Some(column) = force.columns().into_iter().find(|one| of_each(one) && one.name != SOFTENING_LENGTH) {
            return refuse(format!(
                "collide merges masses, momenta and volumes, and a body would have the `{}` of {} of one of the two alone: set outcome = \"bounce\", or leave \
                 one of both out",
                column.name,
                force.name()
            ));
        }
    }
    if let Some(column) = integrator.columns().into_iter().find(of_each) {
        return refuse(format!(
            "collide merges bodies, and {} keeps the `{}` of each for the next step: choose leapfrog",
            integrator.name(),
            column.name
        ));
    }
    Ok(())
}

/// Refuses laws that treat inactive particles as active ones.
pub(super) fn evaluate_active(forces: &[Box<dyn Component>]) -> Result<(), Error> {
    let refuse = |text: String| Err(Error::Scene(text));
    for force in forces {
        for law in force.laws() {
            let (name, over) = (&law.name, law.over.name());
            match law.over {
                Over::Each
                | Over::Near { .. }
                | Over::Nearest { .. }
                | Over::List { .. }
                | Over::Auto { .. }
                | Over::Links
                | Over::Joints
                | Over::Dihedrals
                | Over::Triangles => {}
                _ if force.properties().ignores_massless => {}
                _ => {
                    return refuse(format!(
                        "`{name}` over \"{over}\" evaluates all pairs, and where particles are spawned or removed, some are inactive: choose over = \
                         \"near\", which evaluates active particles alone"
                    ));
                }
            }
        }
    }
    Ok(())
}
