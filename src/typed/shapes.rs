//! Shapes, written from the register.

use std::borrow::Cow;

use glam::DVec3;

use super::{Field, typed};
use crate::settings::Settings;

typed! {
    shape;
    /// Plummer's sphere, a star cluster in equilibrium (Plummer 1911; Aarseth, Hénon & Wielen 1974).
    Plummer "plummer" plummer(count: u32) {
        /// Number of particles.
        count: u32,
        /// Seed of the random numbers.
        seed: u64,
        /// Mass of all particles together \[mass\].
        mass: f64,
        /// Plummer radius a \[length\]; half of the mass lies within 1.305 a; 3π/16 gives the energy -1/4 for g = mass = 1.
        scale: f64,
        /// Constant of gravity \[length³ / mass / time²\]; as in the force.
        g: f64,
        /// Fraction of the mass of the infinite model that is sampled, from the centre outwards (at most 1).
        cutoff: f64,
        /// The position of the centre \[length\].
        center: DVec3,
        /// The velocity of the whole \[length / time\].
        velocity: DVec3,
        /// The radius at which particles are drawn \[length\]; 0: chosen by the picture.
        particle_size: f64,
    }
    /// Hernquist's sphere, a galaxy or halo with a cusp ρ ∝ 1/r, in equilibrium (Hernquist 1990).
    Hernquist "hernquist" hernquist(count: u32) {
        /// Number of particles.
        count: u32,
        /// Seed of the random numbers.
        seed: u64,
        /// Mass of all particles together \[mass\].
        mass: f64,
        /// Scale a \[length\]; half of the mass lies within 2.414 a; 1/3 gives the energy -1/4 for g = mass = 1.
        scale: f64,
        /// Constant of gravity \[length³ / mass / time²\]; as in the force.
        g: f64,
        /// Fraction of the mass of the infinite model that is sampled, from the centre outwards (below 1); 0.99 ends at 199 a.
        cutoff: f64,
        /// The position of the centre \[length\].
        center: DVec3,
        /// The velocity of the whole \[length / time\].
        velocity: DVec3,
        /// The radius at which particles are drawn \[length\]; 0: chosen by the picture.
        particle_size: f64,
    }
    /// A uniform sphere, cold or with Gaussian velocities (van Albada 1982).
    Sphere "sphere" sphere(count: u32) {
        /// Number of particles.
        count: u32,
        /// Seed of the random numbers.
        seed: u64,
        /// Mass of all particles together \[mass\].
        mass: f64,
        /// Radius of the sphere \[length\].
        radius: f64,
        /// Kinetic over potential energy, K / |W|, of the random velocities: 0 is cold, 0.5 is virial equilibrium.
        virial: f64,
        /// Turning as a whole, on top of the random velocities: angular velocity \[1 / time\] along its axis.
        spin: DVec3,
        /// Constant of gravity \[length³ / mass / time²\]; as in the force.
        g: f64,
        /// The position of the centre \[length\].
        center: DVec3,
        /// The velocity of the whole \[length / time\].
        velocity: DVec3,
        /// The radius at which particles are drawn \[length\]; 0: chosen by the picture.
        particle_size: f64,
    }
    /// A disk galaxy in a halo, with a bulge or without, near equilibrium: the disk's particles first, then the halo's, then the bulge's (Hernquist 1993).
    Disk "disk" disk(count: u32) {
        /// Number of particles.
        count: u32,
        /// Seed of the random numbers.
        seed: u64,
        /// Mass of the disk \[mass\].
        disk_mass: f64,
        /// R_d of its surface density exp(-R / R_d) \[length\].
        disk_scale: f64,
        /// Z₀ of its profile sech²(z / z₀) \[length\].
        disk_height: f64,
        /// Mass of the halo \[mass\]; 0 leaves it out.
        halo_mass: f64,
        /// A of the halo's density 1 / (r (r + a)³), which is cut at 10 a \[length\].
        halo_scale: f64,
        /// Share of the particles that are halo (below 1); their ids follow the disk's.
        halo_fraction: f64,
        /// The halo in pictures; "black" hides it; left out: as the disk.
        halo_color: Cow<'static, str>,
        /// Mass of the bulge \[mass\]; 0 leaves it out.
        bulge_mass: f64,
        /// A of the bulge's density, as of the halo's \[length\].
        bulge_scale: f64,
        /// Share of the particles that are bulge (below 1), where it has a mass; their ids follow the halo's.
        bulge_fraction: f64,
        /// The bulge in pictures; left out: as the disk.
        bulge_color: Cow<'static, str>,
        /// Toomre's Q at every radius: below 1 the disk breaks into clumps, above 2 it forms hardly any arms.
        toomre_q: f64,
        /// The softening of the force `gravity` \[length\], so that the centre is in equilibrium too.
        softening: f64,
        /// The axis about which it turns, counter-clockwise.
        normal: DVec3,
        /// Constant of gravity \[length³ / mass / time²\]; as in the force.
        g: f64,
        /// The position of the centre \[length\].
        center: DVec3,
        /// The velocity of the whole \[length / time\].
        velocity: DVec3,
        /// The radius at which particles are drawn \[length\]; 0: chosen by the picture.
        particle_size: f64,
    }
    /// Clumps of clumps, a fractal, cold or with Gaussian velocities (Soneira & Peebles 1978).
    Clusters "clusters" clusters(count: u32) {
        /// Number of particles.
        count: u32,
        /// Seed of the random numbers.
        seed: u64,
        /// Mass of all particles together \[mass\].
        mass: f64,
        /// Radius of the ball that the centres of the largest clumps lie in; what they hold lies up to λ / (λ - 1) as far out \[length\].
        radius: f64,
        /// η: how many clumps a clump holds (2 or above).
        children: u32,
        /// D = ln η / ln λ, at most 3: 3 is evenly filled; 1.23 is that of galaxies, λ = 1.76 for η = 2.
        dimension: f64,
        /// Standard deviation of each component of the velocities \[length / time\].
        dispersion: f64,
        /// The position of the centre \[length\].
        center: DVec3,
        /// The velocity of the whole \[length / time\].
        velocity: DVec3,
        /// The radius at which particles are drawn \[length\]; 0: chosen by the picture.
        particle_size: f64,
    }
    /// A simple cubic lattice, straight, jittered, or displaced by random waves that grow by gravity (Zel'dovich 1970).
    Lattice "lattice" lattice(size: DVec3) {
        /// Particles along x, y and z: three whole numbers, 1 or above.
        size: DVec3,
        /// Distance between neighbours along an axis \[length\].
        spacing: f64,
        /// Mass of each particle \[mass\].
        mass: f64,
        /// Largest displacement along each axis, in spacings; 0.5 lets neighbours just touch.
        jitter: f64,
        /// Random waves, periodic over the lattice: root mean square of their displacement along each axis, in spacings.
        displacement: f64,
        /// N of the power k^n of the density in those waves: the lower it is, the more there is in long ones.
        spectrum: f64,
        /// Velocity of each particle over its displacement by waves \[1 / time\]; sqrt(4 pi g density) for the growing mode.
        growth: f64,
        /// Seed of the random numbers.
        seed: u64,
        /// The position of the centre \[length\].
        center: DVec3,
        /// The velocity of the whole \[length / time\].
        velocity: DVec3,
        /// The radius at which particles are drawn \[length\]; 0: chosen by the picture.
        particle_size: f64,
    }
    /// The matter of an expanding universe at a redshift, a periodic cube of particles of one mass in comoving coordinates: a lattice displaced by a random field with the power spectrum of cold dark matter (Eisenstein & Hu 1998), to first or second order (Zel'dovich 1970; Bouchet et al. 1995).
    Cosmological "cosmological" cosmological(count_per_side: u32, side: f64, megaparsec: f64) {
        /// Particles along each side of the cube, 3 to 464; soonest made where it has small factors, such as 2, 3 and 5.
        count_per_side: u32,
        /// The side of the cube, comoving \[length\].
        side: f64,
        /// The gravitational constant; left out: that of the force \[length³ / mass / time²\].
        g: f64,
        /// Hubble's constant of today; left out: that of the force \[1 / time\].
        hubble: f64,
        /// The density of matter today, of the critical one; left out: that of the force.
        omega_matter: f64,
        /// That of the cosmological constant; left out: that of the force.
        omega_lambda: f64,
        /// The redshift of the particles; left out: that of the force.
        redshift: f64,
        /// The root mean square of the density contrast in balls of 8 Mpc/h today, in linear theory.
        sigma_8: f64,
        /// The index of the primordial power spectrum, k to this power: above -3 and below 4.
        spectral_index: f64,
        /// The part of omega_matter that is baryons, for the power spectrum.
        omega_baryon: f64,
        /// Hubble's constant in 100 km/s/Mpc, for the power spectrum.
        h: f64,
        /// How long 1 Mpc/h is in the unit of the scene: 1, or 1000 where lengths are in kpc/h \[length\].
        megaparsec: f64,
        /// The order of the displacements: "first" for those of Zel'dovich: second, first.
        order: Cow<'static, str>,
        /// Seed of the random numbers.
        seed: u64,
        /// The position of the centre \[length\].
        center: DVec3,
        /// The radius at which particles are drawn \[length\]; 0: chosen by the picture.
        particle_size: f64,
    }
    /// A crystal of a number density: cubic, body-centred, face-centred or diamond, with velocities at a temperature.
    Crystal "crystal" crystal(cells: DVec3, density: f64) {
        /// Unit cells along x, y and z: three whole numbers, 1 or above.
        cells: DVec3,
        /// Particles per volume; with n particles in a cell its edge is (n / density)^(1/3) \[1 / length³\].
        density: f64,
        /// The cubic cell: face-centred (4 particles), body-centred (2), simple (1) or diamond (8): fcc, bcc, sc, diamond.
        structure: Cow<'static, str>,
        /// Mass of each particle \[mass\].
        mass: f64,
        /// K T: velocities are Maxwellian, without total momentum, and have exactly 2 K / (3 N − 3) = k T \[energy\].
        temperature: f64,
        /// Seed of the random numbers.
        seed: u64,
        /// The position of the centre \[length\].
        center: DVec3,
        /// The velocity of the whole \[length / time\].
        velocity: DVec3,
        /// The radius at which particles are drawn \[length\]; 0: chosen by the picture.
        particle_size: f64,
    }
    /// A block of fluid: a cubic lattice that fills a box, or a rectangle.
    Block "block" block(size: DVec3, spacing: f64) {
        /// Its sides; 0 along z for a rectangle \[length\].
        size: DVec3,
        /// The particle spacing; left out: that of the force `fluid` \[length\].
        spacing: f64,
        /// The density at rest of the fluid, as in the force \[mass / length³, or mass / length²\].
        density: f64,
        /// Largest displacement along each axis, in spacings.
        jitter: f64,
        /// The speed of vortices in it, one period along each of x and y (Taylor & Green 1937) \[length / time\].
        vortices: f64,
        /// The rate of strain: stretched along y and compressed along x \[1 / time\].
        strain: f64,
        /// Seed of the random numbers.
        seed: u64,
        /// The position of the centre \[length\].
        center: DVec3,
        /// The velocity of the whole \[length / time\].
        velocity: DVec3,
        /// The radius at which particles are drawn \[length\]; 0: chosen by the picture.
        particle_size: f64,
    }
    /// A drop of fluid: a ball, an ellipsoid or a disk cut from a cubic lattice.
    Drop "drop" drop(size: DVec3, spacing: f64) {
        /// Its diameters along x, y and z; 0 along z for a disk \[length\].
        size: DVec3,
        /// The particle spacing; left out: that of the force `fluid` \[length\].
        spacing: f64,
        /// The density at rest of the fluid, as in the force \[mass / length³, or mass / length²\].
        density: f64,
        /// The position of the centre \[length\].
        center: DVec3,
        /// The velocity of the whole \[length / time\].
        velocity: DVec3,
        /// The radius at which particles are drawn \[length\]; 0: chosen by the picture.
        particle_size: f64,
    }
    /// A box, or a rectangle, of walls around a fluid, as fixed particles, without gaps at the edges (Akinci et al. 2012).
    Tank "tank" tank(size: DVec3, spacing: f64) {
        /// The sides of the space inside; 0 along z for a rectangle \[length\].
        size: DVec3,
        /// The particle spacing; left out: that of the force `fluid` \[length\].
        spacing: f64,
        /// Which sides are left out, such as "+z" or "-x +x"; none: it is closed.
        open: Cow<'static, str>,
        /// The support radius of the fluid's kernel, as in the force \[spacings\].
        support: f64,
        /// The smoothing kernel of the fluid, as in the force: cubic, wendland.
        kernel: Cow<'static, str>,
        /// The mass of wall particles, as in the force: sampled walls stand at the gap that keeps the fluid at rest, lattice walls continue its lattice: sampled, lattice.
        wall_mass: Cow<'static, str>,
        /// The layers of particles in a wall; 0: one where it is sampled, on a lattice as many as the support has spacings.
        layers: u64,
        /// The density at rest of the fluid, as in the force \[mass / length³, or mass / length²\].
        density: f64,
        /// The position of the centre \[length\].
        center: DVec3,
        /// The radius at which particles are drawn \[length\]; 0: chosen by the picture.
        particle_size: f64,
    }
    /// A plane, a box, a sphere or a mesh as a wall of a fluid, of fixed particles or with a prescribed motion (Akinci et al. 2012).
    Wall "wall" wall(spacing: f64) {
        /// The shape of the surface: plane, box, sphere, mesh.
        surface: Cow<'static, str>,
        /// Box and sphere: the sides, or three times the diameter, 0 along z for a rectangle or a circle; plane: along the level and up, where 0 up is a line \[length\].
        size: DVec3,
        /// Plane: the direction to the fluid.
        normal: DVec3,
        /// Mesh: a file in Wavefront's OBJ; its faces point towards the fluid.
        mesh: Cow<'static, str>,
        /// Mesh: by how much it is made larger.
        scale: f64,
        /// Box, sphere and mesh: whether the fluid is within.
        inside: bool,
        /// The particle spacing; left out: that of the force `fluid` \[length\].
        spacing: f64,
        /// The support radius of the fluid's kernel, as in the force \[spacings\].
        support: f64,
        /// The smoothing kernel of the fluid, as in the force: cubic, wendland.
        kernel: Cow<'static, str>,
        /// The mass of wall particles, as in the force: sampled walls stand at the gap that keeps the fluid at rest, lattice walls continue its lattice: sampled, lattice.
        wall_mass: Cow<'static, str>,
        /// The layers of particles in a wall; 0: one where it is sampled, on a lattice as many as the support has spacings.
        layers: u64,
        /// The density at rest of the fluid, as in the force \[mass / length³, or mass / length²\].
        density: f64,
        /// The position of the centre \[length\].
        center: DVec3,
        /// The radius at which particles are drawn \[length\]; 0: chosen by the picture.
        particle_size: f64,
    }
    /// A box filled uniformly at random, at rest or warm.
    RandomBox "box" random_box(count: u32) {
        /// Number of particles.
        count: u32,
        /// Seed of the random numbers.
        seed: u64,
        /// Lengths of the sides \[length\], 0 or above: a zero makes it flat, and all that moves in it.
        size: DVec3,
        /// Mass of each particle \[mass\].
        mass: f64,
        /// Thermal speed: standard deviation of each velocity component, but across a flat box \[length / time\], √(k T / m) of a gas.
        speed: f64,
        /// The position of the centre \[length\].
        center: DVec3,
        /// The velocity of the whole \[length / time\].
        velocity: DVec3,
        /// The radius at which particles are drawn \[length\]; 0: chosen by the picture.
        particle_size: f64,
    }
    /// Particles thrown from a nozzle into a cone: sparks, drops, a fountain.
    Spray "spray" spray(count: u32) {
        /// Number of particles.
        count: u32,
        /// Seed of the random numbers.
        seed: u64,
        /// The axis of the cone.
        direction: DVec3,
        /// From the axis to the edge of the cone \[degrees\], up to 180.
        angle: f64,
        /// Mean speed \[length / time\].
        speed: f64,
        /// Standard deviation of the speed, as a part of its mean.
        speed_spread: f64,
        /// Radius of the disk from which they are thrown \[length\].
        nozzle: f64,
        /// Mass of each particle \[mass\].
        mass: f64,
        /// The position of the centre \[length\].
        center: DVec3,
        /// The velocity of the whole \[length / time\].
        velocity: DVec3,
        /// The radius at which particles are drawn \[length\]; 0: chosen by the picture.
        particle_size: f64,
    }
    /// Solid spheres that do not touch, on a disordered lattice in a box or a cylinder, with their radii and moments of inertia.
    Grains "grains" grains(size: DVec3, radius: f64) {
        /// The sides of the box; of a cylinder x and y are its diameter, and z is its height \[length\].
        size: DVec3,
        /// The mean radius \[length\].
        radius: f64,
        /// Radii are uniform between 1 − this and 1 + this times the mean, below 1.
        spread: f64,
        /// The density of the material \[mass / length³\].
        density: f64,
        /// The least distance of the largest spheres in the lattice, in their radii; within it they are displaced.
        gap: f64,
        /// Whether they fill the cylinder along z in the box.
        cylinder: bool,
        /// Seed of the random numbers.
        seed: u64,
        /// The position of the centre \[length\].
        center: DVec3,
        /// The velocity of the whole \[length / time\].
        velocity: DVec3,
    }
    /// Pedestrians at random in a rectangle, apart from each other, with radii and desired speeds from distributions (Weidmann 1993).
    Crowd "crowd" crowd(count: u32, size: DVec3) {
        /// Number of particles.
        count: u32,
        /// The sides of the rectangle, within which all discs are; z is not used \[length\].
        size: DVec3,
        /// Radii are uniform between this \[length\].
        min_radius: f64,
        /// And this \[length\].
        max_radius: f64,
        /// Mass of each pedestrian \[mass\].
        mass: f64,
        /// Desired speeds are normal with this mean \[length / time\].
        mean_speed: f64,
        /// And this standard deviation \[length / time\].
        speed_spread: f64,
        /// Within this \[length / time\].
        min_speed: f64,
        /// And this: speeds outside are drawn again \[length / time\].
        max_speed: f64,
        /// The least distance between discs \[length\].
        gap: f64,
        /// Seed of the random numbers.
        seed: u64,
        /// The position of the centre \[length\].
        center: DVec3,
        /// The velocity of the whole \[length / time\].
        velocity: DVec3,
    }
    /// Particles in a row, each connected to the next by springs, ropes or rods: pendulums, strings, beams.
    Chain "chain" chain(count: u32) {
        /// Number of particles, 2 or above.
        count: u32,
        /// Where the first is \[length\].
        from: DVec3,
        /// Where the last is \[length\].
        to: DVec3,
        /// Mass of each particle \[mass\].
        mass: f64,
        /// The kind of link: spring, rope, rod.
        tie: Cow<'static, str>,
        /// Springs, ropes: Hooke's constant of each \[mass / time²\].
        stiffness: f64,
        /// Springs, ropes: the damping of each, along its axis \[mass / time\].
        damping: f64,
        /// Springs, ropes: the rest length, relative to the distance; 0: equally stiff in all directions.
        rest: f64,
        /// The bending stiffness of joints, EI / ds \[mass length² / time²\].
        bending: f64,
        /// Which of the particles are fixed: none, first, ends.
        pins: Cow<'static, str>,
        /// The velocity of the whole \[length / time\].
        velocity: DVec3,
        /// The radius at which particles are drawn \[length\]; 0: chosen by the picture.
        particle_size: f64,
    }
    /// Chains that fill a cubic lattice: one random path through all of its places, made by moves of its ends (Mansfield 1982), cut into pieces.
    Chains "chains" chains(size: DVec3, beads: u32) {
        /// Places along x, y and z: three whole numbers, 1 or above.
        size: DVec3,
        /// Particles in a chain: the number of places is a multiple of it.
        beads: u32,
        /// Distance between neighbours on the lattice, and length of each bond \[length\].
        spacing: f64,
        /// Whether chains pass through the sides: the box is then as long as its places, `size` times `spacing`, and periodic; of more than 8192 places each block of as many has its own path, which stays in it where there are several along an axis.
        periodic: bool,
        /// Moves of an end of the path, per place, 1000 at most: without any, chains lie straight in rows.
        moves: f64,
        /// Mass of each particle \[mass\].
        mass: f64,
        /// Of each bond: K of `fene`, or Hooke's constant of `spring` \[mass / time²\].
        stiffness: f64,
        /// Of each bond, along its axis \[mass / time\].
        damping: f64,
        /// K T: velocities are Maxwellian, without total momentum, and have exactly 2 K / (3 N − 3) = k T; of one layer, they lie in it, with 2 K / (2 N − 2) = k T \[energy\].
        temperature: f64,
        /// Seed of the random numbers.
        seed: u64,
        /// The position of the centre \[length\].
        center: DVec3,
        /// The velocity of the whole \[length / time\].
        velocity: DVec3,
        /// The radius at which particles are drawn \[length\]; 0: chosen by the picture.
        particle_size: f64,
    }
    /// A sheet of springs: along the threads, across the squares, and over two against bending (Provot 1995).
    Cloth "cloth" cloth(columns: u32, rows: u32) {
        /// Particles along `right`, 2 or above.
        columns: u32,
        /// Particles along `down`, 2 or above.
        rows: u32,
        /// Distance between neighbours along a thread \[length\].
        spacing: f64,
        /// The way along a row.
        right: DVec3,
        /// The way from row to row.
        down: DVec3,
        /// Mass of each particle \[mass\].
        mass: f64,
        /// Stiffness of the springs along the threads \[mass / time²\].
        stretch: f64,
        /// Stiffness of the springs across each square \[mass / time²\]; 0: none.
        shear: f64,
        /// Stiffness of the springs over two, against bending \[mass / time²\]; 0: none.
        bend: f64,
        /// Damping of the springs along the threads, of others by their stiffness \[mass / time\].
        damping: f64,
        /// Rest lengths, relative to the distances; 0: equally stiff in all directions.
        rest: f64,
        /// Which particles are fixed: two corners of the first row, the first row, the first column, or the whole edge: none, corners, row, column, rim.
        pins: Cow<'static, str>,
        /// Largest random displacement of a particle normal to the sheet, in spacings: a perfectly flat sheet does not buckle.
        jitter: f64,
        /// Seed of the random numbers.
        seed: u64,
        /// The position of the centre \[length\].
        center: DVec3,
        /// The velocity of the whole \[length / time\].
        velocity: DVec3,
        /// The radius at which particles are drawn \[length\]; 0: chosen by the picture.
        particle_size: f64,
    }
    /// An elastic block: a cubic lattice of springs along edges and face diagonals, of Young's modulus 2.5 k / a and Poisson's ratio 1/4.
    Jelly "jelly" jelly(size: DVec3) {
        /// Particles along x, y and z: three whole numbers, 2 or above.
        size: DVec3,
        /// Distance between neighbours along an edge \[length\].
        spacing: f64,
        /// Mass of each particle \[mass\].
        mass: f64,
        /// K, of edges and face diagonals alike \[mass / time²\].
        stiffness: f64,
        /// Damping of each spring, along its axis \[mass / time\].
        damping: f64,
        /// The position of the centre \[length\].
        center: DVec3,
        /// The velocity of the whole \[length / time\].
        velocity: DVec3,
        /// The radius at which particles are drawn \[length\]; 0: chosen by the picture.
        particle_size: f64,
    }
    /// Strands of rods and joints that stand on a head; the first two particles of each are fixed.
    Hair "hair" hair(strands: u32) {
        /// Number of strands.
        strands: u32,
        /// Particles of each strand, 3 or above.
        points: u32,
        /// The length of a strand \[length\].
        length: f64,
        /// The variation of lengths, relative to the length; below 1.
        spread: f64,
        /// The radius of the head \[length\].
        head: f64,
        /// How far down from the top of the head it grows \[degrees\], up to 180.
        cap: f64,
        /// Mass of each particle \[mass\].
        mass: f64,
        /// The bending stiffness EI of a strand \[mass length³ / time²\].
        bending: f64,
        /// The direction from the centre of the head to its top.
        up: DVec3,
        /// Seed of the random numbers.
        seed: u64,
        /// The position of the centre \[length\].
        center: DVec3,
        /// The radius at which particles are drawn \[length\]; 0: chosen by the picture.
        particle_size: f64,
    }
}
