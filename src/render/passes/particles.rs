//! Particles: where they are seen, their colours, balls, lights and trails.

use std::sync::Arc;

use glam::DVec4;

use super::super::frame::{BINS, Frame, NEVER, PROJECTED, whole};
use super::super::{Color, Picture, Scaled};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Kind, Plan, Shader, Source, Threads, VELOCITY};

/// Iterations of one invocation's loops in one layer, at most: half of the 65 535 that lavapipe allows.
const TURNS: u32 = 1 << 15;
/// Pixels across a diagonal, for each straight across.
const DIAGONAL: f64 = 1.4143;

/// An empty canvas, and where each particle is seen.
pub fn prepare(frame: &Frame, plan: &mut Plan) -> Result<(), Error> {
    // Every bin of the histogram is emptied, however small the picture.
    let threads = frame.area().max(u32::try_from(BINS).unwrap_or(u32::MAX));
    plan.add(frame.simple("clear", &[crate::shader!("render/clear.wgsl")], threads, 1)?);
    plan.add(frame.simple("project", &[crate::shader!("render/project.wgsl")], frame.count, 1)?);
    Ok(())
}

/// Hides particles that are not active, of so many.
///
/// # Errors
/// When the shader does not compile.
pub fn absent(count: u32) -> Result<Kernel, Error> {
    let shader = Shader::join(&[
        crate::shader!("world.wgsl"),
        crate::shader!("life/active.wgsl"),
        crate::shader!("life/absent.wgsl"),
    ])?;
    let reference = |host: &Host| {
        let is_active = host.is_active()?;
        let mut projected = host.write(PROJECTED)?;
        let hidden = projected.iter_mut().enumerate().filter(|(id, _)| !is_active(*id));
        hidden.for_each(|(_, p)| *p = DVec4::new(0.0, 0.0, 0.0, -2.0));
        Ok(())
    };
    Ok(Kernel::new("absent", shader, Vec::new(), count, Arc::new(reference)))
}

/// Colours that are no given ones.
pub fn color(picture: &Picture, plan: &mut Plan) -> Result<(), Error> {
    let heading = [crate::shader!("render/heading_color.wgsl")];
    plan.add(match &picture.color {
        Color::Speed { .. } => {
            let length = crate::shader!("render/column_length.wgsl").renamed("column_buffer", VELOCITY.name);
            on_scale(picture, "color by speed", length, false)?
        }
        Color::Heading => picture.frame.simple("color by heading", &heading, picture.frame.count, 4)?,
        Color::Value(scaled) => by_column(picture, scaled)?,
        Color::Given(_) | Color::Column(_) => return Ok(()),
    });
    Ok(())
}

/// Colours on the scale of values, which a file gives.
fn on_scale(picture: &Picture, name: &str, value: Source, logarithmic: bool) -> Result<Kernel, Error> {
    let files = [crate::shader!("render/scale.wgsl"), value, crate::shader!("render/column_color.wgsl")];
    let mut kernel = picture.frame.simple(name, &files, picture.frame.count, 4)?;
    let logarithmic = ("LOGARITHMIC", f64::from(u8::from(logarithmic)));
    kernel.passes.iter_mut().for_each(|pass| pass.constants.push(logarithmic));
    Ok(kernel)
}

/// Colours by a column, in whatever way it lies on the device.
fn by_column(picture: &Picture, scaled: &Scaled) -> Result<Kernel, Error> {
    let place = &scaled.column.place;
    let alone = place.buffer == scaled.column.name;
    let file = match scaled.column.kind {
        Kind::Whole => crate::shader!("render/column_whole.wgsl"),
        Kind::Scalar if alone => crate::shader!("render/column_scalar.wgsl"),
        Kind::Scalar => crate::shader!("render/column_part.wgsl"),
        Kind::Vector | Kind::Quaternion => crate::shader!("render/column_length.wgsl"),
    };
    let file = file.renamed("column_buffer", &place.buffer);
    let mut kernel = on_scale(picture, "color by column", file, scaled.logarithmic)?;
    if scaled.column.kind == Kind::Scalar && !alone {
        let component = ("COMPONENT", f64::from(place.component));
        kernel.passes.iter_mut().for_each(|pass| pass.constants.push(component));
    }
    Ok(kernel)
}

/// A dispatch over all discs, in layers of so many rows.
pub fn layers(frame: &Frame) -> (Threads, u32) {
    let across = whole(2.0 * frame.largest) + 3;
    // A turn for each row, besides one for each pixel in it.
    let rows = (TURNS / (across + 1)).max(1);
    (Threads { count: frame.count, layers: across.div_ceil(rows) }, rows)
}

/// Balls, lights and trails.
pub fn lights(frame: &Frame, plan: &mut Plan) -> Result<(), Error> {
    if frame.solid < NEVER {
        plan.add(balls(frame)?);
    }
    plan.add(if frame.tail > 0.0 { strokes(frame)? } else { splat(frame)? });
    if frame.points > 0 {
        plan.add(trails(frame)?);
    }
    plan.add(histogram(frame)?);
    Ok(())
}

/// The nearest ball in each pixel, and its particle: two dispatches.
fn balls(frame: &Frame) -> Result<Kernel, Error> {
    let (threads, rows) = layers(frame);
    let mut passes = Vec::new();
    for file in [crate::shader!("render/ball_depth.wgsl"), crate::shader!("render/ball_id.wgsl")] {
        let mut pass = frame.pass(&[crate::shader!("render/disc.wgsl"), file], threads, 64)?;
        pass.constants = vec![("ROWS", f64::from(rows))];
        passes.push(pass);
    }
    Ok(frame.kernel("balls", passes))
}

fn splat(frame: &Frame) -> Result<Kernel, Error> {
    let across = u64::from(whole(2.0 * frame.glow)) + 2;
    frame.simple("splat", &[crate::shader!("render/splat.wgsl")], frame.count, across * across)
}

/// Strokes of light: where each particle has just been.
fn strokes(frame: &Frame) -> Result<Kernel, Error> {
    let across = whole(2.0 * DIAGONAL * frame.glow) + 3;
    // A turn for each column, besides one for each pixel in it.
    let walk = (TURNS / (across + 1)).max(1);
    let threads = Threads { count: frame.count, layers: frame.width.max(frame.height).div_ceil(walk) };
    let mut pass = frame.pass(&[crate::shader!("render/stroke.wgsl")], threads, u64::from(across * across))?;
    pass.constants = vec![("WALK", f64::from(walk))];
    Ok(frame.kernel("strokes", vec![pass]))
}

/// Trails: lines from where each particle was to where it is.
fn trails(frame: &Frame) -> Result<Kernel, Error> {
    let mut pass = frame.pass(&[crate::shader!("render/streak.wgsl")], Threads::new(frame.points), 256)?;
    pass.threads.layers = frame.width.max(frame.height).div_ceil(pass.shader.reflection().constant("WALK"));
    Ok(frame.kernel("trails", vec![pass]))
}

/// How bright the canvas is.
pub fn histogram(frame: &Frame) -> Result<Kernel, Error> {
    frame.simple("luminance histogram", &[crate::shader!("render/histogram.wgsl")], frame.area(), 1)
}
