//! Sorting by keys with a large range: from the lowest digit to the highest, eight bits at a time, each move stable.
//!
//! A move counts the digits of each block, scans the table of counts digit by digit, and takes each key to its place
//! (reduce-then-scan: no workgroup waits for another). Eight bits at a time move the pairs half as often as four, at the
//! same work in a workgroup's memory, where a digit is sorted in two halves.

use std::sync::Arc;

use super::{bounded, pass, scan, workgroups};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Machine, Name, Pass, Reference};

/// Bits of a digit.
const DIGIT: u32 = 8;
/// Keys that a workgroup sorts at once; `TILE` in `radix_tile.wgsl`.
const TILE: u32 = 1024;
/// Tiles of a block, at most: more make the table no shorter than it need be.
const TILES: u32 = 16;
/// Chunks of the variant for software adapters, at most, so that the table stays small.
const CHUNKS: u32 = 1 << 13;
/// Keys of such a chunk, at least.
const CHUNK: u32 = 2048;

/// The division of the keys: keys per block, and blocks.
fn cut(elements: u32, machine: &Machine) -> (u32, u32) {
    let block = if machine.software {
        elements.div_ceil(CHUNKS).max(CHUNK)
    } else {
        let busy = (machine.invocations / 256).max(1);
        (elements.div_ceil(TILE) / busy).clamp(1, TILES) * TILE
    };
    (block, elements.div_ceil(block).max(1))
}

/// Sorts pairs in place by the lowest `bits` bits of their keys; pairs with the same bits stay in order. `keys` and `values` have
/// `elements` of `u32` each.
///
/// # Errors
/// [`Error::Limit`] when there are more than [`MOST`](super::MOST) elements, or more bits than 32.
pub fn radix_sort(keys: &Name, values: &Name, elements: u32, bits: u32, machine: &Machine) -> Result<Kernel, Error> {
    bounded("a sort", elements)?;
    if bits > 32 {
        return Err(Error::Limit(format!("a sort by {bits} bits: a key has 32")));
    }
    let (block, blocks) = cut(elements, machine);
    let [other_keys, other_values]: [Name; 2] = [keys, values].map(|name| format!("{name}_other").into());
    let table: Name = format!("{keys}_table").into();
    let sums = scan::scratch(&table);
    let (here, there) = ((keys, values), (&other_keys, &other_values));
    // By no bits all are the same, and stay where they are.
    let digits = bits.div_ceil(DIGIT).max(1);
    // The last of the moves to and fro must end here.
    let (mut from, mut to) = (here, there);
    let mut passes = Vec::new();
    if digits % 2 == 1 {
        let copy = [crate::shader!("primitives/radix_copy.wgsl")];
        passes.push(pass(&copy, elements, elements, &moved(from, to, &table), &[("elements", elements)])?);
        (from, to) = (there, here);
    }
    for shift in (0..digits).map(|digit| digit * DIGIT) {
        let mask = (1u32 << DIGIT.min(bits - shift)) - 1;
        let extent = [("elements", elements), ("block", block), ("blocks", blocks), ("shift", shift), ("mask", mask)];
        let fields = moved(from, to, &table);
        passes.push(count(elements, blocks, &fields, &extent, machine)?);
        passes.extend(scan::passes(&table, &sums, (mask + 1) * blocks, machine)?);
        passes.push(scatter(elements, blocks, &fields, &extent, machine)?);
        (from, to) = (to, from);
    }
    let (n, cells) = (u64::from(elements), (1 << bits.min(DIGIT)) * blocks);
    Ok(Kernel {
        name: format!("sort {keys}"),
        passes,
        reference: Some(reference(keys, values, elements, bits)),
        sizes: vec![
            (keys.clone(), n),
            (values.clone(), n),
            (other_keys.clone(), n),
            (other_values.clone(), n),
            (table.clone(), cells.into()),
            (sums.clone(), scan::blocks(cells, machine)),
        ],
        scratch: vec![other_keys, other_values, table, sums],
        tables: Vec::new(),
    })
}

type Fields = [(&'static str, Name); 5];

fn moved(from: (&Name, &Name), to: (&Name, &Name), table: &Name) -> Fields {
    [
        ("keys", from.0.clone()),
        ("values", from.1.clone()),
        ("sorted_keys", to.0.clone()),
        ("sorted_values", to.1.clone()),
        ("table", table.clone()),
    ]
}

fn count(
    elements: u32,
    blocks: u32,
    fields: &Fields,
    extent: &[(&str, u32)],
    machine: &Machine,
) -> Result<Pass, Error> {
    if machine.software {
        return pass(&[crate::shader!("primitives/radix_chunk_count.wgsl")], blocks, elements, fields, extent);
    }
    Ok(workgroups(pass(&[crate::shader!("primitives/radix_count.wgsl")], 1, elements, fields, extent)?, blocks))
}

fn scatter(
    elements: u32,
    blocks: u32,
    fields: &Fields,
    extent: &[(&str, u32)],
    machine: &Machine,
) -> Result<Pass, Error> {
    if machine.software {
        return pass(&[crate::shader!("primitives/radix_chunk_scatter.wgsl")], blocks, elements, fields, extent);
    }
    let sources = [crate::shader!("primitives/radix_tile.wgsl"), crate::shader!("primitives/radix_scatter.wgsl")];
    Ok(workgroups(pass(&sources, 1, elements, fields, extent)?, blocks))
}

fn reference(keys: &Name, values: &Name, elements: u32, bits: u32) -> Reference {
    let (keys, values) = (keys.clone(), values.clone());
    Arc::new(move |host: &Host| {
        let (mut keys, mut values) = (host.writing::<u32>(&keys)?, host.writing::<u32>(&values)?);
        let pairs = keys.iter().zip(values.iter()).take(elements as usize);
        let mut pairs: Vec<_> = pairs.map(|(key, value)| (*key, *value)).collect();
        let mask = u32::try_from((1u64 << bits) - 1).unwrap_or(u32::MAX);
        pairs.sort_by_key(|(key, _)| key & mask);
        for ((key, value), pair) in keys.iter_mut().zip(values.iter_mut()).zip(pairs) {
            (*key, *value) = pair;
        }
        Ok(())
    })
}
