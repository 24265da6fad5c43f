//! Kick and drift of positions and velocities in two words each, by sums and their rounding errors (Knuth 1969, §4.2.2; Dekker 1971).
//! The low words are what additions lose, and what the step in single precision lacks of dt.

use std::sync::Arc;

use glam::DVec4;

use crate::error::Error;
use crate::kernel::{
    ACCELERATION, ALARM, ALARM_WORDS, Field, Host, Kernel, Name, POSITION, POSITION_LOW, Pass, Problem, Shader, Source,
    VELOCITY, VELOCITY_LOW,
};

/// A part of a step.
#[derive(Clone, Copy)]
struct Part {
    factor: f64,
    /// The step, where all have the same length; otherwise the clock of the device has it.
    dt: Option<f64>,
}

impl Part {
    fn new(factor: f64, problem: &Problem) -> Self {
        Self { factor, dt: problem.adaptive_step.is_none().then_some(problem.dt) }
    }
    /// What the product in single precision lacks.
    fn rest(self) -> f64 {
        #[expect(clippy::cast_possible_truncation, reason = "as the device multiplies")]
        let rest = |dt: f64| self.factor * dt - f64::from(self.factor as f32 * dt as f32);
        self.dt.map_or(0.0, rest)
    }
    fn length(self, host: &Host) -> f64 {
        self.factor * self.dt.unwrap_or_else(|| host.world().dt)
    }
}

/// The functions by which sums are compensated.
pub fn sums() -> Source {
    crate::shader!("integrators/two_sum.wgsl")
}

fn join(file: Source) -> Result<Arc<Shader>, Error> {
    Shader::join(&[crate::shader!("world.wgsl"), sums(), file])
}

/// Advances numbers by rates. The reference keeps all digits in the high words.
fn advance(host: &Host, [value, low]: [Field<glam::Vec4>; 2], rate: &[DVec4], h: f64) -> Result<(), Error> {
    let (mut value, mut low) = (host.write(value)?, host.write(low)?);
    for ((x, rest), y) in value.iter_mut().zip(low.iter_mut()).zip(rate) {
        *x += (rest.truncate() + y.truncate() * h).extend(0.0);
        *rest = DVec4::ZERO;
    }
    Ok(())
}

/// Velocities, with both words.
fn velocities(host: &Host) -> Result<Vec<DVec4>, Error> {
    let (high, low) = (host.read(VELOCITY)?, host.read(VELOCITY_LOW)?);
    Ok(high.iter().zip(low.iter()).map(|(a, b)| *a + *b).collect())
}

/// Kick: v ← v + c a dt.
pub fn kick(problem: &Problem, factor: f64) -> Result<Kernel, Error> {
    let part = Part::new(factor, problem);
    let reference = move |host: &Host| {
        let rate = host.read(ACCELERATION)?.to_vec();
        advance(host, [VELOCITY, VELOCITY_LOW], &rate, part.length(host))
    };
    let shader = join(crate::shader!("integrators/kick_compensated.wgsl"))?;
    let kernel = Kernel::new("kick", shader, vec![("FACTOR", factor)], problem.capacity, Arc::new(reference));
    Ok(with(kernel, &[("REST", part.rest())]))
}

/// Drift: x ← x + c v dt.
pub fn drift(problem: &Problem, factor: f64) -> Result<Kernel, Error> {
    let part = Part::new(factor, problem);
    let reference = move |host: &Host| advance(host, [POSITION, POSITION_LOW], &velocities(host)?, part.length(host));
    let shader = join(crate::shader!("integrators/drift_compensated.wgsl"))?;
    let kernel = Kernel::new("drift", shader, vec![("FACTOR", factor)], problem.capacity, Arc::new(reference));
    Ok(with(kernel, &[("REST", part.rest())]))
}

/// A kick and the drift after it in one dispatch.
pub fn kick_drift(problem: &Problem, kick: f64, drift: f64) -> Result<Kernel, Error> {
    let (kicked, drifted) = (Part::new(kick, problem), Part::new(drift, problem));
    let reference = move |host: &Host| {
        let rate = host.read(ACCELERATION)?.to_vec();
        advance(host, [VELOCITY, VELOCITY_LOW], &rate, kicked.length(host))?;
        advance(host, [POSITION, POSITION_LOW], &velocities(host)?, drifted.length(host))
    };
    let shader = join(crate::shader!("integrators/kick_drift_compensated.wgsl"))?;
    let constants = vec![("KICK", kick), ("DRIFT", drift)];
    let kernel = Kernel::new("kick+drift", shader, constants, problem.capacity, Arc::new(reference));
    Ok(with(kernel, &[("KICK_REST", kicked.rest()), ("DRIFT_REST", drifted.rest())]))
}

/// The same kernel with constants that its name leaves out.
fn with(mut kernel: Kernel, constants: &[(&'static str, f64)]) -> Kernel {
    kernel.passes.iter_mut().for_each(|pass| pass.constants.extend_from_slice(constants));
    kernel
}

/// The summands of a proof that the driver compensates sums, and their sum with its rounding error.
const SUMMANDS: Name = Name::Borrowed("summands");
const SMALL: f32 = 1.0 / 33_554_432.0;

/// Before the first step: raises the alarm where the driver folds the sums on which two words rely.
pub fn prove(file: Source) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), file, crate::shader!("integrators/prove_sums.wgsl")])?;
    let vectors = [[1.0, SMALL, -1.0], [SMALL, 1.0, -SMALL], [1.0, 1.0, -1.0], [SMALL, SMALL, -SMALL]];
    let words = vectors.iter().flat_map(|v| v.map(f32::to_bits).into_iter().chain([0])).collect();
    Ok(Kernel {
        name: "prove sums".to_owned(),
        passes: vec![Pass::new(shader, 1)],
        reference: Some(Arc::new(|host: &Host| host.write(ALARM).map(drop))),
        sizes: vec![(SUMMANDS, 4), (ALARM.name.into(), ALARM_WORDS as u64)],
        scratch: Vec::new(),
        tables: vec![(SUMMANDS, Arc::new(words))],
    })
}
