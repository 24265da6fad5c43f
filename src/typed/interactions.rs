//! Interactions, written from the register.

use std::borrow::Cow;

use glam::DVec3;

use super::{Field, typed};
use crate::settings::{Pair, Settings};

typed! {
    force;
    /// All particles attract each other, softened (Newton 1687).
    Gravity "gravity" gravity() {
        /// The gravitational constant \[length³ / mass / time²\].
        g: f64,
        /// The Plummer softening ε; the spline ends at 2.8 ε, so for PKDGRAV's own ε (whose spline ends at 2 ε) set 2/2.8 of it \[length\].
        softening: f64,
        /// The softening kernel: plummer, spline.
        kernel: Cow<'static, str>,
        /// Whether each particle has a softening of its own, the column `softening_length`: the larger one of a pair counts, and `softening` is the largest there may be.
        individual_softening: bool,
        /// Which pairs are evaluated: all (direct summation), or far groups approximated by a tree; "auto": whichever is faster: pairs, tree, auto.
        over: Cow<'static, str>,
        /// The opening angle θ of the tree, at most 1: a group of size l is approximated beyond the distance l / θ.
        theta: f64,
        /// Above 0: the relative opening criterion (GADGET): a group of mass M and size l is approximated where G M l² / d⁴ is below α times the last acceleration.
        alpha: f64,
        /// In a periodic box: nearest images only, or Ewald sums over all images on a neutralizing background, in a cube (Ewald 1921): nearest, ewald.
        images: Cow<'static, str>,
        /// With images = "ewald": the error of the force of a mass M, root mean square over the cube, 1e-10 or more; more than 1.5e-4 changes nothing, rounding on a device adds some 1e-5, and a tree the error of its groups \[G M / side²\].
        accuracy: f64,
        /// The multipole order of far groups: quadrupole, monopole.
        multipoles: Cow<'static, str>,
        /// Above 0: space expands, with Hubble's constant H₀ of today; positions are comoving and time is supercomoving (Martel & Shapiro 1998): velocities are a² dx/dT of the physical time T \[1 / time\].
        hubble: f64,
        /// Where space expands: the density of matter today, of the critical one.
        omega_matter: f64,
        /// Where space expands: that of the cosmological constant; what both lack of 1 is curvature.
        omega_lambda: f64,
        /// Where space expands: the redshift z = 1 / a − 1 at the time 0.
        redshift: f64,
    }
    /// A uniform acceleration field, such as weight.
    Uniform "uniform" uniform() {
        /// The acceleration \[length / time²\].
        acceleration: DVec3,
        /// What is evaluated: single particles.
        over: Cow<'static, str>,
    }
    /// Linear and quadratic drag in a medium that may move (Stokes 1851, Newton 1687).
    Drag "drag" drag() {
        /// The rate of linear (Stokes) drag \[1 / time\].
        linear: f64,
        /// The coefficient of quadratic (Newton) drag \[1 / length\].
        quadratic: f64,
        /// The velocity of the medium \[length / time\].
        wind: DVec3,
        /// What is evaluated: single particles.
        over: Cow<'static, str>,
    }
    /// A wind that blows in gusts and carries particles along.
    Wind "wind" wind() {
        /// The mean velocity of the air \[length / time\].
        velocity: DVec3,
        /// The rate at which particles adopt the velocity of the air \[1 / time\].
        rate: f64,
        /// The amplitude of gusts, relative to the mean velocity.
        gust: f64,
        /// The time from gust to gust \[time\].
        period: f64,
        /// The distance from gust to gust, along the wind \[length\].
        wavelength: f64,
        /// What is evaluated: single particles.
        over: Cow<'static, str>,
    }
    /// A vortex about an axis that carries particles along (Kaufmann 1962).
    Vortex "vortex" vortex() {
        /// A point on the axis \[length\].
        center: DVec3,
        /// The axis of rotation, by the right-hand rule.
        axis: DVec3,
        /// The circulation Γ at large radius \[length² / time\].
        circulation: f64,
        /// The core radius, where the flow is fastest \[length\].
        core: f64,
        /// The rate at which particles adopt the velocity of the flow \[1 / time\].
        rate: f64,
        /// What is evaluated: single particles.
        over: Cow<'static, str>,
    }
    /// A fixed or moving centre: point mass, spring or logarithmic halo.
    Attractor "attractor" attractor() {
        /// The position of the centre at time 0 \[length\].
        position: DVec3,
        /// Its velocity \[length / time\]; energy is conserved only if it is at rest.
        velocity: DVec3,
        /// The profile of the attraction: point, harmonic, logarithmic.
        profile: Cow<'static, str>,
        /// Point: G M \[length³ / time²\]; harmonic: ω² \[1 / time²\]; logarithmic: v₀² \[length² / time²\].
        strength: f64,
        /// Point, logarithmic: the core radius ε \[length\].
        softening: f64,
        /// What is evaluated: single particles.
        over: Cow<'static, str>,
    }
    /// A Gaussian trap along a line, as that of a laser beam (Ashkin et al. 1986).
    Tweezers "tweezers" tweezers() {
        /// A point on the axis of the beam \[length\].
        position: DVec3,
        /// The direction of the beam; in a periodic box the trap repeats across the sides that the beam is parallel to, and a slanted beam ends at those that it crosses.
        axis: DVec3,
        /// The distance w from the axis at which the trap is e² times shallower \[length\].
        waist: f64,
        /// The depth U of the trap, per mass; below 0 it repels \[length² / time²\].
        depth: f64,
        /// What is evaluated: single particles.
        over: Cow<'static, str>,
    }
    /// A flock: separation, alignment and cohesion within a field of view (Reynolds 1987, 1999).
    Boids "boids" boids() {
        /// The range of view, near and within \[length\].
        range: f64,
        /// The range of separation; no larger than the range of view \[length\].
        separation_range: f64,
        /// The weight of separation.
        separation: f64,
        /// The weight of alignment.
        alignment: f64,
        /// The weight of cohesion.
        cohesion: f64,
        /// Half of the angle of view; 180 or more: all directions, as for a bird at rest \[degrees\].
        vision: f64,
        /// The desired speed, and the maximum speed \[length / time\].
        max_speed: f64,
        /// The minimum speed; a bird at rest sets off along x \[length / time\].
        min_speed: f64,
        /// The maximum acceleration of each rule, and of all together \[length / time²\].
        max_force: f64,
        /// The species that it acts on, or "all".
        species: Option<u32>,
        /// How neighbours in range are found: by a cell list, by a neighbour list that is reused over steps, by the faster of both, or by brute force; or the k nearest neighbours, of all species, at any distance (Ballerini et al. 2008): near, list, auto, within, nearest.
        over: Cow<'static, str>,
        /// Over = "list" or "auto": the skin of the neighbour list beyond the range; 0: a fifth of the range, and chosen anew while it runs \[length\].
        skin: f64,
        /// Over = "nearest": the number k of neighbours.
        neighbors: u32,
    }
    /// A sphere, a box or a plane that particles avoid by looking ahead (after Reynolds 1999).
    Obstacle "obstacle" obstacle() {
        /// Its shape: sphere, box, plane.
        shape: Cow<'static, str>,
        /// Its centre, or a point on the plane \[length\].
        position: DVec3,
        /// Sphere: its radius \[length\].
        radius: f64,
        /// Box: its sides \[length\].
        size: DVec3,
        /// Plane: the direction to the free side.
        normal: DVec3,
        /// How far ahead particles look \[time\].
        look_ahead: f64,
        /// The minimum distance from it: the radius of a bird \[length\].
        clearance: f64,
        /// The acceleration of particles that touch it \[length / time²\].
        max_force: f64,
        /// The species that it acts on, or "all".
        species: Option<u32>,
        /// What is evaluated: single particles.
        over: Cow<'static, str>,
    }
    /// Prey flee from predators.
    Flee "flee" flee() {
        /// How far a predator is seen \[length\].
        range: f64,
        /// The acceleration away from a predator at distance 0 \[length / time²\].
        strength: f64,
        /// The species that flees.
        species: Option<u32>,
        /// The species from which it flees.
        predators: Option<u32>,
        /// How neighbours in range are found: by a cell list, by a neighbour list that is reused over steps, by the faster of both, or by brute force: near, list, auto, within.
        over: Cow<'static, str>,
        /// Over = "list" or "auto": the skin of the neighbour list beyond the range; 0: a fifth of the range, and chosen anew while it runs \[length\].
        skin: f64,
    }
    /// Predators chase prey.
    Chase "chase" chase() {
        /// How far prey is seen \[length\].
        range: f64,
        /// The desired speed; for a limit see speed_limit \[length / time\].
        max_speed: f64,
        /// The maximum acceleration by steering \[length / time²\].
        max_force: f64,
        /// The species that chases.
        species: Option<u32>,
        /// The species that is chased.
        prey: Option<u32>,
        /// How neighbours in range are found: by a cell list, by a neighbour list that is reused over steps, by the faster of both, or by brute force: near, list, auto, within.
        over: Cow<'static, str>,
        /// Over = "list" or "auto": the skin of the neighbour list beyond the range; 0: a fifth of the range, and chosen anew while it runs \[length\].
        skin: f64,
    }
    /// A target to steer to and arrive at, or a roost to stay near (Reynolds 1999).
    Goal "goal" goal() {
        /// Its position at time 0 \[length\].
        position: DVec3,
        /// Its velocity \[length / time\].
        velocity: DVec3,
        /// The desired speed \[length / time\].
        max_speed: f64,
        /// The maximum acceleration by steering \[length / time²\].
        max_force: f64,
        /// The radius within which particles slow down, to rest at the goal \[length\].
        slow_radius: f64,
        /// The radius within which particles are not steered: a roost \[length\].
        free_radius: f64,
        /// The species that it acts on, or "all".
        species: Option<u32>,
        /// What is evaluated: single particles.
        over: Cow<'static, str>,
    }
    /// A random walk of velocities, with the same random numbers on every device.
    Wander "wander" wander() {
        /// σ: after the time t a velocity has changed by σ √t (rms), for any dt \[length / time^(3/2)\].
        strength: f64,
        /// Seed of the random numbers, counted by id and step.
        seed: u64,
        /// The species that it acts on, or "all".
        species: Option<u32>,
        /// What is evaluated: single particles.
        over: Cow<'static, str>,
    }
    /// A box with soft walls that turn particles back.
    SoftTurn "soft_turn" soft_turn() {
        /// The lowest corner of the box \[length\].
        low: DVec3,
        /// The highest corner \[length\].
        high: DVec3,
        /// The depth of the wall inside of the box; outside it is unlimited \[length\].
        margin: f64,
        /// The acceleration of each side's wall \[length / time²\].
        acceleration: f64,
        /// The species that it acts on, or "all".
        species: Option<u32>,
        /// What is evaluated: single particles.
        over: Cow<'static, str>,
    }
    /// Each particle takes the mean heading of its neighbours, with noise, in the plane (Vicsek et al. 1995).
    Vicsek "vicsek" vicsek() {
        /// The radius of the neighbourhood, which includes the particle itself \[length\].
        range: f64,
        /// The speed of all particles; v₀ of the paper is this times dt \[length / time\].
        speed: f64,
        /// η: angular, the width of the random angle \[0 to 2π\]; vectorial, the length of the random vector \[0 to 1\].
        noise: f64,
        /// Whether the noise turns the mean heading, or adds to the headings: angular, vectorial.
        noise_kind: Cow<'static, str>,
        /// Seed of the random numbers, counted by id and step.
        seed: u64,
        /// How neighbours in range are found: by a cell list, by a neighbour list that is reused over steps, by the faster of both, or by brute force: near, list, auto, within.
        over: Cow<'static, str>,
        /// Over = "list" or "auto": the skin of the neighbour list beyond the range; 0: a fifth of the range, and chosen anew while it runs \[length\].
        skin: f64,
    }
    /// Ions: repulsion and dispersion by pair of species, and damped Coulomb forces of their charges (Born & Mayer 1932).
    BornMayer "born_mayer" born_mayer(pairs: Vec<Pair>, range: f64) {
        /// The coefficients of each pair of species, as in \[{ species = \[0, 1\], repulsion = 1.0, decay = 0.3 }\].
        pairs: Vec<Pair>,
        /// The cut-off radius, where energy and force end \[length\].
        range: f64,
        /// Coulomb's constant, 1 / 4π ε₀ \[energy length / charge²\].
        coulomb: f64,
        /// α: the Coulomb energy is erfc(α r) / r; 0: shifted only \[1 / length\].
        damping: f64,
        /// How neighbours in range are found: by a cell list, by a neighbour list that is reused over steps, by the faster of both, or by brute force: near, list, auto, within.
        over: Cow<'static, str>,
        /// Over = "list" or "auto": the skin of the neighbour list beyond the range; 0: a fifth of the range, and chosen anew while it runs \[length\].
        skin: f64,
    }
    /// Charges, with the reaction field of a dielectric continuum beyond the cut-off radius (Barker & Watts 1973), or with all images of a periodic box (Ewald 1921).
    Coulomb "coulomb" coulomb(range: f64) {
        /// The cut-off radius R, where the energy ends \[length\].
        range: f64,
        /// Coulomb's constant k, 1 / 4π ε₀ \[energy length / charge²\].
        coulomb: f64,
        /// The relative permittivity ε of the continuum beyond R, such as 78.5 for water; 1: none, the energy is shifted only; 0: a conductor.
        permittivity: f64,
        /// In a periodic box: nearest images up to `range`, or Ewald sums over all images, in a conductor, of which the law between two ends at `range` (Ewald 1921): nearest, ewald.
        images: Cow<'static, str>,
        /// With images = "ewald": the error of the force between two charges, root mean square over a cube of side 2 R, 1e-10 to 0.1; rounding on a device adds some 1e-6 \[k q q' / R²\].
        accuracy: f64,
        /// How neighbours in range are found: by a cell list, by a neighbour list that is reused over steps, by the faster of both, or by brute force: near, list, auto, within.
        over: Cow<'static, str>,
        /// Over = "list" or "auto": the skin of the neighbour list beyond the range; 0: a fifth of the range, and chosen anew while it runs \[length\].
        skin: f64,
        /// Over = "list" or "auto": pairs up to so many bonds apart (springs, ropes and rods) are left out: 1, 1–2 pairs; 2, 1–3 pairs too; 3, 1–4 pairs too; 0: none.
        exclude: u64,
    }
    /// Lennard-Jones atoms, by pair of species, with four ways to end at the cut-off radius (Lennard-Jones 1931).
    LennardJones "lennard_jones" lennard_jones(range: f64) {
        /// ε, the depth of the well \[energy\].
        epsilon: f64,
        /// σ, the distance at which the energy is 0 \[length\].
        sigma: f64,
        /// The cut-off radius \[length\].
        range: f64,
        /// How U ends at the range R: not at all, less U(R), less U(R) and its slope there, or smoothed by a polynomial from `onset` on (Brooks et al. 1983): cut, shift, force_shift, xplor.
        truncation: Cow<'static, str>,
        /// Truncation = "xplor": the distance at which smoothing begins, as a part of the range.
        onset: f64,
        /// Factors for pairs of species, as in \[{ species = \[0, 1\], epsilon = 0.5 }\], by which the values above are multiplied; none: all species are alike.
        pairs: Vec<Pair>,
        /// The coefficients of two species of which `pairs` has each, and not both together: ε = √(ε₁ ε₂) with σ = (σ₁ + σ₂) / 2 or √(σ₁ σ₂); none: all pairs are given: lorentz_berthelot, geometric, none.
        mixing: Cow<'static, str>,
        /// How neighbours in range are found: by a cell list, by a neighbour list that is reused over steps, by the faster of both, or by brute force: near, list, auto, within.
        over: Cow<'static, str>,
        /// Over = "list" or "auto": the skin of the neighbour list beyond the range; 0: a fifth of the range, and chosen anew while it runs \[length\].
        skin: f64,
        /// Over = "list" or "auto": pairs up to so many bonds apart (springs, ropes and rods) are left out: 1, 1–2 pairs; 2, 1–3 pairs too; 3, 1–4 pairs too; 0: none.
        exclude: u64,
    }
    /// Atoms that only repel each other: Lennard-Jones up to its minimum (Weeks, Chandler & Andersen 1971).
    Wca "wca" wca() {
        /// ε, the energy at r = σ \[energy\].
        epsilon: f64,
        /// σ: atoms repel each other up to 2^(1/6) σ \[length\].
        sigma: f64,
        /// Factors for pairs of species, as in \[{ species = \[0, 1\], epsilon = 0.5 }\], by which the values above are multiplied; none: all species are alike.
        pairs: Vec<Pair>,
        /// The coefficients of two species of which `pairs` has each, and not both together: ε = √(ε₁ ε₂) with σ = (σ₁ + σ₂) / 2 or √(σ₁ σ₂); none: all pairs are given: lorentz_berthelot, geometric, none.
        mixing: Cow<'static, str>,
        /// How neighbours in range are found: by a cell list, by a neighbour list that is reused over steps, by the faster of both, or by brute force: near, list, auto, within.
        over: Cow<'static, str>,
        /// Over = "list" or "auto": the skin of the neighbour list beyond the range; 0: a fifth of the range, and chosen anew while it runs \[length\].
        skin: f64,
        /// Over = "list" or "auto": pairs up to so many bonds apart (springs, ropes and rods) are left out: 1, 1–2 pairs; 2, 1–3 pairs too; 3, 1–4 pairs too; 0: none.
        exclude: u64,
    }
    /// Morse's energy of a bond, between all pairs in range, by pair of species (Morse 1929).
    Morse "morse" morse(range: f64) {
        /// D, the depth of the well \[energy\].
        depth: f64,
        /// α of exp(−α (r − r₀)) \[1 / length\].
        steepness: f64,
        /// R₀, where the energy is least \[length\].
        distance: f64,
        /// The cut-off radius \[length\].
        range: f64,
        /// How U ends at the range R: not at all, less U(R), less U(R) and its slope there, or smoothed by a polynomial from `onset` on (Brooks et al. 1983): cut, shift, force_shift, xplor.
        truncation: Cow<'static, str>,
        /// Truncation = "xplor": the distance at which smoothing begins, as a part of the range.
        onset: f64,
        /// Factors for pairs of species, as in \[{ species = \[0, 1\], epsilon = 0.5 }\], by which the values above are multiplied; none: all species are alike.
        pairs: Vec<Pair>,
        /// How neighbours in range are found: by a cell list, by a neighbour list that is reused over steps, by the faster of both, or by brute force: near, list, auto, within.
        over: Cow<'static, str>,
        /// Over = "list" or "auto": the skin of the neighbour list beyond the range; 0: a fifth of the range, and chosen anew while it runs \[length\].
        skin: f64,
        /// Over = "list" or "auto": pairs up to so many bonds apart (springs, ropes and rods) are left out: 1, 1–2 pairs; 2, 1–3 pairs too; 3, 1–4 pairs too; 0: none.
        exclude: u64,
    }
    /// Screened charges, by pair of species (Debye & Hückel 1923, Yukawa 1935).
    Yukawa "yukawa" yukawa(range: f64) {
        /// A of A exp(−κ r) / r; below 0 particles attract each other \[energy length\].
        strength: f64,
        /// κ, one over the screening length \[1 / length\].
        screening: f64,
        /// The cut-off radius \[length\].
        range: f64,
        /// How U ends at the range R: not at all, less U(R), less U(R) and its slope there, or smoothed by a polynomial from `onset` on (Brooks et al. 1983): cut, shift, force_shift, xplor.
        truncation: Cow<'static, str>,
        /// Truncation = "xplor": the distance at which smoothing begins, as a part of the range.
        onset: f64,
        /// Factors for pairs of species, as in \[{ species = \[0, 1\], epsilon = 0.5 }\], by which the values above are multiplied; none: all species are alike.
        pairs: Vec<Pair>,
        /// How neighbours in range are found: by a cell list, by a neighbour list that is reused over steps, by the faster of both, or by brute force: near, list, auto, within.
        over: Cow<'static, str>,
        /// Over = "list" or "auto": the skin of the neighbour list beyond the range; 0: a fifth of the range, and chosen anew while it runs \[length\].
        skin: f64,
        /// Over = "list" or "auto": pairs up to so many bonds apart (springs, ropes and rods) are left out: 1, 1–2 pairs; 2, 1–3 pairs too; 3, 1–4 pairs too; 0: none.
        exclude: u64,
    }
    /// Soft spheres that may overlap, by pair of species (Groot & Warren 1997).
    Soft "soft" soft(range: f64) {
        /// A, the force at r = 0 \[energy / length\].
        strength: f64,
        /// The cut-off radius \[length\].
        range: f64,
        /// Factors for pairs of species, as in \[{ species = \[0, 1\], epsilon = 0.5 }\], by which the values above are multiplied; none: all species are alike.
        pairs: Vec<Pair>,
        /// How neighbours in range are found: by a cell list, by a neighbour list that is reused over steps, by the faster of both, or by brute force: near, list, auto, within.
        over: Cow<'static, str>,
        /// Over = "list" or "auto": the skin of the neighbour list beyond the range; 0: a fifth of the range, and chosen anew while it runs \[length\].
        skin: f64,
        /// Over = "list" or "auto": pairs up to so many bonds apart (springs, ropes and rods) are left out: 1, 1–2 pairs; 2, 1–3 pairs too; 3, 1–4 pairs too; 0: none.
        exclude: u64,
    }
    /// Granular contacts of spheres: normal springs and dashpots, friction with history, torques (Cundall & Strack 1979).
    Contact "contact" contact(range: f64) {
        /// The largest sum of two radii; larger ones are refused \[length\].
        range: f64,
        /// The force of an overlap: proportional to it, or by Hertz and Mindlin: linear, hertz.
        model: Cow<'static, str>,
        /// Linear: k, the normal force per overlap \[mass / time²\].
        stiffness: f64,
        /// Hertz: Young's modulus of both bodies \[mass / length / time²\].
        young_modulus: f64,
        /// Hertz: Poisson's ratio of both bodies, 0.5 at most.
        poisson_ratio: f64,
        /// The coefficient of restitution: the speed after a head-on impact over that before.
        restitution: f64,
        /// The friction coefficient μ: a contact slides where the tangential force would exceed μ times the normal force.
        friction: f64,
        /// Linear: the tangential stiffness, relative to the normal one.
        tangential_stiffness: f64,
        /// The tangential damping, relative to the normal one; hertz: also times the root of the ratio of stiffnesses.
        tangential_damping: f64,
        /// The coefficient of rolling friction μᵣ: the largest torque against rolling, relative to the normal force times the reduced radius.
        rolling_friction: f64,
        /// Rolling friction by a spring and a dashpot up to that torque, which piles at rest require, or always of that size: elastic_plastic, constant.
        rolling_model: Cow<'static, str>,
        /// Elastic_plastic: the damping of rolling, relative to the critical one.
        rolling_damping: f64,
        /// The coefficient of torsional friction: the largest torque about the normal, relative to the normal force times the reduced radius.
        torsional_friction: f64,
        /// The surface tension γ of liquid that bridges grains from where they touch until they are too far apart; 0: dry \[mass / time²\].
        surface_tension: f64,
        /// The angle θ at which liquid meets grains \[radians\].
        contact_angle: f64,
        /// The volume V of each bridge, relative to the cube of the smaller radius: a bridge breaks (1 + θ / 2) V^(1/3) apart.
        bridge_volume: f64,
        /// Factors for pairs of species, as in \[{ species = \[0, 1\], friction = 0.5 }\], by which the values above are multiplied; of two species with values of their own, the pair has both as springs in series, and geometric means of all coefficients; none: all species are alike.
        pairs: Vec<Pair>,
        /// The skin of the neighbour list beyond the range; 0: a fifth of the range, and chosen anew while it runs \[length\].
        skin: f64,
    }
    /// A wall that grains touch as they touch each other: plane, box, sphere, capsule, tube or funnel, still or moving (Cundall & Strack 1979).
    ContactWall "contact_wall" contact_wall() {
        /// Its shape: plane, box, sphere, capsule, cone.
        shape: Cow<'static, str>,
        /// Its centre, or a point on the plane \[length\].
        position: DVec3,
        /// Plane: the direction to the grains.
        normal: DVec3,
        /// Box: its sides \[length\].
        size: DVec3,
        /// Sphere and capsule: the radius; cone: that of its first end \[length\].
        radius: f64,
        /// Cone: the radius of its other end \[length\].
        end_radius: f64,
        /// Capsule and cone: from the centre of one end to the other's \[length\].
        axis: DVec3,
        /// Whether it is a container with grains inside; a box then has a contact with a side along each axis.
        inside: bool,
        /// The motion that moves it, if any.
        motion: Cow<'static, str>,
        /// The force of an overlap: proportional to it, or by Hertz and Mindlin: linear, hertz.
        model: Cow<'static, str>,
        /// Linear: k, the normal force per overlap \[mass / time²\].
        stiffness: f64,
        /// Hertz: Young's modulus of both bodies \[mass / length / time²\].
        young_modulus: f64,
        /// Hertz: Poisson's ratio of both bodies, 0.5 at most.
        poisson_ratio: f64,
        /// The coefficient of restitution: the speed after a head-on impact over that before.
        restitution: f64,
        /// The friction coefficient μ: a contact slides where the tangential force would exceed μ times the normal force.
        friction: f64,
        /// Linear: the tangential stiffness, relative to the normal one.
        tangential_stiffness: f64,
        /// The tangential damping, relative to the normal one; hertz: also times the root of the ratio of stiffnesses.
        tangential_damping: f64,
        /// The coefficient of rolling friction μᵣ: the largest torque against rolling, relative to the normal force times the reduced radius.
        rolling_friction: f64,
        /// Rolling friction by a spring and a dashpot up to that torque, which piles at rest require, or always of that size: elastic_plastic, constant.
        rolling_model: Cow<'static, str>,
        /// Elastic_plastic: the damping of rolling, relative to the critical one.
        rolling_damping: f64,
        /// The coefficient of torsional friction: the largest torque about the normal, relative to the normal force times the reduced radius.
        torsional_friction: f64,
        /// The surface tension γ of liquid that bridges grains from where they touch until they are too far apart; 0: dry \[mass / time²\].
        surface_tension: f64,
        /// The angle θ at which liquid meets grains \[radians\].
        contact_angle: f64,
        /// The volume V of each bridge, relative to the cube of the smaller radius: a bridge breaks (1 + θ / 2) V^(1/3) apart.
        bridge_volume: f64,
        /// The species that it acts on, or "all".
        species: Option<u32>,
        /// What is evaluated: single particles.
        over: Cow<'static, str>,
    }
    /// Pedestrians keep apart; where they touch they press and rub (Helbing, Farkas & Vicsek 2000).
    SocialForce "social_force" social_force() {
        /// The distance of centres up to which pedestrians act on each other \[length\].
        range: f64,
        /// A, the repulsion where discs touch without pressing \[mass length / time²\].
        repulsion: f64,
        /// B, the distance over which the repulsion falls by e \[length\].
        decay: f64,
        /// K, the body force per overlap \[mass / time²\].
        stiffness: f64,
        /// κ, the sliding friction per overlap and sliding velocity \[mass / (length time)\].
        friction: f64,
        /// λ, the part of the repulsion by pedestrians straight behind; 1: the same all round.
        anisotropy: f64,
        /// The species that it acts on, or "all".
        species: Option<u32>,
        /// How neighbours in range are found: by a cell list, by a neighbour list that is reused over steps, by the faster of both, or by brute force: near, list, auto, within.
        over: Cow<'static, str>,
        /// Over = "list" or "auto": the skin of the neighbour list beyond the range; 0: a fifth of the range, and chosen anew while it runs \[length\].
        skin: f64,
    }
    /// Pedestrians turn aside, and are as fast as there is room (Tordeux, Chraibi & Seyfried 2015).
    CollisionFreeSpeed "collision_free_speed" collision_free_speed() {
        /// The distance of centres up to which pedestrians see each other \[length\].
        range: f64,
        /// T, the time in which a pedestrian would be where the one in front is \[time\].
        time_gap: f64,
        /// A, what a pedestrian in touch adds to the desired direction, a unit vector.
        repulsion: f64,
        /// D, the distance over which that falls by e \[length\].
        decay: f64,
        /// What a wall of the plan in touch adds to the desired direction.
        wall_repulsion: f64,
        /// The distance over which that falls by e \[length\].
        wall_decay: f64,
        /// The species that it acts on, or "all".
        species: Option<u32>,
        /// How neighbours in range are found: by a cell list, by a neighbour list that is reused over steps, by the faster of both, or by brute force: near, list, auto, within.
        over: Cow<'static, str>,
        /// Over = "list" or "auto": the skin of the neighbour list beyond the range; 0: a fifth of the range, and chosen anew while it runs \[length\].
        skin: f64,
    }
    /// Pedestrians take up their desired speed, along a direction or to a target (Helbing & Molnár 1995).
    Walk "walk" walk() {
        /// Where pedestrians walk: along a direction, or to a target: direction, target.
        to: Cow<'static, str>,
        /// To = "direction": the direction, of any length.
        direction: DVec3,
        /// To = "target": the point at which they stop \[length\].
        target: DVec3,
        /// τ, the time in which a free pedestrian takes up the desired velocity \[time\].
        relaxation_time: f64,
        /// The species that it acts on, or "all".
        species: Option<u32>,
        /// What is evaluated: single particles.
        over: Cow<'static, str>,
    }
    /// Pedestrians take up their desired speed along the shortest way to an exit of the plan (Helbing & Molnár 1995; Rouy & Tourin 1992).
    Navigate "navigate" navigate() {
        /// τ, the time in which a free pedestrian takes up the desired velocity \[time\].
        relaxation_time: f64,
        /// The species that it acts on, or "all".
        species: Option<u32>,
        /// What is evaluated: single particles.
        over: Cow<'static, str>,
    }
    /// Walls of the plan that pedestrians keep away from, press and rub on, and never pass (Helbing, Farkas & Vicsek 2000).
    SocialWall "social_wall" social_wall() {
        /// The distance from a wall to centres up to which it acts \[length\].
        range: f64,
        /// A, the repulsion where discs touch without pressing \[mass length / time²\].
        repulsion: f64,
        /// B, the distance over which the repulsion falls by e \[length\].
        decay: f64,
        /// K, the body force per overlap \[mass / time²\].
        stiffness: f64,
        /// κ, the sliding friction per overlap and sliding velocity \[mass / (length time)\].
        friction: f64,
        /// The species that it acts on, or "all".
        species: Option<u32>,
        /// What is evaluated: single particles.
        over: Cow<'static, str>,
    }
    /// Springs and ropes, damped along their axis (Hooke 1678).
    Spring "spring" spring() {
        /// Which pairs are evaluated: those connected by a spring or a rope, which has its own length, stiffness and damping.
        over: Cow<'static, str>,
    }
    /// Bonds of polymers, with an energy that is infinite at their maximum length (Kremer & Grest 1990).
    Fene "fene" fene() {
        /// R₀, the length at which the energy of a bond is infinite: one that is found longer ends the run \[length\].
        max_length: f64,
        /// Which pairs are evaluated: those connected by a spring or a rope: its stiffness and damping count, its rest length does not.
        over: Cow<'static, str>,
    }
    /// Joints that resist bending: elastic rods, hair (Euler 1744).
    Joint "joint" joint() {
        /// What is evaluated: the three particles of a joint, which has its own stiffness.
        over: Cow<'static, str>,
    }
    /// Torsions about bonds, by multiplicity and phase (Blondel & Karplus 1996).
    Dihedral "dihedral" dihedral() {
        /// What is evaluated: the four particles of a dihedral, which has its own stiffness, multiplicity and phase.
        over: Cow<'static, str>,
    }
    /// A fluid by smoothed particle hydrodynamics, weakly compressible (Monaghan 1994); fixed particles are its walls.
    Fluid "fluid" fluid(spacing: f64) {
        /// "viscous", for flows between walls without a surface, at Reynolds numbers up to some 100: other defaults of kernel, support, density_by, diffusion, negative_pressure, viscosity_form, walls and wall_mass; keys that are given win: general, viscous.
        regime: Cow<'static, str>,
        /// The density at rest \[mass / length³, or mass / length² in two dimensions\].
        density: f64,
        /// The spacing of particles at rest, on a cubic lattice \[length\].
        spacing: f64,
        /// The support radius of the kernel \[spacings\].
        support: f64,
        /// The smoothing kernel: the cubic spline, or Wendland's C2: cubic, wendland.
        kernel: Cow<'static, str>,
        /// Pressure by an equation of state, or solved for (Bender & Koschier 2015): wcsph, dfsph.
        solver: Cow<'static, str>,
        /// Wcsph: the speed of sound: ten times the fastest flow makes the density vary by 1 % \[length / time\].
        sound_speed: f64,
        /// The exponent of Tait's equation p = (ρ₀ c² / γ) ((ρ/ρ₀)^γ − 1), 2 to 15.
        gamma: u32,
        /// Whether pressure may be below 0: where there is no free surface.
        negative_pressure: bool,
        /// The artificial viscosity α (Monaghan 1992).
        alpha: f64,
        /// The kinematic viscosity ν, of the form viscosity_form \[length² / time\].
        viscosity: f64,
        /// The form of the viscosity: along the line between two particles, which preserves angular momentum (Monaghan & Gingold 1983; Cleary 1998; Monaghan 2005), or along the difference of their velocities, which is more accurate in channels on a lattice and takes the angular momentum of a fluid with a free surface (Morris, Fox & Zhu 1997): central, morris.
        viscosity_form: Cow<'static, str>,
        /// ε of XSPH: the fraction by which velocities move towards the mean of the neighbours in each step (Schechter & Bridson 2012), which takes energy and angular momentum, whatever the resolution.
        xsph: f64,
        /// The part of both viscosities that acts at walls; 0: free slip.
        wall_friction: f64,
        /// The pressure of walls: that of the particle at the wall (Akinci et al. 2012), or that of the fluid around them (Adami, Hu & Adams 2012, as if they were not accelerated): mirror, extrapolate.
        walls: Cow<'static, str>,
        /// The mass of wall particles: from their spacing, for one layer (Akinci et al. 2012), or that of a lattice particle, for several layers: sampled, lattice.
        wall_mass: Cow<'static, str>,
        /// How density is computed: by summation over neighbours, or by the continuity equation (Monaghan 1994), which has no deficit at free surfaces: summation, continuity.
        density_by: Cow<'static, str>,
        /// Density_by = "continuity": the density diffusion δ, for instance 0.1 (Molteni & Colagrossi 2009).
        diffusion: f64,
        /// The gravitational acceleration that another force applies, so that density diffusion (Fourtakas et al. 2019) and walls preserve hydrostatic equilibrium \[length / time²\].
        weight: DVec3,
        /// The surface tension coefficient γ (Akinci, Akinci & Teschner 2013), which is not the physical σ: with density 1000, in three dimensions, σ is about 25 000, 55 000 or 75 000 γ spacing² where support is 2, 2.5 or 3.
        tension: f64,
        /// The adhesion coefficient β of walls (Akinci, Akinci & Teschner 2013).
        adhesion: f64,
        /// Wcsph: how neighbours are found: by a cell list, by a neighbour list that is reused over steps, or by the faster of both: near, list, auto.
        over: Cow<'static, str>,
        /// Over = "list" or "auto": the skin of the neighbour list beyond the range; 0: a fifth of the range, and chosen anew while it runs \[length\].
        skin: f64,
        /// Dfsph: the tolerance of the mean density error \[relative to the density\].
        tolerance: f64,
        /// Dfsph: the tolerance of the mean density change by divergence in a step \[relative to the density\].
        divergence_tolerance: f64,
        /// Dfsph: the minimum number of iterations of a solve.
        min_iterations: u32,
        /// Dfsph: the maximum number of iterations of a solve.
        max_iterations: u32,
    }
    /// Drag and lift on every triangle of a cloth, in gusts (Ling, Damodaran & Gay 1996).
    Air "air" air() {
        /// The mean velocity of the air \[length / time\].
        wind: DVec3,
        /// The density of the air \[mass / length³\].
        density: f64,
        /// The drag coefficient of a triangle that faces the wind.
        drag: f64,
        /// The lift coefficient.
        lift: f64,
        /// The amplitude of gusts, relative to the mean velocity.
        gust: f64,
        /// The time from gust to gust \[time\].
        period: f64,
        /// The distance from gust to gust, along the wind \[length\].
        wavelength: f64,
        /// What is evaluated: the corners of each triangle of cloth.
        over: Cow<'static, str>,
    }
}
