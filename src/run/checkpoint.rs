//! `checkpoint_*.npz`: all that a run needs to continue, in one file.
//!
//! It is the archive of the state, which `numpy.load` and `--from` read, with entries `run/…` beside the arrays: the scene with every
//! value, the files that it reads, the lengths of tables, and the host's data of the run. Every entry has a checksum, and `run/run.toml` is
//! the last one, so that a truncated archive is detected.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, BufReader, Cursor, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use npyz::npz::NpzArchive;
use npyz::zip::CompressionMethod;
use npyz::zip::read::ZipFile;
use toml::{Table as Toml, Value};

use super::packed::{FROM, Packed};
use super::table::Lengths;
use crate::error::Error;
use crate::formats::{Input, Precision, atomically, npz};
use crate::kernel::Columns;
use crate::life::Life;
use crate::render::{Ends, Exposure};
use crate::state::State;

/// The prefix of the entries beside arrays.
const RUN: &str = "run/";
const HEAD: &str = "run.toml";
const SCENE: &str = "scene.toml";
const TRAIL: &str = "trail.f64";
const KEPT: &str = "kept.f32";
const FILM: &str = "film.npz";
/// The folder of the files that the scene reads.
const FILE: &str = "files/";
/// The version of the format.
const FORMAT: u64 = 2;

/// The program and the machine of a run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Place {
    pub version: String,
    pub device: String,
    pub precision: Precision,
}

/// The host's data of a run in addition to its state.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Past {
    /// The steps of dt before the run began, and those done.
    pub begun: u64,
    pub done: u64,
    pub lengths: Lengths,
    /// The results in the folder.
    pub results: BTreeSet<String>,
    /// The largest kinetic energy, the largest change of the total energy, and the number of measured states.
    pub kinetic: f64,
    pub change: f64,
    pub looks: u64,
    /// The numbers of the trail.
    pub trail: Vec<f64>,
    pub film: Reel,
}

/// The progress of a film.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Reel {
    pub done: u64,
    pub outside: u64,
    pub exposure: Option<Exposure>,
    /// The scale of a column's colours.
    pub scale: Option<Ends>,
    /// The state for which the camera was set up, and the number of pushes to the trail at that time.
    pub first: Option<State>,
    /// Whether that state has a life column: files have none where all particles are active.
    pub life: bool,
    pub pushes: u64,
    /// Steps of the states to be drawn, and the number of pushes to the trail at each; their positions and velocities, one state after another.
    pub steps: Vec<u64>,
    pub numbers: Vec<f32>,
}

/// A checkpoint that was read completely and verified.
#[derive(Debug)]
pub struct Checkpoint {
    file: PathBuf,
    step: u64,
    time: f64,
    name: String,
    pub(super) place: Place,
    pub(super) packed: Packed,
    pub(super) past: Past,
    /// The folder of its files, which is deleted when this is dropped.
    folder: tempfile::TempDir,
}

