//! Stages: every kernel of a scene's picture, with what it is given and what its reference makes of that.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;
use std::time::Duration;

use glam::Vec4;
use motes::kernel::{Access, Array, Backend, Kernel, Plan, Shader, Source, World};
use motes::{Cpu, Gpu, wgpu};

use crate::alike::alike;
use crate::scenes::Scene;
use crate::support::Random;
use crate::support::machines::alone;

/// Elements behind every field, in which nothing may be written.
const PAD: u64 = 5;

/// One device's fields, for all stages whose pictures have one size: a text that comes again is not compiled again.
pub type Canvas = Rc<RefCell<Gpu>>;

pub struct Stage {
    pub name: String,
    pub kernel: Kernel,
    canvas: Canvas,
    count: u32,
    given: BTreeMap<String, Array>,
    wanted: BTreeMap<String, Array>,
}

impl Stage {
    /// Runs a kernel on what this one is given. Whether it does what the reference does.
    pub fn good(&self, kernel: &Kernel) -> bool {
        let gpu = &mut *self.canvas.borrow_mut();
        let Ok(program) = gpu.compile(&alone(kernel.clone())) else { return false };
        for (name, array) in &self.given {
            gpu.write_bytes(name, 0, &self.padded(name, array, gpu.size(name))).expect("a field");
        }
        gpu.set_world(World { count: self.count, dt: 0.37, ..World::default() }).expect("a clock");
        if gpu.run(&program, 1).is_err() {
            return false;
        }
        self.wanted.iter().all(|(name, want)| {
            let Ok(bytes) = pollster::block_on(gpu.bytes(name, 0, gpu.size(name))) else { return false };
            let (got, behind) = bytes.split_at(want.to_bytes().len());
            let given = self.padded(name, &self.given[name], gpu.size(name));
            behind == &given[got.len()..] && alike(&self.kernel.name, name, want, &want.like(got))
        })
    }
    /// Whether a file is part of what runs here.
    pub fn uses(&self, file: &str) -> bool {
        self.kernel.passes.iter().any(|p| p.shader.sources().iter().any(|s| s.file == file))
    }
    /// The kernel with another text in place of a file's; `None` when that does not compile.
    pub fn mutated(&self, file: &str, text: &str) -> Option<Kernel> {
        let mut kernel = self.kernel.clone();
        // A stranger's text: memory is checked, and loops are bounded.
        let theirs = |s: &Source| if s.file == file { Source::theirs(file.into(), text.into()) } else { s.clone() };
        for pass in &mut kernel.passes {
            if pass.shader.sources().iter().any(|s| s.file == file) {
                let sources: Vec<_> = pass.shader.sources().iter().map(theirs).collect();
                pass.shader = Shader::join(&sources).ok()?;
            }
        }
        Some(kernel)
    }
    /// Bytes of a field, and behind them what a kernel that looks too far would take for a particle in the picture, near
    /// enough to be seen: a ball for kernels of balls, a light for kernels of lights.
    fn padded(&self, name: &str, array: &Array, size: u64) -> Vec<u8> {
        let mut bytes = array.to_bytes();
        let radius = if ["splat", "density"].contains(&self.kernel.name.as_str()) { 0.0 } else { 3.0 };
        // A place in space for kernels that project it.
        let place = if self.kernel.name == "stroke" { [0.13, -0.11] } else { [20.3, 12.7] };
        let behind = Vec4::new(place[0], place[1], 0.1, radius);
        // Of the pixels behind the last one none is taken yet.
        let free = [u32::MAX; 4];
        let behind =
            if ["front", "owner"].contains(&name) { bytemuck::bytes_of(&free) } else { bytemuck::bytes_of(&behind) };
        // No particle there is drawn by itself; there is a facet, which is whole.
        let words = match name {
            "veil" => [1_u32; 4],
            "facet" => [0, 12, 20, 4],
            _ => [0; 4],
        };
        let behind = if ["veil", "facet", "torn"].contains(&name) { bytemuck::bytes_of(&words) } else { behind };
        let words = behind.iter().copied().cycle();
        let missing = usize::try_from(size).expect("small") - bytes.len();
        bytes.extend(words.take(missing));
        bytes
    }
}

/// Fields of a size of picture.
pub fn canvas((device, queue): &(wgpu::Device, wgpu::Queue), count: usize) -> Canvas {
    let count = u32::try_from(count).expect("few");
    let mut gpu = Gpu::new(device, queue, count).expect("a GPU");
    gpu.pad(PAD);
    gpu.limit_submissions(Duration::from_millis(80), Duration::from_secs(5));
    Rc::new(RefCell::new(gpu))
}

/// The stages of a scene: what each is given is what the references before it have left.
pub fn stages(scene: &Scene, canvas: &Canvas) -> Vec<Stage> {
    let plans = [scene.picture.plan(), scene.picture.development(scene.exposure)].map(|p| p.expect("a plan"));
    let count = scene.picture.frame.count;
    let mut cpu = Cpu::new(count).expect("some particles");
    for plan in &plans {
        cpu.compile(plan).expect("references");
        canvas.borrow_mut().compile(plan).expect("a good plan");
    }
    let mut random = Random::new(29);
    let names: Vec<String> = plans.iter().flat_map(|p| p.fields(count)).map(|(name, _)| name).collect();
    for name in &names {
        let garbage = match cpu.host().get(name) {
            // Scratch, which references do without.
            None => continue,
            Some(Array::Vec3(v)) => Array::Vec3(v.iter().map(|_| random.vector()).collect()),
            Some(Array::Vec4(v)) => Array::Vec4(v.iter().map(|_| random.vector().extend(random.next())).collect()),
            Some(Array::Float(v)) => Array::Float(v.iter().map(|_| f64::from(random.narrow())).collect()),
            Some(Array::Uint(v)) => Array::Uint(v.iter().map(|_| random.narrow().to_bits()).collect()),
        };
        cpu.write(name, &garbage.like(&garbage.to_bytes())).expect("a field");
    }
    // What the host says of facets, springs and solids is no garbage.
    for (name, words) in plans.iter().flat_map(|p| &p.kernels).flat_map(|kernel| &kernel.tables) {
        let kind = cpu.host().get(name).expect("a field");
        cpu.write(name, &kind.like(bytemuck::cast_slice(words))).expect("a table");
    }
    for (name, array) in scene.fields() {
        cpu.write(name, &array.like(&array.to_bytes())).expect("a field");
    }
    let mut stages = Vec::new();
    for kernel in plans.iter().flat_map(Plan::steps) {
        let fields = kernel.bindings().filter(|(_, b)| b.access != Access::Uniform).map(|(field, _)| field.to_owned());
        // What is left of an earlier run in a scratch field must not matter; the host has none.
        let fields: Vec<_> = fields.filter(|n| cpu.host().contains(n)).collect();
        let look = |cpu: &Cpu, name: &String| (name.clone(), cpu.host().get(name).expect("a field"));
        let given = fields.iter().map(|name| look(&cpu, name)).collect();
        kernel.reference.as_ref().expect("a reference")(cpu.host()).expect("a reference runs");
        let wanted: BTreeMap<_, _> = kernel.writes().iter().map(|name| look(&cpu, name)).collect();
        for (name, array) in &wanted {
            cpu.write(name, &array.like(&array.to_bytes())).expect("a field");
        }
        if kernel.name == "project" {
            scene.touch_up(cpu.host());
        }
        let name = format!("{}: {}", scene.name, kernel.name);
        stages.push(Stage { name, kernel: kernel.clone(), canvas: canvas.clone(), count, given, wanted });
    }
    stages
}
