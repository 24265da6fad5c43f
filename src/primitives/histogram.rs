//! The number of keys in each bin.

use std::sync::Arc;

use super::{bounded, fill, pass, workgroups};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Machine, Name};

/// `counts[b]` = the number of i < `elements` with `keys[i]` = b, for b < `bins`; `counts[bins]` = the number of keys that
/// are `bins` or more, which must not be dropped unseen. `counts` so has `bins` + 1 elements.
///
/// # Errors
/// [`Error::Limit`] when there are more than [`MOST`](super::MOST) elements, or as many bins.
pub fn histogram(keys: &Name, counts: &Name, elements: u32, bins: u32, machine: &Machine) -> Result<Kernel, Error> {
    bounded("a histogram", elements)?;
    bounded("a histogram's counts", bins.saturating_add(1))?;
    let fields = [("keys", keys.clone()), ("counts", counts.clone())];
    let extent = [("elements", elements), ("bins", bins)];
    let few = pass(&[crate::shader!("primitives/histogram_few.wgsl")], 1, elements, &fields, &extent)?;
    let constant = |name| few.shader.reflection().constant(name);
    let (block, most) = (constant("BLOCK"), constant("MOST"));
    // Atomics of a software adapter do not contend, whatever the bins.
    let count = if machine.software || bins >= most {
        pass(&[crate::shader!("primitives/histogram.wgsl")], elements, elements, &fields, &extent)?
    } else {
        workgroups(few, elements.div_ceil(block))
    };
    let mut passes = fill::passes(counts, bins + 1, 0)?;
    passes.push(count);
    let (from, to) = (keys.clone(), counts.clone());
    let reference = move |host: &Host| {
        let keys = host.reading::<u32>(&from)?;
        let mut counts = host.writing::<u32>(&to)?;
        counts.iter_mut().take(bins as usize + 1).for_each(|count| *count = 0);
        for key in keys.iter().take(elements as usize) {
            counts[(*key).min(bins) as usize] += 1;
        }
        Ok(())
    };
    Ok(Kernel {
        name: format!("histogram {keys}"),
        passes,
        reference: Some(Arc::new(reference)),
        sizes: vec![(keys.clone(), elements.into()), (counts.clone(), u64::from(bins) + 1)],
        scratch: Vec::new(),
        tables: Vec::new(),
    })
}
