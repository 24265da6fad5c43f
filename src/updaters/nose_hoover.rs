//! A thermostat with a variable of the whole system.

use std::sync::Arc;

use glam::DVec4;

use super::{Component, Problem, Properties, Stage};
use crate::component::bath::TEMPERATURE;
use crate::component::thermostat::{CHANGE, REMOVED, TOTAL, measured, scale, serves};
use crate::error::Error;
use crate::kernel::{Bounds, Column, Field, Host, Kernel, Kind as Element, Name, Plan, Shader, Shape};
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    TEMPERATURE,
    Key::new("time", Kind::Positive, Value::Number(1.0), "τ, the relaxation time of the thermostat; some periods of the fastest motion [time]"),
    REMOVED,
    Key::new("chain", Kind::Count, Value::Number(3.0), "variables of the system, each of which regulates the one before it; 1: the thermostat of Nosé and Hoover alone"),
];

/// Variables of a chain, at most.
const LONGEST: u32 = 64;
/// ξ
const RATE: Field<f32> = Field::new("thermostat_rate");
/// η
const PHASE: Field<f32> = Field::new("thermostat_phase");

/// `nose_hoover`: v' = a − ξ₁ v, ξ₁' = (2 K / N k T − 1) / τ² − ξ₁ ξ₂, with N degrees of freedom of all particles that are free and have
/// mass (Nosé, J. Chem. Phys. 81, 511, 1984; Hoover, Phys. Rev. A 31, 1695, 1985), and a chain of ξ₂' = N ξ₁² − 1 / τ² − ξ₂ ξ₃,
/// ξ₃' = ξ₂² − 1 / τ² − ξ₃ ξ₄ and so on (Martyna, Klein & Tuckerman, J. Chem. Phys. 97, 2635, 1992). Half of it is done before each step and half
/// after it, which is reversible (Martyna, Tuckerman, Tobias & Klein, Mol. Phys. 87, 1117, 1996), so that
/// K + U + N k T (τ² ξ₁² / 2 + η₁) + k T Σ (τ² ξᵢ² / 2 + ηᵢ), with η the integrals of ξ, swings by dt² and does not drift. Without a chain few or
/// harmonic particles do not visit all states that they should (Hoover 1985): a single oscillator keeps to its torus.
#[derive(Clone)]
pub struct NoseHoover {
    temperature: f64,
    time: f64,
    removed: f64,
    chain: u32,
}

/// exp(−x) − 1, for small x: reversible, since the product of the factors of x and −x is 1.
fn change(x: f64) -> f64 {
    -x / (1.0 + x * (0.5 + x / 12.0))
}

impl NoseHoover {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        let [temperature, time, removed] = ["temperature", "time", "removed"].map(|name| settings.number(name));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked to be a count")]
        let chain = settings.number("chain") as u32;
        Self { temperature, time, removed, chain }
    }
    /// Kernels of a part of a step.
    fn part(&self, factor: f64, problem: &Problem) -> Result<Vec<Kernel>, Error> {
        let mut kernels = measured(problem)?;
        kernels.extend([self.advance(factor, problem)?, scale(problem)?]);
        Ok(kernels)
    }
    /// ξ and η over a part of a step, and what velocities change by.
    fn advance(&self, factor: f64, problem: &Problem) -> Result<Kernel, Error> {
        let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("updaters/nose_hoover.wgsl")])?;
        let dimensions = f64::from(problem.bounds.dimensions);
        let Self { temperature, time, removed, chain } = *self;
        let reference = move |host: &Host| {
            let DVec4 { x: twice, y: count, .. } = host.read(TOTAL)?[0];
            let (mut rate, mut phase) = (host.write(RATE)?, host.write(PHASE)?);
            let (h, freedoms) = (factor * host.world().dt, dimensions * count - removed);
            let mut part = 0.0;
            if freedoms > 0.0 {
                let links = chain as usize;
                // ξ over half of the part.
                let turn = |rate: &mut [f64], link: usize, twice: f64| {
                    let one = 1.0 / (time * time);
                    let push = match link {
                        0 => (twice / (freedoms * temperature) - 1.0) * one,
                        1 => freedoms * rate[0].powi(2) - one,
                        _ => rate[link - 1].powi(2) - one,
                    };
                    let braked = 1.0 + rate.get(link + 1).map_or(0.0, |next| change(0.25 * h * next));
                    rate[link] = (rate[link] * braked + 0.5 * h * push) * braked;
                };
                (0..links).rev().for_each(|link| turn(&mut rate, link, twice));
                part = change(h * rate[0]);
                phase.iter_mut().zip(rate.iter()).for_each(|(phase, rate)| *phase += h * rate);
                let rest = twice * (1.0 + part).powi(2);
                (0..links).for_each(|link| turn(&mut rate, link, rest));
            }
            host.write(CHANGE)?[0] = part;
            Ok(())
        };
        let constants = vec![
            ("FACTOR", factor),
            ("DIMENSIONS", dimensions),
            ("REMOVED", removed),
            ("TEMPERATURE", temperature),
            ("TIME", time),
            ("CHAIN", f64::from(chain)),
        ];
        let kernel = Kernel::new("nose_hoover", shader, constants, 1, Arc::new(reference));
        let some = |name: &'static str, count: u32| (Name::from(name), u64::from(count));
        let sizes = vec![some(TOTAL.name, 1), some(RATE.name, chain), some(PHASE.name, chain), some(CHANGE.name, 1)];
        Ok(Kernel { sizes, ..kernel })
    }
}

impl Component for NoseHoover {
    fn columns(&self) -> Vec<Column> {
        let shape = Shape::System(self.chain);
        let of_all = |name, unit, about| Column::new(name, Element::Scalar, unit, about).shaped(shape);
        vec![
            of_all(RATE.name, "1 / time", "ξ of the chain: the first brakes all particles, each other one the one before it"),
            of_all(PHASE.name, "", "η, the integrals of ξ over time, which the conserved energy counts"),
        ]
    }
    fn check(&self, _: &Bounds) -> Result<(), Error> {
        if self.chain > LONGEST {
            let text = format!("nose_hoover: chain = {} is more than {LONGEST}: a few variables are enough", self.chain);
            return Err(Error::Scene(text));
        }
        Ok(())
    }
    fn properties(&self) -> Properties {
        let why = "nose_hoover is reversible in steps of one length";
        Properties { fixed_step: Some(why), constrains: true, thermostat: true, canonical: true, temperature: Some(self.temperature), ..Properties::default() }
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        if matches!(stage, Stage::StartOfStep | Stage::EndOfStep) {
            serves("nose_hoover", self.removed, problem)?;
            self.part(0.5, problem)?.into_iter().for_each(|kernel| plan.add(kernel));
        }
        Ok(())
    }
}
