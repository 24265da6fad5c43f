//! Frames without a window, for scripts and tests.

use std::path::Path;

use egui::{Context, Pos2, RawInput, Rect, Vec2};
use motes::gpu::{Controls, Sheet};
use motes::render::Image;
use motes::view::{PICTURE, View};
use motes::{Error, Simulation, gpu};

use super::super::args::ViewArgs;
use super::super::engine;
use super::super::failure::Failure;

/// Draws the frames, a step in each, and saves the last one.
pub async fn draw(args: &ViewArgs, file: &Path) -> Result<(), Failure> {
    let loaded = super::load(args, &super::Origin::find(args, &args.scene)?, &mut Vec::new()).await?;
    let found = engine::open(gpu::adapters(&gpu::instance()).await, args.adapter.as_deref()).await?;
    let (device, queue) = (found.device.clone(), found.queue.clone());
    let make = Box::new(move |setup: &_| Simulation::new(&device, &queue, setup));
    let mut view = View::new(&loaded.scene, loaded.setup, make).await?;
    view.each_frame(1);
    let mut sheet = Sheet::new(&found, args.size)?;
    let [width, height] = sheet.size();
    #[expect(clippy::cast_precision_loss, reason = "at most 4096 pixels")]
    let screen = Rect::from_min_size(Pos2::ZERO, Vec2::new(width as f32, height as f32));
    let context = Context::default();
    let frames = args.frames.unwrap_or(1);
    // The first frame finds the place of the picture, and shows none.
    for frame in 0..=frames {
        let input = RawInput { screen_rect: Some(screen), time: Some(frame as f64 / 60.0), ..RawInput::default() };
        let output = context.run_ui(input, |ui| view.controls(ui));
        let controls = Controls::of(&context, output);
        view.pause(frame == frames);
        view.advance().await?;
        show(&mut view, &mut sheet)?;
        sheet.paint(&controls)?;
        found.faults.check()?;
    }
    Image { width, height, rgba: sheet.read().await?, outside: 0, broken: 0 }.save(file)?;
    let (steps, many) = (view.simulation().steps(), |n: u64| if n == 1 { "" } else { "s" });
    out!("{frames} frame{}, {steps} step{}: {}", many(frames), many(steps), file.display());
    if let [Some(step), Some(picture)] = view.times().map(|time| time.map(|seconds| 1e3 * seconds)) {
        out!("a step took {step:.1} ms, a picture {picture:.1} ms");
    }
    if view.message().is_empty() { Ok(()) } else { Err(Error::Device(view.message().to_owned()).into()) }
}

/// Takes the picture over.
fn show(view: &mut View<motes::Gpu>, sheet: &mut Sheet) -> Result<(), Error> {
    let size = view.size();
    if let Some(pixels) = view.simulation().buffer(PICTURE) {
        let id = sheet.canvas().take(pixels, size)?;
        view.show(id);
    }
    Ok(())
}
