//! Constraints: what projects positions or velocities. Each is one `.wgsl` and one `.rs` of the same name, and one line in the register below.

use crate::component::keys::EACH;
use crate::component::kind::{Kind, SPECIES, species};
use crate::component::{Component, Projection, Properties, Resolved, Stage, components};
use crate::kernel::Problem;
use crate::visit::Over;

components! {
    CONSTRAINTS, Constraint;
    speed_limit: SpeedLimit, "the least and the greatest speed of a species";
    solid: Solid, "a sphere, a box, a plane or a capsule that lets no particle in, or out: bounces and friction";
    rod: Rod, "rigid rods in chains keep their lengths, whatever the other forces do (RATTLE: Andersen 1983)";
    strain_limit: StrainLimit, "springs that are not stretched farther than so much (Provot 1995)";
}
