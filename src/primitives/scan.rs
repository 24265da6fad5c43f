//! The exclusive scan (prefix sum).
//!
//! Reduce, then scan (Dotsenko et al. 2008): blocks are summed, the sums scanned, the blocks scanned from there. No
//! workgroup waits for another, so no device can hang that promises no progress.

use std::sync::Arc;

use super::{bounded, pass, workgroups};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Machine, Name, Pass};

/// Elements that one workgroup scans alone: below, two more dispatches cost more than they gain.
const ALONE: u32 = 8192;
/// Elements that a workgroup of the GPU's variant holds; `TILE` in `scan_tile.wgsl`.
const TILE: u32 = 2048;
/// Chunks of the variant for software adapters, at most; one invocation scans their sums.
const CHUNKS: u32 = 1 << 14;
/// Elements of such a chunk, at least.
const CHUNK: u32 = 1024;

/// `field[i] = field[0] + … + field[i − 1]` for i < `elements`, in place, of a field of `u32`; sums wrap at 2³². With a
/// last element of 0, that holds the sum of all.
///
/// # Errors
/// [`Error::Limit`] when there are more than [`MOST`](super::MOST) elements.
pub fn scan(field: &Name, elements: u32, machine: &Machine) -> Result<Kernel, Error> {
    let sums = scratch(field);
    let name = field.clone();
    let reference = move |host: &Host| {
        exclusive(&mut host.writing::<u32>(&name)?, elements as usize);
        Ok(())
    };
    Ok(Kernel {
        name: format!("scan {field}"),
        passes: passes(field, &sums, elements, machine)?,
        reference: Some(Arc::new(reference)),
        sizes: vec![(field.clone(), u64::from(elements)), (sums.clone(), blocks(elements, machine))],
        scratch: vec![sums],
        tables: Vec::new(),
    })
}

/// The name of the field of sums that [`scan`] needs.
#[must_use]
pub fn scratch(field: &Name) -> Name {
    format!("{field}_sums").into()
}

/// The elements of that field, at least: no fewer for more elements of the scanned one.
#[must_use]
pub fn blocks(elements: u32, machine: &Machine) -> u64 {
    let blocks = if machine.software { elements.div_ceil(CHUNK).min(CHUNKS) } else { elements.div_ceil(TILE) };
    blocks.max(1).into()
}

/// The dispatches alone, for a larger kernel: it lists `sums` among its scratch, with [`blocks`] elements.
///
/// # Errors
/// As [`scan`].
pub fn passes(field: &Name, sums: &Name, elements: u32, machine: &Machine) -> Result<Vec<Pass>, Error> {
    bounded("a scan", elements)?;
    let alone = |field: &Name, elements: u32| {
        let serial = [crate::shader!("primitives/scan_serial.wgsl")];
        let line = [crate::shader!("primitives/scan_tile.wgsl"), crate::shader!("primitives/scan_line.wgsl")];
        let sources: &[_] = if machine.software { &serial } else { &line };
        pass(sources, 1, elements, &[("items", field.clone())], &[("elements", elements)])
    };
    if elements <= ALONE {
        return Ok(vec![alone(field, elements)?]);
    }
    let fields = [("items", field.clone()), ("sums", sums.clone())];
    if machine.software {
        let chunk = chunk(elements);
        let chunks = elements.div_ceil(chunk);
        let extent = [("elements", elements), ("chunk", chunk)];
        let (first, last) =
            (crate::shader!("primitives/scan_chunk_sums.wgsl"), crate::shader!("primitives/scan_chunks.wgsl"));
        return Ok(vec![
            pass(&[first], chunks, elements, &fields, &extent)?,
            alone(sums, chunks)?,
            pass(&[last], chunks, elements, &fields, &extent)?,
        ]);
    }
    let tiles = elements.div_ceil(TILE);
    let extent = [("elements", elements)];
    let first = pass(&[crate::shader!("primitives/scan_sums.wgsl")], tiles, elements, &fields, &extent)?;
    let last = [crate::shader!("primitives/scan_tile.wgsl"), crate::shader!("primitives/scan_blocks.wgsl")];
    let last = pass(&last, tiles, elements, &fields, &extent)?;
    Ok(vec![workgroups(first, tiles), alone(sums, tiles)?, workgroups(last, tiles)])
}

/// Elements of a chunk of the variant for software adapters: an invocation's loop stays far below 65 535 iterations.
fn chunk(elements: u32) -> u32 {
    elements.div_ceil(CHUNKS).max(CHUNK)
}

/// The reference.
pub(super) fn exclusive(items: &mut [u32], elements: usize) {
    let mut before = 0u32;
    for item in items.iter_mut().take(elements) {
        let next = before.wrapping_add(*item);
        *item = before;
        before = next;
    }
}
