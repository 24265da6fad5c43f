//! Parallel primitives on arrays: fill, scan, reduce, histogram, two sorts. Each takes the names of the fields
//! that it works on, and lengths that the host knows; each is exact, and has an integer reference (sums of vectors excepted,
//! which round, by a fixed tree).
//!
//! Arrays have at most [`MOST`] elements. Where there are none, the same dispatches run and find nothing to do, so that
//! a plan and its fields look the same at every size.

pub mod counting_sort;
pub mod fill;
mod histogram;
mod radix_sort;
mod reduce;
pub mod scan;

pub use counting_sort::counting_sort;
pub use fill::fill;
pub use histogram::histogram;
pub use radix_sort::radix_sort;
pub use reduce::{Items, Operation, reduce, rows};
pub use scan::scan;

use crate::error::Error;
use crate::kernel::{Name, Pass, Scalar, Shader, Source, Threads};

/// Elements of an array, at most: a dispatch rounds their number up, and indices stay below 2³² with room to spare.
pub const MOST: u32 = 1 << 27;

/// A pass over fields that the shader names in its own way, with the values of its block `extent`.
fn pass(
    sources: &[Source],
    threads: u32,
    elements: u32,
    fields: &[(&'static str, Name)],
    extent: &[(&str, u32)],
) -> Result<Pass, Error> {
    let mut all = vec![crate::shader!("world.wgsl")];
    all.extend_from_slice(sources);
    let shader = Shader::join(&all)?;
    let values: Vec<_> = extent.iter().map(|(name, n)| (*name, Scalar::Uint(*n))).collect();
    let block = shader.reflection().binding("extent").map_or(Ok(Vec::new()), |b| b.packed.pack("extent", &values))?;
    let pass = Pass { uniforms: vec![("extent", block)], work: u64::from(elements), ..Pass::new(shader, threads) };
    Ok(pass.on(fields))
}

/// The same pass in so many workgroups.
fn workgroups(pass: Pass, groups: u32) -> Pass {
    let threads = Threads::new(groups * pass.shader.reflection().workgroup);
    Pass { threads, ..pass }
}

/// Refuses arrays whose indices a dispatch could not count.
fn bounded(what: &str, elements: u32) -> Result<(), Error> {
    if elements > MOST {
        let message = format!("{what} of {elements} elements: at most {MOST} fit one dispatch; use fewer");
        return Err(Error::Limit(message));
    }
    Ok(())
}
