//! Errors, grouped by their remedy.

use std::path::PathBuf;

/// All errors. Each message states the numbers and a remedy.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The scene (or the caller's setup) is invalid. Remedy: in the scene, or by the caller.
    #[error("{0}")]
    Scene(String),
    /// The same, with the key of the component that is at fault.
    #[error("{why}")]
    Setting {
        /// The key.
        key: &'static str,
        /// The fault, with the number and the remedy.
        why: String,
    },
    /// A file of particles cannot be read. Remedy: in that file.
    #[error("{}: {message}", file.display())]
    Input {
        /// The file.
        file: PathBuf,
        /// The fault, with line or byte offset.
        message: String,
    },
    /// A WGSL file does not compile, or does not have the functions that its visit calls. Remedy: in that file.
    #[error("{message}")]
    Shader {
        /// The message with file, line and caret.
        message: String,
    },
    /// No suitable adapter. Remedy: another choice of adapter, or a driver.
    #[error("{0}")]
    NoAdapter(String),
    /// A limit of the device is exceeded. Remedy: another adapter, or fewer particles.
    #[error("{0}")]
    Limit(String),
    /// A position, velocity or acceleration is not finite. Remedy: a smaller step, or more softening.
    #[error(
        "particle {particle} stopped being finite in step {step} (its position, velocity or acceleration is NaN, infinite or above 3.4e38): \
         try a smaller dt, more softening where particles attract each other, or look for particles that start at the same position"
    )]
    NotFinite {
        /// The lowest id among the particles that failed first.
        particle: u32,
        /// The step, counted from 0, in which it happened.
        step: u64,
    },
    /// Speeds grow exponentially: the integration is unstable. Remedy: a smaller step, or another integrator.
    #[error(
        "particle {particle} is running away in step {step}: the maximum speed has more than doubled from 16 steps to the next 16, \
         eight times in a row: the integration is unstable; try a smaller dt, or an integrator that is stable for stiffer forces"
    )]
    Runaway {
        /// The lowest id among these particles.
        particle: u32,
        /// The step, counted from 0, in which that was detected.
        step: u64,
    },
    /// A bond is longer than its law admits. Remedy: a smaller step, a start with shorter bonds, or weaker forces.
    #[error(
        "{bond} reached its maximum length {longest} in step {step}: there its energy is infinite, and no force is right any more; try a \
         smaller dt, move particles apart more gently where they start too close to each other, or give it a larger max_length"
    )]
    Overlong {
        /// Its end with the lower id.
        particle: u32,
        /// The bond, by its particles.
        bond: String,
        /// The maximum length \[length\].
        longest: f64,
        /// The step, counted from 0, in which it was found.
        step: u64,
    },
    /// Forces require a step that is shorter than the minimum. Remedy: a start with weaker forces, or a smaller minimum.
    #[error(
        "step {step} would have to be {wanted:.3e} long, shorter than dt_min = {least:.3e}, because of the {reason} of {particle}: {remedy}"
    )]
    TooShort {
        /// The step, counted from 0.
        step: u64,
        /// The required length \[time\].
        wanted: f64,
        /// The minimum \[time\].
        least: f64,
        /// The limiting criterion.
        reason: &'static str,
        /// The limiting particle.
        particle: String,
        /// What allows longer steps.
        remedy: &'static str,
    },
    /// Forces require a block time step that is shorter than the shortest. Remedy: more levels, a shorter step, or a larger softening.
    #[error(
        "step {step} would have to be {wanted:.3e} long at most for particle {particle}, and the shortest block time step is dt / 2^{levels} = {least:.3e}: \
         set more block_levels (10 at most), a smaller dt, a larger block_eta, or a larger softening"
    )]
    TooManyLevels {
        /// The step, counted from 0.
        step: u64,
        /// The lowest particle that requires it.
        particle: u32,
        /// The shortest length required, a power of two of dt \[time\].
        wanted: f64,
        /// The shortest length there is \[time\].
        least: f64,
        /// The largest level.
        levels: u32,
    },
    /// A particle has more neighbours than a neighbour search or a tree walk can visit. Remedy: a shorter range, or a larger
    /// opening angle.
    #[error(
        "particle {particle} has more neighbours than can be visited at once (240000 in a cell list, 28000 to 120000 where a software adapter builds a neighbour list, all dispatches of a tree walk, \
         or twice as many as at rest in a fluid with solver = \"dfsph\"): choose a shorter range or a larger theta; for a \
         fluid a smaller dt, or a spacing that agrees with its particles; or look for forces that drive particles to \
         one position"
    )]
    TooManyNeighbors {
        /// The lowest id of such a particle.
        particle: u32,
    },
    /// A body has merged with others until it is larger than the range in which collisions are searched. Remedy: a larger range, or all pairs.
    #[error(
        "particle {particle} has grown by mergers beyond the collision_radius {largest}, half of the `range` of collide: bodies that touch would be \
         missed; choose a larger range, or over = \"pairs\""
    )]
    Outgrown {
        /// The lowest id of such a body.
        particle: u32,
        /// The largest radius for that range \[length\].
        largest: f64,
    },
    /// The driver has ended the loops of a user's law before they were complete, so that forces are wrong. Remedy: in that law,
    /// or another driver.
    #[error(
        "{law}: its loops and those of its visit need more iterations than this driver allows (Mesa before 25 ends the loops of an \
         invocation silently after 65535 iterations in all), so that its forces would be wrong: use fewer iterations or a shorter range, \
         choose over = \"pairs\", which is cut into slices of 128 particles, or install Mesa 25 or choose another adapter"
    )]
    CutShort {
        /// The law and its file.
        law: String,
    },
    /// A loop of a user's law does not end. Remedy: in that law.
    #[error(
        "{law}: its loops took 16777216 iterations in one invocation without ending, and were stopped: look for an \
         infinite loop, or reduce the iterations"
    )]
    Endless {
        /// The law and its file.
        law: String,
    },
    /// A particle has more neighbours than the capacity of the neighbour list, which cannot grow: the device binds no more, or steps were
    /// encoded by a caller and cannot be repeated. Remedy: a smaller skin, or a cell list.
    #[error(
        "particle {particle} has more neighbours within range + skin = {reach:.6} than its neighbour list holds: the capacity is {capacity}, \
         the largest number found is {longest}, and the list cannot grow here; choose a smaller skin, or over = \"near\", which has no limit, or look for \
         forces that drive particles to one position"
    )]
    ListFull {
        /// The lowest id of such a particle.
        particle: u32,
        /// The largest number of neighbours of any particle.
        longest: u32,
        /// The capacity of the list.
        capacity: u32,
        /// The range and the skin \[length\].
        reach: f64,
    },
    /// The device is lost (driver reset, watchdog, unplugged). Remedy: a new start, with less work per submission.
    #[error("the device was lost: {0}; start again, on another adapter if it happens twice")]
    Lost(String),
    /// The device has no memory left.
    #[error("the device is out of memory: {0}; choose another adapter with --adapter, or fewer particles")]
    OutOfMemory(String),
    /// The device did not answer in time.
    #[error("the device did not finish within {seconds} s: {what}")]
    Timeout {
        /// The operation that timed out.
        what: String,
        /// The time waited.
        seconds: u64,
    },
    /// No thread can be started on the host. Remedy: the limits of the system.
    #[error(
        "the threads of the CPU backend cannot be started: {0}; allow more processes or memory (`ulimit -u`, `ulimit -v`), or \
         fewer threads (RAYON_NUM_THREADS=1)"
    )]
    Threads(String),
    /// The driver or wgpu refused a call: a bug in this crate or in the driver.
    #[error(
        "the device refused a call, which is a bug in motes or in its driver; please report it with `motes doctor`: {0}"
    )]
    Device(String),
    /// A result cannot be written. Remedy: the disk or its permissions.
    #[error("cannot write {}: {message}", file.display())]
    Output {
        /// The file.
        file: PathBuf,
        /// The reason.
        message: String,
    },
}

impl Error {
    /// The exit code of the command `motes` for this error; `motes --help` lists them.
    #[must_use]
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Scene(_) | Self::Setting { .. } | Self::Shader { .. } => 3,
            Self::Input { .. } => 4,
            Self::NoAdapter(_) | Self::Limit(_) => 5,
            Self::NotFinite { .. }
            | Self::Runaway { .. }
            | Self::TooManyNeighbors { .. }
            | Self::TooShort { .. }
            | Self::TooManyLevels { .. }
            | Self::CutShort { .. }
            | Self::Endless { .. }
            | Self::ListFull { .. }
            | Self::Outgrown { .. }
            | Self::Overlong { .. } => 6,
            Self::Lost(_) | Self::OutOfMemory(_) | Self::Timeout { .. } | Self::Threads(_) | Self::Device(_) => 7,
            Self::Output { .. } => 8,
        }
    }
}
