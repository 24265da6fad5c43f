//! One particle on a damped spring under an integrator: x″ = −ω² x − c x′. A step is a matrix, and the
//! matrix determines stability (Hairer, Lubich & Wanner 2006, chapter I). It is measured from the step itself, so that an integrator
//! needs no formula for its stability limit.

use std::borrow::Cow;

use glam::{DMat3, DVec3, DVec4};

use crate::cpu::Cpu;
use crate::error::Error;
use crate::forces::{self, Component};
use crate::integrators::Integrator;
use crate::kernel::{ACCELERATION, Array, Backend, Bounds, POSITION, Solver, VELOCITY, World};
use crate::settings::{Settings, Value};
use crate::simulation::{Setup, Simulation};
use crate::state::State;

/// A run in which nothing grows by more than this is called stable.
const MOST: f64 = 10.0;
/// The first dt that is tried, as a part of 1 / (ω + c): every useful method is stable at it.
const FIRST: f64 = 0.05;
/// From one dt that is tried to the next: a gap of stability narrower than this may be missed.
const STRIDE: f64 = 1.05;
/// A method that is stable at this dt, in units of 1 / (ω + c), is stable at any.
const LAST: f64 = 1e4;
/// One that is unstable at this one is stable at none.
const LEAST: f64 = 1e-9;

/// A damped oscillator under an integrator, of which single steps are looked at.
pub struct Oscillator<B: Backend> {
    simulation: Simulation<B>,
    /// ω + c
    rate: f64,
}

impl Oscillator<Cpu> {
    /// On the references, in f64. `omega` is ω and `damping` is c, both \[1 / time\].
    ///
    /// # Errors
    /// When the numbers are invalid.
    pub fn new(integrator: Box<dyn Integrator>, omega: f64, damping: f64) -> Result<Self, Error> {
        Self::on(Cpu::new(1)?, integrator, omega, damping)
    }
}

impl<B: Backend> Oscillator<B> {
    /// The same on a backend for one particle.
    ///
    /// # Errors
    /// Errors of creating a simulation there.
    pub fn on(backend: B, integrator: Box<dyn Integrator>, omega: f64, damping: f64) -> Result<Self, Error> {
        let setup = oscillator(integrator, omega, damping, 1.0);
        let mut simulation = Simulation::on(backend, &setup)?;
        // After this step the start plan has run.
        simulation.step(1)?;
        Ok(Self { simulation, rate: omega + damping })
    }
    /// The matrix of a step of dt on (x, v, a). An integrator may use the previous acceleration, as leapfrog does, so that it belongs to
    /// the state.
    ///
    /// # Errors
    /// When the device is lost.
    pub async fn step(&mut self, dt: f64) -> Result<DMat3, Error> {
        let backend = self.simulation.backend();
        backend.set_world(World { time: 0.0, dt, step: 0, count: 1, free: 0, bounds: Bounds::default() })?;
        // Three axes that know nothing of each other are three oscillators: one begins with x, one with v, one with a.
        let state = [(POSITION.name, DVec3::X.extend(1.0)), (VELOCITY.name, DVec4::Y), (ACCELERATION.name, DVec4::Z)];
        for (name, value) in state {
            backend.write(name, &Array::Vec4(vec![value]))?;
        }
        self.simulation.step(1)?;
        let mut rows = [DVec3::NAN; 3];
        for (row, (name, _)) in rows.iter_mut().zip(state) {
            let read = self.simulation.backend().read(name, &Array::Vec4(Vec::new()), 1).await?;
            if let Array::Vec4(values) = read {
                *row = values.first().map_or(DVec3::NAN, |v| v.truncate());
            }
        }
        Ok(DMat3::from_cols(rows[0], rows[1], rows[2]).transpose())
    }
    /// The growth factor of a step of dt: the largest |eigenvalue| of its matrix.
    ///
    /// # Errors
    /// When the device is lost.
    pub async fn growth(&mut self, dt: f64) -> Result<f64, Error> {
        Ok(spectral_radius(self.step(dt).await?))
    }
    /// Whether steps of dt over a time let nothing grow tenfold.
    async fn bears(&mut self, dt: f64, duration: f64) -> Result<bool, Error> {
        Ok(self.growth(dt).await?.ln() * (duration / dt) < MOST.ln())
    }
    /// The largest dt for which a run of this duration stays bounded: nothing grows tenfold. Infinite for a method that is stable at any
    /// dt, and 0 for one that is never stable.
    ///
    /// # Errors
    /// When the device is lost.
    pub async fn largest_step(&mut self, duration: f64) -> Result<f64, Error> {
        if self.rate == 0.0 {
            return Ok(f64::INFINITY);
        }
        let mut low = FIRST / self.rate;
        let mut high = low;
        while !self.bears(low, duration).await? {
            (low, high) = (low / 2.0, low);
            if low * self.rate < LEAST {
                return Ok(0.0);
            }
        }
        while low >= high || self.bears(high, duration).await? {
            (low, high) = (high, high * STRIDE);
            if high * self.rate > LAST {
                return Ok(f64::INFINITY);
            }
        }
        while high - low > 1e-13 * low {
            let middle = f64::midpoint(low, high);
            if middle <= low || middle >= high {
                break;
            }
            if self.bears(middle, duration).await? { low = middle } else { high = middle }
        }
        Ok(low)
    }
}

