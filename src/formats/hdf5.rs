//! HDF5 in the layout of GADGET-4 (Springel et al. 2021), which yt, pynbody and h5py read: a group `PartType0` … `PartType5` for each
//! species, with `Coordinates`, `Velocities`, `Masses`, `ParticleIDs`, and every other column under its own name.
//!
//! Where the state has a density, species 0 is `PartType0`, gas, species 1 is `PartType1`, and so on; else species 0 is `PartType1`, dark
//! matter. What comes behind the last type is of that type, with a dataset `species`. `Header` holds the time, the step, counts and the
//! box. Sets of several files are read by the name of any of them, and all must be in one folder. Quantities that only some types have are 0 for the others. Where
//! no type has masses, they are 1. Numbers
//! stay in the units of the file.

use std::collections::{BTreeMap, HashMap};
use std::io::{self, Write};
use std::path::PathBuf;

use hdf5_pure::{AttrValue, DType, Dataset, DatasetBuilder, File, FileBuilder, FormatError, Group};

use super::binary::single;
use super::sheet::{self, Place, Sheet};
use super::titles::{self, Field, Number};
use super::{Format, Input, Options, Precision, input, set};
use crate::error::Error;
use crate::kernel::{Bounds, Columns, Side};
use crate::state::State;

/// Its entry in the register.
pub(super) const FORMAT: Format = Format {
    name: "hdf5",
    about: "HDF5 in the layout of GADGET-4, for yt, pynbody and h5py: a group for each species",
    endings: &["hdf5", "h5"],
    begins: |start| start.starts_with(b"\x89HDF\r\n\x1a\n"),
    contents: |path| Ok(sheet(path, &|_| false)?.contents),
    read: Some(read),
    write: Some(|out, state, options| write_hdf5(out, state, options)),
    left_out: None,
    compresses: true,
    divides: true,
};

/// Types of particles in a file.
const TYPES: usize = 6;
/// The names of columns in GADGET.
const NAMES: [(&str, &str); 9] = [
    ("position", "Coordinates"),
    ("velocity", "Velocities"),
    ("mass", "Masses"),
    ("id", "ParticleIDs"),
    ("density", "Density"),
    ("potential", "Potential"),
    ("acceleration", "Acceleration"),
    ("internal_energy", "InternalEnergy"),
    ("smoothing_length", "SmoothingLength"),
];
/// Different names in SWIFT (Schaller et al. 2024).
const PLURALS: [(&str, &str); 5] = [
    ("density", "Densities"),
    ("potential", "Potentials"),
    ("acceleration", "Accelerations"),
    ("internal_energy", "InternalEnergies"),
    ("smoothing_length", "SmoothingLengths"),
];
/// The attribute of a group that gives the species of all of its particles.
const SPECIES: &str = "Species";

