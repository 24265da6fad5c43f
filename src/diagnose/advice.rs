//! Remarks on a setup before it runs.

use std::collections::BTreeSet;

use crate::error::Error;
use crate::forces::{Law, Over};
use crate::kernel::Bounds;
use crate::kernel::Side;
use crate::kernel::{ACCELERATION, Array, Host, Machine, POSITION, Reference, SPECIES, VELOCITY, World};
use crate::links::Links;
use crate::motion::Hold;
use crate::simulation::Setup;
use glam::{DVec3, DVec4};

use super::{Remark, births, crowds, jumps, rounding, solves};

/// The acceleration of a particle at rest at a position, by a law's reference.
pub fn acceleration_at(
    reference: &Reference,
    (time, step): (f64, u32),
    position: DVec3,
    bounds: Bounds,
) -> Result<DVec4, Error> {
    let mut host = Host::default();
    host.insert(POSITION.name, Array::Vec4(vec![position.extend(1.3)]));
    host.insert(VELOCITY.name, Array::Vec4(vec![DVec4::ZERO]));
    host.insert(ACCELERATION.name, Array::Vec4(vec![DVec4::ZERO]));
    host.set_world(World { time, dt: 1.0, step, count: 1, free: 0, bounds });
    reference(&host)?;
    Ok(host.read(ACCELERATION)?.first().copied().unwrap_or_default())
}

/// Whether a law does the same at another time, and to the particle's images in a periodic box.
fn keeps_energy(reference: &Reference, bounds: &Bounds) -> Result<bool, Error> {
    let x = DVec3::new(0.31, -0.23, 0.17);
    let here = acceleration_at(reference, (0.0, 0), x, *bounds)?;
    let image = acceleration_at(reference, (0.0, 0), x + bounds.period(), *bounds)?;
    // Images are where they are up to rounding; time takes part or does not.
    let alike = (here - image).abs().max_element() <= 1e-9 * here.abs().max_element();
    Ok(alike && here == acceleration_at(reference, (0.7, 3), x, *bounds)?)
}

/// Whether a law leaves the first particles of a flat world in their plane.
fn in_the_plane(name: &str, reference: &Reference, setup: &Setup) -> Result<(), Error> {
    let particles = &setup.state;
    let some = particles.len().min(64);
    let mut host = Host::default();
    let places = particles.position()[..some].iter().zip(particles.mass()).map(|(x, m)| x.extend(*m)).collect();
    let ways = particles.velocity()[..some].iter().zip(particles.size()).map(|(v, r)| v.extend(*r)).collect();
    host.insert(POSITION.name, Array::Vec4(places));
    host.insert(VELOCITY.name, Array::Vec4(ways));
    host.insert(SPECIES.name, Array::Uint(particles.species()[..some].to_vec()));
    host.insert(ACCELERATION.name, Array::Vec4(vec![DVec4::ZERO; some]));
    let count = u32::try_from(some).unwrap_or(0);
    host.set_world(World { time: 0.0, dt: setup.dt, step: 0, count, free: 0, bounds: setup.bounds });
    reference(&host)?;
    let across = host.read(ACCELERATION)?.iter().map(|a| a.z).find(|z| z.abs() > 0.0);
    across.map_or(Ok(()), |z| {
        Err(Error::Scene(format!(
            "`{name}` accelerates out of the plane (by {z:e}), where particles must stay in 2 dimensions: give its vectors no z, or \
             say dimensions = 3 in [box]"
        )))
    })
}

/// The quantities that a run conserves.
#[derive(Debug, Clone)]
pub struct Conserved {
    /// The total energy.
    pub energy: bool,
    /// The forces that change them, if any.
    pub takers: Vec<&'static str>,
    /// The momentum.
    pub momentum: bool,
    /// The angular momentum.
    pub angular_momentum: bool,
    /// What alone changes it, if anything does, where it would be conserved.
    pub turners: Vec<&'static str>,
}

/// Whether any spring is damped.
fn damped(links: &Links) -> bool {
    links.springs.iter().any(|spring| spring.damping > 0.0)
}

/// Links that exert no force, because no law evaluates them. Triangles may exist for pictures only.
fn idle(links: &Links, laws: &[Law]) -> Vec<Remark> {
    let ties = [
        (links.springs.len(), Over::Links, "springs", "spring"),
        (links.joints.len(), Over::Joints, "joints", "joint"),
        (links.dihedrals.len(), Over::Dihedrals, "dihedrals", "dihedral"),
    ];
    let idle = ties.into_iter().filter(|(n, over, ..)| *n > 0 && laws.iter().all(|law| law.over != *over));
    idle.map(|(n, _, what, force)| {
        Remark::note("idle-links", format!("no force acts on the {what} ({n} of them)"))
            .with("links", n as f64)
            .advice(format!("add a [[force]] of kind = \"{force}\""))
    })
    .collect()
}

/// The laws of a setup but those of a method, for which its component answers by properties.
fn of_pairs(setup: &Setup) -> impl Iterator<Item = Law> {
    setup.forces.iter().flat_map(|force| force.laws()).filter(|law| law.outlined.is_none())
}

