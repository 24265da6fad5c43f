//! Bindings that a user's law may use: its own buffers, and fields that motes lets it read.

use naga::{AddressSpace, Block, Expression, Function, GlobalVariable, ResourceBinding, Statement, StorageAccess};

use super::Joined;
use crate::error::Error;
use crate::kernel::{ACCELERATION, ALARM, HOME, LIFE, POSITION, SPECIES, TARGET, VELOCITY};

/// The bind group of a law's own bindings.
const GROUP: u32 = 3;
/// Binding numbers must be below this: WebGPU guarantees no more.
const BINDINGS: u32 = 1000;
/// Fields that every simulation has, or whose names are reserved. Those of a particular plan are checked when there is one.
const FIELDS: [&str; 8] =
    [POSITION.name, VELOCITY.name, ACCELERATION.name, SPECIES.name, LIFE.name, TARGET.name, HOME.name, ALARM.name];

/// Refuses a law with an entry point, with bindings that are not its own, with writes to fields of motes, or with operations that wait for
/// other invocations.
pub fn check(joined: &Joined) -> Result<(), Error> {
    for source in joined.sources.iter().filter(|source| source.law) {
        if source.has_entry_points() {
            let message = format!(
                "{}: a law must not contain an entry point: motes calls its functions from entry points of its own",
                source.file
            );
            return Err(Error::Shader { message });
        }
    }
    let variables = &joined.module.global_variables;
    for (handle, variable) in variables.iter().filter(|(handle, _)| joined.is_law(variables.get_span(*handle))) {
        binding(variable).map_err(|message| joined.fault(&message, variables.get_span(handle), "here"))?;
    }
    for (_, function) in joined.functions() {
        names(joined, function)?;
        waits(joined, &function.body)?;
    }
    Ok(())
}

/// The names of storage that the law writes.
pub fn written(joined: &Joined) -> Vec<String> {
    let variables = &joined.module.global_variables;
    let own = variables.iter().filter(|(handle, _)| joined.is_law(variables.get_span(*handle)));
    let storage = own
        .filter(|(_, variable)| matches!(variable.space, AddressSpace::Storage { .. }) && is_written(variable.space));
    storage.filter_map(|(_, variable)| variable.name.clone()).collect()
}

/// The fault of a variable of a law.
fn binding(variable: &GlobalVariable) -> Result<(), String> {
    let name = variable.name.as_deref().unwrap_or_default();
    let Some(ResourceBinding { group, binding }) = variable.binding else { return Ok(()) };
    if group != GROUP || binding >= BINDINGS {
        return Err(format!(
            "`{name}` is bound at group {group}, binding {binding}: a law binds its own in group {GROUP}, with bindings from 0 to {}",
            BINDINGS - 1
        ));
    }
    match variable.space {
        AddressSpace::Uniform if name != "params" => Err(format!(
            "`{name}` is a uniform block: a law has one, `params`, which its scene fills; bind a storage buffer"
        )),
        AddressSpace::Storage { access } if access.contains(StorageAccess::STORE) && FIELDS.contains(&name) => {
            Err(format!("`{name}` is a buffer that only motes writes: choose another name for what the law writes"))
        }
        AddressSpace::Uniform | AddressSpace::Storage { .. } => Ok(()),
        _ => Err(format!("`{name}` is neither a storage buffer nor `params`: a law binds nothing else")),
    }
}

/// Whether a shader may write in an address space, or all other code of the invocation or the workgroup does.
fn is_written(space: AddressSpace) -> bool {
    match space {
        AddressSpace::Storage { access } => access.contains(StorageAccess::STORE),
        AddressSpace::Private | AddressSpace::WorkGroup => true,
        _ => false,
    }
}

fn names(joined: &Joined, function: &Function) -> Result<(), Error> {
    for (handle, expression) in function.expressions.iter() {
        let Expression::GlobalVariable(global) = *expression else { continue };
        let variable = &joined.module.global_variables[global];
        let theirs = joined.is_law(joined.module.global_variables.get_span(global));
        if !theirs && is_written(variable.space) {
            let name = variable.name.as_deref().unwrap_or_default();
            let message = format!(
                "`{name}` is a buffer that only motes writes, while the law runs: a law reads the arguments of its functions \
                 and the columns that it binds, and motes adds what it returns"
            );
            return Err(joined.fault(&message, function.expressions.get_span(handle), "not for a law"));
        }
    }
    Ok(())
}

/// Refuses operations in which other invocations must take part: lanes evaluate different particles, and some run alone.
fn waits(joined: &Joined, block: &Block) -> Result<(), Error> {
    for (statement, span) in block.span_iter() {
        let what = match statement {
            Statement::ControlBarrier(_) | Statement::MemoryBarrier(_) | Statement::WorkGroupUniformLoad { .. } => {
                "barrier"
            }
            Statement::SubgroupBallot { .. }
            | Statement::SubgroupGather { .. }
            | Statement::SubgroupCollectiveOperation { .. } => "subgroup operation",
            Statement::Block(inner) => {
                waits(joined, inner)?;
                continue;
            }
            Statement::If { accept, reject, .. } => {
                waits(joined, accept)?;
                waits(joined, reject)?;
                continue;
            }
            Statement::Switch { cases, .. } => {
                cases.iter().try_for_each(|case| waits(joined, &case.body))?;
                continue;
            }
            Statement::Loop { body, continuing, .. } => {
                waits(joined, body)?;
                waits(joined, continuing)?;
                continue;
            }
            _ => continue,
        };
        let message = format!(
            "a law must not contain a {what}: its functions are called for one particle at a time, by some invocations of a workgroup and not \
             by others, which would wait forever"
        );
        return Err(joined.fault(&message, *span, "remove it"));
    }
    Ok(())
}
