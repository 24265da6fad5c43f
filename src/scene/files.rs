//! The files that a scene names: their location, and whether the scene may read them.

use std::cell::RefCell;
use std::fs;
use std::path::{Component, Path, PathBuf};

use super::Options;
use super::report::{Fault, Place, nearest, shorten};
use super::source::{Opened, shorten_path};
use crate::formats::Input;

/// The longest shader \[bytes\].
pub(super) const LONGEST_SHADER: u64 = 1 << 20;
/// The longest mesh \[bytes\].
const LONGEST_MESH: u64 = 1 << 30;

/// The longest floor plan \[bytes\].
const LONGEST_PLAN: u64 = 1 << 24;

/// The folders in which files are searched.
pub(super) struct Files {
    /// The files that were sought and that were found, by absolute paths.
    sought: RefCell<Vec<PathBuf>>,
    read: RefCell<Vec<PathBuf>>,
    folder: Option<PathBuf>,
    embedded: Vec<(String, Vec<u8>)>,
    allow_outside: bool,
    /// Files that may be anywhere, by their paths without links.
    beside: Vec<PathBuf>,
}

/// A file that was found.
pub(super) enum Located {
    /// On the disk; with the name that the resolved scene gives it.
    Disk { path: PathBuf, name: String },
    /// Built into the program, or given with the scene.
    Embedded { name: String, bytes: Vec<u8> },
}

impl Files {
    pub(super) fn new(opened: &Opened, options: &Options) -> Self {
        Self {
            sought: RefCell::default(),
            read: RefCell::default(),
            folder: opened.folder.clone(),
            embedded: opened.embedded.clone(),
            allow_outside: options.allow_outside,
            beside: options.beside.iter().filter_map(|file| fs::canonicalize(file).ok()).collect(),
        }
    }

    /// Finds the file that is given at `place` as the value of `key`.
    pub(super) fn locate(&self, key: &str, name: &str, place: &Place) -> Result<Located, Fault> {
        let shown = shorten(name);
        if let Some((name, bytes)) = self.embedded.iter().find(|(n, _)| n == name).cloned() {
            return Ok(Located::Embedded { name, bytes });
        }
        // A built-in scene with an override is the user's own: it may name files in the current folder.
        let folder = self.folder.as_deref().unwrap_or(Path::new("."));
        let path = folder.join(name);
        let is_beside = || fs::canonicalize(&path).is_ok_and(|file| self.beside.contains(&file));
        if !self.allow_outside && !is_inside(&path, folder) && !is_beside() {
            return Err(Fault::at(place, format!("`{key}` leads outside of the scene's folder"))
                .note("help: move the file beside the scene, or use --allow-outside if you trust the scene"));
        }
        self.sought.borrow_mut().extend(std::path::absolute(&path));
        let meta = fs::metadata(&path).map_err(|why| {
            let absent = why.kind() == std::io::ErrorKind::NotFound;
            let message =
                if absent { format!("there is no file {shown}") } else { format!("cannot read {shown}: {why}") };
            let fault = Fault::at(place, message).in_input();
            match similar(&path) {
                Some(near) if absent => fault.label(format!("did you mean \"{}\"?", shorten(&near))),
                _ => fault.note(format!("it is sought at {}", shorten_path(&path))),
            }
        })?;
        if !meta.is_file() {
            let what = if meta.is_dir() { "a folder" } else { "not a regular file" };
            return Err(Fault::at(place, format!("{shown} is {what}")).in_input());
        }
        // The folder of the resolved scene is not known here, so it names files by absolute paths.
        let absolute = fs::canonicalize(&path)
            .map_err(|why| Fault::at(place, format!("cannot read {shown}: {why}")).in_input())?;
        let Some(name) = absolute.to_str().map(str::to_owned) else {
            return Err(Fault::at(place, format!("{shown} is in a folder whose name is no UTF-8 text"))
                .in_input()
                .note(
                    "help: results and checkpoints name the file by its way from the root, in UTF-8: rename the folder",
                ));
        };
        self.read.borrow_mut().push(absolute);
        Ok(Located::Disk { path, name })
    }
    /// The files that were found, by absolute paths.
    pub(super) fn found(self) -> Vec<PathBuf> {
        self.read.into_inner()
    }
    /// The files that were sought, also those that are missing, by absolute paths.
    pub(super) fn sought(self) -> Vec<PathBuf> {
        self.sought.into_inner()
    }
}