/// Writes a checkpoint. It is written completely or not at all, and no other file is changed.
pub(super) fn write(
    path: &Path,
    name: &str,
    (state, place): (&State, &Place),
    packed: &Packed,
    past: &Past,
) -> Result<(), Error> {
    // All 64 bits, as a signed TOML integer.
    let number = |x: u64| Value::Integer(x.cast_signed());
    let list = |all: &mut dyn Iterator<Item = u64>| Value::Array(all.map(number).collect());
    let film = &past.film;
    let exposure = film.exposure.map(|Exposure { knee, white }| [knee.to_bits(), white.to_bits()]);
    let scale = film.scale.map(|of| [of.low.to_bits(), of.high.to_bits(), of.logarithmic.into()]);
    let head: Toml = [
        ("format", number(FORMAT)),
        ("version", place.version.as_str().into()),
        ("device", place.device.as_str().into()),
        ("double", (place.precision == Precision::Double).into()),
        ("scene", name.into()),
        ("also", packed.also.as_str().into()),
        ("step", number(state.step)),
        ("time", number(state.time.to_bits())),
        ("begun", number(past.begun)),
        ("done", number(past.done)),
        ("kinetic", number(past.kinetic.to_bits())),
        ("change", number(past.change.to_bits())),
        ("looks", number(past.looks)),
        ("results", Value::Array(past.results.iter().map(|name| name.as_str().into()).collect())),
        ("tables", Value::Table(past.lengths.iter().map(|(name, length)| (name.clone(), number(*length))).collect())),
        ("film_done", number(film.done)),
        ("film_outside", number(film.outside)),
        ("film_exposure", list(&mut exposure.into_iter().flatten())),
        ("film_scale", list(&mut scale.into_iter().flatten())),
        ("film_life", film.life.into()),
        ("film_pushes", number(film.pushes)),
        ("film_steps", list(&mut film.steps.iter().copied())),
    ]
    .into_iter()
    .map(|(key, value)| (key.to_owned(), value))
    .collect();
    let (head, entry) = (head.to_string(), |name: &str| format!("{RUN}{name}"));
    let trail: Vec<u8> = past.trail.iter().flat_map(|x| x.to_le_bytes()).collect();
    let kept: Vec<u8> = film.numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
    let mut entries = vec![(entry(SCENE), packed.scene.as_bytes())];
    entries.extend(packed.files.iter().map(|(name, bytes)| (format!("{RUN}{FILE}{name}"), bytes.as_slice())));
    entries.extend([(entry(TRAIL), trail.as_slice()), (entry(KEPT), &kept)]);
    let mut first = Cursor::new(Vec::new());
    atomically(path, |out| {
        if let Some(state) = &film.first {
            npz::write_npz(&mut first, state, place.precision)?;
            entries.push((entry(FILM), first.get_ref()));
        }
        entries.push((entry(HEAD), head.as_bytes()));
        npz::write_beside(out, state, place.precision, false, &entries)
    })
}

impl Checkpoint {
    /// Reads a checkpoint, all of it: every checksum is compared.
    ///
    /// # Errors
    /// [`Error::Input`] with the fault of the file.
    pub fn read(file: &Path) -> Result<Self, Error> {
        Self::examine(file).map_err(|fault| fault.of(file))
    }
    /// The same, with the kind of the fault.
    pub(super) fn examine(file: &Path) -> Result<Self, Unread> {
        read(file)
    }
    /// The file.
    #[must_use]
    pub fn file(&self) -> &Path {
        &self.file
    }
    /// The step and the time of its state.
    #[must_use]
    pub fn at(&self) -> (u64, f64) {
        (self.step, self.time)
    }
    /// The name of its scene.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }
    /// The text of its scene.
    #[must_use]
    pub fn scene(&self) -> &str {
        &self.packed.scene
    }
    /// The folder of the files that the scene reads, which is deleted when this is dropped.
    #[must_use]
    pub fn folder(&self) -> &Path {
        self.folder.path()
    }
    /// The file of the state with which the run began, if it was not that of the scene.
    #[must_use]
    pub fn from(&self) -> Option<PathBuf> {
        let mut names = self.packed.files.iter().map(|(name, _)| name);
        Some(self.folder().join(names.find(|name| name.starts_with(FROM))?))
    }
    /// Its state, with these columns.
    pub(super) fn state(&self, columns: &Columns) -> Result<State, Error> {
        npz::read(&Input::disk(&self.file), columns)
    }
    /// The state for which the camera of the film was set up, if there is one.
    pub(super) fn film(&self, columns: &Columns) -> Result<Option<State>, Error> {
        let file = self.folder().join(FILM);
        let mut state = file.exists().then(|| npz::read(&Input::disk(&file), columns)).transpose()?;
        if let Some(state) = state.as_mut().filter(|state| self.past.film.life && state.life().is_empty()) {
            state.set_life(0, Life::Active);
        }
        Ok(state)
    }
}

/// The reason why a checkpoint cannot be read.
#[derive(Debug)]
pub(super) enum Unread {
    /// It is truncated or damaged: an older one may be intact.
    Damaged(String),
    /// It cannot be read by the system, or by this version: it may be intact.
    Refused(String),
}