/// The quantities that all forces and the sides of the box conserve. A mirror changes momentum and conserves energy; in a periodic box
/// momentum is conserved, and the angular momentum is meaningless.
///
/// # Errors
/// When the setup is invalid.
pub fn conserved(setup: &Setup) -> Result<Conserved, Error> {
    let setup = &*setup.in_its_box()?;
    let (periodic, reflecting) = (setup.bounds.has(Side::Periodic), setup.bounds.has(Side::Reflecting));
    let mut conserved = Conserved {
        energy: true,
        takers: Vec::new(),
        momentum: !reflecting,
        angular_momentum: !reflecting && !periodic,
        turners: Vec::new(),
    };
    let problem = setup.problem(MACHINE)?;
    for law in of_pairs(setup) {
        conserved.momentum &= law.reciprocal;
        conserved.angular_momentum &= law.reciprocal;
        // Forces that are not equal and opposite conserve nothing.
        conserved.energy &= law.over == Over::Each || law.reciprocal;
        if matches!(law.over, Over::Links | Over::Joints | Over::Dihedrals | Over::Triangles) {
            // Only the links matter here; damping dissipates energy.
            conserved.energy &= law.over != Over::Links || !damped(&setup.state.links);
            continue;
        }
        // What depends on velocity takes energy, and what keeps history of pairs is no function of positions.
        conserved.energy &= match &law.reference {
            Some(reference) if law.accelerates() && !law.remembers() && !law.depends_on_velocity(&problem)? => {
                keeps_energy(reference, &setup.bounds)?
            }
            _ => false,
        };
    }
    // Broken springs lose their energy.
    conserved.energy &= !setup.breaks();
    // Fixed particles take momentum; prescribed motions do work as well.
    let held = &setup.state.held;
    conserved.momentum &= held.is_empty();
    conserved.angular_momentum &= held.is_empty();
    conserved.energy &= held.iter().all(|one| one.by == Hold::Fixed);
    // Projections of velocities or positions conserve neither energy nor momentum; nor do births and drains.
    let mut constrained = setup.state.has_inactive();
    for properties in setup.forces.iter().map(|force| force.properties()) {
        conserved.turners.extend(properties.turns);
        conserved.takers.extend(properties.dissipates);
        conserved.takers.extend(properties.dissipates_at_walls.into_iter().filter(|_| !held.is_empty()));
        constrained |= properties.constrains;
    }
    for names in [&mut conserved.takers, &mut conserved.turners] {
        let mut known = BTreeSet::new();
        names.retain(|name| known.insert(*name));
    }
    conserved.energy &= conserved.takers.is_empty();
    if constrained {
        conserved = Conserved { energy: false, momentum: false, angular_momentum: false, ..conserved };
    }
    if !conserved.angular_momentum {
        conserved.turners.clear();
    }
    conserved.angular_momentum &= conserved.turners.is_empty();
    Ok(conserved)
}

const MACHINE: Machine = Machine::HOST;

/// Particles that begin inside of a solid, or nearer to it than its thickness, are put out of it in the first step.
fn inside(setup: &Setup) -> Result<Option<Remark>, Error> {
    let moved = setup.put_out()?;
    let Some((first, depth)) = moved.first() else { return Ok(None) };
    let deepest = moved.iter().map(|(_, depth)| *depth).fold(0.0, f64::max);
    let text = format!(
        "{} of {} particles start inside of an obstacle, or closer to it than its thickness, the first is particle {first}, by {depth:.3e}, \
         and by {deepest:.3e} at most: the initial projection moves them out, without regard to other particles",
        moved.len(),
        setup.state.len()
    );
    let remark = Remark::note("inside-solid", text).with("particles", moved.len() as f64);
    Ok(Some(remark.with("particle", *first as f64).with("largest_depth", deepest)))
}

