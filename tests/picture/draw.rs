//! Pictures of states on a device and on the host, and how far two of them are apart.

use std::path::PathBuf;

use glam::DVec3;
use motes::kernel::{Array, Backend, Pass, Plan, World};
use motes::render::{Color, Exposure, Image, Picture};
use motes::{Cpu, Gpu, State};

use super::support::{Shared, joint};

/// A backend that holds the particles of a state.
pub fn hold<B: Backend>(mut backend: B, state: &State, picture: &Picture) -> B {
    let count = picture.frame.count;
    let array = |v: &[DVec3], w: &[f64]| Array::Vec4(v.iter().zip(w).map(|(x, w)| x.extend(*w)).collect());
    // A host makes these by itself; kernels of pictures it has none.
    let on_host = backend.host().is_some();
    if !on_host {
        backend.compile(&picture.plan().expect("a plan")).expect("shaders");
    }
    backend.set_world(World { count, dt: 0.1, ..World::default() }).expect("a clock");
    backend.write("position", &array(state.position(), state.mass())).expect("positions");
    backend.write("velocity", &array(state.velocity(), state.size())).expect("velocities");
    if let Some((name, values)) = own(state, picture).filter(|_| !on_host) {
        backend.write(name, values).expect("a column");
    }
    backend
}

/// The column that colours show, where it has a buffer of its own.
fn own<'a>(state: &'a State, picture: &'a Picture) -> Option<(&'a str, &'a Array)> {
    let Color::Value(scaled) = &picture.color else { return None };
    let name = scaled.column.name.as_ref();
    let is_own = scaled.column.place.buffer == name && !["position", "velocity"].contains(&name);
    state.get(name).filter(|_| is_own).map(|values| (name, values))
}

pub fn gpu(shared: &Shared, state: &State, picture: &Picture) -> Gpu {
    let gpu = Gpu::new(&shared.found.device, &shared.found.queue, picture.frame.count).expect("a device");
    let mut gpu = hold(gpu, state, picture);
    if !state.life().is_empty() {
        gpu.write("life", &lives(state)).expect("lives");
    }
    gpu
}

fn lives(state: &State) -> Array {
    Array::Uint(state.life().iter().map(|life| life.word()).collect())
}

/// The plain renderer's picture.
pub fn plain(state: &State, picture: &Picture) -> Image {
    let mut cpu = hold(Cpu::new(picture.frame.count).expect("particles"), state, picture);
    if !state.life().is_empty() {
        cpu.host_mut().insert("life", lives(state));
    }
    if let Some((name, values)) = own(state, picture) {
        cpu.host_mut().insert(name, values.clone());
    }
    pollster::block_on(motes::render::draw(&mut cpu, picture)).expect("a picture")
}

/// The device's picture.
pub fn device(shared: &Shared, state: &State, picture: &Picture) -> Image {
    pollster::block_on(motes::render::draw(&mut gpu(shared, state, picture), picture)).expect("a picture")
}

/// The plans of a picture, with the exposure that it was given.
pub struct Plans {
    exposing: Plan,
    exposure: Exposure,
    developing: Plan,
}

impl Plans {
    /// For a picture that has been drawn of what a device holds.
    pub fn of(gpu: &mut Gpu, picture: &Picture) -> Self {
        let exposing = picture.plan().expect("a plan");
        let exposure = expose(gpu, picture, &exposing, None).expect("an exposure");
        Self { exposing, exposure, developing: picture.development(exposure).expect("a plan") }
    }
    pub fn passes(&self) -> impl Iterator<Item = &Pass> {
        [&self.exposing, &self.developing].into_iter().flat_map(|plan| &plan.kernels).flat_map(|kernel| &kernel.passes)
    }
}

