//! Images as PNG files.

use std::io::Write;
use std::path::Path;

use super::Image;
use crate::error::Error;
use crate::formats::atomically;

impl Image {
    /// Writes a PNG. The file is there whole or not at all.
    ///
    /// # Errors
    /// [`Error::Output`] when the disk refuses.
    pub fn save(&self, path: &Path) -> Result<(), Error> {
        atomically(path, |out| Ok(self.encode(out)?))
    }
    /// A PNG in memory.
    ///
    /// # Errors
    /// [`Error::Device`] when it has no pixels.
    pub fn png(&self) -> Result<Vec<u8>, Error> {
        let mut bytes = Vec::new();
        self.encode(&mut bytes).map_err(|why| Error::Device(format!("the picture is no PNG: {why}")))?;
        Ok(bytes)
    }

    fn encode(&self, out: impl Write) -> Result<(), png::EncodingError> {
        let mut encoder = png::Encoder::new(out, self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header()?;
        let rgb: Vec<u8> = self.rgba.chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
        writer.write_image_data(&rgb)?;
        writer.finish()
    }
}
