//! Draws a picture on any backend.

use super::frame::{COLOR, FIELDS, Frame, HISTOGRAM, NOT_DRAWN, PIXELS, TRAIL};
use super::{Color, Exposure, Picture, plain};
use crate::error::Error;
use crate::kernel::{Array, Backend, Element};

/// A finished picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Image {
    /// Pixels from left to right.
    pub width: u32,
    /// Pixels from top to bottom.
    pub height: u32,
    /// Red, green, blue and alpha of each pixel, row by row from the top.
    pub rgba: Vec<u8>,
    /// Particles out of the picture: beyond its edges, or behind the eye.
    pub outside: u32,
    /// Particles that are not drawn because a number of theirs is NaN or infinite.
    pub broken: u32,
}

/// Draws the current state of a backend's particles. Only the pixels, and a histogram for the exposure, are read back.
///
/// # Errors
/// When the picture does not fit the device, or the device is lost, out of memory or does not answer in time.
pub async fn draw<B: Backend>(backend: &mut B, picture: &Picture) -> Result<Image, Error> {
    exposed(backend, picture, |metered| metered).await
}

/// The same with an exposure given by the caller; the measured one is a proposal.
pub(super) async fn exposed<B: Backend>(
    backend: &mut B,
    picture: &Picture,
    choose: impl FnOnce(Exposure) -> Exposure,
) -> Result<Image, Error> {
    granted(&picture.frame, backend.host().is_some())?;
    if let Some(host) = backend.host() {
        return plain::draw(host, picture, choose);
    }
    let image = attempt(backend, picture, choose).await;
    // The next picture may have another size.
    for field in FIELDS {
        backend.forget(field);
    }
    image
}

/// What a picture takes of the host's memory \[bytes\]: for each pixel, where it is drawn by a device and by the references; for each sample
/// of these; and beside them.
const READ: u64 = 16;
const PIXEL: u64 = 160;
const SAMPLE: u64 = 16;
const BESIDE: u64 = 16 << 20;

/// Asks the system for the memory of a picture, once and in one piece: to fail later would end the process.
fn granted(frame: &Frame, by_references: bool) -> Result<(), Error> {
    let [pixels, samples] = [frame.area(), frame.samples()].map(u64::from);
    let bytes = BESIDE + if by_references { pixels * PIXEL + samples * SAMPLE } else { pixels * READ };
    let size = usize::try_from(bytes).unwrap_or(usize::MAX);
    Vec::<u8>::new().try_reserve_exact(size).map_err(|_| {
        Error::Limit(format!(
            "a picture of {}×{} takes some {} MiB of memory, which the system refuses: draw smaller ones (`width` and `height` of \
             [picture]), or none (no \"png\" among `formats`, `frames = 0`)",
            frame.width,
            frame.height,
            bytes >> 20
        ))
    })
}

async fn attempt<B: Backend>(
    backend: &mut B,
    picture: &Picture,
    choose: impl FnOnce(Exposure) -> Exposure,
) -> Result<Image, Error> {
    on_device(backend, picture, choose).await?;
    let frame = &picture.frame;
    let not_drawn = words(backend, NOT_DRAWN.name, 2).await?;
    let pixels = words(backend, PIXELS.name, frame.area() as usize).await?;
    Ok(Image {
        width: frame.width,
        height: frame.height,
        rgba: pixels.iter().flat_map(|p| p.to_le_bytes()).collect(),
        outside: not_drawn.first().copied().unwrap_or(0),
        broken: not_drawn.get(1).copied().unwrap_or(0),
    })
}

/// Draws into the field of pixels, which stays on the device. Only a histogram for the exposure is read back.
pub(super) async fn on_device<B: Backend>(
    backend: &mut B,
    picture: &Picture,
    choose: impl FnOnce(Exposure) -> Exposure,
) -> Result<(), Error> {
    let frame = &picture.frame;
    let plan = picture.plan()?;
    // A style may leave colours out.
    let is_colored = plan.fields(frame.count).contains_key(COLOR.name);
    let expose = backend.compile(&plan)?;
    if let (Color::Given(colors), true) = (&picture.color, is_colored) {
        backend.write(COLOR.name, &Array::Uint(colors.clone()))?;
    }
    if frame.points > 0 {
        backend.write(TRAIL.name, &Array::Vec4(picture.trail.array()))?;
    }
    backend.run(&expose, 1)?;
    let histogram = words(backend, HISTOGRAM.name, super::frame::BINS).await?;
    let exposure = choose(Exposure::of(&histogram, frame, picture.exposure));
    let develop = backend.compile(&picture.development(exposure)?)?;
    backend.run(&develop, 1)
}

async fn words<B: Backend>(backend: &mut B, name: &str, len: usize) -> Result<Vec<u32>, Error> {
    let array = backend.read(name, &Array::Uint(Vec::new()), len).await?;
    Ok(u32::view(&array).cloned().unwrap_or_default())
}
