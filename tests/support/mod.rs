//! What several tests need: a device, and particles with no round numbers.
#![allow(dead_code, reason = "each test uses a part of it")]
#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds")]

pub mod choices;
pub mod columns;
pub mod equivalents;
pub mod fluids;
pub mod joint;
pub mod machines;
pub mod mutants;
pub mod scenes;
pub mod small;
pub mod states;
pub mod tint;

use std::sync::{Mutex, MutexGuard, OnceLock, TryLockError};
use std::time::Duration;

use glam::DVec3;
use motes::State;
use motes::gpu;
use motes::links::{Dihedral, Joint, Link, Links};
use motes::lockstep::Verdict;

/// A device of a whole test binary, used by one test at a time.
pub struct Shared {
    pub found: gpu::Found,
}

/// A device of its own, which no other test has, for shaders that may write anything: indirect arguments beyond what a device
/// takes are none. No adapter is a failure, never a skip.
pub fn open() -> Shared {
    let flags = gpu::flags() | motes::wgpu::InstanceFlags::VALIDATION_INDIRECT_CALL;
    let default = motes::wgpu::InstanceDescriptor::new_without_display_handle();
    opened(&motes::wgpu::Instance::new(motes::wgpu::InstanceDescriptor { flags, ..default }.with_env()))
}

/// The best device of an instance.
fn opened(instance: &motes::wgpu::Instance) -> Shared {
    let found = pollster::block_on(async {
        let adapter = gpu::choose(gpu::adapters(instance).await, &gpu::Choice::Best)?;
        gpu::open(adapter).await
    });
    Shared { found: found.expect("tests need an adapter; tests/run installs one") }
}

/// Whether a device is a processor.
pub fn is_software(shared: &Shared) -> bool {
    shared.found.adapter.get_info().device_type == motes::wgpu::DeviceType::Cpu
}

/// Devices that tests share: while one computes, the host of another compiles or evaluates references.
const DEVICES: usize = 4;

/// A device that no other test uses now. No adapter is a failure, never a skip.
pub fn device() -> MutexGuard<'static, Shared> {
    static ALL: [OnceLock<Mutex<Shared>>; DEVICES] = [const { OnceLock::new() }; DEVICES];
    loop {
        for device in &ALL {
            match device.get_or_init(|| Mutex::new(opened(&gpu::instance()))).try_lock() {
                Ok(shared) => return shared,
                Err(TryLockError::Poisoned(shared)) => return shared.into_inner(),
                Err(TryLockError::WouldBlock) => {}
            }
        }
        std::thread::sleep(Duration::from_millis(2));
    }
}

/// The same adapter with another device, whose limits are changed to smaller ones.
pub async fn limited(
    shared: &Shared,
    change: impl FnOnce(&mut motes::wgpu::Limits),
) -> (motes::wgpu::Device, motes::wgpu::Queue) {
    let mut required_limits = shared.found.device.limits();
    change(&mut required_limits);
    let descriptor = motes::wgpu::DeviceDescriptor {
        label: Some("limited"),
        required_features: shared.found.device.features(),
        required_limits,
        ..Default::default()
    };
    shared.found.adapter.request_device(&descriptor).await.expect("an adapter gives less than it has")
}

/// The radius that holds a part of the particles.
pub fn lagrangian(particles: &State, share: f64) -> f64 {
    let mut radii: Vec<f64> = particles.position().iter().map(|x| x.length()).collect();
    radii.sort_by(f64::total_cmp);
    #[expect(clippy::cast_sign_loss, reason = "a part of a small number")]
    let place = (radii.len() as f64 * share) as usize;
    radii[place.min(radii.len() - 1)]
}

/// Numbers that repeat, and are neither 0 nor 1.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }
    /// In (-1, 1).
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 11) as f64 / (1u64 << 53) as f64).mul_add(2.0, -1.0)
    }
    /// The same, in f32.
    pub fn narrow(&mut self) -> f32 {
        self.next() as f32
    }
    pub fn vector(&mut self) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next())
    }
}

/// Species 0, 1 and 2, no two neighbours in a row alike more often than others.
pub fn species(count: usize) -> Vec<u32> {
    (0..count).map(|i| [1, 2, 1, 0, 1, 0, 2][i % 7]).collect()
}

/// Particles in a cube of side 2 with masses about 1 / n, as f32 holds them, of three species.
pub fn cloud(count: usize, seed: u64) -> State {
    let mut random = Random::new(seed);
    let mut particles = State::default();
    for _ in 0..count {
        let round = |v: DVec3| v.as_vec3().as_dvec3();
        let (x, v) = (round(random.vector()), round(random.vector() * 0.7));
        let mass = f64::from(((1.3 + 0.4 * random.next()) / count as f64) as f32);
        particles.push(x, v, mass, 0.01);
    }
    particles.species_mut().copy_from_slice(&species(count));
    particles.links = links(count);
    particles
}

/// Springs and ropes to the next and to the seventh, joints and triangles: all in a cloud that are not too near its end.
/// Their numbers are those that f32 holds, and such that the cloud's masses of about 1 / n move at a rate of about 1.
pub fn links(count: usize) -> Links {
    let mut random = Random::new(31);
    let (n, count) = (count as f64, count as u32);
    let mut links = Links::default();
    for i in 0..count {
        for partner in [i + 1, i + 7].into_iter().filter(|id| *id < count) {
            let mut next = |middle: f64, half: f64| f64::from((middle + half * random.next()) as f32);
            let (rest, stiffness, damping) = (next(0.6, 0.5), next(1.3, 0.4) / n, next(0.3, 0.2) / n);
            let rope = (i + partner) % 3 == 0;
            let rest = if i % 11 == 4 && !rope { 0.0 } else { rest };
            let [stiffness, damping] = [stiffness, damping].map(|x| f64::from(x as f32));
            links.springs.push(Link { ends: [i, partner], rest, stiffness, damping, rope });
        }
        if i + 5 < count {
            // Straight at rest, or bent.
            let bends = [0.0, 0.75, 1.5];
            let stiffness = f64::from(((0.7 + 0.3 * random.next()) / n) as f32);
            links.joints.push(Joint { ids: [i, i + 1, i + 2], stiffness, rest: bends[i as usize % bends.len()] });
            let (multiplicity, phase) = (1 + i % 4, f64::from(i % 5) - 2.0);
            let ids = [i, i + 1, i + 2, i + 3];
            links.dihedrals.push(Dihedral { ids, stiffness, multiplicity, phase });
            links.triangles.push([i, i + 5, i + 1]);
        }
    }
    links
}

/// The same with nothing that damps.
pub fn elastic(mut particles: State) -> State {
    particles.links.springs.iter_mut().for_each(|link| link.damping = 0.0);
    particles
}

/// Whether the device agrees with the reference. Of thousands of dihedrals anywhere some have three particles nearly in a line, where rounded places
/// say little of the angle: those agree as far as the places say anything.
pub fn agrees(verdict: &Verdict) -> bool {
    if verdict.kernel == "dihedral" { verdict.sound() } else { verdict.good() }
}
