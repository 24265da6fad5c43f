//! A picture, before it is drawn.

use std::borrow::Cow;

use glam::DVec3;

use super::camera::FEW;
use super::meter::Exposure;
use super::{Camera, Color, Frame, Trail};
use super::{blank, cover, halo, heading, meter, paint, project, splat, streak, stroke, tone};
use crate::error::Error;
use crate::kernel::Plan;
use crate::particles::Particles;
use crate::settings::{Key, Kind, Settings, Value};

const fn word(text: &'static str) -> Value {
    Value::Text(Cow::Borrowed(text))
}

/// What a scene may say in `[picture]`.
pub const KEYS: &[Key] = &[
    Key::new("width", Kind::Count, Value::Number(1280.0), "from left to right [pixels]"),
    Key::new("height", Kind::Count, Value::Number(720.0), "from top to bottom [pixels]"),
    Key::new("eye", Kind::Direction, Value::Vector(DVec3::new(0.35, -1.0, 0.7)), "from the centre towards the eye"),
    Key::new("up", Kind::Direction, Value::Vector(DVec3::Z), "what is up in the picture"),
    Key::new(
        "projection",
        Kind::Choice(&["perspective", "orthographic"]),
        word("perspective"),
        "whether what is nearer looks larger",
    ),
    Key::new(
        "auto_frame",
        Kind::Flag,
        Value::Flag(true),
        "look at all particles but the outermost, and at their trails; each picture by itself, a film once",
    ),
    Key::new("center", Kind::Vector, Value::Vector(DVec3::ZERO), "what to look at, without auto_frame [length]"),
    Key::new(
        "extent",
        Kind::Positive,
        Value::Number(1.0),
        "half the height of the picture at the centre, without auto_frame [length]",
    ),
    Key::new(
        "style",
        Kind::Choice(&["auto", "glow", "balls"]),
        word("auto"),
        "particles as lights, as shaded balls, or balls where they are few or large",
    ),
    Key::new(
        "color",
        Kind::Choice(&["auto", "group", "speed", "heading"]),
        word("auto"),
        "by group of particles, by speed, by heading (hue round the z axis, lighter upwards); auto: by speed where many are one group",
    ),
    Key::new(
        "tail",
        Kind::NotNegative,
        Value::Number(0.0),
        "draw each particle as a stroke of light from where it was so long ago [time]",
    ),
    Key::new(
        "exposure",
        Kind::Positive,
        Value::Number(1.0),
        "brightness of lights, as a multiple of the automatic one",
    ),
    Key::new(
        "background",
        Kind::Choice(&["night", "black", "dusk"]),
        word("night"),
        "a dark blue sky; nothing; or a bright sky at dusk, with lights and trails as ink",
    ),
];

/// A picture of so many particles, from one place. It can be drawn again and again as they move.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Camera, size and looks.
    pub frame: Frame,
    /// What decides the colours.
    pub color: Color,
    /// Where particles have been.
    pub trail: Trail,
    /// Brightness of lights, as a multiple of the automatic one.
    pub exposure: f64,
}

/// Pixels from side to side, at most: one invocation draws a whole line.
const SIDE: f64 = 8192.0;
/// Pixels in all, at most: three numbers for each fit the 128 MiB that every device binds.
const AREA: f64 = 11_184_810.0;
/// A ball of many is this large at most \[pixels\].
const LARGEST_OF_MANY: f64 = 80.0;
/// No ball is that large \[pixels\].
const NEVER: f64 = 1e9;

