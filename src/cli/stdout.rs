//! Standard output, and whether everything that was printed got there.

use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::OnceLock;

use motes::Error;

/// The first failure that loses words.
static FAILURE: OnceLock<String> = OnceLock::new();

/// Takes note of what came of printing. A reader that has closed the pipe has what it wants.
pub fn printed(result: &io::Result<()>) {
    if let Err(why) = result
        && why.kind() != io::ErrorKind::BrokenPipe
    {
        let _ = FAILURE.set(why.to_string());
    }
}

/// Sends what is still held back.
///
/// # Errors
/// [`Error::Output`] where some of what was printed is lost.
pub fn flush() -> Result<(), Error> {
    printed(&io::stdout().flush());
    match FAILURE.get() {
        Some(message) => Err(Error::Output { file: PathBuf::from("standard output"), message: message.clone() }),
        None => Ok(()),
    }
}
