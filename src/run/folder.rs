//! The folder that a run writes into: it belongs to one run at a time, and nothing in it is deleted unless requested.

use std::collections::BTreeSet;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::formats::FORMATS;
use crate::measure::{MEASURES, Measure};

/// The file that is locked while a run writes.
const LOCK: &str = ".motes-lock";
/// The folder of the pictures of a film.
const FRAMES: &str = "frames";
/// The text before the name of the scene in that line.
const NAMED: &str = ", as ";

/// Files that a run writes under one name, beside the last good state.
const NAMES: &[&str] = &["scene.toml", "energy.svg", "snapshots.pvd"];
/// Files of which it writes many, with the number of a step or a picture between these two strings.
const NUMBERED: &[(&str, &str)] = &[("links_", "csv"), ("picture_", "png"), ("frame_", "png"), CHECKPOINT];
/// The files from which a run continues.
const CHECKPOINT: (&str, &str) = ("checkpoint_", "npz");
/// States, and the last good one, in any format.
const STATE: &str = "snapshot_";
const LAST_GOOD: &str = "last_good";
/// Files that begin with the name of the scene.
const ENDINGS: &[&str] = &[".png", "_film.png", "_film.mp4", "_film.part.mp4"];

/// The folder of a run, locked until this is dropped.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    name: String,
    lock: Option<File>,
    remark: Option<String>,
}

impl Folder {
    /// The start of the line about the run in the resolved scene.
    pub const SIGNATURE: &str = "# Run by motes ";

    /// Whether a run of the scene `name`, which reads the files `read`, may write into the folder. It may not if its results would replace
    /// a file that it reads, a file that no run has written, or, unless `overwrite` is set, those of another run.
    ///
    /// # Errors
    /// [`Error::Output`] with the file that would be replaced.
    pub fn examine(path: &Path, name: &str, read: &[PathBuf], overwrite: bool) -> Result<(), Error> {
        let Some(inside) = fs::canonicalize(path).ok().filter(|found| found.is_dir()) else { return Ok(()) };
        let earlier = earlier(path);
        let found = results(path, &[Some(name), earlier.as_deref()]).map_err(|why| failed(path, &why))?;
        for file in read.iter().filter_map(|file| fs::canonicalize(file).ok()) {
            let of_run = |result: &&PathBuf| inside.join(result) == file;
            if let Some(result) = found.iter().find(of_run) {
                return refused(
                    &path.join(result),
                    "this run reads the file, and its results would replace it: choose another folder with -o",
                );
            }
        }
        match (found.first(), &earlier) {
            (Some(first), None) => refused(
                &path.join(first),
                "the file is there already, and the folder has no scene.toml of a run, so that it may not be a result: \
                 choose another folder with -o",
            ),
            (Some(first), Some(_)) if !overwrite => {
                let more = match found.len() - 1 {
                    0 => String::new(),
                    more => format!(" and {more} more"),
                };
                refused(
                    path,
                    &format!(
                        "the folder holds the results of another run ({}{more}): choose another folder with -o, or say \
                         --overwrite, which removes them",
                        first.display()
                    ),
                )
            }
            _ => Ok(()),
        }
    }

    /// Creates the folder and locks it for a run of the scene `name`, which reads the files `read`; with `overwrite` it removes the results
    /// of an earlier run. Partly written files of a killed run are removed, too.
    ///
    /// # Errors
    /// [`Error::Output`] where [`Folder::examine`] refuses, another run holds the lock, or the folder cannot be made.
    pub fn open(path: &Path, name: &str, read: &[PathBuf], overwrite: bool) -> Result<Self, Error> {
        let folder = Self::hold(path)?.named(name);
        Self::examine(path, name, read, overwrite)?;
        let earlier = earlier(path);
        let mut old = results(path, &[Some(name), earlier.as_deref()]).map_err(|why| failed(path, &why))?;
        // The file with the signature is removed last: if a removal is interrupted, the rest is still recognised as results.
        old.sort_by_key(|file| file == Path::new("scene.toml"));
        removed(old.into_iter().map(|file| path.join(file)).chain(parts(path)))?;
        Ok(folder)
    }

