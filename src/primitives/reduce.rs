//! One element out of many: sum, minimum, maximum.

use std::sync::Arc;

use glam::DVec4;

use super::{bounded, pass, workgroups};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Machine, Name, Reference, Source};

/// The operation on two elements.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Operation {
    /// Their sum; of integers it wraps at 2³².
    Sum,
    /// The lesser; of vectors, component by component. A NaN stays one.
    Min,
    /// The greater, likewise.
    Max,
}

/// The elements to reduce.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Which {
    All,
    /// Those of rows in use.
    Rows,
}

/// The type of the elements.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Items {
    /// `vec4f`
    Vec4,
    /// `u32`
    Uint,
}

impl Operation {
    fn name(self) -> &'static str {
        match self {
            Self::Sum => "sum",
            Self::Min => "min",
            Self::Max => "max",
        }
    }
    fn source(self) -> Source {
        match self {
            Self::Sum => crate::shader!("primitives/reduce_sum.wgsl"),
            Self::Min => crate::shader!("primitives/reduce_min.wgsl"),
            Self::Max => crate::shader!("primitives/reduce_max.wgsl"),
        }
    }
    /// The neutral element.
    fn neutral(self, items: Items) -> u32 {
        match (self, items) {
            (Self::Sum, _) | (Self::Max, Items::Uint) => 0,
            (Self::Min, Items::Uint) => u32::MAX,
            (Self::Min, Items::Vec4) => f32::INFINITY.to_bits(),
            (Self::Max, Items::Vec4) => f32::NEG_INFINITY.to_bits(),
        }
    }
}

/// `into[0]` = the operation over `field[i]`, i < `elements`; of no elements 0, infinity (or 2³² − 1), −infinity (or 0).
/// A fixed tree: the same elements on the same machine give the same bits.
///
/// # Errors
/// [`Error::Limit`] when there are more than [`MOST`](super::MOST) elements.
pub fn reduce(
    operation: Operation,
    items: Items,
    field: &Name,
    into: &Name,
    elements: u32,
    machine: &Machine,
) -> Result<Kernel, Error> {
    reduction(operation, items, field, into, elements, machine, Which::All)
}

/// The same over the rows that are in use, of so many: behind those the field holds nothing.
///
/// # Errors
/// As [`reduce`].
pub fn rows(
    operation: Operation,
    items: Items,
    field: &Name,
    into: &Name,
    elements: u32,
    machine: &Machine,
) -> Result<Kernel, Error> {
    reduction(operation, items, field, into, elements, machine, Which::Rows)
}

fn reduction(
    operation: Operation,
    items: Items,
    field: &Name,
    into: &Name,
    elements: u32,
    machine: &Machine,
    which: Which,
) -> Result<Kernel, Error> {
    bounded("a reduction", elements)?;
    let what = match items {
        Items::Vec4 => crate::shader!("primitives/reduce_vec4.wgsl"),
        Items::Uint => crate::shader!("primitives/reduce_uint.wgsl"),
    };
    let sources = |which: Which| {
        let end = match which {
            Which::All => crate::shader!("primitives/reduce_all.wgsl"),
            Which::Rows => crate::shader!("primitives/reduce_rows.wgsl"),
        };
        [what.clone(), operation.source(), end, crate::shader!("primitives/reduce.wgsl")]
    };
    let neutral = operation.neutral(items);
    let reduction = |from: &Name, to: &Name, elements: u32, block: u32, which: Which| {
        let fields = [("items", from.clone()), ("results", to.clone())];
        let extent = [("elements", elements), ("block", block), ("neutral", neutral)];
        Ok::<_, Error>(workgroups(
            pass(&sources(which), 1, elements, &fields, &extent)?,
            elements.div_ceil(block).max(1),
        ))
    };
    // Barriers cost more on a software adapter, so that its blocks are longer.
    let block = if machine.software { 1 << 15 } else { 1 << 12 };
    let blocks = elements.div_ceil(block);
    let parts: Name = format!("{into}_parts").into();
    let passes = if blocks <= 1 {
        vec![reduction(field, into, elements, block, which)?]
    } else {
        vec![reduction(field, &parts, elements, block, which)?, reduction(&parts, into, blocks, blocks, Which::All)?]
    };
    Ok(Kernel {
        name: format!("{} {field}", operation.name()),
        passes,
        reference: Some(reference(operation, items, field, into, elements, which)),
        sizes: vec![(field.clone(), elements.into()), (into.clone(), 1), (parts.clone(), blocks.max(1).into())],
        scratch: vec![parts],
        tables: Vec::new(),
    })
}

fn reference(operation: Operation, items: Items, field: &Name, into: &Name, elements: u32, which: Which) -> Reference {
    let (field, into, elements) = (field.clone(), into.clone(), elements as usize);
    Arc::new(move |host: &Host| {
        let used = if which == Which::Rows { host.world().count as usize } else { usize::MAX };
        let elements = elements.min(used);
        match items {
            Items::Uint => {
                let from = host.reading::<u32>(&field)?;
                let all = from.iter().take(elements).copied();
                let result = match operation {
                    Operation::Sum => all.fold(0, u32::wrapping_add),
                    Operation::Min => all.fold(u32::MAX, u32::min),
                    Operation::Max => all.fold(0, u32::max),
                };
                host.writing::<u32>(&into)?.iter_mut().take(1).for_each(|r| *r = result);
            }
            Items::Vec4 => {
                let from = host.reading::<glam::Vec4>(&field)?;
                let all = from.iter().take(elements).copied();
                let result = match operation {
                    Operation::Sum => all.fold(DVec4::ZERO, |a, b| a + b),
                    Operation::Min => all.fold(DVec4::INFINITY, |a, b| each(a, b, f64::min)),
                    Operation::Max => all.fold(DVec4::NEG_INFINITY, |a, b| each(a, b, f64::max)),
                };
                host.writing::<glam::Vec4>(&into)?.iter_mut().take(1).for_each(|r| *r = result);
            }
        }
        Ok(())
    })
}

/// Component by component; what is not a number stays so.
fn each(a: DVec4, b: DVec4, of: impl Fn(f64, f64) -> f64) -> DVec4 {
    let both = |a: f64, b: f64| if a.is_nan() || b.is_nan() { f64::NAN } else { of(a, b) };
    DVec4::new(both(a.x, b.x), both(a.y, b.y), both(a.z, b.z), both(a.w, b.w))
}