/// The picture by plans that are changed, with the [`joint::choice`] of a mutant where several are compiled together; `None` when one does not
/// compile or run.
pub fn altered(
    gpu: &mut Gpu,
    picture: &Picture,
    plans: &Plans,
    change: impl Fn(&mut Plan) -> Option<()>,
    choice: Option<u32>,
) -> Option<Image> {
    let mut exposing = plans.exposing.clone();
    change(&mut exposing)?;
    // Colours of an earlier picture would stay where a kernel writes none.
    if !matches!(picture.color, Color::Given(_)) && exposing.fields(picture.frame.count).contains_key("color") {
        gpu.write("color", &Array::Uint(vec![0; picture.frame.count as usize])).ok()?;
    }
    let exposure = expose(gpu, picture, &exposing, choice)?;
    let same = exposure == plans.exposure;
    let mut developing = if same { plans.developing.clone() } else { picture.development(exposure).expect("a plan") };
    change(&mut developing)?;
    let program = gpu.compile(&developing).ok()?;
    choose(gpu, &developing, choice)?;
    gpu.run(&program, 1).ok()?;
    let (width, height) = (picture.frame.width, picture.frame.height);
    let not_drawn = words(gpu, "not_drawn", 2)?;
    let rgba = words(gpu, "pixels", (width * height) as usize)?.into_iter().flat_map(u32::to_le_bytes).collect();
    Some(Image { width, height, rgba, outside: not_drawn[0], broken: not_drawn[1] })
}

/// Chooses a mutant in a plan, if it has several.
fn choose(gpu: &mut Gpu, plan: &Plan, choice: Option<u32>) -> Option<()> {
    match choice {
        Some(choice) if plan.fields(1).contains_key(joint::BUFFER) => {
            gpu.write(joint::BUFFER, &Array::Uint(vec![choice])).ok()
        }
        _ => Some(()),
    }
}

fn expose(gpu: &mut Gpu, picture: &Picture, plan: &Plan, choice: Option<u32>) -> Option<Exposure> {
    let frame = &picture.frame;
    let program = gpu.compile(plan).ok()?;
    choose(gpu, plan, choice)?;
    if let (Color::Given(colors), true) = (&picture.color, plan.fields(frame.count).contains_key("color")) {
        gpu.write("color", &Array::Uint(colors.clone())).ok()?;
    }
    if frame.points > 0 {
        gpu.write("trail", &Array::Vec4(picture.trail.points().map(|x| x.extend(0.0)).collect())).ok()?;
    }
    gpu.run(&program, 1).ok()?;
    Some(Exposure::of(&words(gpu, "histogram", 256)?, frame, picture.exposure))
}

fn words(gpu: &mut Gpu, name: &str, len: usize) -> Option<Vec<u32>> {
    match pollster::block_on(gpu.read(name, &Array::Uint(Vec::new()), len)) {
        Ok(Array::Uint(words)) => Some(words),
        _ => None,
    }
}

/// How far two pictures are apart.
#[derive(Debug, Clone, Copy)]
pub struct Difference {
    /// The part of all colours that are more than eight levels apart.
    pub far: f64,
    /// The mean \[levels\].
    pub mean: f64,
}

impl Difference {
    /// What drivers may differ by. A place is known to some 1e-5 pixels, which moves a light by some hundredths of a level; the dither
    /// makes one level of that in as many of the cases. Only where a place decides yes or no (the edge of a ball, which of two is
    /// nearer, a bin of the histogram) is a colour further off. `rounding_is_within_the_tolerance` measures both.
    pub const TOLERANCE: Self = Self { far: 0.002, mean: 0.04 };

    pub fn between(a: &[u8], b: &[u8]) -> Self {
        assert_eq!(a.len(), b.len(), "pictures of one size");
        let levels = || a.iter().zip(b).map(|(a, b)| a.abs_diff(*b));
        let all = a.len() as f64;
        let far = levels().filter(|levels| *levels > 8).count() as f64 / all;
        Self { far, mean: levels().map(f64::from).sum::<f64>() / all }
    }
    pub fn is_within(self, part: f64) -> bool {
        self.far <= part * Self::TOLERANCE.far && self.mean <= part * Self::TOLERANCE.mean
    }
}

/// Red, green and blue.
pub fn rgb(image: &Image) -> Vec<u8> {
    image.rgba.chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect()
}

pub fn file(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("tests/picture/snapshots/{name}.png"))
}

/// The colours of a snapshot.
pub fn snapshot(name: &str) -> Vec<u8> {
    let path = file(name);
    let open = std::fs::File::open(&path);
    let open = open.unwrap_or_else(|e| panic!("{}: {e}; UPDATE=1 writes it", path.display()));
    let mut reader = png::Decoder::new(std::io::BufReader::new(open)).read_info().expect("a PNG");
    let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
    let info = reader.next_frame(&mut bytes).expect("pixels");
    bytes.truncate(info.buffer_size());
    bytes
}
