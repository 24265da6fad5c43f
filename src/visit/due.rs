//! The particles that are due, in block time steps: the targets of laws that are evaluated of no others.

use std::sync::Arc;

use super::{Law, Over};
use crate::error::Error;
use crate::kernel::{ACCELERATION, DUE, Field, Host, Kernel, Pass, Problem, Reference, Shader};
use crate::primitives::scan;

/// The number of particles that are due, and their rows.
pub(super) const ROWS: &str = "due_rows";
const DUE_ROWS: Field<u32> = Field::new(ROWS);
/// The number of particles before each that are due.
const BEFORE: &str = "due_before";

impl Law {
    /// Whether it is evaluated of particles that are due alone: one that accelerates, by all pairs or a tree, in block time steps.
    #[must_use]
    pub fn of_due(&self, problem: &Problem) -> bool {
        let searched = matches!(self.chosen(problem), Over::Pairs | Over::Within { .. } | Over::Tree { .. });
        problem.block_steps.is_some() && searched && self.into == [ACCELERATION.name]
    }
}

/// Lists the particles that are due.
///
/// # Errors
/// When a shader does not compile, or there are more particles than a scan takes.
pub fn rows(problem: &Problem) -> Result<Kernel, Error> {
    let (elements, before) = (problem.capacity.saturating_add(1), crate::kernel::Name::from(BEFORE));
    let each = |file| Ok::<_, Error>(Pass::new(Shader::join(&[crate::shader!("world.wgsl"), file])?, elements));
    let sums = scan::scratch(&before);
    let mut passes = vec![each(crate::shader!("visit/due_count.wgsl"))?];
    passes.extend(scan::passes(&before, &sums, elements, &problem.machine)?);
    passes.push(each(crate::shader!("visit/due_rows.wgsl"))?);
    let reference = |host: &Host| {
        let (due, mut rows) = (host.read(DUE)?, host.write(DUE_ROWS)?);
        let listed: Vec<u32> = (0..).zip(due.iter()).filter(|(_, due)| **due != 0).map(|(row, _)| row).collect();
        rows[0] = u32::try_from(listed.len()).unwrap_or(u32::MAX);
        rows[1..=listed.len()].copy_from_slice(&listed);
        Ok(())
    };
    Ok(Kernel {
        name: "list due".to_owned(),
        passes,
        reference: Some(Arc::new(reference)),
        sizes: vec![
            (BEFORE.into(), u64::from(elements)),
            (ROWS.into(), u64::from(elements)),
            (sums.clone(), scan::blocks(elements, &problem.machine)),
        ],
        scratch: vec![sums, before],
        tables: Vec::new(),
    })
}

/// A reference that leaves the accelerations of others as they are.
pub(super) fn of_due(reference: Reference) -> Reference {
    Arc::new(move |host| {
        let before = host.read(ACCELERATION)?.to_vec();
        reference(host)?;
        let (rows, mut acceleration) = (host.read(DUE_ROWS)?, host.write(ACCELERATION)?);
        let mut due = rows.iter().skip(1).take(rows[0] as usize).peekable();
        for (row, (a, before)) in (0..).zip(acceleration.iter_mut().zip(before)) {
            if due.next_if(|next| **next == row).is_none() {
                *a = before;
            }
        }
        Ok(())
    })
}
