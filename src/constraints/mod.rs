//! Constraints: what projects positions or velocities. Each is one `.wgsl` and one `.rs` of the same name, and one line in the register below.

use crate::component::keys::EACH;
use crate::component::kind::{Kind, SPECIES, species};
use crate::component::{Component, Projection, Properties, Resolved, Stage, components};
use crate::kernel::Problem;
use crate::visit::Over;

components! {
    CONSTRAINTS, Constraint;
    speed_limit: SpeedLimit, "the minimum and the maximum speed of a species";
    solid: Solid, "an obstacle or a container: a sphere, a box, a plane or a capsule, with restitution and friction";
    rod: Rod, "rigid rods in chains keep their lengths, whatever the other forces do (RATTLE: Andersen 1983)";
    strain_limit: StrainLimit, "an upper limit of the strain of springs (Provot 1995)";
}
