//! A picture, before it is drawn.

use std::borrow::Cow;
use std::sync::Arc;

use glam::DVec3;

use super::camera::FEW;
use super::exposure::Exposure;
use super::frame::NEVER;
use super::light::LAMP_VIEW;
use super::palette::pack;
use super::scenery::Facets;
use super::styles::{self, STYLES, Style, Subject};
use super::{Camera, Color, Frame, Scenery, Solid, Trail, Water, fluid, passes};
use crate::cosmology::Expansion;
use crate::error::Error;
use crate::kernel::Plan;
use crate::settings::{Settings, Value};
use crate::state::State;

/// A picture of `count` particles, from one camera. It can be drawn repeatedly as they move.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Camera, size and style.
    pub frame: Frame,
    /// The quantity that determines the colours.
    pub color: Color,
    /// The trails of particles.
    pub trail: Trail,
    /// Brightness of lights, as a multiple of the automatic one.
    pub exposure: f64,
    facets: Facets,
    /// The style, by its name in the register.
    style: &'static str,
    /// The expansion of space, of which notes have the redshift in place of the time.
    pub expansion: Option<Arc<Expansion>>,
    /// Whether notes are written on it.
    annotated: bool,
    /// Whether some may not be active, which are not drawn.
    has_inactive: bool,
}

/// The brightest bloom, as a multiple of the usual one.
const BLOOM: f64 = 1000.0;
/// Pixels from side to side, at most: one invocation draws a whole line.
const SIDE: f64 = 8192.0;
/// Pixels in all, at most: three numbers for each fit the 128 MiB that every device binds.
pub const AREA: u32 = 11_184_810;
/// A ball of many is this large at most \[pixels\].
const LARGEST_OF_MANY: f64 = 80.0;
/// The radius of a light at most \[pixels\]: one invocation draws all of it.
const LARGEST_LIGHT: f64 = 100.0;
/// Brightness of ink, for that of light: before a sky all but black, on paper in colours that stand out from white.
const TINT: f64 = 0.13;
const TINT_ON_PAPER: f64 = 0.6;
/// Samples of a pixel each way, at most.
const FINE: u32 = 3;
/// Samples of all pixels together, at most: a number for each fits the 128 MiB that every device binds.
const SAMPLES: u32 = 1 << 25;

