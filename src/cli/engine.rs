//! The backend of a command: an adapter of this machine, or the references if there is none.

use motes::formats::Precision;
use motes::gpu::{self, Choice, Found};
use motes::kernel::{Backend, Machine, Plan};
use motes::scene::{Options, Scene, Source};
use motes::{Cpu, Error, Gpu, Setup};

use super::args::{BackendChoice, DeviceArgs, SceneArgs};
use super::failure::Failure;

/// A backend.
pub enum Engine {
    /// A device.
    Gpu(Box<Found>),
    /// The references, and the reason if they were not requested.
    Cpu(Option<String>),
}

impl Engine {
    /// Chooses a backend by the arguments.
    pub async fn choose(args: &DeviceArgs) -> Result<Self, Error> {
        if args.backend == BackendChoice::Cpu {
            if args.adapter.is_some() {
                let text = "--adapter names an adapter, and --backend cpu uses none: leave one of them out";
                return Err(Error::NoAdapter(text.to_owned()));
            }
            return Ok(Self::Cpu(None));
        }
        let adapters = gpu::adapters(&gpu::instance()).await;
        if adapters.is_empty() && args.backend == BackendChoice::Auto && args.adapter.is_none() {
            return Ok(Self::Cpu(Some(gpu::NO_DRIVER.to_owned())));
        }
        Ok(Self::Gpu(Box::new(open(adapters, args.adapter.as_deref()).await?)))
    }
    /// Its name, for messages and for files.
    pub fn describe(&self) -> String {
        match self {
            Self::Gpu(found) => found.describe(),
            Self::Cpu(_) => format!("f64 references on {} cores of the processor", rayon::current_num_threads()),
        }
    }
    /// The precision of its numbers.
    pub fn precision(&self) -> Precision {
        if let Self::Cpu(_) = self { Precision::Double } else { Precision::Single }
    }
    /// The limits for which plans are made.
    pub fn machine(&self, count: u32) -> Result<Machine, Error> {
        Ok(match self {
            Self::Gpu(found) => Gpu::new(&found.device, &found.queue, count)?.machine(),
            Self::Cpu(_) => Cpu::new(count)?.machine(),
        })
    }
    /// A plan as it runs there: a device fuses kernels that treat each particle alone.
    pub fn runs(&self, plan: &Plan) -> Plan {
        match self {
            Self::Gpu(_) => plan.fused(),
            Self::Cpu(_) => plan.clone(),
        }
    }
    /// Remarks on it, and on a setup that runs on it.
    pub fn remarks(&self, setup: &Setup) -> Result<Vec<String>, Failure> {
        let single = matches!(self, Self::Gpu(_));
        let of_machine = motes::diagnose::of_machine(setup, self.machine(1)?, single)?;
        Ok(self.own().into_iter().chain(of_machine.iter().map(ToString::to_string)).collect())
    }
    /// Remarks on it.
    pub fn own(&self) -> Vec<String> {
        match self {
            Self::Cpu(Some(reason)) => {
                vec![format!("{reason}; running the f64 references instead, which are slow")]
            }
            Self::Cpu(None) => Vec::new(),
            Self::Gpu(found) => {
                let software =
                    found.software().then(|| "this adapter is software: it runs on the processor".to_owned());
                found.substitute().into_iter().chain(software).collect()
            }
        }
    }
}

/// Opens the adapter of this name, or the best.
pub async fn open(adapters: Vec<motes::wgpu::Adapter>, name: Option<&str>) -> Result<Found, Error> {
    let choice = name.map_or(Choice::Best, |name| Choice::Named(name.to_owned()));
    gpu::open(gpu::choose(adapters, &choice)?).await
}

/// Loads the scene of the arguments.
pub fn load(args: &SceneArgs) -> Result<Scene, Failure> {
    load_with(args, &[])
}

/// The same with additional overrides.
pub fn load_with(args: &SceneArgs, more: &[String]) -> Result<Scene, Failure> {
    load_from(&Source::find(&args.scene)?, args, more)
}

/// The same from another source.
pub fn load_from(source: &Source, args: &SceneArgs, more: &[String]) -> Result<Scene, Failure> {
    let mut overrides = args.overrides.clone();
    overrides.extend_from_slice(more);
    overrides.extend(args.steps.map(|n| format!("simulation.steps={n}")));
    overrides.extend(args.until.map(|t| format!("simulation.until={t:?}")));
    load_scaled(source, overrides, args.scale, &Options { allow_outside: args.allow_outside, ..Options::default() })
}

/// Loads a scene with these overrides, and so many times its particles.
pub fn load_scaled(
    source: &Source,
    mut overrides: Vec<String>,
    scale: Option<f64>,
    options: &Options,
) -> Result<Scene, Failure> {
    let scene = Scene::load(source, &overrides, options)?;
    let Some(factor) = scale else { return Ok(scene) };
    let scaled = scene.scaled(factor)?;
    overrides.extend_from_slice(&scaled);
    let mut scene = Scene::load(source, &overrides, options)?;
    scene.remarks.push(format!("--scale {factor} sets {}", scaled.join(", ")));
    Ok(scene)
}
