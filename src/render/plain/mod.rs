//! A plain renderer for machines without a device: the same looks in f64, one pass after another.

mod fluid;
mod light;
mod particles;
mod raster;
mod surfaces;
mod tones;

use glam::{DVec2, DVec3, DVec4};

use super::exposure::bin;
use super::frame::{BINS, Frame, NEVER, middle, whole};
use super::scenery::LINK;
use super::{Color, Exposure, Image, Picture, Scaled};
use crate::error::Error;
use crate::kernel::{Columns, Host, POSITION, Reading, VELOCITY};

/// A particle in the picture.
#[derive(Debug, Clone, Copy)]
pub struct Disc {
    pub place: DVec2,
    /// Of its front \[length\].
    pub depth: f64,
    /// Of a ball; zero for a light \[pixels\].
    pub radius: f64,
}

/// A picture while it is drawn on the host.
pub struct Canvas<'a> {
    /// Its numbers.
    pub frame: Frame,
    picture: &'a Picture,
    position: Reading<'a, glam::Vec4>,
    velocity: Reading<'a, glam::Vec4>,
    link: Option<Reading<'a, u32>>,
    /// What colours show of each particle, where they show a column.
    values: Vec<f64>,
    /// Of each particle that is drawn by itself.
    pub discs: Vec<Option<Disc>>,
    /// Those that are not active, or for which a surface or a line stands.
    hidden: Vec<bool>,
    /// Of those of the latter that would be drawn.
    walls: Vec<Disc>,
    color: Vec<DVec3>,
    /// What is behind particles, and how much of each pixel it covers.
    pub behind: Vec<DVec4>,
    /// The depth from which on a pixel is hidden.
    front: Vec<f64>,
    /// The particle of the nearest ball.
    ball: Vec<Option<usize>>,
    /// What lights add up to, in units of the canvas.
    pub light: Vec<DVec3>,
    /// Of the brightest trail: brightness, and particle.
    trail: Vec<(f64, usize)>,
}

/// Draws the particles of a host. `choose` gives the exposure, from the one that is metered.
///
/// # Errors
/// When the host has no particles, or a field is being written.
pub fn draw(host: &Host, picture: &Picture, choose: impl FnOnce(Exposure) -> Exposure) -> Result<Image, Error> {
    let (position, velocity) = (host.read(POSITION)?, host.read(VELOCITY)?);
    let link = if host.contains(LINK) { Some(host.reading(LINK)?) } else { None };
    let area = picture.frame.area() as usize;
    let mut canvas = Canvas {
        frame: picture.frame,
        picture,
        position,
        velocity,
        link,
        values: values(host, picture)?,
        discs: Vec::new(),
        hidden: Vec::new(),
        walls: Vec::new(),
        color: Vec::new(),
        behind: vec![DVec4::ZERO; area],
        front: vec![NEVER; area],
        ball: vec![None; area],
        light: vec![DVec3::ZERO; area],
        trail: vec![(0.0, 0); area],
    };
    let [outside, broken] = canvas.project();
    if picture.has_inactive() {
        let is_active = host.is_active()?;
        (0..canvas.discs.len()).filter(|id| !is_active(*id)).for_each(|id| canvas.hide(id));
    }
    canvas.set_colors();
    canvas.stand();
    picture.style().plain(&mut canvas);
    let exposure = choose(Exposure::of(&canvas.histogram(), &canvas.frame, picture.exposure));
    let rgb = picture.style().plain_pixels(&canvas, exposure);
    let byte = |x: f64| u8::try_from(whole(x)).unwrap_or(u8::MAX);
    let rgba = rgb.into_iter().flat_map(|c| [byte(c.x), byte(c.y), byte(c.z), u8::MAX]).collect();
    let (width, height) = (canvas.frame.width, canvas.frame.height);
    Ok(Image { width, height, rgba, outside, broken })
}

/// The column by which a picture is coloured, if there is one.
fn values(host: &Host, picture: &Picture) -> Result<Vec<f64>, Error> {
    let Color::Value(scaled) = &picture.color else { return Ok(Vec::new()) };
    let elements = host.get(&scaled.column.place.buffer).ok_or_else(|| {
        Error::Scene(format!("the column `{}` is not there, so that no colours can show it", scaled.column.name))
    })?;
    Ok(Scaled::sizes(&Columns::unpacked(&scaled.column, &elements)))
}

impl Canvas<'_> {
    /// The pixels within a rectangle of the picture, with their indices.
    fn pixels(&self, low: DVec2, high: DVec2) -> impl Iterator<Item = (usize, DVec2)> + use<> {
        let frame = self.frame;
        let (columns, rows) = frame.touched(low, high);
        rows.flat_map(move |y| columns.clone().map(move |x| (frame.pixel(x, y), middle(x, y))))
    }
    /// Mass and place of every light.
    pub fn lights(&self) -> impl Iterator<Item = (f64, Disc)> {
        let discs = self.discs.iter().zip(&self.position[..]);
        discs.filter_map(|(disc, x)| disc.filter(|disc| disc.radius == 0.0).map(|disc| (x.w, disc)))
    }
    /// The pixels about a light: how near to its middle they are, from 0 at the edge to 1.
    pub fn about(&self, place: DVec2) -> impl Iterator<Item = (usize, f64)> + use<> {
        let glow = self.frame.glow;
        let pixels = self.pixels(place - glow, place + glow);
        let near = move |(at, pixel): (usize, DVec2)| (at, 1.0 - ((pixel - place) / glow).length_squared());
        pixels.map(near).filter(|(_, q)| *q > 0.0)
    }
    fn hide(&mut self, id: usize) {
        self.discs[id] = None;
        self.hidden[id] = true;
    }
    fn histogram(&self) -> Vec<u32> {
        let mut histogram = vec![0; BINS];
        let brightest = self.light.iter().map(|light| whole(light.max_element() + 0.5));
        brightest.filter(|light| *light > 0).for_each(|light| histogram[bin(light)] += 1);
        histogram
    }
}
