//! Softenings of particles that are all 0, as files have them that were written without any.

use super::Remark;
use crate::forces::Component;
use crate::interactions::gravity::SOFTENING_LENGTH;
use crate::simulation::Setup;

/// Whether a force reads softenings of particles.
pub fn reads(force: &dyn Component) -> bool {
    force.columns().iter().any(|column| column.name == SOFTENING_LENGTH)
}

/// Gravity that reads softenings of particles, of which none is above 0.
pub fn all_zero(setup: &Setup) -> Option<Remark> {
    let is_read = setup.forces.iter().any(|force| reads(force.as_ref()));
    let lengths = setup.state.scalar(SOFTENING_LENGTH).filter(|_| is_read)?;
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
