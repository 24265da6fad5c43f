//! Pictures, films and plots as files. A build without the feature `images` writes none, and refuses a run that requires pictures.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::Folder;
use super::stream::Stream;
use crate::error::Error;
use crate::measure::Energy;
use crate::render::{Image, Picture};
use crate::scene::Output;

/// Whether this build can write the pictures of a scene.
///
/// # Errors
/// [`Error::Scene`] when it requires pictures or a film, and this build writes none.
pub fn check(output: &Output) -> Result<(), Error> {
    if cfg!(feature = "images") || !(output.pictures || output.frames > 0) {
        return Ok(());
    }
    Err(Error::Scene(
        "the scene asks for pictures, and this build of motes writes no files of pictures: leave \"png\" out of \
         output.formats and set output.frames = 0, or build it with the feature `images`"
            .to_owned(),
    ))
}

/// Notes on an image, where its picture asks for them. A build without the feature `images` makes no files of it.
pub fn note(image: Image, picture: &Picture, time: f64) -> Image {
    #[cfg(feature = "images")]
    if picture.annotated() {
        let mut image = image;
        image.annotate(picture, time);
        return image;
    }
    let _ = (picture, time);
    image
}

/// A PNG of a picture.
pub fn save(image: &Image, path: &Path) -> Result<(), Error> {
    #[cfg(feature = "images")]
    return image.save(path);
    #[cfg(not(feature = "images"))]
    Err(unwritten(path, image.rgba.len()))
}

/// The same, after all files queued so far, without waiting.
pub fn save_later(image: &Arc<Image>, path: PathBuf, folder: &Arc<Folder>, stream: &Stream) -> Result<(), Error> {
    let (image, folder) = (image.clone(), folder.clone());
    stream.write(&path.clone(), image.rgba.len(), move || {
        // The folder stays locked until the file is written.
        let _held = folder;
        save(&image, &path)
    })
}

/// A film of picture files.
pub fn join(path: &Path, frames: &[PathBuf], rate: u16) -> Result<(), Error> {
    #[cfg(feature = "images")]
    return crate::formats::apng::write_apng(path, frames, rate);
    #[cfg(not(feature = "images"))]
    Err(unwritten(path, frames.len() * usize::from(rate)))
}

/// A plot of energies; a build without the feature `images` writes only their table.
#[cfg_attr(not(feature = "images"), expect(clippy::unnecessary_wraps, reason = "with that feature it may fail"))]
pub fn energy(path: &Path, rows: &[Energy], title: &str) -> Result<(), Error> {
    #[cfg(feature = "images")]
    return super::plot::energy(path, rows, title);
    #[cfg(not(feature = "images"))]
    {
        let _ = (path, rows, title);
        Ok(())
    }
}

#[cfg(not(feature = "images"))]
fn unwritten(path: &Path, _: usize) -> Error {
    let message = "this build of motes writes no pictures: build it with the feature `images`".to_owned();
    Error::Output { file: path.to_owned(), message }
}