/// Remarks on the combination of forces, obstacles, motions and the integrator of a setup, in a run that ends at `end`, if given.
///
/// # Errors
/// [`Error::Scene`] when a force leads out of the plane of a flat box, or the setup is invalid.
pub fn advice(setup: &Setup, end: Option<f64>) -> Result<Vec<Remark>, Error> {
    let setup = &*setup.in_its_box()?;
    let mut remarks = Vec::new();
    remarks.extend(inside(setup)?);
    remarks.extend(end.into_iter().flat_map(|end| births::early(setup, end)));
    let end = end.unwrap_or(f64::INFINITY);
    remarks.extend(super::baths::remark(setup));
    remarks.extend(rounding::crossings(setup));
    remarks.extend(jumps::remarks(setup, end));
    let problem = setup.problem(MACHINE)?;
    let laws: Vec<Law> = of_pairs(setup).collect();
    remarks.extend(idle(&setup.state.links, &laws));
    remarks.extend(super::bonds::overlong(setup, &laws));
    remarks.extend(super::images::beyond(setup, &laws));
    remarks.extend(super::images::neutralized(setup));
    let implicit = setup.integrator.is_implicit();
    if implicit {
        remarks.push(solves::remark(setup)?);
    }
    let (order, reduced) = (setup.integrator.order(), setup.integrator.order_with_velocity());
    let loses = reduced < order || implicit && order > 1;
    // What keeps history is evaluated once in a step.
    let keeps_history = laws.iter().any(Law::remembers) || setup.forces.iter().any(|force| force.properties().history);
    let depends = |name: &str| {
        let with_it = if implicit { 1 } else { reduced };
        let text = format!(
            "`{name}` depends on velocity: {} is of order {order} for other forces, and of order {with_it} with it",
            setup.integrator.name()
        );
        Remark::note("reduced-order", text).with("order", f64::from(with_it)).advice(if keeps_history {
            "choose a smaller dt"
        } else {
            "midpoint, heun and rk4 keep their order"
        })
    };
    for force in setup.forces.iter().filter(|force| force.properties().makes_fluid) {
        let rates = force.resolved(&problem)?.rates.unwrap_or_default();
        remarks.extend((loses && rates.friction.max(rates.drawn) > 0.0).then(|| depends("fluid")));
    }
    for law in laws {
        let name = law.name.clone();
        let (without_reference, over, offered) = (law.reference.is_none(), law.over, law.jacobian.is_some());
        let (all_images, is_own) = (law.distant.images, law.wgsl.law);
        if let Some(reference) = law.reference.as_ref().filter(|_| setup.bounds.dimensions == 2 && law.accelerates()) {
            in_the_plane(&name, reference, setup)?;
        }
        let reads_velocity = law.depends_on_velocity(&problem)?;
        let solved = implicit && offered;
        // Velocities count in the springs of the house where they are damped, and nowhere else.
        let calm = over == Over::Links && !without_reference && !damped(&setup.state.links);
        if reads_velocity && !calm && !solved && loses {
            remarks.push(depends(&name));
        }
        if over == Over::Pairs && setup.bounds.has(Side::Periodic) && !all_images {
            let text = format!("`{name}` in a periodic box acts on nearest images only, without an Ewald sum");
            let remark = Remark::note("nearest-images", text);
            // With the spline there are no images, and a user's law of that name has no such setting.
            remarks.push(if name == "gravity" && !is_own {
                remark.advice("set images = \"ewald\", in a cube that is periodic on all sides")
            } else {
                remark
            });
        }
        if let Over::Near { of: Some(kind), .. } = over
            && !setup.state.species().contains(&kind)
        {
            let text = format!("`{name}` acts on species {kind}, and no particle is of that species");
            remarks.push(Remark::note("absent-species", text).with("species", f64::from(kind)));
        }
        if without_reference {
            let text = format!("`{name}` has no f64 reference: it is not verified, and requires a device");
            remarks.push(Remark::note("no-reference", text));
        }
    }
    let name = setup.integrator.name();
    for (force, properties) in setup.forces.iter().map(|force| (force, force.properties())) {
        if let Some(length) = properties.largest_move {
            let speed = length / setup.dt;
            let text = format!(
                "the fluid's dt = {} is for speeds up to {speed:.3}: in one step no particle should move farther than {length:.3e}",
                setup.dt
            );
            let remark = Remark::note("largest-speed", text).with("dt", setup.dt).with("largest_speed", speed);
            remarks.push(Remark { advice: properties.caution.map(str::to_owned), ..remark });
        }
        let its = properties.integrators;
        if its.is_empty() {
            continue;
        }
        if properties.evaluated_last && properties.makes_fluid {
            if !its.contains(&name) {
                let text = format!(
                    "the fluid solves for the pressure of a whole step, evaluated at its start: it requires {}, not {name}",
                    its.join(" or ")
                );
                remarks.push(Remark::note("other-integrator", text));
            }
            continue;
        }
        if !its.contains(&name) {
            let law = force.laws().first().map(|law| law.name.clone()).unwrap_or_default();
            let text = format!("`{law}` is a rule for whole steps: it requires {}, not {name}", its.join(" or "));
            remarks.push(Remark::note("other-integrator", text));
        }
        if properties.sets_velocities {
            remarks.extend(crowds::overridden(setup, force.name()));
        } else if setup.forces.iter().filter(|force| !force.laws().is_empty()).count() > 1 {
            let text = format!(
                "{} sets velocities itself: combined with other forces it is only a relaxation towards them",
                force.laws().first().map_or_else(String::new, |law| format!("`{}`", law.name))
            );
            remarks.push(Remark::note("velocities-set", text));
        }
    }
    if !setup.state.links.rods.is_empty() && order > 2 {
        let text = format!("with rods {name} is of order 2, as leapfrog is, which costs less");
        remarks.push(Remark::note("reduced-order", text).with("order", 2.0));
    }
    if name == "forward_euler" && setup.forces.iter().all(|force| !force.properties().integrators.contains(&name)) {
        let text = "forward_euler gains energy in every step, at any dt: it is here for comparison only";
        remarks.push(Remark::note("gains-energy", text));
    }
    Ok(remarks)
}