/// Writes a state, or the part of it that `options` give.
///
/// # Errors
/// Those of `out`; a number that does not fit single precision, where that is asked for; a column that has the name of another in GADGET.
pub fn write_hdf5(out: impl Write, state: &State, options: &Options) -> io::Result<()> {
    let (fields, ids) = (titles::fields(state), state.ids());
    let meant = |name: &str| Some(column_of(name)).filter(|column| *column != name).map(str::to_owned);
    titles::reserved(fields.iter().map(|field| field.name.as_str()), "HDF5", meant)?;
    let first = usize::from(state.get("density").is_none());
    let mut types: [Vec<usize>; TYPES] = Default::default();
    let mut totals = [0_u64; TYPES];
    let here = options.part.places(state.len());
    for row in 0..state.len() {
        let species = state.species().get(row).copied().unwrap_or(0) as usize;
        let number = species.saturating_add(first).min(TYPES - 1);
        totals[number] += 1;
        if here.contains(&row) {
            types[number].push(row);
        }
    }
    let mut file = FileBuilder::new();
    let mut header = file.create_group("Header");
    let counts: Vec<u64> = types.iter().map(|rows| rows.len() as u64).collect();
    let words = |shift: u32| totals.iter().map(|count| u32::try_from(count >> shift & 0xffff_ffff).unwrap_or(0)).collect();
    header.set_attr("NumPart_ThisFile", AttrValue::U64Array(counts));
    header.set_attr("NumPart_Total", AttrValue::U32Array(words(0)));
    header.set_attr("NumPart_Total_HighWord", AttrValue::U32Array(words(32)));
    header.set_attr("MassTable", AttrValue::F64Array(vec![0.0; TYPES]));
    header.set_attr("NumFilesPerSnapshot", AttrValue::I32(i32::try_from(options.part.of).unwrap_or(i32::MAX)));
    header.set_attr("Time", AttrValue::F64(state.time));
    // Without cosmological parameters: if there is one of them, yt requires all, and pynbody treats the file as comoving.
    header.set_attr("Redshift", AttrValue::F64(0.0));
    let side = options.closed().map_or(0.0, |bounds| (bounds.high - bounds.low).max_element());
    header.set_attr("BoxSize", AttrValue::F64(side));
    if let Some(bounds) = &options.bounds {
        header.set_attr("BoxLow", AttrValue::F64Array(bounds.low.to_array().to_vec()));
        header.set_attr("BoxHigh", AttrValue::F64Array(bounds.high.to_array().to_vec()));
        header.set_attr("BoxSides", AttrValue::U32Array(bounds.sides.map(|side| side as u32).to_vec()));
    }
    header.set_attr("Flag_DoublePrecision", AttrValue::I32(i32::from(options.precision == Precision::Double)));
    header.set_attr("Step", AttrValue::U64(state.step));
    header.set_attr("Writer", AttrValue::String(format!("motes {}", env!("CARGO_PKG_VERSION"))));
    file.add_group(header.finish());
    for (number, rows) in types.iter().enumerate().filter(|(_, rows)| !rows.is_empty()) {
        let mut group = file.create_group(&format!("PartType{number}"));
        let species: Vec<u32> = rows.iter().map(|row| state.species().get(*row).copied().unwrap_or(0)).collect();
        if species.iter().all(|of| *of == species[0]) {
            group.set_attr(SPECIES, AttrValue::U32(species[0]));
        } else {
            shaped(group.create_dataset("species").with_u32_data(&species), &[rows.len() as u64], options);
        }
        for field in fields.iter().filter(|field| field.name != "species") {
            let width = field.strips.len() as u64;
            let shape = if width == 1 { vec![rows.len() as u64] } else { vec![rows.len() as u64, width] };
            let dataset = group.create_dataset(name_of(&field.name));
            let dataset = match (field.is_whole(), options.precision) {
                (true, _) => dataset.with_u32_data(&whole(field, rows)),
                (_, Precision::Single) => {
                    let all: io::Result<Vec<f32>> = real(field, rows).map(single).collect();
                    dataset.with_f32_data(&all?)
                }
                (_, Precision::Double) => dataset.with_f64_data(&real(field, rows).collect::<Vec<_>>()),
            };
            shaped(dataset, &shape, options);
        }
        let ids: Vec<u32> = rows.iter().map(|row| ids[*row]).collect();
        shaped(group.create_dataset("ParticleIDs").with_u32_data(&ids), &[rows.len() as u64], options);
        file.add_group(group.finish());
    }
    file.finish_to(out).map_err(|why| io::Error::other(why.to_string()))
}

/// Rows of a chunk, which is compressed separately.
const CHUNK: u64 = 1 << 16;
/// The effort of deflate, from 1 to 9: more takes longer, and numbers of particles hardly shrink further.
const EFFORT: u32 = 4;

/// Sets the shape of a dataset, and the filters that all readers of HDF5 support: byte shuffle, then deflate.
fn shaped(dataset: &mut DatasetBuilder, shape: &[u64], options: &Options) {
    dataset.with_shape(shape);
    if options.compress {
        let mut chunk = shape.to_vec();
        chunk[0] = chunk[0].min(CHUNK);
        dataset.with_chunks(&chunk).with_shuffle().with_deflate(EFFORT);
    }
}