/// The largest dt for which an integrator keeps x″ = −ω² x − c x′ bounded over a duration: by the references, in f64, from its own steps. A
/// network of springs is stable at the result for bounds of ω and c.
///
/// # Errors
/// When the numbers are invalid.
pub async fn largest_step(
    integrator: Box<dyn Integrator>,
    omega: f64,
    damping: f64,
    duration: f64,
) -> Result<f64, Error> {
    Oscillator::new(integrator, omega, damping)?.largest_step(duration).await
}

/// The largest |eigenvalue|: lim ‖Mⁿ‖^(1/n) (Gelfand 1941), with n doubled until it converges. It needs no formula for roots, and is as
/// accurate as the matrix.
#[must_use]
pub fn spectral_radius(mut matrix: DMat3) -> f64 {
    let (mut logarithm, mut part) = (0.0, 1.0);
    for _ in 0..60 {
        if !matrix.is_finite() {
            return f64::INFINITY;
        }
        let size = matrix.to_cols_array().iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        if size == 0.0 {
            return 0.0;
        }
        logarithm += part * size.ln();
        matrix *= 1.0 / size;
        matrix = matrix * matrix;
        part *= 0.5;
    }
    logarithm.exp()
}

/// One particle of mass 1 at x = 1, at rest, that swings with `omega` and is damped by `damping` \[1 / time\].
#[must_use]
pub fn oscillator(integrator: Box<dyn Integrator>, omega: f64, damping: f64, dt: f64) -> Setup {
    let mut particles = State::default();
    particles.push(DVec3::X, DVec3::ZERO, 1.0, 0.0);
    let spring = [("profile", Value::Text(Cow::Borrowed("harmonic"))), ("strength", Value::Number(omega * omega))];
    let drag = [("linear", Value::Number(damping))];
    let mut forces: Vec<Box<dyn Component>> = Vec::new();
    forces.extend(force("attractor", &spring).filter(|_| omega != 0.0));
    forces.extend(force("drag", &drag).filter(|_| damping != 0.0));
    Setup { state: particles, forces, integrator, dt, bounds: Bounds::default(), solver: Solver::default() }
}

fn force(name: &str, settings: &[(&'static str, Value)]) -> Option<Box<dyn Component>> {
    let entry = forces::entry(name)?;
    let all = settings.iter().fold(Settings::defaults(entry.keys), |all, (key, value)| all.with(key, value.clone()));
    Some((entry.build)(&all))
}
