//! A scene with all files that it reads, for a checkpoint.

use std::fs;
use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::scene::{self, Scene};

/// The text of a scene, and the files that it names, under names of their own.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Packed {
    /// Every value of the scene.
    pub scene: String,
    /// The options that affect results, a line each.
    pub also: String,
    /// Names and contents.
    pub files: Vec<(String, Vec<u8>)>,
}

/// The folder of the state with which a run was begun.
pub(super) const FROM: &str = "from/";

impl Packed {
    /// Reads the files of a scene, and the state with which it begins, if that is from a file.
    pub(super) fn of(scene: &Scene, also: String, from: Option<&Path>) -> Result<Self, Error> {
        let (text, named) = scene.packed();
        let end = |path: &Path| path.file_name().map(|name| scene::plain(&name.to_string_lossy())).unwrap_or_default();
        let named = named.into_iter().chain(from.map(|path| (format!("{FROM}{}", end(path)), path.to_owned())));
        let read = |(name, path): (String, PathBuf)| {
            let bytes = fs::read(&path).map_err(|why| Error::Input { file: path, message: why.to_string() })?;
            Ok((name, bytes))
        };
        Ok(Self { scene: text, also, files: named.map(read).collect::<Result<_, Error>>()? })
    }
    /// The difference to another one, in words; `None` where they are equal.
    pub(super) fn difference(&self, other: &Self) -> Option<String> {
        let lines = |packed: &Self| format!("{}\n{}", packed.scene, packed.also);
        let (here, there) = (lines(self), lines(other));
        let mut pairs = here.lines().zip(there.lines());
        if let Some((here, there)) = pairs.find(|(here, there)| here != there) {
            return Some(format!("`{here}` here, `{there}` there"));
        }
        if here != there {
            return Some("one of them has more keys".to_owned());
        }
        let mut files = self.files.iter().zip(&other.files);
        let file =
            files.find(|(here, there)| here != there).map(|((name, _), _)| format!("the file {name} has changed"));
        file.or_else(|| (self.files.len() != other.files.len()).then(|| "one of them begins from a state".to_owned()))
    }
}