    /// Creates the folder and locks it for a run whose scene is not known yet; nothing in it is removed.
    ///
    /// # Errors
    /// [`Error::Output`] where another run holds the lock, or the folder cannot be made.
    pub fn hold(path: &Path) -> Result<Self, Error> {
        let fails = |why: &io::Error| failed(path, why);
        fs::create_dir_all(path).map_err(|why| fails(&why))?;
        let (lock, remark) = match locked(&path.join(LOCK)).map_err(|why| fails(&why))? {
            Locked::Here(lock) => (Some(lock), None),
            Locked::Elsewhere => {
                refused(path, "another run writes into this folder: wait until it ends, or choose another with -o")?;
                (None, None)
            }
            Locked::Never(why) => {
                let text = format!("the folder cannot be locked ({why}): start no second run into it");
                (None, Some(text))
            }
        };
        Ok(Self { path: path.to_owned(), name: String::new(), lock, remark })
    }

    /// The same for a run of this scene.
    #[must_use]
    pub fn named(mut self, name: &str) -> Self {
        name.clone_into(&mut self.name);
        self
    }

    /// The names of existing results, except checkpoints.
    ///
    /// # Errors
    /// [`Error::Output`] when the folder cannot be read.
    pub fn results(&self) -> Result<BTreeSet<String>, Error> {
        let found = results(&self.path, &[Some(&self.name)]).map_err(|why| failed(&self.path, &why))?;
        let names = found.iter().filter_map(|file| file.to_str()).filter(|name| checkpointed(name).is_none());
        Ok(names.map(|name| name.replace('\\', "/")).collect())
    }

    /// Removes all results except these, and partly written files. Returns the number of removed results.
    ///
    /// # Errors
    /// [`Error::Output`] when a file cannot be removed.
    pub fn keep_only(&self, results: &BTreeSet<String>) -> Result<usize, Error> {
        let gone: Vec<_> = self.results()?.difference(results).map(|name| self.path.join(name)).collect();
        removed(parts(&self.path).into_iter())?;
        let count = gone.len();
        removed(gone.into_iter())?;
        Ok(count)
    }

    /// The file of the checkpoint of a step.
    ///
    /// # Errors
    /// As for [`Folder::file`].
    pub fn checkpoint(&self, step: u64) -> Result<PathBuf, Error> {
        self.file(&format!("{}{step:010}.{}", CHECKPOINT.0, CHECKPOINT.1))
    }

    /// The existing checkpoints, the newest first.
    ///
    /// # Errors
    /// [`Error::Output`] when the folder cannot be read.
    pub fn checkpoints(&self) -> Result<Vec<PathBuf>, Error> {
        let found = results(&self.path, &[]).map_err(|why| failed(&self.path, &why))?;
        let mut found: Vec<_> = found.iter().map(|file| self.path.join(file)).collect();
        found.retain(|file| number_of(file).is_some());
        found.sort_by_key(|file| std::cmp::Reverse(number_of(file)));
        Ok(found)
    }

    /// Removes checkpoints up to this step except the newest of them. Later ones, which were passed over, are kept.
    ///
    /// # Errors
    /// [`Error::Output`] when a file cannot be removed.
    pub fn keep_checkpoints(&self, most: usize, step: u64) -> Result<(), Error> {
        removed(self.checkpoints()?.into_iter().filter(|file| number_of(file) <= Some(step)).skip(most))
    }

    /// Its path.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// A remark, which is no error: the file system has no locks.
    #[must_use]
    pub fn remark(&self) -> Option<&str> {
        self.remark.as_deref()
    }

    /// The line at the end of the resolved scene by which a later run recognises the results of this one.
    #[must_use]
    pub fn signature(&self, device: &str) -> String {
        format!("{}{} on {device}{NAMED}{}\n", Self::SIGNATURE, env!("CARGO_PKG_VERSION"), self.name)
    }

