//! Kernels that treat each particle alone, fused: neighbours in a plan become one dispatch, which moves the data of a particle once.
//! A plan stays as it is; a backend asks for the fused one when it compiles.

use std::collections::HashSet;
use std::fmt::Write as _;
use std::sync::Arc;

use super::merge::Merged;
use super::{ALARM, Access, Host, Kernel, Name, Op, Pass, Plan, Reference, Shader};

/// Storage buffers of a shader, by WebGPU's default limits.
const STORAGE: usize = 8;
/// Uniform blocks of a shader, `world` among them. The limit is 12; llvmpipe of Mesa 22.3 ends by a signal now and then with 11.
const UNIFORMS: usize = 6;
/// Expressions in the shader of a user's law that is fused: a driver takes long for a large one, and has compiled it for the start already.
const LAW_EXPRESSIONS: usize = 500;
/// Bytes of workgroup memory of a shader, by WebGPU's default limits.
const WORKGROUP_BYTES: u64 = 16_384;

impl Plan {
    /// The same operations, in which kernels that follow one another and treat each particle alone are one kernel.
    #[must_use]
    pub fn fused(&self) -> Self {
        let mut plan = Self::default();
        plan.ops = self.fused_ops(&self.ops, &mut plan);
        plan
    }
    fn fused_ops(&self, ops: &[Op], into: &mut Self) -> Vec<Op> {
        let (mut made, mut row): (Vec<Op>, Vec<&Kernel>) = (Vec::new(), Vec::new());
        for op in ops {
            let kernel = match op {
                Op::Run(index) => self.kernels.get(*index),
                Op::Repeat { .. } => None,
            };
            if kernel.is_none_or(|kernel| !joins(kernel, &row)) {
                into.close(&mut row, &mut made);
            }
            match op {
                Op::Run(_) => row.extend(kernel),
                Op::Repeat { most, until, body } => {
                    let body = self.fused_ops(body, into);
                    made.push(Op::Repeat { most: *most, until: until.clone(), body });
                }
            }
        }
        into.close(&mut row, &mut made);
        made
    }
    /// Adds a row of kernels as one, or one by one where they cannot be fused.
    fn close(&mut self, row: &mut Vec<&Kernel>, made: &mut Vec<Op>) {
        let fused = if row.len() > 1 { fused(row) } else { None };
        let kernels = fused.map_or_else(|| row.iter().copied().cloned().collect(), |kernel| vec![kernel]);
        made.extend(kernels.into_iter().map(|kernel| Op::Run(self.place(kernel))));
        row.clear();
    }
}

/// The dispatch of a kernel that treats each particle alone.
fn alone(kernel: &Kernel) -> Option<&Pass> {
    match kernel.passes.as_slice() {
        [pass] if pass.alone && pass.indirect.is_none() && pass.threads.layers <= 1 => Some(pass),
        _ => None,
    }
}

/// Whether a kernel can be fused with a row of others, to run after them: as many particles, and buffers within the limits of a shader.
fn joins(kernel: &Kernel, row: &[&Kernel]) -> bool {
    let (Some(last), Some(next)) = (row.last().and_then(|last| alone(last)), alone(kernel)) else { return false };
    let alike =
        last.threads == next.threads && last.shader.reflection().workgroup == next.shader.reflection().workgroup;
    let (mut storage, mut blocks) = (HashSet::new(), HashSet::new());
    for (place, kernel) in row.iter().copied().chain([kernel]).enumerate() {
        for (field, binding) in kernel.bindings() {
            match binding.access {
                Access::Uniform => blocks.insert((field, has_contents(kernel, &binding.name).then_some(place))),
                Access::Read | Access::Write => storage.insert(field),
            };
        }
    }
    let all = || row.iter().copied().chain([kernel]);
    let bytes: u64 = all().filter_map(alone).map(|pass| pass.shader.reflection().workgroup_bytes).sum();
    // An error of a driver names the only law that is not of this crate.
    let own: Vec<&Kernel> = all().filter(|kernel| is_own(kernel)).collect();
    alike
        && own.len() <= 1
        && own.iter().all(|kernel| expressions(kernel) <= LAW_EXPRESSIONS)
        && bytes <= WORKGROUP_BYTES
        && storage.len() <= STORAGE
        && blocks.len() <= UNIFORMS
        && row.iter().all(|before| !meets(before, kernel))
}

/// Whether a kernel has a file that is not of this crate.
fn is_own(kernel: &Kernel) -> bool {
    kernel.passes.iter().any(|pass| !pass.shader.trusted())
}

/// The expressions of its shaders.
fn expressions(kernel: &Kernel) -> usize {
    let of = |module: &naga::Module| {
        let entries = module.entry_points.iter().map(|entry| entry.function.expressions.len());
        module.functions.iter().map(|(_, function)| function.expressions.len()).chain(entries).sum::<usize>()
    };
    kernel.passes.iter().map(|pass| of(pass.shader.module())).sum()
}

/// Whether two kernels use a field that one of them writes, and that does not have one element for each particle: an element belongs to none.
/// The words of the alarm are maxima and minima, in any order.
fn meets(one: &Kernel, other: &Kernel) -> bool {
    one.bindings().any(|(field, binding)| {
        let mut its = other.bindings().filter(|(name, _)| *name == field).map(|(_, its)| its);
        its.any(|its| {
            let written = [binding, its].iter().any(|binding| binding.access == Access::Write);
            let sized = [one, other].iter().any(|kernel| kernel.size(field).is_some()) || !(binding.array && its.array);
            written && sized && field != ALARM.name
        })
    })
}

/// Whether a uniform block of a kernel has contents of its own.
fn has_contents(kernel: &Kernel, name: &str) -> bool {
    kernel.passes.iter().flat_map(|pass| &pass.uniforms).any(|(known, _)| *known == name)
}

/// The kernels as one; `None` where their shaders have something that is not merged.
fn fused(row: &[&Kernel]) -> Option<Kernel> {
    let passes: Vec<&Pass> = row.iter().filter_map(|kernel| alone(kernel)).collect();
    let (first, mut merged) = (*passes.first()?, Merged::new());
    let mut text = String::new();
    for pass in &passes {
        merged.add(pass)?;
        let _ = writeln!(text, "{}\n// {:?} {:?}", pass.shader.text(), pass.constants, pass.fields);
    }
    let uniforms = merged.take_uniforms();
    let shader = Arc::new(Shader::merged(&passes, text, merged.module(first.shader.reflection().workgroup))?);
    let pass = Pass {
        uniforms,
        alone: true,
        work: passes.iter().map(|pass| pass.work).max().unwrap_or(0),
        ..Pass::new(shader, first.threads.count)
    };
    let references: Option<Vec<Reference>> = row.iter().map(|kernel| kernel.reference.clone()).collect();
    let reference = references
        .map(|all| -> Reference { Arc::new(move |host: &Host| all.iter().try_for_each(|reference| reference(host))) });
    let all = |of: fn(&Kernel) -> &Vec<(Name, u64)>| row.iter().flat_map(|kernel| of(kernel).clone()).collect();
    Some(Kernel {
        name: row.iter().map(|kernel| kernel.name.as_str()).collect::<Vec<_>>().join(" + "),
        passes: vec![pass],
        reference,
        sizes: all(|kernel| &kernel.sizes),
        scratch: row.iter().flat_map(|kernel| kernel.scratch.clone()).collect(),
        tables: row.iter().flat_map(|kernel| kernel.tables.clone()).collect(),
    })
}
