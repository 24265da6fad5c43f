//! A claim: a scene, and a number that is known from elsewhere.

use std::time::{Duration, Instant};

use glam::DVec3;
use motes::kernel::Backend;
use motes::scene::{Options, Scene, Source};
use motes::{Cpu, Gpu, Setup, Simulation, State};

use crate::cli::engine::Engine;
use crate::cli::failure::Failure;

/// What is run.
pub enum Run {
    /// A built-in scene, with some values set.
    Builtin(&'static str, &'static [&'static str]),
    /// A scene of its own.
    Own(&'static str),
}

/// A number that a run gives, and the published one.
pub struct Claim {
    /// Its name, for the command line.
    pub name: &'static str,
    /// The family.
    pub family: &'static str,
    /// The set-up, in a sentence.
    pub about: &'static str,
    /// What is run.
    pub run: Run,
    /// What is measured, with its unit.
    pub quantity: &'static str,
    /// The known value.
    pub published: f64,
    /// Its source.
    pub source: &'static str,
    /// The largest difference from it.
    pub tolerance: f64,
    /// The reason of the tolerance.
    pub because: &'static str,
    /// Values of the scene by which the claim has to fail: a check that it can.
    pub control: &'static [&'static str],
    /// Whether it takes more than some seconds: it is then run with `--all`, or by its name.
    pub long: bool,
    /// The number.
    pub measure: fn(&Course) -> f64,
}

/// The states of a run: at the start, and at each output.
pub struct Course {
    /// The states, of which the first is the start and the last is the end.
    pub states: Vec<State>,
}

impl Course {
    /// The state at the start.
    pub fn first(&self) -> &State {
        &self.states[0]
    }
    /// The state at the end.
    pub fn last(&self) -> &State {
        &self.states[self.states.len() - 1]
    }
    /// The mean of a value over the states after the start.
    pub fn mean(&self, of: impl Fn(&State) -> f64) -> f64 {
        let later = &self.states[1..];
        later.iter().map(of).sum::<f64>() / later.len().max(1) as f64
    }
}

/// Twice the kinetic energy of a degree of freedom.
pub fn temperature(state: &State) -> f64 {
    let twice: f64 = state.mass().iter().zip(state.velocity()).map(|(m, v)| m * v.length_squared()).sum();
    twice / (3.0 * state.len() as f64)
}

/// |Σ v| / Σ |v|
pub fn order(state: &State) -> f64 {
    let v = state.velocity();
    v.iter().sum::<DVec3>().length() / v.iter().map(|v| v.length()).sum::<f64>()
}

/// The result of a claim.
pub struct Verdict {
    /// The claim.
    pub claim: &'static Claim,
    /// What was measured.
    pub measured: f64,
    /// What was measured with the values of the control.
    pub control: Option<f64>,
    /// Why there is no number, where a run failed.
    pub error: Option<String>,
    /// How long it took.
    pub time: Duration,
}

impl Claim {
    /// Whether a word of the command line means it.
    pub fn is(&self, word: &str) -> bool {
        self.name == word || self.family == word
    }
    /// Whether a number is within the tolerance. NaN is not.
    pub fn holds(&self, measured: f64) -> bool {
        (measured - self.published).abs() <= self.tolerance
    }
    /// Runs it, and its control if that is asked for.
    pub async fn verdict(&'static self, engine: &Engine, with_control: bool) -> Verdict {
        let begun = Instant::now();
        let (mut measured, mut control, mut error) = (f64::NAN, None, None);
        match self.number(engine, &[]).await {
            Ok(number) => measured = number,
            Err(failure) => error = Some(failure.words()),
        }
        if with_control && error.is_none() {
            match self.number(engine, self.control).await {
                Ok(number) => control = Some(number),
                Err(failure) => error = Some(format!("the control: {}", failure.words())),
            }
        }
        Verdict { claim: self, measured, control, error, time: begun.elapsed() }
    }
    /// The number, with more values set.
    async fn number(&self, engine: &Engine, more: &[&str]) -> Result<f64, Failure> {
        let (source, set) = match self.run {
            Run::Builtin(name, set) => (Source::find(name)?, set),
            Run::Own(text) => {
                let (name, text) = (self.name.to_owned(), text.to_owned());
                (Source::Text { name, text, folder: std::path::PathBuf::new() }, &[][..])
            }
        };
        let overrides: Vec<String> = set.iter().chain(more).map(|word| (*word).to_owned()).collect();
        let mut scene = Scene::load(&source, &overrides, &Options::default())?;
        let (steps, every) = (scene.steps, scene.output.every.clamp(1, u64::from(u32::MAX)));
        let setup = scene.setup();
        let count = setup.check()?;
        let states = match engine {
            Engine::Gpu(found) => states(Gpu::new(&found.device, &found.queue, count)?, &setup, steps, every).await?,
            Engine::Cpu(_) => states(Cpu::new(count)?, &setup, steps, every).await?,
        };
        Ok((self.measure)(&Course { states }))
    }
}

async fn states<B: Backend>(backend: B, setup: &Setup, steps: u64, every: u64) -> Result<Vec<State>, Failure> {
    let mut simulation = Simulation::on(backend, setup)?;
    let mut states = vec![simulation.snapshot().await?];
    let mut done = 0;
    while done < steps {
        let batch = every.min(steps - done);
        done += batch;
        if setup.integrator.adaptive_step().is_some() {
            until(&mut simulation, done as f64 * setup.dt, setup.dt).await?;
        } else {
            simulation.step(u32::try_from(batch).unwrap_or(u32::MAX))?;
        }
        states.push(simulation.snapshot().await?);
    }
    Ok(states)
}

/// Adaptive steps, none longer than `longest`, to a time.
async fn until<B: Backend>(simulation: &mut Simulation<B>, time: f64, longest: f64) -> Result<(), Failure> {
    let time = simulation.stop_at(time)?;
    while let Some(clock) = simulation.clock().await?.filter(|clock| clock.time < time) {
        simulation.step(clock.steps_before(time, longest))?;
        simulation.check().await?;
    }
    Ok(())
}

impl Verdict {
    /// Whether the number is right, and that of the control wrong.
    pub fn good(&self) -> bool {
        self.error.is_none()
            && self.claim.holds(self.measured)
            && !self.control.is_some_and(|number| self.claim.holds(number))
    }
    /// In a word.
    pub fn word(&self) -> &'static str {
        match (self.claim.holds(self.measured), self.good()) {
            _ if self.error.is_some() => "NOT MEASURED",
            (true, true) => "holds",
            (true, false) => "HOLDS FOR THE CONTROL, TOO",
            _ => "FAILS",
        }
    }
}
