//! Columns that a user's file reads and nothing writes, or that a later law computes.

use std::collections::BTreeSet;

use super::Plans;
use crate::error::Error;
use crate::kernel::{ACCELERATION, ALARM, Access, Columns, Plan, Role};

/// Refuses a user's shader that reads a field that neither the state holds nor any kernel of the plans writes: a misspelt name, or a column
/// that no law computes.
pub(super) fn check(plans: &Plans, columns: &Columns) -> Result<(), Error> {
    let kernels = || plans.all().flat_map(|plan| &plan.kernels);
    if kernels().all(|kernel| kernel.passes.iter().all(|pass| pass.shader.trusted())) {
        return Ok(());
    }
    let written: BTreeSet<String> = kernels().flat_map(crate::kernel::Kernel::writes).collect();
    let held = |name: &str| columns.of_buffer(name).any(|column| column.role == Role::State);
    for kernel in kernels() {
        for pass in kernel.passes.iter().filter(|pass| !pass.shader.trusted()) {
            for (name, binding) in pass.bindings().filter(|(_, binding)| binding.access == Access::Read) {
                let table = kernel.tables.iter().any(|(table, _)| table == name);
                // A binding under another name in the shader belongs to a visit: a cell list, which an earlier kernel fills.
                if table || held(name) || written.contains(name) || name == ALARM.name || name != binding.name {
                    continue;
                }
                let file = pass.shader.sources().iter().find(|source| !source.ours).map_or("", |source| &source.file);
                let known: Vec<&str> = columns.iter().filter(|c| !c.is_packed()).map(|c| c.name.as_ref()).collect();
                let message = match columns.get(name) {
                    Some(_) => {
                        format!("{file} reads the column `{name}`, which nothing computes: add a force that writes it")
                    }
                    None => format!(
                        "{file}: nothing fills the field `{name}`; the columns are {} (a scene declares more: [[column]] name = \"{name}\")",
                        known.join(", ")
                    ),
                };
                return Err(Error::Shader { message });
            }
        }
    }
    Ok(())
}

/// Refuses a user's shader that reads a column before all of it is computed: in an evaluation laws follow one another as in the scene, so that
/// it would have values of the evaluation before. `plan` has one evaluation.
pub(super) fn in_order(plan: &Plan, columns: &Columns) -> Result<(), Error> {
    let computed = |name: &str| {
        let column = columns.get(name).filter(|column| column.place.buffer != ACCELERATION.name);
        column.is_some_and(|column| column.role != Role::State)
    };
    for (place, kernel) in plan.kernels.iter().enumerate() {
        for pass in kernel.passes.iter().filter(|pass| !pass.shader.trusted()) {
            for (name, _) in pass.bindings().filter(|(name, one)| one.access == Access::Read && computed(name)) {
                let mut later = plan.kernels.iter().skip(place + 1);
                let Some(later) = later.find(|kernel| kernel.writes().iter().any(|written| written == name)) else {
                    continue;
                };
                let file = pass.shader.sources().iter().find(|source| !source.ours).map_or("", |source| &source.file);
                return Err(Error::Scene(format!(
                    "{file} reads the column `{name}`, which `{}` computes after it in an evaluation, so that its values would be those of the \
                     evaluation before: put the force that computes `{name}` before the one that reads it",
                    later.name
                )));
            }
        }
    }
    Ok(())
}
