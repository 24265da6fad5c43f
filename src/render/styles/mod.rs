//! Picture styles. Each is one file, with its own shaders if it needs them, and one line in the register below.

use glam::DVec3;

use super::plain::Canvas;
use super::{Exposure, Picture, passes};
use crate::error::Error;
use crate::kernel::Plan;
use crate::settings::Settings;
use crate::state::State;

/// The subject of a picture.
pub struct Subject<'a> {
    /// The particles.
    pub particles: &'a State,
    /// Whether they are so few that each is to be seen.
    pub few: bool,
    /// The shorter side of the picture \[pixels\].
    pub short: f64,
    /// The mean distance of particles, if spread evenly over the picture \[pixels\].
    pub apart: f64,
    /// Whether each particle is drawn as a stroke from where it was.
    pub has_tails: bool,
    /// Pixels per length, at the centre.
    pub scale: f64,
}

/// A way of drawing particles.
pub trait Style: Sync {
    /// The radius at which the heaviest particle is drawn at least \[pixels\].
    fn marker(&self, _of: &Subject) -> f64 {
        0.0
    }
    /// The radius from which on a particle is a ball, and below it a light \[pixels\].
    fn solid(&self, _of: &Subject) -> f64 {
        super::frame::NEVER
    }
    /// The radius of a light \[pixels\].
    fn glow(&self, of: &Subject) -> f64 {
        // A stroke has more pixels than a point, and would run into the next one.
        let part = if of.has_tails { 0.28 } else { 0.4 };
        (part * of.apart).clamp(1.5, (of.short / 150.0).max(1.5))
    }
    /// Whether particles are drops of one surface.
    fn is_fluid(&self) -> bool {
        false
    }
    /// Keys of `[picture]` that have no effect in this style.
    fn unused(&self) -> &'static [&'static str] {
        &["drop", "clarity", "foam"]
    }
    /// Whether particles leave trails.
    fn has_trails(&self) -> bool {
        true
    }
    /// From particles to light: adds what runs before the exposure is known.
    ///
    /// # Errors
    /// When a shader does not compile.
    fn light(&self, picture: &Picture, plan: &mut Plan) -> Result<(), Error> {
        passes::lights(&picture.frame, plan)
    }
    /// From light to pixels.
    ///
    /// # Errors
    /// When a shader does not compile.
    fn develop(&self, picture: &Picture, exposure: Exposure, plan: &mut Plan) -> Result<(), Error> {
        passes::tones(&picture.frame, exposure, plan)
    }
    /// The same as [`Style::light`] without a device.
    fn plain(&self, canvas: &mut Canvas) {
        canvas.draw_lights();
    }
    /// The same as [`Style::develop`] without a device: red, green and blue of each pixel, as bytes before they are cut off.
    fn plain_pixels(&self, canvas: &Canvas, exposure: Exposure) -> Vec<DVec3> {
        canvas.tones(exposure)
    }
}

/// A line of the register.
pub struct Entry {
    /// The scene's word for it.
    pub name: &'static str,
    /// One line for a list.
    pub about: &'static str,
    /// The style.
    pub style: &'static dyn Style,
}

macro_rules! register {
    ($($module:ident: $type:ident, $about:literal;)*) => {
        $(mod $module;)*
        /// All styles.
        pub const STYLES: &[Entry] = &[$(Entry { name: stringify!($module), about: $about, style: &$module::$type }),*];
        /// Their names.
        pub const NAMES: &[&str] = &[$(stringify!($module)),*];
    };
}

register! {
    auto: Auto, "balls where they are few or large, otherwise points of light";
    glow: Glow, "lights that add up";
    balls: Balls, "shaded balls";
    fluid: Fluid, "the surface of a fluid";
    density: Density, "the mass along the line of sight, on a logarithmic scale of colours";
}

/// The keys of a picture that have no effect in its style, though their values are not the defaults.
#[must_use]
pub fn remark(settings: &Settings) -> Option<String> {
    let entry = of(settings);
    let defaults = Settings::defaults(super::KEYS);
    let idle = entry.style.unused().iter().filter(|key| settings.0.get(*key) != defaults.0.get(*key));
    let idle: Vec<_> = idle.map(|key| format!("`{key}`")).collect();
    (!idle.is_empty()).then(|| {
        format!(
            "a picture with style = \"{}\" does not draw {}: leave it out, or choose another style",
            entry.name,
            idle.join(", ")
        )
    })
}

/// The style of a scene's `[picture]`.
#[must_use]
pub fn of(settings: &Settings) -> &'static Entry {
    STYLES.iter().find(|entry| entry.name == settings.text("style")).unwrap_or(&STYLES[0])
}
