//! Sorting by keys that are few: count, scan, scatter, and end the race inside each bin.

use std::sync::Arc;

use super::{bounded, fill, pass, scan};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Machine, Name, Pass};

/// The maximum number of elements in one bin whose order is made ascending: a quarter of a billion comparisons, which a small GPU does in 0.1 s.
pub const LARGEST: u32 = 1 << 14;

/// The fields of a counting sort.
#[derive(Debug, Clone)]
pub struct Fields {
    /// The keys, `elements` of `u32`.
    pub keys: Name,
    /// The start of each bin in `order`, `bins` + 1 of them: the last one is the start of the keys of `bins` and more, which must not be
    /// dropped silently. It ends with the elements.
    pub starts: Name,
    /// The ids of the elements, bin by bin, ascending in each.
    pub order: Name,
    /// The number of elements in the fullest bin, 1 of `u32`. Beyond [`LARGEST`] the order inside such bins is undefined: code that relies
    /// on the order must check this.
    pub largest: Name,
}

/// Sorts ids by their keys: stable, so the same on every run, as long as no bin holds more than [`LARGEST`].
///
/// # Errors
/// [`Error::Limit`] when there are more than [`MOST`](super::MOST) elements, or as many bins.
pub fn counting_sort(fields: &Fields, elements: u32, bins: u32, machine: &Machine) -> Result<Kernel, Error> {
    bounded("a sort", elements)?;
    bounded("a sort's bins", bins.saturating_add(1))?;
    let Fields { keys, starts, order, largest } = fields;
    let [ranks, arrivals]: [Name; 2] = ["ranks", "arrivals"].map(|what| format!("{order}_{what}").into());
    let sums = scan::scratch(starts);
    let own = [
        ("keys", keys.clone()),
        ("starts", starts.clone()),
        ("order", order.clone()),
        ("largest", largest.clone()),
        ("ranks", ranks.clone()),
        ("arrivals", arrivals.clone()),
    ];
    let extent = [("elements", elements), ("bins", bins)];
    let each = |source| pass(&[source], elements, elements, &own, &extent);
    let mut passes = fill::passes(starts, bins + 1, 0)?;
    passes.extend(fill::passes(largest, 1, 0)?);
    passes.push(each(crate::shader!("primitives/sort_count.wgsl"))?);
    passes.extend(scan::passes(starts, &sums, bins + 1, machine)?);
    passes.push(each(crate::shader!("primitives/sort_scatter.wgsl"))?);
    let constants = vec![("LARGEST", f64::from(LARGEST))];
    passes.push(Pass { constants, ..each(crate::shader!("primitives/sort_settle.wgsl"))? });
    let n = u64::from(elements);
    Ok(Kernel {
        name: format!("sort {keys}"),
        passes,
        reference: Some(reference(fields, elements, bins)),
        sizes: vec![
            (keys.clone(), n),
            (starts.clone(), u64::from(bins) + 1),
            (order.clone(), n),
            (largest.clone(), 1),
            (ranks.clone(), n),
            (arrivals.clone(), n),
            (sums.clone(), scan::blocks(bins + 1, machine)),
        ],
        scratch: vec![ranks, arrivals, sums],
        tables: Vec::new(),
    })
}

fn reference(fields: &Fields, elements: u32, bins: u32) -> crate::kernel::Reference {
    let fields = fields.clone();
    Arc::new(move |host: &Host| {
        let keys = host.reading::<u32>(&fields.keys)?;
        let bin = |id: u32| keys[id as usize].min(bins) as usize;
        let mut counts = vec![0; bins as usize + 1];
        (0..elements).for_each(|id| counts[bin(id)] += 1);
        let largest = counts.iter().copied().max().unwrap_or(0);
        scan::exclusive(&mut counts, usize::MAX);
        let mut ids: Vec<u32> = (0..elements).collect();
        ids.sort_by_key(|id| bin(*id));
        let copy = |name: &Name, values: &[u32]| {
            host.writing::<u32>(name)?.iter_mut().zip(values).for_each(|(to, from)| *to = *from);
            Ok::<_, Error>(())
        };
        copy(&fields.starts, &counts)?;
        copy(&fields.order, &ids)?;
        copy(&fields.largest, &[largest])
    })
}
