//! Fields that kernels fill with contents of their own: those of one name have the same, since a device has one of them.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::error::Error;
use crate::kernel::Plan;

/// Refuses two kernels that fill a field of one name with contents that differ: the second would read those of the first.
///
/// # Errors
/// [`Error::Scene`] with the field and the kernels.
pub(super) fn agree<'a>(plans: impl Iterator<Item = &'a Plan>) -> Result<(), Error> {
    let mut known = BTreeMap::new();
    for kernel in plans.flat_map(|plan| &plan.kernels) {
        for (name, words) in &kernel.tables {
            let (first, its) = *known.entry(name).or_insert((&kernel.name, words));
            if !Arc::ptr_eq(its, words) && its != words {
                return Err(Error::Scene(format!(
                    "`{first}` and `{}` fill the field `{name}` with different contents: give one of them a field of another name",
                    kernel.name
                )));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::{Kernel, Shader};

    fn filling(name: &str, words: [u32; 2]) -> Plan {
        let files = [crate::shader!("world.wgsl"), crate::shader!("integrators/clear.wgsl")];
        let kernel = Kernel::new(name, Shader::join(&files).expect("a shader"), Vec::new(), 1, Arc::new(|_| Ok(())));
        Plan::of([Kernel { tables: vec![("table".into(), Arc::new(words.to_vec()))], ..kernel }])
    }

    #[test]
    fn contents_that_differ_are_refused() {
        let (one, same, other) = (filling("one", [1, 2]), filling("two", [1, 2]), filling("three", [1, 3]));
        assert!(agree([&one, &same].into_iter()).is_ok());
        let refused = agree([&one, &same, &other].into_iter()).expect_err("two contents").to_string();
        assert!(refused.contains("`one` and `three` fill the field `table`"), "{refused}");
    }
}