fn name_of(column: &str) -> &str {
    NAMES.iter().find(|(known, _)| *known == column).map_or(column, |(_, name)| name)
}

fn column_of(name: &str) -> &str {
    NAMES.iter().chain(&PLURALS).find(|(_, known)| *known == name).map_or(name, |(column, _)| column)
}

fn real<'a>(field: &'a Field<'_>, rows: &'a [usize]) -> impl Iterator<Item = f64> + 'a {
    let number = |number| if let Number::Real(x) = number { x } else { 0.0 };
    rows.iter().flat_map(move |row| field.strips.iter().map(move |strip| number(strip.of(*row))))
}

fn whole(field: &Field<'_>, rows: &[usize]) -> Vec<u32> {
    let number = |number| if let Number::Whole(n) = number { n } else { 0 };
    rows.iter().flat_map(|row| field.strips.iter().map(|strip| number(strip.of(*row)))).collect()
}

/// Reads a state of these columns. Datasets without a column are skipped.
///
/// # Errors
/// [`Error::Input`] with the part that is not HDF5, truncated, missing, of a length other than that of `Coordinates`, not numeric, or
/// invalid; a missing part of a set.
pub fn read(path: &Input<'_>, columns: &Columns) -> Result<State, Error> {
    sheet::read(path, columns, sheet)
}

/// The lists of all groups so far.
#[derive(Default)]
struct Gathered {
    rows: usize,
    lists: BTreeMap<String, (bool, Vec<f64>)>,
    /// Attributes of the header of the first file.
    header: HashMap<String, AttrValue>,
    /// Datasets that are skipped.
    left_out: Vec<String>,
    /// Time and step of the last file, as bits.
    moment: Vec<u64>,
    /// Particles of each type in all files.
    types: [u64; TYPES],
    /// Whether a group has masses, and the first group without them.
    massive: bool,
    massless: Option<String>,
}

fn sheet(path: &Input<'_>, wanted: &dyn Fn(&str) -> bool) -> Result<Sheet, Error> {
    let mut gathered = Gathered::default();
    let parts = gathered.file(path, wanted)?;
    if parts > 1 {
        if path.bytes().is_some() {
            return Err(input(path, format!("is one of {parts} files: a set is read from a folder, not from memory")));
        }
        gathered = Gathered::default();
        let (before, after) = set::split(path).ok_or_else(|| {
            input(path, format!("is one of {parts} files, and its name has no number, as in snapshot_007.0.hdf5"))
        })?;
        let mut of = None;
        for part in 0..parts {
            let file = PathBuf::from(format!("{before}.{part}.{after}"));
            set::beside(path, &file)?;
            let (there, step) = (gathered.file(&Input::disk(&file), wanted)?, gathered.moment.clone());
            if there != parts {
                return Err(input(&file, format!("is one of {there} files, and {} of {parts}", path.display())));
            }
            if *of.get_or_insert_with(|| step.clone()) != step {
                return Err(input(&file, format!("is of another time or step than {before}.0.{after}")));
            }
        }
        gathered.complete().map_err(|why| input(path, why))?;
    }
    if let (true, Some(name)) = (gathered.massive, &gathered.massless) {
        let why = "has neither `Masses` nor a mass in MassTable, and others have: give it the dataset `Masses`";
        return Err(input(path, format!("{name} {why}")));
    }
    let number = |name: &str| gathered.header.get(name).map(numbers).and_then(|list| list.first().copied());
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates, which suits a step")]
    let step = number("Step").unwrap_or(0.0) as u64;
    let mut sheet = Sheet { time: number("Time").unwrap_or(0.0), step, ..Sheet::default() };
    sheet.contents.rows = gathered.rows;
    sheet.contents.bounds = bounds(&gathered.header);
    gathered.left_out.sort_unstable();
    gathered.left_out.dedup();
    sheet.contents.left_out = gathered.left_out;
    if gathered.rows == 0 {
        for title in ["x", "y", "z"] {
            gathered.lists.entry(title.to_owned()).or_default();
        }
    }
    for (title, (whole, values)) in gathered.lists {
        let place = Place::Named(title.clone());
        sheet.enter(&title, whole, wanted, || (values, place));
    }
    Ok(sheet)
}