    /// The path of a result.
    ///
    /// # Errors
    /// [`Error::Output`] if a later run would not recognise the name as that of a result.
    pub fn file(&self, name: &str) -> Result<PathBuf, Error> {
        let path = self.path.join(name);
        if is_result(name, &[Some(&self.name)]) {
            return Ok(path);
        }
        refused(&path, "run/folder.rs does not list this name among those of results, which is a bug in motes")?;
        Ok(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // While the lock is held: a process that waits for it checks whether the path still refers to the same file.
        if self.lock.is_some() {
            let _ = fs::remove_file(self.path.join(LOCK));
        }
    }
}

/// The result of an attempt to lock.
enum Locked {
    Here(File),
    Elsewhere,
    Never(io::Error),
}

fn locked(path: &Path) -> io::Result<Locked> {
    // The run that held the lock may have removed the file between the two calls.
    for _ in 0..100 {
        if fs::symlink_metadata(path).is_ok_and(|found| !found.is_file()) {
            return Err(io::Error::other(format!("{} is no ordinary file: remove it", path.display())));
        }
        let file = OpenOptions::new().create(true).truncate(false).write(true).open(path)?;
        match file.try_lock() {
            Ok(()) if is_there(&file, path) => return Ok(Locked::Here(file)),
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Ok(Locked::Elsewhere),
            Err(TryLockError::Error(why)) => return Ok(Locked::Never(why)),
        }
    }
    Ok(Locked::Elsewhere)
}

/// Whether an open file still has this path.
#[cfg(unix)]
fn is_there(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let (Ok(open), Ok(named)) = (file.metadata(), fs::metadata(path)) else { return false };
    (open.dev(), open.ino()) == (named.dev(), named.ino())
}

/// On other systems an open file keeps its name.
#[cfg(not(unix))]
fn is_there(_: &File, path: &Path) -> bool {
    path.exists()
}

/// The name of the scene whose results are in the folder, if any; empty if an old run did not record it.
fn earlier(path: &Path) -> Option<String> {
    let text = fs::read_to_string(path.join("scene.toml")).ok()?;
    let line = text.lines().rev().find_map(|line| line.strip_prefix(Folder::SIGNATURE))?;
    Some(line.rsplit_once(NAMED).map_or_else(String::new, |(_, name)| name.to_owned()))
}

/// Names in the folder that are those of results of these scenes, in order; symbolic links count by their names.
fn results(path: &Path, scenes: &[Option<&str>]) -> io::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(path)? {
        let entry = entry?;
        let name = entry.file_name();
        let Some(text) = name.to_str() else { continue };
        let kind = entry.file_type()?;
        if text == FRAMES && kind.is_symlink() {
            return Err(io::Error::other(format!(
                "{FRAMES} is a link, and results are not written through links: remove it"
            )));
        }
        if text == FRAMES && kind.is_dir() {
            for frame in fs::read_dir(entry.path())? {
                let frame = frame?;
                let (frame, kind) = (frame.file_name(), frame.file_type()?);
                if !kind.is_dir() && frame.to_str().is_some_and(|frame| is_result(&format!("{FRAMES}/{frame}"), scenes))
                {
                    found.push(Path::new(FRAMES).join(frame));
                }
            }
        }
        if !kind.is_dir() && is_result(text, scenes) && !is_foreign(&entry.path()) {
            found.push(PathBuf::from(name));
        }
    }
    found.sort();
    Ok(found)
}

/// Partly written files of a killed run.
fn parts(path: &Path) -> Vec<PathBuf> {
    let inside = |folder: PathBuf| fs::read_dir(folder).into_iter().flatten().flatten();
    let is_part = |name: &str| name.strip_suffix(".part").is_some_and(|stem| stem.starts_with(".motes-"));
    let entries = inside(path.to_owned()).chain(inside(path.join(FRAMES)));
    entries.filter(|entry| entry.file_name().to_str().is_some_and(is_part)).map(|entry| entry.path()).collect()
}

