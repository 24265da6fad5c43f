//! A kernel of one invocation for each particle, with the information which ones are free.

use crate::error::Error;
use crate::kernel::{Kernel, Pass, Problem, Reference, Shader, Source};

/// Joins the shader `file`, which may call `is_held`, with its reference; it runs over all rows.
pub(crate) fn each(name: &str, file: Source, problem: &Problem, reference: Reference) -> Result<Kernel, Error> {
    let (holding, tables) = problem.holding();
    let shader = Shader::join(&[crate::shader!("world.wgsl"), holding, file])?;
    let passes = vec![Pass { alone: true, ..Pass::new(shader, problem.capacity) }];
    let (sizes, scratch) = (Vec::new(), Vec::new());
    Ok(Kernel { name: name.to_owned(), passes, reference: Some(reference), sizes, scratch, tables })
}
