//! Standard output, and the first error of printing.

use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::OnceLock;

use motes::Error;

/// The first error of printing.
static FAILURE: OnceLock<String> = OnceLock::new();

/// Records an error of printing. A closed pipe is none: its reader has read enough.
pub fn printed(result: &io::Result<()>) {
    if let Err(why) = result
        && why.kind() != io::ErrorKind::BrokenPipe
    {
        let _ = FAILURE.set(why.to_string());
    }
}

/// Flushes standard output.
///
/// # Errors
/// [`Error::Output`] if some of the output is lost.
pub fn flush() -> Result<(), Error> {
    printed(&io::stdout().flush());
    match FAILURE.get() {
        Some(message) => Err(Error::Output { file: PathBuf::from("standard output"), message: message.clone() }),
        None => Ok(()),
    }
}
