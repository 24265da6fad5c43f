//! The source of a scene, and its text.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use super::builtin::{Builtin, SCENES};
use super::diagnostic::Diagnostics;
use super::report::{listed, nearest, shorten};

/// The longest scene that is read \[bytes\]. Many particles belong in a file of their own.
pub(super) const LONGEST: u64 = 16 << 20;
/// The comment of a scene that is written back, after its own first comment.
pub(super) const RESOLVED: &str = "Every value of the run, defaults included.";

/// The source of a scene.
#[derive(Debug, Clone)]
pub enum Source {
    /// A file. The files that it names are searched in its folder.
    File(PathBuf),
    /// A built-in scene.
    Builtin(&'static Builtin),
    /// A text in memory.
    Text {
        /// Its name in messages.
        name: String,
        /// The scene.
        text: String,
        /// The folder of the files that it names.
        folder: PathBuf,
    },
    /// A text in memory, with the files that it names: for programs that have no disk.
    Memory {
        /// Its name in messages.
        name: String,
        /// The scene.
        text: String,
        /// Names and contents of files.
        files: Vec<(String, Vec<u8>)>,
    },
}

/// A source that has been read.
pub(super) struct Opened {
    /// The scene's name.
    pub(super) name: String,
    /// The name of its file in messages.
    pub(super) file: String,
    pub(super) text: String,
    /// The folder of the files that it names; `None`: those of the built-in scene.
    pub(super) folder: Option<PathBuf>,
    pub(super) embedded: Vec<(String, Vec<u8>)>,
}

impl Source {
    /// The argument of the command line: the name of a built-in scene, or else a file. (A file with the name of a built-in
    /// scene is reached by `./name`.)
    ///
    /// # Errors
    /// When there is neither; the message names a built-in scene with a similar name.
    pub fn find(word: &str) -> Result<Self, Diagnostics> {
        if let Some(builtin) = SCENES.iter().find(|s| s.name == word) {
            return Ok(Self::Builtin(builtin));
        }
        let path = Path::new(word);
        if path.is_dir() {
            let note = "help: name the .toml file in it".to_owned();
            return Err(Diagnostics::alone(&shorten(word), "this is a folder, not a scene".to_owned(), vec![note]));
        }
        if path.exists() {
            return Ok(Self::File(path.to_owned()));
        }
        let names = || SCENES.iter().map(|s| s.name);
        let mut notes = Vec::new();
        if let Some(near) = nearest(word, names()) {
            notes.push(format!("help: did you mean the built-in scene `{near}`?"));
        }
        notes.push(format!("built-in scenes: {}", listed(names())));
        Err(Diagnostics::alone(
            &shorten(word),
            "there is no such file, and no built-in scene of this name".to_owned(),
            notes,
        ))
    }

    pub(super) fn open(&self) -> Result<Opened, Diagnostics> {
        match self {
            Self::File(path) => {
                let file = shorten_path(path);
                let name = path.file_stem().map_or_else(|| file.clone(), |s| shorten(&s.to_string_lossy()));
                // Results are written into a folder of that name, which must not be one that every folder contains.
                let name = if matches!(name.as_str(), "." | "..") { "scene".to_owned() } else { name };
                let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new(".")).to_owned();
                let text = read(path).map_err(|why| Diagnostics::alone(&file, why, Vec::new()))?;
                Ok(Opened { name, file, text, folder: Some(folder), embedded: Vec::new() })
            }
            Self::Builtin(b) => {
                let file = format!("{}.toml", b.name);
                let embedded =
                    b.files.iter().map(|&(name, text)| (name.to_owned(), text.as_bytes().to_vec())).collect();
                Ok(Opened { name: b.name.to_owned(), file, text: b.text.to_owned(), folder: None, embedded })
            }
            Self::Memory { name, text, files } => {
                let source = Self::Text { name: name.clone(), text: text.clone(), folder: PathBuf::from(".") };
                Ok(Opened { embedded: files.clone(), ..source.open()? })
            }
            Self::Text { name, text, folder } => {
                if text.len() as u64 > LONGEST {
                    return Err(Diagnostics::alone(&shorten(name), too_long(), Vec::new()));
                }
                let stem =
                    Path::new(name).file_stem().map_or_else(|| name.clone(), |s| s.to_string_lossy().into_owned());
                let folder = Some(folder.clone());
                Ok(Opened {
                    name: shorten(&stem),
                    file: shorten(name),
                    text: text.clone(),
                    folder,
                    embedded: Vec::new(),
                })
            }
        }
    }
}

/// A path, shortened for messages.
pub(super) fn shorten_path(path: &Path) -> String {
    path.display().to_string().chars().map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect()
}

/// A pipe with a name, which may wait forever for a program that writes to it. An unnamed one, such as that of a shell's `<(command)`, has
/// no path in the file system.
#[cfg(unix)]
fn is_named_pipe(path: &Path) -> bool {
    use std::os::unix::fs::FileTypeExt;
    std::fs::canonicalize(path).and_then(std::fs::metadata).is_ok_and(|found| found.file_type().is_fifo())
}

#[cfg(not(unix))]
fn is_named_pipe(_: &Path) -> bool {
    false
}

fn read(path: &Path) -> Result<String, String> {
    if is_named_pipe(path) {
        return Err("the scene is a pipe, which may never end: save it into a file, or name /dev/stdin".to_owned());
    }
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(|e| format!("cannot read the scene: {e}"))?;
    // One byte more than allowed shows that the limit is exceeded; a pipe has no size.
    file.take(LONGEST + 1).read_to_end(&mut bytes).map_err(|e| format!("cannot read the scene: {e}"))?;
    if bytes.len() as u64 > LONGEST {
        return Err(too_long());
    }
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        return Err("the scene is UTF-16 text: save it as UTF-8".to_owned());
    }
    String::from_utf8(bytes).map_err(|e| {
        let good = e.utf8_error().valid_up_to();
        let line = e.as_bytes()[..good].split(|&b| b == b'\n').count();
        format!("the scene is not UTF-8 text: byte {good}, in line {line}, is 0x{:02x}", e.as_bytes()[good])
    })
}

fn too_long() -> String {
    format!(
        "the scene is longer than {} MiB: put particles into a file of their own (CSV, Tipsy) and name it with `file`",
        LONGEST >> 20
    )
}

/// The first block of comments: what the run shows.
pub(super) fn about(text: &str) -> String {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let lines = text.lines().map(str::trim).skip_while(|l| l.is_empty());
    let comments = lines.map_while(|l| l.strip_prefix('#')).map(|l| l.strip_prefix(' ').unwrap_or(l));
    let about = comments.collect::<Vec<_>>().join("\n").trim_end().to_owned();
    // A scene without a comment would get this one as its own when it is written back.
    if about == RESOLVED { String::new() } else { about }
}