impl Located {
    /// Its name in the resolved scene.
    pub(super) fn name(&self) -> &str {
        match self {
            Self::Disk { name, .. } | Self::Embedded { name, .. } => name,
        }
    }
    /// It, to be read as a file of particles or links.
    pub(super) fn input(&self) -> Input<'_> {
        match self {
            Self::Disk { path, .. } => Input::disk(path),
            Self::Embedded { name, bytes } => Input::memory(Path::new(name), bytes),
        }
    }
    /// Its text, for a shader.
    pub(super) fn shader(&self, place: &Place) -> Result<String, Fault> {
        self.text(place, "a shader", LONGEST_SHADER)
    }
    /// Its bytes, for a floor plan.
    pub(super) fn plan(&self, place: &Place) -> Result<Vec<u8>, Fault> {
        self.bytes(place, "a floor plan", LONGEST_PLAN)
    }
    /// Its text, for a mesh.
    pub(super) fn mesh(&self, place: &Place) -> Result<String, Fault> {
        let text = self.text(place, "a mesh", LONGEST_MESH)?;
        if text.trim().is_empty() {
            let name = shorten(self.name());
            return Err(
                Fault::at(place, format!("{name} is empty: it has no faces, lines such as `f 1 2 3`")).in_input()
            );
        }
        Ok(text)
    }
    fn text(&self, place: &Place, what: &str, longest: u64) -> Result<String, Fault> {
        String::from_utf8(self.bytes(place, what, longest)?).map_err(|_| {
            // As the library says it that reads files.
            Fault::at(place, format!("cannot read {}: stream did not contain valid UTF-8", self.shown())).in_input()
        })
    }
    fn shown(&self) -> String {
        match self {
            Self::Disk { path, .. } => shorten_path(path),
            Self::Embedded { name, .. } => shorten(name),
        }
    }
    fn bytes(&self, place: &Place, what: &str, longest: u64) -> Result<Vec<u8>, Fault> {
        match self {
            Self::Embedded { name, bytes } if bytes.len() as u64 > longest => Err(Fault::at(
                place,
                format!("{} has {} bytes, more than the {longest} that {what} may have", shorten(name), bytes.len()),
            )
            .in_input()),
            Self::Embedded { bytes, .. } => Ok(bytes.clone()),
            Self::Disk { path, .. } => {
                let bad = |why: String| Fault::at(place, format!("cannot read {}: {why}", self.shown())).in_input();
                let length = fs::metadata(path).map_err(|e| bad(e.to_string()))?.len();
                if length > longest {
                    return Err(bad(format!("{length} bytes are more than the {longest} that {what} may have")));
                }
                fs::read(path).map_err(|e| bad(e.to_string()))
            }
        }
    }
}

/// Whether a path stays in a folder, by its components and by the targets of its links. Of a path that does not exist only the existing
/// part counts, so that nothing is revealed about other folders.
fn is_inside(path: &Path, folder: &Path) -> bool {
    let (Ok(by_words), Ok(home)) = (std::path::absolute(path), std::path::absolute(folder)) else { return false };
    let by_words = plain(&by_words);
    let Ok(folder) = fs::canonicalize(folder) else { return by_words.starts_with(plain(&home)) };
    let there = by_words.ancestors().find_map(|part| fs::canonicalize(part).ok());
    // Components alone do not show a link that `..` goes back through.
    let real = path.ancestors().find_map(|part| fs::canonicalize(part).ok());
    [there, real].into_iter().flatten().all(|part| part.starts_with(&folder))
}

/// A path with its `..` resolved.
fn plain(path: &Path) -> PathBuf {
    let mut out = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => {
                out.pop();
            }
            Component::CurDir => {}
            other => out.push(other),
        }
    }
    out
}

/// A file of similar name in the same folder.
fn similar(path: &Path) -> Option<String> {
    let wanted = path.file_name()?.to_str()?.to_owned();
    let names: Vec<String> =
        fs::read_dir(path.parent()?).ok()?.take(1000).filter_map(|e| e.ok()?.file_name().into_string().ok()).collect();
    nearest(&wanted, names.iter().map(String::as_str)).map(str::to_owned)
}
