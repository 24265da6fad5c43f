//! A film of what is seen.

use crate::error::Error;
use crate::formats::apng;
use crate::render::Image;

/// Pictures in a second of film.
const RATE: u16 = 30;
/// Bytes of pictures that are kept, at most.
const MOST: usize = 512 << 20;

/// Pictures of one size, as PNG, which become a film.
pub struct Recording {
    pub size: [u32; 2],
    pictures: Vec<Vec<u8>>,
    bytes: usize,
    /// The step of the last one.
    step: Option<u64>,
}

impl Recording {
    pub fn new(size: [u32; 2]) -> Self {
        Self { size, pictures: Vec::new(), bytes: 0, step: None }
    }
    /// Whether a picture of this step is wanted: what stands still is not filmed.
    pub fn wants(&self, step: u64) -> bool {
        self.step != Some(step)
    }
    /// Adds the picture of a step. Returns whether there is room for more.
    pub fn add(&mut self, step: u64, image: &Image) -> Result<bool, Error> {
        let png = image.png()?;
        self.bytes += png.len();
        self.pictures.push(png);
        self.step = Some(step);
        Ok(self.bytes < MOST)
    }
    pub fn is_empty(&self) -> bool {
        self.pictures.is_empty()
    }
    /// What is said meanwhile.
    pub fn words(&self) -> String {
        let (pictures, seconds) = (self.pictures.len(), self.pictures.len() as f64 / f64::from(RATE));
        format!("recording: {pictures} pictures, {seconds:.1} s of film; V ends it")
    }
    /// The film, an animated PNG.
    pub fn film(&self) -> Result<Vec<u8>, Error> {
        apng::joined(&self.pictures, RATE).map_err(|why| Error::Device(format!("the film cannot be made: {why}")))
    }
}