impl Unread {
    /// The error of this file, for the user.
    pub(super) fn of(self, file: &Path) -> Error {
        let (Self::Damaged(message) | Self::Refused(message)) = self;
        Error::Input { file: file.to_owned(), message }
    }
    /// An error of the operating system is a fault of the machine; an error of the archive reader is damage.
    fn from(error: &io::Error, damage: String) -> Self {
        if error.raw_os_error().is_some() {
            Self::Refused(format!("cannot be read: {error}"))
        } else {
            Self::Damaged(damage)
        }
    }
}

impl From<String> for Unread {
    fn from(message: String) -> Self {
        Self::Damaged(message)
    }
}

fn read(file: &Path) -> Result<Checkpoint, Unread> {
    let words = |error: io::Error| Unread::Refused(format!("cannot be read: {error}"));
    let opened = || File::open(file).map(BufReader::new).map_err(words);
    let found = fs::metadata(file).map_err(words)?;
    if !found.is_file() {
        return Err(Unread::Refused("is no ordinary file".to_owned()));
    }
    let length = found.len();
    let mut raw = opened()?;
    let mut archive = NpzArchive::new(opened()?)
        .map_err(|error| Unread::from(&error, format!("is not a complete archive ({error})")))?;
    let zip = archive.zip_archive();
    let (mut starts, mut sizes) = (BTreeSet::new(), 0_u64);
    let unpacked = |error: io::Error| Unread::Refused(format!("cannot be unpacked into a temporary folder: {error}"));
    let folder = tempfile::tempdir().map_err(unpacked)?;
    let (mut head, mut files) = (None, Vec::new());
    let mut blobs = [(SCENE, Vec::new()), (TRAIL, Vec::new()), (KEPT, Vec::new())];
    for number in 0..zip.len() {
        let mut entry = zip.by_index(number).map_err(|error| format!("is damaged ({error})"))?;
        let name = entry.name().to_owned();
        let damaged = |why: &dyn std::fmt::Display| format!("is damaged: `{name}` {why}");
        let same = named(&mut raw, entry.header_start()).is_ok_and(|own| own == name.as_bytes());
        // Entries that share bytes would be read repeatedly.
        let alone = starts.insert(entry.header_start());
        sizes = sizes.saturating_add(entry.size());
        if !same || !alone || entry.compression() != CompressionMethod::Stored || sizes > length {
            return Err(damaged(&"is not an entry of a checkpoint").into());
        }
        let broken = |error: io::Error| Unread::from(&error, damaged(&error));
        let Some(own) = name.strip_prefix(RUN) else {
            io::copy(&mut entry, &mut io::sink()).map_err(broken)?;
            continue;
        };
        let bytes = content(&mut entry).map_err(broken)?;
        if let Some((_, blob)) = blobs.iter_mut().find(|(known, _)| *known == own) {
            *blob = bytes;
        } else if own == HEAD {
            head = Some(String::from_utf8(bytes).map_err(|error| damaged(&error))?);
        } else if let Some((inner, end)) = own.strip_prefix(FILE).and_then(within) {
            let inner = folder.path().join(inner);
            fs::create_dir_all(&inner).and_then(|()| fs::write(inner.join(end), &bytes)).map_err(unpacked)?;
            files.push((own[FILE.len()..].to_owned(), bytes));
        } else if own == FILM {
            fs::write(folder.path().join(FILM), bytes).map_err(unpacked)?;
        } else {
            return Err(damaged(&"is not an entry of a checkpoint").into());
        }
    }
    let head = head.ok_or_else(|| "is truncated, or not a checkpoint: it has no entry `run/run.toml`".to_owned())?;
    let head: Toml = head.parse().map_err(|error: toml::de::Error| format!("is damaged: {}", error.message()))?;
    let head = Head(head);
    let format = head.number("format")?;
    if format != FORMAT {
        return Err(Unread::Refused(format!(
            "is of format {format}, and this version reads {FORMAT}: go on with the version that wrote it"
        )));
    }
    let [(_, scene), (_, trail), (_, numbers)] = blobs;
    let scene = String::from_utf8(scene).map_err(|error| error.to_string())?;
    let exposure = match head.list("film_exposure")?[..] {
        [knee, white] => Some(Exposure { knee: f64::from_bits(knee), white: f64::from_bits(white) }),
        _ => None,
    };
    let scale = match head.list("film_scale")?[..] {
        [low, high, logarithmic] => {
            Some(Ends { low: f64::from_bits(low), high: f64::from_bits(high), logarithmic: logarithmic != 0 })
        }
        _ => None,
    };
    let film = Reel {
        done: head.number("film_done")?,
        outside: head.number("film_outside")?,
        exposure,
        scale,
        first: None,
        life: head.of("film_life", Value::as_bool)?,
        pushes: head.number("film_pushes")?,
        steps: head.list("film_steps")?,
        numbers: numbers.chunks_exact(4).map(|four| f32::from_le_bytes([four[0], four[1], four[2], four[3]])).collect(),
    };
    let eight = |bytes: &[u8]| f64::from_le_bytes(std::array::from_fn(|k| bytes[k]));
    let past = Past {
        begun: head.number("begun")?,
        done: head.number("done")?,
        lengths: head.lengths("tables")?,
        results: head.names("results")?,
        kinetic: f64::from_bits(head.number("kinetic")?),
        change: f64::from_bits(head.number("change")?),
        looks: head.number("looks")?,
        trail: trail.chunks_exact(8).map(eight).collect(),
        film,
    };
    let precision = if head.of("double", Value::as_bool)? { Precision::Double } else { Precision::Single };
    let place = Place { version: head.text("version")?, device: head.text("device")?, precision };
    Ok(Checkpoint {
        file: file.to_owned(),
        step: head.number("step")?,
        time: f64::from_bits(head.number("time")?),
        name: head.text("scene")?,
        place,
        packed: Packed { scene, also: head.text("also")?, files },
        past,
        folder,
    })
}