/// Whether a run of one of these scenes writes a file of this name.
fn is_result(name: &str, scenes: &[Option<&str>]) -> bool {
    let (name, framed) = match name.split_once('/') {
        Some((FRAMES, frame)) => (frame, true),
        Some(_) => return false,
        None => (name, false),
    };
    let stem = |ending: &str| name.strip_suffix(ending).and_then(|stem| stem.strip_suffix('.'));
    let numbered = |kind: (&str, &str)| (kind.0 == "frame_") == framed && digits(name, kind).is_some();
    let states = || FORMATS.iter().filter(|format| format.write.is_some()).map(|format| format.name);
    let of_scene =
        |scene: &str| !scene.is_empty() && name.strip_prefix(scene).is_some_and(|end| ENDINGS.contains(&end));
    // A part of a set: snapshot_10.3.hdf5.
    let of_set = || {
        let mut divided = FORMATS.iter().filter(|format| format.divides && !framed);
        let part =
            |ending: &str| stem(ending)?.rsplit_once('.').filter(|(_, part)| part.bytes().all(|b| b.is_ascii_digit()));
        divided.any(|format| {
            part(format.name).is_some_and(|(stem, part)| {
                !part.is_empty() && digits(&format!("{stem}.{}", format.name), (STATE, format.name)).is_some()
            })
        })
    };
    let last = || states().any(|ending| stem(ending) == Some(LAST_GOOD));
    let own = || {
        NAMES.contains(&name) || table(name).is_some() || last() || scenes.iter().flatten().any(|scene| of_scene(scene))
    };
    let kinds = NUMBERED.iter().copied().chain(states().map(|ending| (STATE, ending)));
    kinds.into_iter().any(numbered) || of_set() || !framed && own()
}

/// The digits between the two words of a name.
fn digits<'a>(name: &'a str, (before, ending): (&str, &str)) -> Option<&'a str> {
    let digits = name.strip_suffix(ending)?.strip_suffix('.')?.strip_prefix(before)?;
    (!digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit())).then_some(digits)
}

/// The step of a checkpoint of this name.
fn checkpointed(name: &str) -> Option<u64> {
    digits(name, CHECKPOINT)?.parse().ok()
}

fn number_of(file: &Path) -> Option<u64> {
    checkpointed(file.file_name()?.to_str()?)
}

fn removed(mut files: impl Iterator<Item = PathBuf>) -> Result<(), Error> {
    files.try_for_each(|file| fs::remove_file(&file).map_err(|why| failed(&file, &why)))
}

fn failed(path: &Path, why: &io::Error) -> Error {
    Error::Output { file: path.to_owned(), message: why.to_string() }
}

fn refused(path: &Path, why: &str) -> Result<(), Error> {
    Err(Error::Output { file: path.to_owned(), message: why.to_owned() })
}

/// The measure of a table of this name, `flock.csv`, or `flock_2.csv` where a scene has two; and whether it is a second or a further one.
fn table(name: &str) -> Option<(&'static Measure, bool)> {
    let stem = name.strip_suffix(".csv")?;
    let number = |number: &str| number.parse().is_ok_and(|n: u32| n > 1 && n.to_string() == number);
    MEASURES.iter().find_map(|measure| {
        let end = stem.strip_prefix(measure.name)?;
        let further = end.strip_prefix('_').is_some_and(number);
        (end.is_empty() || further).then_some((measure, further))
    })
}

/// Whether a file has the name of such a further table, and not its first line: no run has written it.
fn is_foreign(file: &Path) -> bool {
    let name = file.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    let Some((measure, true)) = table(name) else { return false };
    let (header, mut line) = (measure.header(), String::new());
    let read = |file: File| BufReader::new(file.take(header.len() as u64 + 1)).read_line(&mut line);
    File::open(file).and_then(read).is_err() || line.trim_end() != header
}
