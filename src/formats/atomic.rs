//! Files that are written completely or not at all.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::Path;

use crate::error::Error;

/// Writes a file so that neither a reader nor a crash ever sees it incomplete: into a temporary file in the same folder, which is renamed
/// once it is complete and on the disk. A symbolic link is followed; a file that is not regular (a pipe, `/dev/stdout`) is written to
/// directly.
///
/// # Errors
/// [`Error::Output`] with the path, if the folder, the disk or `write` fails; an existing file is then unchanged.
pub fn atomically(path: &Path, write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> Result<(), Error> {
    replaced(path, write, |_| Ok(())).map_err(|error| failed(path, &error))
}

/// The same, but the new file is renamed only if `check`, which gets the path of the temporary file, returns no error.
///
/// # Errors
/// [`Error::Output`] as before, and errors of `check`; when the path is that of a pipe or a device, which cannot be read back.
pub(super) fn verified<T>(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    check: impl FnOnce(&Path) -> Result<T, Error>,
) -> Result<T, Error> {
    if fs::metadata(path).is_ok_and(|there| !there.is_file()) {
        return Err(failed(
            path,
            &io::Error::other("is not a regular file, and written files are read back: name a regular file"),
        ));
    }
    let mut found = None;
    let checked = replaced(path, write, |temporary| {
        let result = check(temporary);
        let fault = result.as_ref().err().map(|error| io::Error::other(error.to_string()));
        found = Some(result);
        fault.map_or(Ok(()), Err)
    });
    match (found, checked) {
        (Some(Ok(value)), Ok(())) => Ok(value),
        (Some(Err(error)), _) => Err(error),
        (_, Err(error)) => Err(failed(path, &error)),
        (None, Ok(())) => Err(failed(path, &io::Error::other("was not checked"))),
    }
}

fn failed(path: &Path, error: &io::Error) -> Error {
    Error::Output { file: path.to_owned(), message: error.to_string() }
}

fn replaced(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    check: impl FnOnce(&Path) -> io::Result<()>,
) -> io::Result<()> {
    match fs::metadata(path) {
        Ok(there) if !there.is_file() => {
            return filled(OpenOptions::new().write(true).open(path)?, write).map(drop);
        }
        _ => {}
    }
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let folder = match target.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".motes-").suffix(".part");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // As for any new file, subject to the user's umask. (A temporary file would be private.)
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let (file, temporary) = builder.tempfile_in(folder)?.into_parts();
    filled(file, write)?.sync_all()?;
    check(&temporary)?;
    temporary.persist(&target).map_err(|error| error.error)?;
    settle(folder)
}

/// Flushes a folder to the disk: only then is the renaming of a file durable.
#[cfg(unix)]
fn settle(folder: &Path) -> io::Result<()> {
    match File::open(folder)?.sync_all() {
        // Some file systems have no such call for folders.
        Err(why) if matches!(why.kind(), io::ErrorKind::InvalidInput | io::ErrorKind::Unsupported) => Ok(()),
        settled => settled,
    }
}

/// On other systems a folder cannot be opened as a file.
#[cfg(not(unix))]
#[expect(clippy::unnecessary_wraps, reason = "where folders can be opened it may fail")]
fn settle(_: &Path) -> io::Result<()> {
    Ok(())
}

fn filled(file: File, write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> io::Result<File> {
    let mut writer = BufWriter::with_capacity(1 << 16, file);
    write(&mut writer)?;
    writer.flush()?;
    writer.into_inner().map_err(io::IntoInnerError::into_error)
}
