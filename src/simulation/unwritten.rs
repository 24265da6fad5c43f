//! Columns that a user's file reads and nothing writes.

use std::collections::BTreeSet;

use super::Plans;
use crate::error::Error;
use crate::kernel::{ALARM, Access, Columns, Role};

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
