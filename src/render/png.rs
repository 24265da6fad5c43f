//! Images as PNG files.

use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use super::Image;
use crate::error::Error;

impl Image {
    /// Writes a PNG. The file is there whole or not at all.
    ///
    /// # Errors
    /// [`Error::Output`] when the disk refuses.
    pub fn save(&self, path: &Path) -> Result<(), Error> {
        let part = path.with_extension("png.part");
        let written = self.encode(&part).and_then(|()| Ok(std::fs::rename(&part, path)?));
        written.map_err(|error| {
            let _ = std::fs::remove_file(&part);
            Error::Output { file: path.to_owned(), message: error.to_string() }
        })
    }

    fn encode(&self, path: &Path) -> Result<(), png::EncodingError> {
        let mut encoder = png::Encoder::new(BufWriter::new(File::create(path)?), self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header()?;
        let rgb: Vec<u8> = self.rgba.chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
        writer.write_image_data(&rgb)?;
        writer.finish()
    }
}
