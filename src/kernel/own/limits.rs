//! Size limits of a user's law. Drivers inline each function at every call and keep small arrays in registers: one line of text can take
//! minutes and all memory of the machine to compile.

use std::collections::HashMap;

use naga::proc::GlobalCtx;
use naga::{AddressSpace, Block, Function, Handle, Statement, TypeInner};

use super::Joined;
use crate::error::Error;

/// Bytes of arrays in one invocation, each counted at every call of its function: lavapipe compiles 1 KiB of them in about a second, 4 KiB
/// in half a minute and 16 KiB in more than three.
const MEMORY: u64 = 4 << 10;
/// The same, including the visit, which calls a law some hundred times.
const MEMORY_OF_VISIT: u64 = 32 << 10;
/// Bytes of a value, or of a constant.
const VALUE: u64 = 4 << 10;
/// Expressions and statements, each counted at every call of its function.
const NODES: u64 = 100_000;
/// The same, including the visit.
const NODES_OF_VISIT: u64 = 1_000_000;

/// The size of a function, including all that it calls.
#[derive(Clone, Copy, Default)]
struct Size {
    memory: u64,
    nodes: u64,
}

impl Size {
    fn plus(self, other: Self) -> Self {
        Self { memory: self.memory.saturating_add(other.memory), nodes: self.nodes.saturating_add(other.nodes) }
    }
}

/// Refuses a law that takes drivers minutes to compile.
pub fn check(joined: &Joined) -> Result<(), Error> {
    constants(joined)?;
    let module = joined.module;
    let mut sizes = HashMap::new();
    let private = private(joined);
    for (handle, function) in joined.functions() {
        values(joined, handle, function)?;
        let size = size(joined, handle, &mut sizes);
        let name = function.name.as_deref().unwrap_or_default();
        let span = module.functions.get_span(handle);
        let memory = size.memory.saturating_add(private);
        if memory > MEMORY {
            let message = format!(
                "`{name}`, with what it calls and with private memory, has {memory} bytes of arrays; a driver takes minutes to \
                 compile more than {MEMORY}: use a smaller array, or a storage buffer"
            );
            return Err(joined.fault(&message, span, "here"));
        }
        if size.nodes > NODES {
            let message = format!(
                "`{name}` is {} operations long, where each function is counted as often as it is called; a driver takes minutes \
                 to compile more than {NODES}: call fewer functions, or repeat by loops",
                size.nodes
            );
            return Err(joined.fault(&message, span, "here"));
        }
    }
    // The visit calls the law for many pairs in a row, and keeps a `Sum` for each.
    let entry = module.entry_points.first().map(|entry| sum(joined, &entry.function, &mut sizes)).unwrap_or_default();
    let entry = entry.plus(Size { memory: private, nodes: 0 });
    if entry.memory > MEMORY_OF_VISIT || entry.nodes > NODES_OF_VISIT {
        let file = joined.sources.iter().find(|source| source.law).map_or("a law", |source| &source.file);
        return Err(Error::Shader {
            message: format!(
                "{file}: with the visit that calls it the law is {} operations long and has {} bytes of arrays; a driver takes \
                 minutes to compile more than {NODES_OF_VISIT} or {MEMORY_OF_VISIT}: use a smaller `Sum` and smaller arrays, and \
                 call less",
                entry.nodes, entry.memory
            ),
        });
    }
    Ok(())
}

fn bytes(inner: &TypeInner, context: GlobalCtx) -> u64 {
    match inner {
        TypeInner::Pointer { .. } | TypeInner::ValuePointer { .. } => 0,
        inner => inner.try_size(context).map_or(u64::MAX, u64::from),
    }
}

/// Bytes of a variable with computed indices; drivers keep others in registers, and only the parts in use.
fn indexed(module: &naga::Module, ty: Handle<naga::Type>) -> u64 {
    match &module.types[ty].inner {
        inner @ TypeInner::Array { .. } => bytes(inner, module.to_ctx()),
        TypeInner::Struct { members, .. } => {
            members.iter().map(|member| indexed(module, member.ty)).fold(0, u64::saturating_add)
        }
        _ => 0,
    }
}

fn constants(joined: &Joined) -> Result<(), Error> {
    let module = joined.module;
    for (handle, constant) in module.constants.iter() {
        let size = bytes(&module.types[constant.ty].inner, module.to_ctx());
        if size > VALUE {
            let name = constant.name.as_deref().unwrap_or_default();
            let message = format!(
                "the constant `{name}` has {size} bytes; a driver takes minutes to compile more than {VALUE}: use a storage buffer"
            );
            return Err(joined.fault(&message, module.constants.get_span(handle), "here"));
        }
    }
    Ok(())
}

/// Bytes of private memory.
fn private(joined: &Joined) -> u64 {
    let module = joined.module;
    let private = module.global_variables.iter().filter(|(_, variable)| variable.space == AddressSpace::Private);
    private.map(|(_, variable)| indexed(module, variable.ty)).fold(0, u64::saturating_add)
}

/// Refuses values that are too large for the registers of many processors.
fn values(joined: &Joined, handle: Handle<Function>, function: &Function) -> Result<(), Error> {
    for (expression, _) in function.expressions.iter() {
        let inner = joined.info[handle][expression].ty.inner_with(&joined.module.types);
        let size = bytes(inner, joined.module.to_ctx());
        if size > VALUE && !matches!(inner, TypeInner::Array { size: naga::ArraySize::Dynamic, .. }) {
            let message = format!(
                "this value has {size} bytes; a driver takes minutes to compile more than {VALUE}: read the element that is \
                 wanted, or use a smaller array"
            );
            return Err(joined.fault(&message, function.expressions.get_span(expression), "here"));
        }
    }
    Ok(())
}

/// The size of a function. It is not recursive: that was validated.
fn size(joined: &Joined, handle: Handle<Function>, known: &mut HashMap<Handle<Function>, Size>) -> Size {
    if let Some(size) = known.get(&handle) {
        return *size;
    }
    let size = sum(joined, &joined.module.functions[handle], known);
    known.insert(handle, size);
    size
}

fn sum(joined: &Joined, function: &Function, known: &mut HashMap<Handle<Function>, Size>) -> Size {
    let module = joined.module;
    let variables = function.local_variables.iter().map(|(_, variable)| indexed(module, variable.ty));
    let memory = variables.fold(0, u64::saturating_add);
    let mut size = Size { memory, nodes: function.expressions.len() as u64 };
    let mut calls = Vec::new();
    size.nodes += statements(&function.body, &mut calls);
    for callee in calls {
        size = size.plus(self::size(joined, callee, known));
    }
    size
}

/// Counts the statements of a block, and collects its calls.
fn statements(block: &Block, calls: &mut Vec<Handle<Function>>) -> u64 {
    let mut count = 0;
    for statement in block {
        count += 1;
        match statement {
            Statement::Block(inner) => count += statements(inner, calls),
            Statement::If { accept, reject, .. } => count += statements(accept, calls) + statements(reject, calls),
            Statement::Switch { cases, .. } => {
                count += cases.iter().map(|case| statements(&case.body, calls)).sum::<u64>();
            }
            Statement::Loop { body, continuing, .. } => {
                count += statements(body, calls) + statements(continuing, calls);
            }
            Statement::Call { function, .. } => calls.push(*function),
            _ => {}
        }
    }
    count
}
