//! The dt criteria of a fluid (Monaghan 1992; Morris, Fox & Zhu 1997; Ihmsen et al. 2014): dt = min( C √(s / |a|), C s / (c + |μ| + 0.6 α
//! c), s² / (8 ν), 0.4 C d / |v| ), with s the smoothing length, which is half of the support, and d the spacing. Where the speed of sound
//! is given, there is no speed criterion. A central viscosity, which damps longitudinal waves as well, has s² / (20 ν): [`viscous_steps`].

use std::sync::Arc;

use glam::{DVec3, DVec4, Vec4};

use super::{Boxed, Form, Friction, Medium};
use crate::error::Error;
use crate::kernel::{
    ACCELERATION, Field, Host, Kernel, Pass, Plan, Problem, STEP_CRITERIA, Scalar, Shader, VELOCITY, World,
};
use crate::visit::{Candidate, Law, Outcome, Over, Particle};

/// The maximum distance of a particle in a step, in spacings, where there is no speed of sound (Courant, Friedrichs & Lewy 1928; 0.4 as in
/// Bender & Koschier 2015).
pub const COURANT: f64 = 0.4;

/// The maximum speed at which neighbours approach or separate \[length / time\].
const CLOSING: Field<f32> = Field::new("closing");

/// The quantities that limit the time step of a fluid, besides accelerations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// The speed of sound \[length / time\]; none where the fluid has none: then speeds are a limit.
    pub sound: Option<f64>,
    /// α of the artificial viscosity, which goes with sound (Monaghan 1992).
    pub alpha: f64,
}

/// The factors of the dt criteria of all particles.
#[derive(Clone, Copy)]
struct Shares {
    acceleration: f64,
    signal: f64,
    /// With what artificial viscosity adds to it.
    sound: f64,
    speed: f64,
}

/// The number of steps per longest step that viscosity requires; `None` with a fixed time step.
///
/// With Morris' form the fastest waves on a lattice ([`Rates`](super::Rates)) are damped at 5.4 to 7.0 ν / s², whatever the kernel and its
/// support: s² / (8 ν) is 0.87 of that time. With the central form they are longitudinal, and damped at 12.9 to 17.8 ν / s²: s² / (20 ν) is
/// 0.89 of that time.
#[must_use]
pub fn viscous_steps(medium: &Medium, friction: Friction, problem: &Problem) -> Option<f64> {
    let length = 0.5 * medium.range();
    let factor = match friction.form {
        Form::Central => 20.0,
        Form::Morris => 8.0,
    };
    problem.adaptive_step.map(|_| problem.dt * factor * friction.viscosity / (length * length))
}

/// Adds kernels that fill [`STEP_CRITERIA`]; none with a fixed time step.
///
/// # Errors
/// When the range is invalid, or a shader does not compile.
pub fn limits(of: &Boxed, over: Over, limits: Limits, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
    let Some(adaptive_step) = problem.adaptive_step else { return Ok(()) };
    let medium = of(&problem.bounds)?;
    let (length, longest) = (0.5 * medium.range(), problem.dt / adaptive_step.courant);
    if limits.sound.is_some() {
        plan.add(closing(of, over).kernel(problem)?);
    }
    let shares = Shares {
        acceleration: longest / length.sqrt(),
        signal: limits.sound.map_or(0.0, |_| longest / length),
        sound: limits.sound.unwrap_or(0.0) * (1.0 + 0.6 * limits.alpha),
        speed: if limits.sound.is_some() { 0.0 } else { longest / (COURANT * medium.spacing) },
    };
    plan.add(criterion(&shares, problem)?);
    Ok(())
}

fn closing(of: &Boxed, over: Over) -> Law {
    let (of, wgsl) = (of.clone(), crate::shader!("sph/closing.wgsl"));
    Law::outlined("fluid closing", over, wgsl, &[CLOSING.name], move |law, problem| {
        let medium = of(&problem.bounds)?;
        let search = medium.search(law.over, Candidate::STILL, &[], problem)?;
        let (length, fixed) = (0.5 * medium.range(), problem.clone());
        let gather = move |me: &Particle, you: &Particle, r: DVec3, _: &World, most: &mut f64| {
            let near = r.length_squared() + 0.01 * length * length;
            *most = most.max((you.velocity - me.velocity).dot(r).abs() * length / near);
        };
        let finish = move |me: &Particle, most: &f64, _: &World, outcome: &mut Outcome| {
            if !fixed.is_held(me.index) {
                outcome.set(CLOSING.name, *most);
            }
        };
        Ok(law.searched(search, Vec::new(), gather, finish))
    })
}

fn criterion(shares: &Shares, problem: &Problem) -> Result<Kernel, Error> {
    let (holding, tables) = problem.holding();
    let shader = Shader::join(&[
        holding,
        problem.active(),
        crate::shader!("world.wgsl"),
        crate::shader!("sph/step_criterion.wgsl"),
    ])?;
    let params = vec![
        ("acceleration", Scalar::Float(shares.acceleration)),
        ("signal", Scalar::Float(shares.signal)),
        ("sound", Scalar::Float(shares.sound)),
        ("speed", Scalar::Float(shares.speed)),
    ];
    let uniforms = shader.block("the limits of a fluid", "params", &params)?;
    let pass = Pass { uniforms, ..Pass::new(shader, problem.capacity) };
    let (shares, all) = (*shares, problem.clone());
    let reference = move |host: &Host| {
        let (velocity, acceleration) = (host.read(VELOCITY)?, host.read(ACCELERATION)?);
        let (closing, mut step_criteria) = (host.read(CLOSING)?, host.write::<Vec4>(STEP_CRITERIA)?);
        let is_active = host.is_active()?;
        for (i, criterion) in step_criteria.iter_mut().enumerate().filter(|(i, _)| !all.is_held(*i)) {
            *criterion = DVec4::new(
                shares.acceleration * acceleration[i].truncate().length().sqrt(),
                shares.signal * (shares.sound + closing[i]),
                shares.speed * velocity[i].truncate().length(),
                0.0,
            ) * f64::from(u8::from(is_active(i)));
        }
        Ok(())
    };
    Ok(Kernel {
        name: "fluid step criterion".to_owned(),
        passes: vec![pass],
        reference: Some(Arc::new(reference)),
        sizes: Vec::new(),
        scratch: Vec::new(),
        tables,
    })
}
