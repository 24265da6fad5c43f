//! Fields that users' laws write, among those that all kernels of a simulation name.

use crate::error::Error;
use crate::kernel::{Columns, Kernel, Plan};

/// Refuses a law that writes a field of motes. Columns belong to no law: a law lists those that it writes.
///
/// # Errors
/// [`Error::Shader`] that names the law, the field and the kernel that it belongs to.
pub fn check<'a>(plans: &(impl Iterator<Item = &'a Plan> + Clone), columns: &Columns) -> Result<(), Error> {
    let kernels = || plans.clone().flat_map(|plan| &plan.kernels);
    let law = |kernel: &Kernel| {
        let mut sources = kernel.passes.iter().flat_map(|pass| pass.shader.sources());
        sources.find(|source| source.law).map(|source| source.file.clone())
    };
    for (kernel, file) in kernels().filter_map(|kernel| Some((kernel, law(kernel)?))) {
        let written = kernel.passes.iter().flat_map(|pass| pass.shader.written());
        for name in written.filter(|name| columns.get(name).is_none()) {
            if let Some(owner) = kernels().find(|other| law(other).is_none() && other.names(name)) {
                return Err(Error::Shader {
                    message: format!(
                        "{file}: `{name}` is a buffer that only motes writes in this simulation, where `{}` works with it: give what the law writes \
                         another name",
                        owner.name
                    ),
                });
            }
        }
    }
    Ok(())
}
