//! One value everywhere.

use std::sync::Arc;

use super::{bounded, pass};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Name, Pass};

/// `field[i] = value` for i < `elements`, of a field of `u32`.
///
/// # Errors
/// [`Error::Limit`] when there are more than [`MOST`](super::MOST) elements.
pub fn fill(field: &Name, elements: u32, value: u32) -> Result<Kernel, Error> {
    let name = field.clone();
    let reference = move |host: &Host| {
        host.writing::<u32>(&name)?.iter_mut().take(elements as usize).for_each(|item| *item = value);
        Ok(())
    };
    Ok(Kernel {
        name: format!("fill {field}"),
        passes: passes(field, elements, value)?,
        reference: Some(Arc::new(reference)),
        sizes: vec![(field.clone(), u64::from(elements))],
        scratch: Vec::new(),
        tables: Vec::new(),
    })
}

/// The dispatches alone, for a larger kernel.
///
/// # Errors
/// As [`fill`].
pub fn passes(field: &Name, elements: u32, value: u32) -> Result<Vec<Pass>, Error> {
    bounded("fill", elements)?;
    let source = crate::shader!("primitives/fill.wgsl");
    let extent = [("elements", elements), ("value", value)];
    let pass = pass(&[source], elements, elements, &[("items", field.clone())], &extent)?;
    let each = pass.shader.reflection().constant("EACH");
    let threads = crate::kernel::Threads::new(elements.div_ceil(each));
    Ok(vec![Pass { threads, ..pass }])
}