impl Picture {
    /// The picture of a scene's `[picture]`, framed for these particles. `groups` has a number for each of them, or is empty when all are
    /// one group.
    ///
    /// # Errors
    /// [`Error::Scene`] when there are no particles or too many, or the picture is too large.
    pub fn new(settings: &Settings, particles: &State, groups: &[u32], trail: Trail) -> Result<Self, Error> {
        Self::with(settings, particles, groups, trail, &Scenery::default())
    }
    /// The same with links between the particles, and with solids. The key `draw` selects what is drawn of them.
    ///
    /// # Errors
    /// As for [`Picture::new`]; when a link has an id that no particle has, or there are too many solids.
    pub fn with(
        settings: &Settings,
        particles: &State,
        groups: &[u32],
        trail: Trail,
        scenery: &Scenery,
    ) -> Result<Self, Error> {
        let (width, height) = (settings.number("width"), settings.number("height"));
        if !(1.0..=SIDE).contains(&width) || !(1.0..=SIDE).contains(&height) || width * height > f64::from(AREA) {
            return Err(Error::Scene(format!(
                "a picture of {width} × {height} pixels is too large: each side may have {SIDE}, and all of it {AREA}"
            )));
        }
        let bloom = settings.number("bloom");
        if bloom > BLOOM {
            return Err(Error::Scene(format!(
                "`bloom` of the picture is {bloom}: above {BLOOM} nothing but light is left, so give a smaller one"
            )));
        }
        let count = u32::try_from(particles.rows()).ok().filter(|n| *n > 0);
        let count = count.ok_or_else(|| Error::Scene("a picture needs one or more particles".to_owned()))?;
        let (few, entry) = (particles.len() <= FEW, styles::of(settings));
        let style = entry.style;
        let background = settings.text("background");
        let bright = ["dusk", "day", "paper"].contains(&background);
        let wet = style.is_fluid();
        let walls: &[u32] = if wet { &scenery.held } else { &[] };
        let facets = Facets::new(scenery, count, settings.text("draw"), walls)?;
        // Linked particles are one object, of one colour.
        let plain = facets.count > 0 && settings.text("color") == "auto";
        let color = if plain {
            Color::choose(&settings.clone().with("color", Value::Text("group".into())), particles, groups)
        } else if wet && settings.text("color") == "auto" {
            Color::Given(vec![pack(fluid::DYE); particles.len()])
        } else {
            Color::choose(settings, particles, groups)
        };
        let camera = Camera::fit(&beside(particles, &scenery.solids), &trail, settings);
        let pixels = super::frame::whole(width) * super::frame::whole(height);
        let fine = (1..=FINE).rev().find(|n| pixels * n * n <= SAMPLES).unwrap_or(1);
        let short = width.min(height);
        let water_only = color == Color::Given(vec![pack(fluid::DYE); particles.len()]);
        let water = Water::of(settings, particles, scenery, &camera, !water_only);
        let water = Water { edges: if wet { facets.edges() } else { 0 }, ..water };
        // Drops of a fluid have a key of their own.
        let size = if wet { 1.0 } else { settings.number("size") };
        let apart = (width * height / f64::from(count)).sqrt();
        let has_tails = settings.number("tail") > 0.0;
        let subject = Subject { particles, few, short, apart, has_tails, scale: 0.5 * height / camera.extent };
        // A film has one frame for all: what is spawned later is in it.
        let masses = || particles.mass().iter().copied().chain(particles.births.iter().map(|birth| birth.mass));
        let frame = Frame {
            camera,
            count,
            width: super::frame::whole(width),
            height: super::frame::whole(height),
            heaviest: masses().fold(0.0, f64::max),
            mean: masses().sum::<f64>() / f64::from(count),
            marker: size * style.marker(&subject),
            water,
            largest: if few { short / 4.0 } else { LARGEST_OF_MANY.min(short / 4.0) }.max(2.0),
            solid: style.solid(&subject),
            glow: (size * style.glow(&subject)).min(LARGEST_LIGHT),
            magnified: size,
            unit: unit(count),
            speeds: color.ends(),
            points: if style.has_trails() { points(&trail) } else { 0 },
            sky: match background {
                "black" => 0.0,
                "day" => 2.0,
                "sea" => 3.0,
                "paper" => 4.0,
                _ => 1.0,
            },
            line: (short / 800.0).max(0.5),
            // A bright sky outshines every bloom.
            bloom: if bright || wet { 0.0 } else { 1.8 * bloom },
            reach: super::frame::whole(short / 48.0).max(1),
            tail: settings.number("tail"),
            // White has no hue to say where it is heading.
            bleach: if color == Color::Heading { 0.2 } else { 0.6 },
            ink: if bright { 0.94 } else { 0.0 },
            tint: if background == "paper" { TINT_ON_PAPER } else { TINT },
            fine,
            // Many are hair.
            thread: (short / if few { 300.0 } else { 1600.0 }).max(0.5 / f64::from(fine)),
            triangles: facets.triangles,
            facets: facets.count,
            solids: facets.solids(),
            map: 1024,
            slab: if settings.number("slab") > 0.0 { 0.5 * settings.number("slab") } else { NEVER },
            lamp: LAMP_VIEW * camera.extent * (width / height).max(1.0),
        };
        Ok(Self {
            frame,
            color,
            trail,
            exposure: settings.number("exposure"),
            facets,
            style: entry.name,
            expansion: scenery.expansion.clone(),
            annotated: settings.flag("annotate"),
            has_inactive: !particles.life().is_empty() || particles.capacity.is_some(),
        })
    }
    /// Takes other colours.
    pub fn paint(&mut self, color: Color) {
        self.frame.speeds = color.ends();
        self.color = color;
    }
    /// The same picture with other trails.
    pub fn retrace(&mut self, trail: Trail) {
        self.frame.points = if self.style().has_trails() { points(&trail) } else { 0 };
        self.trail = trail;
    }
    /// Replaces the solids.
    pub fn place(&mut self, solids: Vec<Solid>) {
        self.facets.set(solids);
        self.frame.solids = self.facets.solids();
    }
    /// Replaces the tanks.
    pub fn contain(&mut self, tanks: Vec<Solid>) {
        self.facets.contain(tanks);
        self.frame.water.edges = if self.frame.water.is_there() { self.facets.edges() } else { 0 };
    }
    /// Whether the scene asks for [notes](super::Image::annotate) on it.
    #[must_use]
    pub fn annotated(&self) -> bool {
        self.annotated
    }
    /// From particles to light: what runs before the exposure is known.
    ///
    /// # Errors
    /// When a shader does not compile.
    pub fn plan(&self) -> Result<Plan, Error> {
        let (frame, facets) = (&self.frame, &self.facets);
        let mut plan = Plan::default();
        passes::prepare(frame, &mut plan)?;
        if self.has_inactive {
            plan.add(passes::absent(frame.count)?);
        }
        passes::color(self, &mut plan)?;
        if facets.hides() {
            plan.add(passes::hide(frame, facets)?);
        }
        if !facets.is_empty() {
            passes::surfaces(frame, facets, &mut plan)?;
        }
        self.style().light(self, &mut plan)?;
        Ok(plan)
    }
    /// From light to pixels.
    ///
    /// # Errors
    /// When a shader does not compile.
    pub fn development(&self, exposure: Exposure) -> Result<Plan, Error> {
        let mut plan = Plan::default();
        self.style().develop(self, exposure, &mut plan)?;
        Ok(plan)
    }
    /// The same in another style.
    #[cfg(test)]
    pub(super) fn styled(self, style: &'static str) -> Self {
        Self { style, ..self }
    }
    pub(super) fn style(&self) -> &'static dyn Style {
        STYLES.iter().find(|entry| entry.name == self.style).map_or(STYLES[0].style, |entry| entry.style)
    }
    pub(super) fn has_inactive(&self) -> bool {
        self.has_inactive
    }
    pub(super) fn facets(&self) -> &Facets {
        &self.facets
    }
}

/// Particles, and where solids reach to.
fn beside<'a>(particles: &'a State, solids: &[Solid]) -> Cow<'a, State> {
    let mut all = Cow::Borrowed(particles);
    for (solid, reach) in solids.iter().filter_map(|solid| Some((solid, solid.reach()?))) {
        all.to_mut().push(solid.place, DVec3::ZERO, 0.0, reach);
    }
    all
}

fn points(trail: &Trail) -> u32 {
    u32::try_from(trail.points().count()).unwrap_or(0)
}

/// A power of two, so that it is the same on the device, and small enough that the lights of all particles on one pixel
/// do not overflow: each adds `unit` at most.
fn unit(count: u32) -> f64 {
    f64::from(1_u32 << (u32::MAX / count).ilog2().min(16))
}
