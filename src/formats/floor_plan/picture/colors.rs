//! What the pixels of a plan are.

#[cfg(feature = "images")]
use std::io::Cursor;

use super::areas::{EXIT, OPEN, WALL};

/// Pixels of a plan, at most: eight thousand each way.
#[cfg(feature = "images")]
const MOST: u64 = 64 << 20;
/// Coloured is what has this much more of one colour than of another, of 255.
const COLORED: u8 = 90;
/// Dark is what has less than this in the mean, of 255.
const DARK: u32 = 140;

/// A plan in pixels, row by row from the top.
pub struct Picture {
    pub width: u32,
    pub height: u32,
    pub kinds: Vec<u8>,
    /// The kind of what is around it.
    pub around: u8,
}

impl Picture {
    /// The same with a margin on all sides \[pixels\].
    pub fn within(self, margin: u32) -> Self {
        let (width, height) = (self.width + 2 * margin, self.height + 2 * margin);
        let mut kinds = vec![self.around; width as usize * height as usize];
        for (row, y) in self.kinds.chunks_exact(self.width as usize).zip(margin as usize..) {
            let start = y * width as usize + margin as usize;
            kinds[start..start + row.len()].copy_from_slice(row);
        }
        Self { width, height, kinds, around: self.around }
    }
}

/// Reads a PNG.
#[cfg(feature = "images")]
pub fn read(bytes: &[u8]) -> Result<Picture, String> {
    let refused = |why: &dyn std::fmt::Display| format!("it is no PNG, or damaged ({why})");
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().map_err(|why| refused(&why))?;
    let (width, height) = (reader.info().width, reader.info().height);
    if u64::from(width) * u64::from(height) > MOST {
        return Err(format!(
            "{width} by {height} pixels are more than the {MOST} that a plan may have: make it smaller"
        ));
    }
    let size = reader.output_buffer_size().ok_or_else(|| refused(&"it does not fit into memory"))?;
    let mut samples = vec![0; size];
    let info = reader.next_frame(&mut samples).map_err(|why| refused(&why))?;
    let kinds = match info.color_type {
        png::ColorType::Grayscale => samples.iter().map(|x| kind([*x; 3], 255)).collect(),
        png::ColorType::GrayscaleAlpha => samples.chunks_exact(2).map(|x| kind([x[0]; 3], x[1])).collect(),
        png::ColorType::Rgb => samples.chunks_exact(3).map(|x| kind([x[0], x[1], x[2]], 255)).collect(),
        png::ColorType::Rgba => samples.chunks_exact(4).map(|x| kind([x[0], x[1], x[2]], x[3])).collect(),
        png::ColorType::Indexed => return Err(refused(&"its palette is missing")),
    };
    Ok(Picture { width, height, kinds, around: OPEN })
}

/// The kind of a pixel on white paper.
pub fn kind(rgb: [u8; 3], alpha: u8) -> u8 {
    let on_white = |x: u8| 255 - u32::from(255 - x) * u32::from(alpha) / 255;
    let rgb = rgb.map(on_white);
    let (most, least) = (rgb.iter().max().copied().unwrap_or(0), rgb.iter().min().copied().unwrap_or(0));
    if most - least > u32::from(COLORED) {
        EXIT
    } else if rgb.iter().sum::<u32>() < 3 * DARK {
        WALL
    } else {
        OPEN
    }
}
