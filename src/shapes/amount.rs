//! The number of particles of a shape, before it is built, and whether there is memory for it.

use std::fmt;
use std::ops::AddAssign;

use crate::settings::Settings;

/// Numbers of what there will be: particles and their links. They are sizes of memory, so that fractions do not matter, nor
/// numbers that fit no integer.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Amount {
    /// Particles.
    pub particles: f64,
    /// Springs and ropes.
    pub springs: f64,
    /// Rods.
    pub rods: f64,
    /// Joints.
    pub joints: f64,
    /// Triangles.
    pub triangles: f64,
}

/// Bytes of the host for each from the scene to the first steps, by the largest memory of `motes check` on the CPU backend: 335
/// for a particle (a box of 10⁶), 230 for a spring of a jelly of 100³ and 150 for one of a cloth of 700², which has few kinds of
/// them; 577 for a rod and a joint together (60 000 strands of hair). That is each twice, since a scene appends what a shape
/// has made, and the sorted tables of kernels, once as words and once as the backend's own.
const PARTICLE: f64 = 335.0;
const SPRING: f64 = 230.0;
const ROD: f64 = 290.0;
const JOINT: f64 = 290.0;
const TRIANGLE: f64 = 120.0;

/// Less than this is never refused: what is free is known to no better.
const SMALL: f64 = 6.7e7;

impl Amount {
    /// The amount of `particles` particles, without links.
    #[must_use]
    pub fn of(particles: f64) -> Self {
        Self { particles, ..Self::default() }
    }
    /// The `count` of settings.
    #[must_use]
    pub fn counted(settings: &Settings) -> Self {
        Self::of(settings.number("count"))
    }
    /// Particles and links together.
    #[must_use]
    pub fn elements(&self) -> f64 {
        self.particles + self.springs + self.rods + self.joints + self.triangles
    }
    /// Bytes that a run takes on the host for this, about.
    #[must_use]
    pub fn bytes(&self) -> f64 {
        PARTICLE * self.particles
            + SPRING * self.springs
            + ROD * self.rods
            + JOINT * self.joints
            + TRIANGLE * self.triangles
    }
    /// Checks whether there is enough memory, by the free memory of the system and by its limits. Otherwise returns a text with the
    /// required and the available memory.
    ///
    /// # Errors
    /// That text, if there is not.
    pub fn fits(&self) -> Result<(), String> {
        let bytes = self.bytes();
        if bytes < SMALL {
            return Ok(());
        }
        let free = free();
        let granted = || {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "beyond 2^64 it saturates")]
            let size = usize::try_from(bytes as u64).unwrap_or(usize::MAX);
            Vec::<u8>::new().try_reserve_exact(size).is_ok()
        };
        match free {
            Some(free) if bytes > free => {
                Err(format!("{self} need {} of memory, and {} are free", shown(bytes), shown(free)))
            }
            _ if !granted() => Err(format!("{self} need {} of memory, which the system refuses", shown(bytes))),
            _ => Ok(()),
        }
    }
}

impl AddAssign for Amount {
    fn add_assign(&mut self, other: Self) {
        self.particles += other.particles;
        self.springs += other.springs;
        self.rods += other.rods;
        self.joints += other.joints;
        self.triangles += other.triangles;
    }
}

impl fmt::Display for Amount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let all = [
            (self.particles, "particles"),
            (self.springs, "springs"),
            (self.rods, "rods"),
            (self.joints, "joints"),
            (self.triangles, "triangles"),
        ];
        let some: Vec<_> = all.iter().filter(|(n, _)| *n > 0.0).map(|(n, what)| format!("{n} {what}")).collect();
        match some.split_last() {
            Some((last, [])) => f.write_str(last),
            Some((last, others)) => write!(f, "{} and {last}", others.join(", ")),
            None => f.write_str("no particles"),
        }
    }
}

/// Bytes for people.
fn shown(bytes: f64) -> String {
    const GIB: f64 = 1_073_741_824.0;
    if bytes < GIB { format!("{:.0} MiB", bytes / 1_048_576.0) } else { format!("{:.1} GiB", bytes / GIB) }
}

/// Bytes that this process may still allocate; `None` if the system does not provide it.
#[cfg(target_os = "linux")]
fn free() -> Option<f64> {
    let text = |path: &str| std::fs::read_to_string(path).ok();
    let first = |text: &str| text.split_whitespace().find_map(|word| word.parse::<f64>().ok());
    let row = |path: &str, name: &str| text(path)?.lines().find_map(|line| first(line.strip_prefix(name)?));
    let system = row("/proc/meminfo", "MemAvailable:").map(|kib| 1024.0 * kib);
    // The limit of `ulimit -v`.
    let used = row("/proc/self/status", "VmSize:").map_or(0.0, |kib| 1024.0 * kib);
    let process = row("/proc/self/limits", "Max address space").map(|most| (most - used).max(0.0));
    // The limit of a container; its file cache can be reclaimed.
    let group = |name: &str| text(&format!("/sys/fs/cgroup/{name}")).and_then(|text| first(&text));
    let files = row("/sys/fs/cgroup/memory.stat", "file ").unwrap_or(0.0);
    let contained = group("memory.max").zip(group("memory.current"));
    let contained = contained.map(|(most, used)| (most - (used - files).max(0.0)).max(0.0));
    [system, process, contained].into_iter().flatten().reduce(f64::min)
}

/// Bytes that this process may still allocate; on other systems it is tested by reserving.
#[cfg(not(target_os = "linux"))]
fn free() -> Option<f64> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_message_has_the_numbers_and_they_are_not_too_small() {
        let some = Amount { springs: 3e9, ..Amount::of(9e7) };
        let why = some.fits().expect_err("no machine has as much");
        assert!(why.starts_with("90000000 particles and 3000000000 springs need 670.7 GiB of memory, "), "{why}");
        assert!(Amount::of(1000.0).fits().is_ok());
        assert_eq!(shown(99_999_999.0), "95 MiB");
    }
}
