//! Pictures in a row, in which nothing jumps but the particles.

use super::draw::{Image, exposed};
use super::{Color, Exposure, Picture, Solid, Trail};
use crate::error::Error;
use crate::kernel::Backend;

/// One camera and one scale of colours for all pictures, and an exposure that follows the light slowly, as an eye does.
#[derive(Debug, Clone, PartialEq)]
pub struct Film {
    picture: Picture,
    exposure: Option<Exposure>,
    /// The scale of a column's colours before it was resumed.
    scale: Option<Ends>,
    /// The part by which each picture approaches its own exposure.
    follow: f64,
}

/// The ends of a scale of values, and whether it is logarithmic.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ends {
    /// The dark end.
    pub low: f64,
    /// The bright end.
    pub high: f64,
    /// Whether it is logarithmic.
    pub logarithmic: bool,
}

/// The margin of a film beyond the first state in each direction, where the camera is framed automatically.
const ROOM: f64 = 1.25;
/// Half of the way to an exposure that would be a picture's own is gone in such a part of the film. The meter counts in eighths
/// of an f-stop: of 240 pictures, none of its jumps makes one brighter than the last by more than 1 %.
const HALF_WAY: f64 = 1.0 / 30.0;

impl Film {
    /// A film of `frames` pictures that begins with this one. With `room` its camera shows a quarter more, in each direction.
    #[must_use]
    pub fn new(mut picture: Picture, frames: u64, room: bool) -> Self {
        if room {
            picture.frame.camera = picture.frame.camera.wider(ROOM);
        }
        let follow = 1.0 - (-1.0 / (HALF_WAY * frames.max(1) as f64)).exp2();
        Self { picture, exposure: None, scale: None, follow }
    }
    /// The settings of its pictures.
    #[must_use]
    pub fn picture(&self) -> &Picture {
        &self.picture
    }
    pub(crate) fn picture_mut(&mut self) -> &mut Picture {
        &mut self.picture
    }
    /// The trails of the next picture.
    pub fn retrace(&mut self, trail: Trail) {
        self.picture.retrace(trail);
    }
    /// Sets the solids of the next picture.
    pub fn place(&mut self, solids: Vec<Solid>) {
        self.picture.place(solids);
    }
    /// Sets the tanks of the next picture.
    pub fn contain(&mut self, tanks: Vec<Solid>) {
        self.picture.contain(tanks);
    }
    /// The exposure of the last picture, if there was one.
    #[must_use]
    pub fn exposure(&self) -> Option<Exposure> {
        self.exposure
    }
    /// The scale of a column's colours, if they have one.
    #[must_use]
    pub fn scale(&self) -> Option<Ends> {
        match &self.picture.color {
            Color::Value(of) => Some(Ends { low: of.low, high: of.high, logarithmic: of.logarithmic }),
            // Nothing was drawn since it was resumed.
            _ => self.scale,
        }
    }
    /// Continues after a picture with this exposure, and with this scale of a column's colours.
    pub fn go_on(&mut self, exposure: Option<Exposure>, scale: Option<Ends>) {
        (self.exposure, self.scale) = (exposure, scale);
    }
    /// Takes the scale from before, where a picture has got one of its own.
    pub(crate) fn rescale(&mut self) {
        let Some(Ends { low, high, logarithmic }) = self.scale.take() else { return };
        let mut color = self.picture.color.clone();
        if let Color::Value(of) = &mut color {
            (of.low, of.high, of.logarithmic) = (low, high, logarithmic);
            self.picture.paint(color);
        }
    }
    /// The exposure of the next picture, whose own would be this one.
    fn follow(&mut self, metered: Exposure) -> Exposure {
        let next = self.exposure.map_or(metered, |last| last.toward(metered, self.follow));
        self.exposure = Some(next);
        next
    }
}

/// Draws the current state of a backend's particles as the next picture of a film.
///
/// # Errors
/// As for `draw`.
pub async fn shoot<B: Backend>(backend: &mut B, film: &mut Film) -> Result<Image, Error> {
    let picture = film.picture.clone();
    exposed(backend, &picture, |metered| film.follow(metered)).await
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::KEYS;
    use crate::settings::Settings;
    use crate::state::State;

    #[test]
    fn the_exposure_follows_slowly_and_arrives() {
        let mut particles = State::default();
        particles.push(glam::DVec3::ONE, glam::DVec3::ZERO, 1.0, 0.0);
        let picture = Picture::new(&Settings::defaults(KEYS), &particles, &[], Trail::new(1)).unwrap();
        let extent = picture.frame.camera.extent;
        let mut film = Film::new(picture.clone(), 240, true);
        assert!((film.picture.frame.camera.extent / extent - 1.25).abs() < 1e-12);
        let (dark, light) = (Exposure { knee: 2.0, white: 10.0 }, Exposure { knee: 4.0, white: 160.0 });
        assert_eq!(film.follow(dark), dark);
        let mut last = dark;
        for _ in 0..120 {
            let next = film.follow(light);
            // Four f-stops in all, of which a picture of 240 does 8 %: a factor of 2^0.33.
            assert!(next.white > last.white && next.white / last.white < 1.26 && next.knee > last.knee);
            last = next;
        }
        // 1.4e-4 of the way is left, half of it fifteen times.
        assert!((last.white / light.white - 1.0).abs() < 1e-3 && (last.knee / light.knee - 1.0).abs() < 1e-3);
        // Of three pictures each has its own, nearly.
        let mut few = Film::new(picture, 3, false);
        few.follow(dark);
        assert!((few.follow(light).white / light.white - 1.0).abs() < 0.01);
    }
}
