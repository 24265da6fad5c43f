//! Interactions: what accelerates particles, or computes columns of them. Each is one `.wgsl` and one `.rs` of the same name, and one
//! line in the register below.

mod pair_potential;

use crate::component::keys::{
    EACH, EXCLUDE, SEE_NEAR, SEED, SKIN, check_exclude, excluding, is_nearer, over, over_within, params, seed,
};
use crate::component::kind::{SPECIES, species};
use crate::component::{Component, Properties, Resolved, Stage, components, evaluate, numbered};
use crate::constraints::speed_limit;
use crate::kernel::Problem;
use crate::visit::{Jacobian, Law, Over};

components! {
    INTERACTIONS, Interaction;
    gravity: Gravity, "all particles attract each other, softened (Newton 1687)";
    uniform: Uniform, "a uniform acceleration field, such as weight";
    drag: Drag, "linear and quadratic drag in a medium that may move (Stokes 1851, Newton 1687)";
    wind: Wind, "a wind that blows in gusts and carries particles along";
    vortex: Vortex, "a vortex about an axis that carries particles along (Kaufmann 1962)";
    attractor: Attractor, "a fixed or moving centre: point mass, spring or logarithmic halo";
    tweezers: Tweezers, "a Gaussian trap along a line, as that of a laser beam (Ashkin et al. 1986)";
    boids: Boids, "a flock: separation, alignment and cohesion within a field of view (Reynolds 1987, 1999)";
    obstacle: Obstacle, "a sphere, a box or a plane that particles avoid by looking ahead (after Reynolds 1999)";
    flee: Flee, "prey flee from predators";
    chase: Chase, "predators chase prey";
    goal: Goal, "a target to steer to and arrive at, or a roost to stay near (Reynolds 1999)";
    wander: Wander, "a random walk of velocities, with the same random numbers on every device";
    soft_turn: SoftTurn, "a box with soft walls that turn particles back";
    vicsek: Vicsek, "each particle takes the mean heading of its neighbours, with noise, in the plane (Vicsek et al. 1995)";
    born_mayer: BornMayer, "ions: repulsion and dispersion by pair of species, and damped Coulomb forces of their charges (Born & Mayer 1932)";
    coulomb: Coulomb, "charges, with the reaction field of a dielectric continuum beyond the cut-off radius (Barker & Watts 1973), or with all images of a periodic box (Ewald 1921)";
    lennard_jones: LennardJones, "Lennard-Jones atoms, by pair of species, with four ways to end at the cut-off radius (Lennard-Jones 1931)";
    wca: Wca, "atoms that only repel each other: Lennard-Jones up to its minimum (Weeks, Chandler & Andersen 1971)";
    morse: Morse, "Morse's energy of a bond, between all pairs in range, by pair of species (Morse 1929)";
    yukawa: Yukawa, "screened charges, by pair of species (Debye & Hückel 1923, Yukawa 1935)";
    soft: Soft, "soft spheres that may overlap, by pair of species (Groot & Warren 1997)";
    contact: Contact, "granular contacts of spheres: normal springs and dashpots, friction with history, torques (Cundall & Strack 1979)";
    contact_wall: ContactWall, "a wall that grains touch as they touch each other: plane, box, sphere, capsule, tube or funnel, still or moving (Cundall & Strack 1979)";
    social_force: SocialForce, "pedestrians keep apart; where they touch they press and rub (Helbing, Farkas & Vicsek 2000)";
    collision_free_speed: CollisionFreeSpeed, "pedestrians turn aside, and are as fast as there is room (Tordeux, Chraibi & Seyfried 2015)";
    walk: Walk, "pedestrians take up their desired speed, along a direction or to a target (Helbing & Molnár 1995)";
    navigate: Navigate, "pedestrians take up their desired speed along the shortest way to an exit of the plan (Helbing & Molnár 1995; Rouy & Tourin 1992)";
    social_wall: SocialWall, "walls of the plan that pedestrians keep away from, press and rub on, and never pass (Helbing, Farkas & Vicsek 2000)";
    spring: Spring, "springs and ropes, damped along their axis (Hooke 1678)";
    fene: Fene, "bonds of polymers, with an energy that is infinite at their maximum length (Kremer & Grest 1990)";
    joint: Joint, "joints that resist bending: elastic rods, hair (Euler 1744)";
    dihedral: Dihedral, "torsions about bonds, by multiplicity and phase (Blondel & Karplus 1996)";
    fluid: Fluid, "a fluid by smoothed particle hydrodynamics, weakly compressible (Monaghan 1994); fixed particles are its walls";
    air: Air, "drag and lift on every triangle of a cloth, in gusts (Ling, Damodaran & Gay 1996)";
}
