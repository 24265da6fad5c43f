//! The number of instructions of a kernel in SPIR-V, as naga writes it for the driver.

use std::collections::HashMap;

use motes::kernel::Pass;
use naga::back::pipeline_constants::process_overrides;
use naga::back::spv;
use naga::valid::{Capabilities, ValidationFlags, Validator};

/// Numbers of instructions, with those of the functions that are called.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Instructions {
    /// Of the entry point.
    pub all: u64,
    /// Of one iteration of its longest innermost loop; 0 without loops.
    pub iteration: u64,
}

/// Words before the first instruction.
const HEADER: usize = 5;
const FUNCTION: u32 = 54;
const FUNCTION_END: u32 = 56;
const FUNCTION_CALL: u32 = 57;
const LOOP_MERGE: u32 = 246;
const LABEL: u32 = 248;

/// The instructions of the shader of a pass, with its constants; `None` if naga cannot write it.
pub fn instructions(pass: &Pass) -> Option<Instructions> {
    let module = pass.shader.module();
    let info = Validator::new(ValidationFlags::all(), Capabilities::all()).validate(module).ok()?;
    let (stage, entry) = (naga::ShaderStage::Compute, pass.shader.reflection().entry.clone());
    let constants = pass.constants.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    let (module, info) = process_overrides(module, &info, Some((stage, &entry)), &constants).ok()?;
    let mut options = spv::Options::default();
    options.flags.remove(spv::WriterFlags::DEBUG);
    options.force_loop_bounding = !pass.shader.trusted();
    let pipeline = spv::PipelineOptions { shader_stage: stage, entry_point: entry };
    Some(count(&spv::write_vec(&module, &info, &options, Some(&pipeline)).ok()?))
}

/// A loop that has not ended yet: the block after it, its instructions so far, and whether it contains another loop.
struct Loop {
    merge: u32,
    spent: u64,
    nested: bool,
}

/// Counts the instructions of the last function, which is the entry point; functions that it calls come before it.
fn count(words: &[u32]) -> Instructions {
    let mut functions: HashMap<u32, Instructions> = HashMap::new();
    let (mut name, mut own, mut loops) = (0, Instructions { all: 0, iteration: 0 }, Vec::<Loop>::new());
    let mut at = HEADER;
    while let Some(word) = words.get(at) {
        let (length, code) = ((word >> 16).max(1) as usize, word & 0xffff);
        let operand = |n: usize| words.get(at + n).copied().unwrap_or(0);
        let mut cost = 1;
        match code {
            FUNCTION => (name, own, cost) = (operand(2), Instructions { all: 0, iteration: 0 }, 0),
            FUNCTION_CALL => {
                let called = functions.get(&operand(3)).copied().unwrap_or(own);
                cost += called.all;
                own.iteration = own.iteration.max(called.iteration);
            }
            LABEL => {
                cost = 0;
                if let Some(done) = loops.pop_if(|inner| inner.merge == operand(1)) {
                    let body = if done.nested { 0 } else { own.all - done.spent };
                    own.iteration = own.iteration.max(body);
                }
            }
            LOOP_MERGE => {
                cost = 0;
                loops.iter_mut().for_each(|outer| outer.nested = true);
                loops.push(Loop { merge: operand(1), spent: own.all, nested: false });
            }
            FUNCTION_END => {
                functions.insert(name, own);
                cost = 0;
            }
            _ => {}
        }
        own.all += cost;
        at += length;
    }
    own
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use motes::kernel::{Pass, Shader, Source};

    use super::*;

    fn of(body: &str) -> Instructions {
        let text = format!(
            "var<workgroup> x: array<f32, 4>; override N: u32 = 3u;
             fn f(y: f32) -> f32 {{ return y * y + 1.0; }}
             @compute @workgroup_size(1) fn main() {{ {body} }}"
        );
        let source = Source::theirs("a.wgsl".to_owned(), text);
        let shader: Arc<Shader> = Shader::join(&[source]).expect("a shader");
        instructions(&Pass::new(shader, 1)).expect("SPIR-V")
    }

    #[test]
    fn loops_and_called_functions_are_counted() {
        let none = of("x[0] = 1.0;");
        assert_eq!(none.iteration, 0);
        let call = of("x[0] = f(x[0]);");
        assert!(call.all > none.all + 2, "{call:?} {none:?}");
        let turn = of("for (var i = 0u; i < N; i++) { x[0] += 1.0; }");
        let heavy = of("for (var i = 0u; i < N; i++) { x[0] += f(f(1.0)); }");
        assert!(turn.iteration > 0 && heavy.iteration >= turn.iteration + 4, "{heavy:?} {turn:?}");
        // The outer loop is not an innermost one.
        let nested = of(
            "for (var j = 0u; j < N; j++) { for (var i = 0u; i < N; i++) { x[0] += 1.0; } x[1] = f(f(f(f(x[2])))); }",
        );
        assert_eq!(nested.iteration, turn.iteration);
    }
}
