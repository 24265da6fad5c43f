//! The force `fluid` in a scene: one, of particles that are free.

use crate::state::State;

use super::report::{Fault, Report};
use super::walk::Table;

/// Reports a force that makes a fluid without particles, or a second fluid: `earlier`: there is one already.
pub(super) fn check(table: &Table<'_>, particles: &State, earlier: bool, report: &mut Report) {
    if earlier {
        report.push(Fault::at(table.place, "there are two fluids of all particles: remove one of them"));
    } else if !particles.is_empty() && particles.held.len() == particles.len() {
        let text = "there is a fluid without particles: all particles are fixed, and fixed particles are its walls; add a [[particles]] of \
                    shape = \"block\"";
        report.push(Fault::at(table.place, text));
    }
}