impl Gathered {
    /// Compares the number of particles in all files of a set with the totals in the header, if it has them.
    fn complete(&self) -> Result<(), String> {
        let words = |name: &str| self.header.get(name).map(numbers).unwrap_or_default();
        let (low, high) = (words("NumPart_Total"), words("NumPart_Total_HighWord"));
        for (number, low) in low.iter().enumerate().take(TYPES) {
            let total = low + high.get(number).copied().unwrap_or(0.0) * 4_294_967_296.0;
            if total.to_bits() != (self.types[number] as f64).to_bits() {
                return Err(format!(
                    "the set announces {total:.0} particles of PartType{number}, and its files hold {}",
                    self.types[number]
                ));
            }
        }
        Ok(())
    }
    /// Adds the groups of a file; returns the number of files in the set.
    fn file(&mut self, path: &Input<'_>, wanted: &dyn Fn(&str) -> bool) -> Result<u32, Error> {
        let (_, length) = path.open()?;
        let refuse = |why: hdf5_pure::Error| input(path, format!("cannot be read as HDF5: {why}"));
        let file = match path.bytes() {
            Some(bytes) => File::from_bytes(bytes.to_vec()),
            None => File::open(&**path),
        };
        let file = file.map_err(refuse)?;
        let root = file.root();
        // By name: listing all groups fails at soft links, which SWIFT writes.
        let group = |name: &str| match root.group(name) {
            Ok(group) => Ok(Some(group)),
            Err(hdf5_pure::Error::Format(FormatError::PathNotFound(_))) => Ok(None),
            Err(why) => Err(refuse(why)),
        };
        let header = group("Header")?.ok_or_else(|| {
            input(path, "has no group `Header`: HDF5 files in the layout of GADGET are read")
        })?;
        let header = header.attrs().map_err(refuse)?;
        let parts = header.get("NumFilesPerSnapshot").map(numbers).and_then(|list| list.first().copied()).unwrap_or(1.0);
        let table = header.get("MassTable").map(numbers).unwrap_or_default();
        let announced = header.get("NumPart_ThisFile").map(numbers);
        for (number, name) in (0..TYPES).map(|number| (number, format!("PartType{number}"))) {
            let promised = announced.as_ref().and_then(|list| list.get(number)).copied();
            let there = if let Some(group) = group(&name)? {
                let mass = table.get(number).copied().unwrap_or(0.0);
                self.group(&group, (&name, number, mass), length, wanted).map_err(|why| input(path, why))?
            } else {
                0
            };
            self.types[number] += there as u64;
            if promised.is_some_and(|promised| promised.to_bits() != (there as f64).to_bits()) {
                return Err(input(
                    path,
                    format!("Header announces {:.0} particles of {name}, and {there} are there", promised.unwrap_or(0.0)),
                ));
            }
        }
        let bits = |name: &str| header.get(name).map(numbers).unwrap_or_default().into_iter().map(f64::to_bits);
        self.moment = bits("Time").chain(bits("Step")).collect();
        if self.header.is_empty() {
            self.header = header;
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
        Ok(parts as u32)
    }
    fn group(
        &mut self,
        group: &Group,
        (name, number, mass): (&str, usize, f64),
        length: u64,
        wanted: &dyn Fn(&str) -> bool,
    ) -> Result<usize, String> {
        let refuse = |why: hdf5_pure::Error| format!("{name}: {why}");
        let mut datasets = group.datasets().map_err(refuse)?;
        datasets.sort_unstable();
        let positions = group.dataset("Coordinates").and_then(|dataset| dataset.shape()).map_err(refuse)?;
        let rows = positions.first().copied().unwrap_or(0);
        let rows = usize::try_from(rows).map_err(|_| format!("{name}: {rows} particles are too many"))?;
        let (start, end) = (self.rows, self.rows.saturating_add(rows));
        let mut found: Vec<(String, bool, Vec<f64>)> = Vec::new();
        for own in &datasets {
            let dataset = group.dataset(own).map_err(refuse)?;
            let lists = lists(&dataset, column_of(own), rows, length, wanted).map_err(|why| format!("{own}: {why}"))?;
            // Not numeric, of another shape, or for a column that another dataset has given: `Density` beside `Densities`.
            let again = lists.iter().any(|(title, ..)| found.iter().any(|(known, ..)| known == title));
            if lists.is_empty() || again {
                self.left_out.push(format!("{name}/{own}"));
            } else {
                found.extend(lists);
            }
        }
        let has = |title: &str, found: &[(String, bool, Vec<f64>)]| found.iter().any(|(known, ..)| known == title);
        if !has("x", &found) {
            return Err(format!("{name}: Coordinates does not hold three numbers for each particle"));
        }
        // If there are none, masses have the default of other formats.
        if !has("mass", &found) && mass != 0.0 {
            found.push(("mass".to_owned(), false, if wanted("mass") { vec![mass; rows] } else { Vec::new() }));
        }
        if has("mass", &found) {
            self.massive |= rows > 0;
        } else if rows > 0 {
            self.massless.get_or_insert_with(|| name.to_owned());
        }
        if !has("species", &found) {
            let attributes = group.attrs().map_err(refuse)?;
            let own = attributes.get(SPECIES).map(numbers).and_then(|list| list.first().copied());
            let list = if wanted("species") { vec![own.unwrap_or(number as f64); rows] } else { Vec::new() };
            found.push(("species".to_owned(), true, list));
        }
        for (title, whole, values) in found {
            let list = self.lists.entry(title).or_insert_with(|| (whole, Vec::new()));
            if !values.is_empty() {
                list.1.resize(start, 0.0);
                list.1.extend(values);
            }
        }
        self.rows = end;
        for (title, (_, list)) in &mut self.lists {
            if wanted(title) {
                list.resize(end, 0.0);
            }
        }
        Ok(rows)
    }
}

/// The numbers of a dataset, a list for each component; without numbers if they are not wanted.
fn lists(
    dataset: &Dataset,
    column: &str,
    rows: usize,
    length: u64,
    wanted: &dyn Fn(&str) -> bool,
) -> Result<Vec<(String, bool, Vec<f64>)>, String> {
    let refuse = |why: hdf5_pure::Error| why.to_string();
    let whole = match dataset.dtype().map_err(refuse)? {
        DType::U8 | DType::U16 | DType::U32 | DType::U64 => true,
        DType::F32 | DType::F64 | DType::I8 | DType::I16 | DType::I32 | DType::I64 => false,
        _ => return Ok(Vec::new()),
    };
    let shape = dataset.shape().map_err(refuse)?;
    let width = match shape[..] {
        [count] if count == rows as u64 => 1,
        [count, width] if count == rows as u64 && (1..=MOST).contains(&width) => width,
        _ if is_known(column, wanted) => return Err(format!("has the shape {shape:?}, and there are {rows} particles")),
        _ => return Ok(Vec::new()),
    };
    let bytes = dataset.element_size().map_err(refuse)?.checked_mul(rows as u64).and_then(|bytes| bytes.checked_mul(width));
    let bytes = bytes.ok_or_else(|| format!("announces {rows} rows"))?;
    let held = held(dataset, length)?;
    if bytes > held {
        return Err(format!("announces {bytes} bytes, and the file holds {held} for it at most"));
    }
    let width = usize::try_from(width).unwrap_or(1);
    let titles = sheet::titles_of(column, width);
    if !titles.iter().any(|title| wanted(title)) {
        return Ok(titles.into_iter().map(|title| (title, whole, Vec::new())).collect());
    }
    if column == sheet::ID && dataset.dtype().map_err(refuse)? == DType::U64 {
        sheet::narrow(&dataset.read_u64().map_err(refuse)?)?;
    }
    let numbers = dataset.read_f64().map_err(refuse)?;
    if numbers.len() != rows * width {
        return Err(format!("holds {} numbers, and {} are announced", numbers.len(), rows * width));
    }
    let list = |k: usize| numbers.iter().skip(k).step_by(width).copied().collect();
    Ok(titles.into_iter().enumerate().map(|(k, title)| (title, whole, list(k))).collect())
}

/// Whether a column is one of GADGET's, or a requested one.
fn is_known(column: &str, wanted: &dyn Fn(&str) -> bool) -> bool {
    let usual = NAMES.iter().any(|(known, _)| *known == column);
    usual || ["", "_x", "_0", "_0_x"].iter().any(|suffix| wanted(&format!("{column}{suffix}")))
}

/// The maximum number of components.
const MOST: u64 = 4096;
/// The maximum ratio of deflate: 258 bytes from 2 bits.
const DEFLATED: u64 = 1032;

/// The maximum number of bytes of a dataset, given the bytes in the file.
fn held(dataset: &Dataset, length: u64) -> Result<u64, String> {
    if !dataset.is_chunked() {
        return Ok(length);
    }
    let chunks = dataset.chunks().map_err(|why| why.to_string())?;
    let packed = !dataset.filters().is_empty();
    let stored: u64 = chunks.iter().map(|chunk| chunk.storage_size).fold(0, u64::saturating_add);
    Ok(if packed { stored.min(length).saturating_mul(DEFLATED) } else { stored.min(length) })
}

/// The numbers of an attribute; empty for text.
fn numbers(value: &AttrValue) -> Vec<f64> {
    macro_rules! cast {
        ($($one:ident $many:ident)*) => {
            match value {
                AttrValue::F64(x) => vec![*x],
                AttrValue::F64Array(list) => list.clone(),
                AttrValue::I64(x) => vec![*x as f64],
                AttrValue::I64Array(list) => list.iter().map(|x| *x as f64).collect(),
                AttrValue::U64(x) => vec![*x as f64],
                AttrValue::U64Array(list) => list.iter().map(|x| *x as f64).collect(),
                $(
                    AttrValue::$one(x) => vec![f64::from(*x)],
                    AttrValue::$many(list) => list.iter().map(|x| f64::from(*x)).collect(),
                )*
                _ => Vec::new(),
            }
        };
    }
    cast!(F32 F32Array I8 I8Array I16 I16Array I32 I32Array U8 U8Array U16 U16Array U32 U32Array)
}

fn bounds(header: &HashMap<String, AttrValue>) -> Option<Bounds> {
    let three = |name: &str| <[f64; 3]>::try_from(header.get(name).map(numbers)?).ok();
    if let (Some(low), Some(high), Some(sides)) = (three("BoxLow"), three("BoxHigh"), three("BoxSides")) {
        let side = |side: f64| match side {
            1.0 => Side::Periodic,
            2.0 => Side::Reflecting,
            _ => Side::Open,
        };
        return Some(Bounds { low: low.into(), high: high.into(), sides: sides.map(side), dimensions: 3 });
    }
    let size = header.get("BoxSize").map(numbers)?;
    let size = match size[..] {
        [size] => [size; 3],
        [x, y, z] => [x, y, z],
        _ => return None,
    };
    let is_one = size.iter().all(|length| length.is_finite() && *length > 0.0);
    is_one.then_some(Bounds { low: [0.0; 3].into(), high: size.into(), sides: [Side::Periodic; 3], dimensions: 3 })
}
