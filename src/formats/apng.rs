//! Animated PNG, from pictures that are PNG files.

use std::fs::File;
use std::io::{self, BufReader, Write};
use std::path::{Path, PathBuf};

use super::atomically;
use crate::error::Error;

/// Writes a film of pictures of one size, of three bytes per pixel, that repeats forever. Each picture is shown for 1 / `rate` s. Only the
/// pixels of a picture that differ from the previous one are stored, so that a constant background costs nothing. Two pictures are in
/// memory at a time.
///
/// # Errors
/// [`Error::Output`], with the file that cannot be read or written; the film is written completely or not at all.
pub fn write_apng(path: &Path, frames: &[PathBuf], rate: u16) -> Result<(), Error> {
    let mut unread = None;
    let written = atomically(path, |out| {
        let count = u32::try_from(frames.len()).map_err(io::Error::other)?;
        film(out, count, frames.iter().map(|file| read(file)), rate).map_err(|fault| {
            let message = fault.error.to_string();
            unread = fault.frame;
            io::Error::other(message)
        })
    });
    match (written, unread) {
        (Err(Error::Output { message, .. }), Some(file)) => Err(Error::Output { file, message }),
        (written, _) => written,
    }
}

/// The same of PNG files in memory.
///
/// # Errors
/// When there is none, one is no such picture, or their sizes differ.
pub fn joined(frames: &[Vec<u8>], rate: u16) -> io::Result<Vec<u8>> {
    let mut out = Vec::new();
    let count = u32::try_from(frames.len()).map_err(io::Error::other)?;
    let pictures = frames.iter().map(|bytes| decoded(io::Cursor::new(bytes)).map_err(Fault::from));
    film(&mut out, count, pictures, rate).map_err(|fault| fault.error)?;
    Ok(out)
}

/// An error, and its frame, if it belongs to one.
struct Fault {
    error: io::Error,
    frame: Option<PathBuf>,
}

impl<E: Into<io::Error>> From<E> for Fault {
    fn from(error: E) -> Self {
        Self { error: error.into(), frame: None }
    }
}

fn film(
    out: impl Write,
    count: u32,
    frames: impl IntoIterator<Item = Result<Pixels, Fault>>,
    rate: u16,
) -> Result<(), Fault> {
    let mut frames = frames.into_iter();
    let mut last = frames.next().ok_or_else(|| io::Error::other("a film needs a picture or more"))??;
    let mut encoder = png::Encoder::new(out, last.width, last.height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_animated(count, 0)?;
    encoder.set_frame_delay(1, rate)?;
    encoder.set_blend_op(png::BlendOp::Over)?;
    encoder.set_dispose_op(png::DisposeOp::None)?;
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&last.rgb.chunks_exact(3).flat_map(|p| [p[0], p[1], p[2], 255]).collect::<Vec<_>>())?;
    for next in frames {
        let next = next?;
        if (next.width, next.height) != (last.width, last.height) {
            let (width, height) = (next.width, next.height);
            let text = format!("{width} × {height} pixels in a film of {} × {}", last.width, last.height);
            return Err(Fault { error: io::Error::other(text), frame: next.file });
        }
        let pixels = last.rgb.chunks_exact(3).zip(next.rgb.chunks_exact(3));
        // A transparent pixel leaves the previous one unchanged.
        let changes = pixels.flat_map(|(old, new)| if old == new { [0; 4] } else { [new[0], new[1], new[2], 255] });
        writer.write_image_data(&changes.collect::<Vec<_>>())?;
        last = next;
    }
    Ok(writer.finish()?)
}

struct Pixels {
    /// The file that it was read from, if it was.
    file: Option<PathBuf>,
    width: u32,
    height: u32,
    rgb: Vec<u8>,
}

fn read(file: &Path) -> Result<Pixels, Fault> {
    let pixels = File::open(file).and_then(|bytes| decoded(BufReader::new(bytes)));
    let pixels = pixels.map_err(|error| Fault { error, frame: Some(file.to_owned()) })?;
    Ok(Pixels { file: Some(file.to_owned()), ..pixels })
}

fn decoded(bytes: impl io::BufRead + io::Seek) -> io::Result<Pixels> {
    let mut reader = png::Decoder::new(bytes).read_info()?;
    let size = reader.output_buffer_size().ok_or_else(|| io::Error::other("a picture larger than memory"))?;
    let mut rgb = vec![0; size];
    let info = reader.next_frame(&mut rgb)?;
    if (info.color_type, info.bit_depth) != (png::ColorType::Rgb, png::BitDepth::Eight) {
        return Err(io::Error::other("not a picture of three bytes for each pixel"));
    }
    rgb.truncate(info.buffer_size());
    Ok(Pixels { file: None, width: info.width, height: info.height, rgb })
}
