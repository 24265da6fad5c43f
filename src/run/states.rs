//! `snapshot_*`: states in every numerical format, and `links_*`: the remaining links, where they may break.

use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use super::Folder;
use super::stream::{self, Stream};
use super::table::Lengths;
use super::writer::Writer;
use crate::error::Error;
use crate::formats::vtp::Collection;
use crate::formats::{self, Format, Options, Part, atomically};
use crate::measure::Moment;
use crate::state::State;

/// Files of states.
#[derive(Debug)]
pub struct States {
    formats: Vec<&'static Format>,
    options: Options,
    /// The number of digits of step numbers.
    digits: usize,
    folder: Option<Arc<Folder>>,
    stream: Stream,
    /// The list of VTK files, which ParaView opens in place of each of them.
    listed: Arc<Mutex<Option<Collection>>>,
}

impl States {
    /// Writes these formats, for a run of `steps` steps.
    pub(super) fn new(formats: &[&'static Format], options: Options, steps: u64, stream: Stream) -> Self {
        let digits = steps.to_string().len();
        Self { formats: formats.to_vec(), options, digits, folder: None, stream, listed: Arc::default() }
    }
    /// Remarks on columns of a state that files do not hold.
    pub(super) fn left_out(&self, state: &State) -> Vec<String> {
        let some = |format: &&'static Format| {
            let names = format.left_out.map(|left_out| left_out(state)).filter(|names| !names.is_empty())?;
            Some(format!(
                "`{}` files do not hold {}: choose another format beside it for these",
                format.name,
                names.join(", ")
            ))
        };
        self.formats.iter().filter_map(some).collect()
    }
}

impl Writer for States {
    fn open(&mut self, folder: &Arc<Folder>, _: &Lengths) -> Result<(), Error> {
        self.folder = Some(folder.clone());
        Ok(())
    }
    fn take(&mut self, moment: &Moment<'_>) -> Result<(), Error> {
        let (Some(folder), state, width) = (&self.folder, moment.state, self.digits) else { return Ok(()) };
        for format in &self.formats {
            let parts = if format.divides { self.options.part.of } else { 1 };
            let stem = format!("snapshot_{:0width$}", state.step);
            let parts = (0..parts).map(|number| {
                let part = Part { number, of: parts };
                Ok((folder.file(&part.name(&stem, format))?, part))
            });
            let parts = parts.collect::<Result<Vec<_>, Error>>()?;
            let Some((path, _)) = parts.first().cloned() else { continue };
            let list = (format.name == "vtp").then(|| folder.file(Collection::NAME)).transpose()?;
            // The folder stays locked until the file is written.
            let (folder, listed) = (folder.clone(), self.listed.clone());
            let bounds = self.options.bounds.map(|bounds| state.boxed(&bounds));
            let options = Options { bounds, ..self.options.clone() };
            let (file, format, state) = (path.clone(), *format, state.clone());
            self.stream.write(&path, stream::size(&state), move || {
                let _held = folder;
                for (file, part) in &parts {
                    written(file, format, &state, &Options { part: *part, ..options.clone() })?;
                }
                let Some(list) = list else { return Ok(()) };
                let mut listed = listed.lock().unwrap_or_else(PoisonError::into_inner);
                let listed = listed.get_or_insert_with(|| Collection::before(&list, state.step));
                listed.add(&state, &file);
                atomically(&list, |out| listed.write(out))
            })?;
        }
        if let (Some(links), false) = (moment.links, self.formats.is_empty()) {
            // Read by `[[links]] file`.
            let path = folder.file(&format!("links_{:0width$}.csv", state.step))?;
            let (folder, file, links) = (folder.clone(), path.clone(), links.clone());
            self.stream.write(&path, stream::tied(&links), move || {
                let _held = folder;
                atomically(&file, |out| formats::links::write(out, &links))
            })?;
        }
        Ok(())
    }
}

/// Writes a state into a file of a format.
///
/// # Errors
/// [`Error::Output`] when the file cannot be written.
pub fn written(path: &Path, format: &Format, state: &State, options: &Options) -> Result<(), Error> {
    atomically(path, |out| format.write.map_or(Ok(()), |write| write(out, state, options)))
}
