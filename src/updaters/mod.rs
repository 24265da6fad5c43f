//! Updaters: what acts between steps. Each is one `.wgsl` and one `.rs` of the same name, and one line in the register below.

use crate::component::{Component, Properties, Stage, components};
use crate::kernel::Problem;
use crate::visit::Over;

components! {
    UPDATERS, Updater;
    tear: Tear, "springs that are stretched too far break, for ever";
}
