//! The pressure at the end of every so many steps: one kernel out of the virials of all laws.

use std::sync::Arc;

use glam::{DVec4, Vec4};

use super::barostat::{TOTAL, due};
use super::{Component, Stage, earlier};
use crate::error::Error;
use crate::kernel::{Field, Host, Indirect, Kernel, Name, POSITION, Pass, Plan, Problem, Reference, Shader, VELOCITY};
use crate::primitives::{Items, Operation, reduce};
use crate::visit::{VIRIAL, clear_virial, no_virial};

/// m v², the virial, and whether forces add up, of each particle.
const PARTS: Field<Vec4> = Field::new("pressure_parts");
/// Indirect arguments of its dispatches: the present ones, and those when it is due.
const GO: &str = "arguments of the pressure";
pub(crate) const ALL: &str = "pressure_all";
/// Words of the arguments of a dispatch.
const EACH: u32 = 3;
/// The part of the sizes of the forces on a particle by which they may fail to add up: some hundred roundings of single precision.
pub(crate) const ROUNDING: f64 = 1e-4;

/// The kernels that compute the virial of all forces of pairs after an evaluation.
///
/// # Errors
/// [`Error::Scene`] with the force that has none.
pub(crate) fn virial(forces: &[Box<dyn Component>], problem: &Problem) -> Result<Vec<Kernel>, Error> {
    if !problem.network.rods.is_empty() {
        return Err(no_virial("rod", "constrains distances"));
    }
    if let Some(force) = forces.iter().find(|force| force.properties().limits_links) {
        return Err(no_virial(force.name(), "constrains distances"));
    }
    let mut kernels = vec![clear_virial(problem)?];
    for (place, force) in forces.iter().enumerate() {
        if force.properties().makes_fluid {
            return Err(no_virial(force.name(), "has more than the forces of pairs"));
        }
        let laws = force.laws();
        let mut evaluated = Plan::default();
        force.stage(Stage::Evaluate { earlier: 0 }, &mut evaluated, problem)?;
        let before = earlier(forces, place);
        let mut beside = Plan::default();
        force.stage(Stage::Virial { earlier: before }, &mut beside, problem)?;
        if evaluated.kernels.len() > laws.len() && beside.kernels.is_empty() {
            let name = laws.first().map_or_else(|| force.name().to_owned(), |law| law.name.clone());
            return Err(no_virial(&name, "has more than the forces of pairs"));
        }
        for law in laws {
            kernels.extend(law.after(before).virial(problem)?);
        }
        kernels.extend(beside.kernels);
    }
    Ok(kernels)
}

/// The kernel that measures the parts of the pressure.
///
/// # Errors
/// Those of [`virial`].
pub(crate) fn kernel(forces: &[Box<dyn Component>], problem: &Problem, every: u32) -> Result<Kernel, Error> {
    let mut parts = virial(forces, problem)?;
    parts.push(measure(problem)?);
    let (field, total): (Name, Name) = (PARTS.name.into(), TOTAL.name.into());
    parts.push(reduce(Operation::Sum, Items::Vec4, &field, &total, problem.capacity, &problem.machine)?);
    let references: Option<Vec<Reference>> = parts.iter().map(|part| part.reference.clone()).collect();
    let reference = references.map(|all| -> Reference {
        Arc::new(
            move |host: &Host| {
                if due(&host.world(), every) { all.iter().try_for_each(|part| part(host)) } else { Ok(()) }
            },
        )
    });
    let (mut passes, mut words) = (Vec::new(), Vec::new());
    let (mut sizes, mut scratch, mut tables) = (Vec::new(), vec![Name::from(GO)], Vec::new());
    for part in parts {
        for mut pass in part.passes {
            let word = u32::try_from(words.len()).unwrap_or(u32::MAX);
            words.extend(pass.workgroups(problem.machine.workgroups)?);
            pass.indirect = Some(Indirect { field: GO.into(), word, rests: false });
            pass.work /= u64::from(every);
            passes.push(pass);
        }
        sizes.extend(part.sizes);
        scratch.extend(part.scratch);
        tables.extend(part.tables);
    }
    let count = u64::from(EACH) * passes.len() as u64;
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("barostat/due.wgsl")])?;
    let constants = vec![("EVERY", f64::from(every)), ("WORDS", count as f64)];
    let decide = Pass { constants, ..Pass::new(shader, 1) }.on(&[("pressure_go", GO.into())]);
    passes.insert(0, decide);
    sizes.extend([(Name::from(GO), count), (ALL.into(), count)]);
    tables.push((ALL.into(), Arc::new(words)));
    Ok(Kernel { name: format!("pressure EVERY={every}"), passes, reference, sizes, scratch, tables })
}

/// The parts of each particle.
fn measure(problem: &Problem) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("barostat/measure.wgsl")])?;
    let reference = |host: &Host| {
        let (position, velocity, virial) = (host.read(POSITION)?, host.read(VELOCITY)?, host.read(VIRIAL)?);
        let of = |(x, v): (&DVec4, &DVec4), two: &[DVec4]| {
            let adds_up = two[0].w <= ROUNDING * two[1].w;
            let twice = x.w * v.truncate().length_squared();
            DVec4::new(twice, two[0].truncate().element_sum(), f64::from(u8::from(!adds_up)), 0.0)
        };
        let parts = position.iter().zip(velocity.iter()).zip(virial.chunks_exact(2));
        host.write(PARTS)?.iter_mut().zip(parts).for_each(|(part, (one, two))| *part = of(one, two));
        Ok(())
    };
    let constants = vec![("ROUNDING", ROUNDING)];
    let kernel = Kernel::new("pressure measure", shader, constants, problem.capacity, Arc::new(reference));
    Ok(Kernel { sizes: vec![(VIRIAL.name.into(), 2 * u64::from(problem.capacity))], ..kernel })
}