/// The name of an entry in its local header: the directory at the end of an archive repeats it, without a checksum.
fn named(raw: &mut BufReader<File>, start: u64) -> io::Result<Vec<u8>> {
    raw.seek(SeekFrom::Start(start))?;
    let mut head = [0; 30];
    raw.read_exact(&mut head)?;
    let mut name = vec![0; usize::from(u16::from_le_bytes([head[26], head[27]]))];
    raw.read_exact(&mut name)?;
    Ok(name)
}

/// A folder and a file in it, with no path that leads elsewhere.
fn within(name: &str) -> Option<(&str, &str)> {
    let (folder, end) = name.split_once('/')?;
    let plain = !folder.is_empty() && folder.bytes().all(|c| c.is_ascii_alphanumeric());
    let leads = end.is_empty() || end == "." || end == ".." || end.contains(['/', '\\', ':', '\0']);
    (plain && !leads).then_some((folder, end))
}

fn content(entry: &mut ZipFile<'_>) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    entry.read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The table of `run.toml`.
struct Head(Toml);

impl Head {
    fn of<'a, T>(&'a self, key: &str, what: impl FnOnce(&'a Value) -> Option<T>) -> Result<T, String> {
        self.0.get(key).and_then(what).ok_or_else(|| format!("is damaged: `{key}` is missing"))
    }
    fn number(&self, key: &str) -> Result<u64, String> {
        self.of(key, Value::as_integer).map(i64::cast_unsigned)
    }
    fn text(&self, key: &str) -> Result<String, String> {
        self.of(key, Value::as_str).map(str::to_owned)
    }
    fn list(&self, key: &str) -> Result<Vec<u64>, String> {
        let number = |value: &Value| value.as_integer().map(i64::cast_unsigned);
        self.of(key, |value| value.as_array()?.iter().map(number).collect())
    }
    fn names(&self, key: &str) -> Result<BTreeSet<String>, String> {
        self.of(key, |value| value.as_array()?.iter().map(|name| name.as_str().map(str::to_owned)).collect())
    }
    fn lengths(&self, key: &str) -> Result<Lengths, String> {
        let one = |(name, length): (&String, &Value)| Some((name.clone(), length.as_integer()?.cast_unsigned()));
        self.of(key, |value| value.as_table()?.iter().map(one).collect())
    }
}