impl Picture {
    /// The picture that a scene's `[picture]` asks for, framed for these particles. `groups` has a number for each of
    /// them, or is empty when all are one group.
    ///
    /// # Errors
    /// [`Error::Scene`] when there are no particles or too many, or the picture is too large.
    pub fn new(settings: &Settings, particles: &Particles, groups: &[u32], trail: Trail) -> Result<Self, Error> {
        let (width, height) = (settings.number("width"), settings.number("height"));
        if !(1.0..=SIDE).contains(&width) || !(1.0..=SIDE).contains(&height) || width * height > AREA {
            return Err(Error::Scene(format!(
                "a picture of {width} × {height} pixels is too large: each side may have {SIDE}, and all of it {AREA}"
            )));
        }
        let count = u32::try_from(particles.len()).ok().filter(|n| *n > 0);
        let count = count.ok_or_else(|| Error::Scene("a picture needs one or more particles".to_owned()))?;
        let (few, style) = (particles.len() <= FEW, settings.text("style"));
        let background = settings.text("background");
        let dusk = background == "dusk";
        let color = Color::choose(settings, particles, groups);
        let camera = Camera::fit(particles, &trail, settings);
        let short = width.min(height);
        let frame = Frame {
            camera,
            count,
            width: super::frame::whole(width),
            height: super::frame::whole(height),
            heaviest: particles.mass.iter().copied().fold(0.0, f64::max),
            marker: match style {
                "auto" | "balls" if few => 0.025 * short / (1.0 + f64::from(count) / 16.0),
                "balls" => 1.0,
                _ => 0.0,
            },
            largest: if few { short / 4.0 } else { LARGEST_OF_MANY.min(short / 4.0) }.max(2.0),
            solid: match style {
                "glow" => NEVER,
                "balls" => 0.0,
                _ => solid(particles, 0.5 * height / camera.extent, few),
            },
            glow: {
                // A stroke has more pixels than a point, and would run into the next one.
                let part = if settings.number("tail") > 0.0 { 0.28 } else { 0.4 };
                (part * (width * height / f64::from(count)).sqrt()).clamp(1.5, (short / 150.0).max(1.5))
            },
            unit: unit(count),
            speeds: if let Color::Speed { slow, fast } = color { (slow, fast) } else { (0.0, 1.0) },
            points: points(&trail),
            sky: if background == "black" { 0.0 } else { 1.0 },
            line: (short / 800.0).max(0.5),
            // A bright sky outshines every halo.
            bloom: if dusk { 0.0 } else { 1.8 },
            reach: super::frame::whole(short / 48.0).max(1),
            tail: settings.number("tail"),
            // White has no hue to say where it is heading.
            bleach: if color == Color::Heading { 0.2 } else { 0.6 },
            ink: if dusk { 0.94 } else { 0.0 },
        };
        Ok(Self { frame, color, trail, exposure: settings.number("exposure") })
    }
    /// The same picture with other trails.
    pub fn retrace(&mut self, trail: Trail) {
        self.frame.points = points(&trail);
        self.trail = trail;
    }
    /// From particles to light: what runs before the exposure is known.
    ///
    /// # Errors
    /// When a shader does not compile.
    pub fn plan(&self) -> Result<Plan, Error> {
        let mut plan = Plan::default();
        plan.add(blank::kernel(&self.frame)?);
        plan.add(project::kernel(&self.frame)?);
        match self.color {
            Color::Speed { .. } => plan.add(paint::kernel(&self.frame)?),
            Color::Heading => plan.add(heading::kernel(&self.frame)?),
            Color::Given(_) => {}
        }
        if self.frame.solid < NEVER {
            plan.add(cover::kernel(&self.frame)?);
        }
        let lights = if self.frame.tail > 0.0 { stroke::kernel } else { splat::kernel };
        plan.add(lights(&self.frame)?);
        if self.frame.points > 0 {
            plan.add(streak::kernel(&self.frame)?);
        }
        plan.add(meter::kernel(&self.frame)?);
        Ok(plan)
    }
    /// From light to pixels.
    ///
    /// # Errors
    /// When a shader does not compile.
    pub fn development(&self, exposure: Exposure) -> Result<Plan, Error> {
        let mut plan = Plan::default();
        // Without light there is none to spread: what a device has not written is zero.
        if self.frame.bloom > 0.0 {
            plan.add(halo::kernel(&self.frame, exposure)?);
        }
        plan.add(tone::kernel(&self.frame, exposure)?);
        Ok(plan)
    }
}

fn points(trail: &Trail) -> u32 {
    u32::try_from(trail.points().count()).unwrap_or(0)
}

/// A power of two, so that it is the same on the device, and small enough that the lights of all particles on one pixel
/// do not overflow: each adds `unit` at most.
fn unit(count: u32) -> f64 {
    f64::from(1_u32 << (u32::MAX / count).ilog2().min(16))
}

/// The radius from which on a particle is a ball. A picture in which like particles are balls here and lights there, as
/// they are near or far, is no good: where the usual size is enough for balls, all that have one are.
fn solid(particles: &Particles, scale: f64, few: bool) -> f64 {
    let mut sizes: Vec<f64> = particles.radius.iter().copied().filter(|radius| *radius > 0.0).collect();
    if few {
        return 0.5;
    }
    let middle = sizes.len() / 2;
    if sizes.is_empty() {
        return NEVER;
    }
    let usual = *sizes.select_nth_unstable_by(middle, f64::total_cmp).1 * scale;
    if usual > 2.0 { 0.5 } else { 5.0 }
}
