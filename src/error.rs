//! Errors, sorted by what mends them.

use std::path::PathBuf;

/// Everything that can go wrong. Each message names the number and the way out.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The scene (or the caller's setup) is invalid. Mended in the scene or by the caller.
    #[error("{0}")]
    Scene(String),
    /// The same, and which key of a component says it.
    #[error("{why}")]
    Setting {
        /// The key.
        key: &'static str,
        /// What is wrong, with the number and the way out.
        why: String,
    },
    /// A file of particles cannot be read. Mended in that file.
    #[error("{}: {message}", file.display())]
    Input {
        /// The file.
        file: PathBuf,
        /// What is wrong, with line or byte offset.
        message: String,
    },
    /// A WGSL file does not compile, or does not have the functions that its visit calls. Mended in that file.
    #[error("{message}")]
    Shader {
        /// The message with file, line and caret.
        message: String,
    },
    /// No adapter fits. Mended by the choice of adapter or by installing a driver.
    #[error("{0}")]
    NoAdapter(String),
    /// A device limit is too small. Mended by another adapter, or fewer particles.
    #[error("{0}")]
    Limit(String),
    /// A number stopped being a number. Mended by a smaller step or more softening.
    #[error(
        "particle {particle} stopped being finite in step {step} (its position, velocity or acceleration is NaN, infinite or above 3.4e38): \
         try a smaller dt, more softening where particles attract each other, or look for some that start at the same place"
    )]
    NotFinite {
        /// The lowest id among the particles that failed first.
        particle: u32,
        /// The step, counted from 0, in which it happened.
        step: u64,
    },
    /// Speeds grow without end, and numbers are about to be lost. Mended by a smaller step, or by another integrator.
    #[error(
        "particle {particle} is running away in step {step}: for the eighth time running the largest speed of 16 steps is more \
         than twice that of the 16 before: try a smaller dt, or an integrator that is stable for stiffer forces"
    )]
    Runaway {
        /// The lowest id among those that are so fast.
        particle: u32,
        /// The step, counted from 0, in which that was seen.
        step: u64,
    },
    /// Forces require a step that is shorter than the minimum. Mended by a softer start, or by a shorter one.
    #[error(
        "step {step} would have to be {wanted:.3e} long, shorter than dt_min = {least:.3e}, because of the {reason} of {particle}: look \
         for particles that start too close to each other or to a wall, or set a smaller dt_min"
    )]
    TooShort {
        /// The step, counted from 0.
        step: u64,
        /// How long it would have to be \[time\].
        wanted: f64,
        /// The shortest that was allowed \[time\].
        least: f64,
        /// What limits it.
        reason: &'static str,
        /// The particle that it belongs to.
        particle: String,
    },
    /// More particles are within reach of one than a search for neighbours or a walk of a tree can visit. Mended by a shorter
    /// range, or by a greater opening angle.
    #[error(
        "particle {particle} has more neighbours than can be visited at once (240000 in the cells of a search, \
         all dispatches of a walk of a tree, and twice as many as at rest in a fluid with solver = \"dfsph\"): choose a \
         shorter range or a greater theta, for a fluid a shorter dt or the spacing that its particles have, or look for what \
         drives all particles to one position"
    )]
    TooManyNeighbors {
        /// The lowest id of such a particle.
        particle: u32,
    },
    /// The driver has ended the loops of a user's law before they were done, so that forces are wrong. Mended in that law, or by
    /// another driver.
    #[error(
        "{law}: its loops and those of its visit need more iterations than this driver allows (Mesa before 25 ends the loops of an \
         invocation after 65535 turns in all, without a word), so that its forces would be wrong: let fewer turns or a shorter range do, \
         choose over = \"pairs\", which is cut into slices of 128 particles, or install Mesa 25 or choose another adapter"
    )]
    CutShort {
        /// The law and its file.
        law: String,
    },
    /// A loop of a user's law does not end. Mended in that law.
    #[error(
        "{law}: its loops took 16777216 iterations in one invocation without ending, and were stopped: look for an \
         infinite loop, or reduce the iterations"
    )]
    Endless {
        /// The law and its file.
        law: String,
    },
    /// A list of neighbours has no room for those of a particle, and cannot get more: the device binds no more, or steps were encoded by
    /// a caller and cannot be repeated. Mended by a smaller skin, or by a search that keeps no list.
    #[error(
        "particle {particle} has more neighbours within range + skin = {reach:.6} than its list holds: there is room for {capacity}, \
         the most that any particle had is {longest}, and the list cannot grow here; choose a smaller skin, or over = \"near\", which has no limit, or look for what \
         drives particles to one position"
    )]
    ListFull {
        /// The lowest id of such a particle.
        particle: u32,
        /// The most neighbours that any particle had.
        longest: u32,
        /// How many there is room for.
        capacity: u32,
        /// The range and the skin \[length\].
        reach: f64,
    },
    /// The device is gone (driver reset, watchdog, unplugged). Mended by starting again, with less work per submission.
    #[error("the device was lost: {0}; start again, on another adapter if it happens twice")]
    Lost(String),
    /// The device has no memory left.
    #[error("the device is out of memory: {0}; choose another adapter with --adapter, or fewer particles")]
    OutOfMemory(String),
    /// The device did not answer in time.
    #[error("the device did not finish within {seconds} s: {what}")]
    Timeout {
        /// What was waited for.
        what: String,
        /// How long.
        seconds: u64,
    },
    /// No thread can be started on the processor. Mended in the limits of the system.
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
    /// A result cannot be written. Mended on the disk.
    #[error("cannot write {}: {message}", file.display())]
    Output {
        /// The file.
        file: PathBuf,
        /// Why.
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
            | Self::CutShort { .. }
            | Self::Endless { .. }
            | Self::ListFull { .. } => 6,
            Self::Lost(_) | Self::OutOfMemory(_) | Self::Timeout { .. } | Self::Threads(_) | Self::Device(_) => 7,
            Self::Output { .. } => 8,
        }
    }
}
