//! Softenings of particles that are all 0, as files have them that were written without any.

use super::Remark;
use crate::simulation::Setup;

/// Gravity that reads softenings of particles, of which none is above 0.
pub fn all_zero(setup: &Setup) -> Option<Remark> {
    let is_read = setup.forces.iter().flat_map(|force| force.columns()).any(|column| column.name == "softening_length");
    let lengths = setup.state.scalar("softening_length").filter(|_| is_read)?;
    if lengths.is_empty() || lengths.iter().any(|length| *length > 0.0) {
        return None;
    }
    let text = format!(
        "all {} particles have the softening_length 0: gravity is not softened, and close encounters need tiny steps",
        lengths.len()
    );
    let remark = Remark::note("unsoftened", text).with("particles", lengths.len() as f64);
    Some(
        remark
            .advice("give softening_length, or leave out individual_softening: then the key softening is that of all"),
    )
}
