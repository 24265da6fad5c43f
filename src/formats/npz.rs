//! NPZ, `NumPy`'s archive of named arrays: `id`, `x`, `y`, `z`, `vx`, `vy`, `vz`, `mass`, `size`, `species`, `life`, those of any other
//! column (`charge`, or `spin_x`, `spin_y`, `spin_z`), quantities of the system by their names, and `time` and `step`. Arrays whose names
//! begin with `kept_` hold the restart data of a step, so that a run continues with the same bits; nothing else reads them.
//!
//! `numpy.load("snapshot.npz")["x"]` is the array of x by id.

use std::io::{self, BufWriter, Seek, Write};

use npyz::npz::NpzWriter;
use npyz::zip::write::FileOptions;
use npyz::zip::{CompressionMethod, DateTime};
use npyz::{AutoSerialize, Serialize, WriterBuilder};

use super::archive::Arrays;
use super::problems::{Problems, order, ordered};
use super::titles::{self, Number, Strip, Title};
use super::{Contents, Format, Heading, Input, Precision, input};
use crate::error::Error;
use crate::kernel::{Array, Column, Columns, Kind, Shape};
use crate::state::{KEPT, KEPT_NEXT, State};

/// Its entry in the register.
pub(super) const FORMAT: Format = Format {
    name: "npz",
    about: "arrays for NumPy, all columns and the time",
    endings: &["npz"],
    begins: |start| start.starts_with(b"PK\x03\x04"),
    contents,
    read: Some(read),
    write: Some(|out, state, options| write_beside(out, state, options.precision, options.compress, &[])),
    left_out: None,
    compresses: true,
    divides: false,
};

/// Bytes that are written at once.
const PIECE: usize = 1 << 16;

/// Reads a state of these columns. Arrays may be f4, f8 or integers of 4 or 8 bytes, stored or deflated; `x`, `y`, `z` must be
/// there; left out, velocities, sizes, species, time and step are 0 and masses are 1; with `id`, entries may come in any order.
///
/// # Errors
/// [`Error::Input`] that lists every array that is missing, unknown, of another length than `x`, larger than the file can
/// hold, not of numbers, not finite, or negative where that makes no sense; and every id that is given twice.
pub fn read(path: &Input<'_>, columns: &Columns) -> Result<State, Error> {
    let (file, _) = path.open()?;
    let known = titles::all(columns);
    let system = || columns.iter().filter(|column| matches!(column.shape, Shape::System(_)));
    let others: Vec<&str> = system().map(|column| column.name.as_ref()).collect();
    let mut arrays = Arrays::opened(file, &known, &others).map_err(|error| input(path, error.to_string()))?;
    let time = arrays.single("time");
    let step = arrays.single("step");
    let given: Vec<_> = known.iter().map(|title| arrays.column(&title.text)).collect();
    let ids = arrays.column("id");
    let kept: Vec<_> = arrays.kept().into_iter().filter_map(|name| Some((arrays.column(&name)?, name))).collect();
    let own: Vec<_> = system().filter_map(|column| Some((column, arrays.column(&column.name)?))).collect();
    let mut problems = arrays.problems;
    let rows = given.first().and_then(Option::as_ref).map(Vec::len);
    for (values, title) in given.iter().zip(&known) {
        check(&title.text, values.as_deref(), rows, |value| title.fault(value), &mut problems);
    }
    let whole_number = |value: f64| Title { text: String::new(), column: &ID, place: 0 }.fault(value);
    check("id", ids.as_deref(), rows, whole_number, &mut problems);
    for (column, values) in &own {
        let wanted = column.shape.len(0) * column.kind.components();
        check(&column.name, Some(values), Some(wanted), |_| None::<&str>, &mut problems);
    }
    if !problems.none() {
        return problems.check(path).map(|()| State::default());
    }
    let count = rows.unwrap_or(0);
    let ids_in_order = ids.as_ref().is_none_or(|ids| ids.windows(2).all(|pair| pair[0] < pair[1]));
    let mut state = titles::state(columns, given, count);
    if let Some(ids) = ids {
        let ids: Vec<u64> = ids.iter().map(|id| whole(*id)).collect();
        let order = order(&ids, |place| format!("id[{place}]"), &mut problems);
        problems.check(path)?;
        state = ordered(&state, &ids, &order);
    } else {
        problems.check(path)?;
    }
    for (column, values) in own {
        let width = column.kind.components();
        let given: Vec<_> = (0..width).map(|k| Some(values.iter().skip(k).step_by(width).copied().collect())).collect();
        // Its elements are read as the rows of a column with one for each particle.
        let rows = Column { shape: Shape::Particle, ..column.clone() };
        state.put(column, Some(titles::array(&rows, &given, values.len() / width)));
    }
    (state.time, state.step) = (time, whole(step));
    // In another order they are not of these particles.
    if ids_in_order {
        kept.into_iter().for_each(|(numbers, name)| state.kept.put(name, numbers));
        state.take_next();
    }
    Ok(state)
}

/// The names of arrays, except restart data.
fn contents(path: &Input<'_>) -> Result<Contents, Error> {
    let (file, _) = path.open()?;
    let mut archive = npyz::npz::NpzArchive::new(file).map_err(|error| input(path, error.to_string()))?;
    let mut names: Vec<String> = archive.array_names().map(str::to_owned).collect();
    names.retain(|name| !name.starts_with(KEPT) && !["time", "step"].contains(&name.as_str()));
    names.sort_unstable();
    let mut contents = Contents::default();
    for title in names {
        let header = |archive: &mut npyz::npz::NpzArchive<_>| {
            let mut file = archive.zip_archive().by_name(&format!("{title}.npy")).ok()?;
            super::npy::Header::read(&mut file).ok()
        };
        let Some(header) = header(&mut archive) else { continue };
        let whole = matches!(header.kind, super::npy::Kind::U4 | super::npy::Kind::U8);
        if let ("x", Some(rows)) = (title.as_str(), header.shape.first()) {
            contents.rows = usize::try_from(*rows).unwrap_or(usize::MAX);
        }
        contents.headings.push(Heading { title, whole });
    }
    Ok(contents)
}

/// The column of ids, for a check.
static ID: std::sync::LazyLock<Column> = std::sync::LazyLock::new(|| Column::new("id", Kind::Whole, "", ""));

/// Records an array of the wrong length, and invalid values.
fn check<T: std::fmt::Display>(
    name: &str,
    values: Option<&[f64]>,
    rows: Option<usize>,
    fault: impl Fn(f64) -> Option<T>,
    problems: &mut Problems,
) {
    let Some(values) = values else { return };
    if let Some(count) = rows.filter(|count| values.len() != *count) {
        problems.note(|| format!("the array `{name}` holds {} numbers, but `x` holds {count}", values.len()));
    }
    for (place, value) in values.iter().enumerate() {
        if let Some(fault) = fault(*value) {
            problems.note(|| format!("{name}[{place}] is {value:?}, which {fault}"));
        }
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "saturates, which suits a step; ids are checked"
)]
fn whole(x: f64) -> u64 {
    x as u64
}

/// Writes a state, uncompressed: `id` (u4), real numbers (f4 or f8) and whole ones (u4) of the columns that a CSV file has too, those of
/// the system, and the single numbers `time` (f8) and `step` (u8). The same state gives the same bytes: no date is stored.
///
/// # Errors
/// Those of `out`; a number that does not fit single precision, where that is asked for.
pub fn write_npz(out: impl Write + Seek, state: &State, precision: Precision) -> io::Result<()> {
    write_beside(out, state, precision, false, &[])
}

/// The same with more entries after the arrays, by name; deflated, if that is requested.
///
/// # Errors
/// Those of `out`; a number that does not fit single precision, where that is asked for.
pub(crate) fn write_beside(
    out: impl Write + Seek,
    state: &State,
    precision: Precision,
    compress: bool,
    more: &[(String, &[u8])],
) -> io::Result<()> {
    let count = state.len() as u64;
    let mut archive = Archive { to: NpzWriter::new(out), compress };
    put(&mut archive, "time", &[], [state.time.to_le_bytes()], 0.0_f64)?;
    put(&mut archive, "step", &[], [state.step.to_le_bytes()], 0_u64)?;
    u32::try_from(count).map_err(|_| io::Error::other(format!("{count} particles; ids have 32 bits")))?;
    put(&mut archive, "id", &[count], state.ids().iter().copied().map(u32::to_le_bytes), 0_u32)?;
    let strips = titles::strips(state);
    titles::fit(&strips, state.len(), precision)?;
    let names = strips.iter().map(|strip| strip.text.as_str());
    let others = state.columns().filter(|(column, _)| matches!(column.shape, Shape::System(_)));
    let meant = |name: &str| match name {
        "time" | "step" => Some(format!("the {name} of the state")),
        "id" => Some("ids".to_owned()),
        _ => name.starts_with(KEPT).then(|| "what a step keeps".to_owned()),
    };
    titles::reserved(names.chain(others.map(|(column, _)| column.name.as_ref())), "NPZ", meant)?;
    for strip in strips {
        numbers(&mut archive, &strip, state.len(), precision)?;
    }
    for (column, values) in state.columns().filter(|(column, _)| matches!(column.shape, Shape::System(_))) {
        system(&mut archive, column, values)?;
    }
    if state.next > 0 {
        kept(&mut archive, KEPT_NEXT, &[f64::from(state.next)])?;
    }
    for (name, numbers) in state.kept.iter() {
        kept(&mut archive, name, numbers)?;
    }
    for (name, bytes) in more {
        archive.to.zip_writer().start_file(name, entry(bytes.len() as u64 >= LARGE, compress)).map_err(io::Error::other)?;
        archive.to.zip_writer().write_all(bytes)?;
    }
    archive.to.zip_writer().finish().map(drop).map_err(io::Error::other)
}

/// One number per particle.
fn numbers<W: Write + Seek>(
    archive: &mut Archive<W>,
    strip: &Strip<'_>,
    count: usize,
    precision: Precision,
) -> io::Result<()> {
    let (name, shape) = (&strip.text, &[count as u64]);
    let real = |id| if let Number::Real(x) = strip.of(id) { x } else { 0.0 };
    let whole = |id| if let Number::Whole(n) = strip.of(id) { n } else { 0 };
    #[expect(clippy::cast_possible_truncation, reason = "single precision was asked for")]
    match precision {
        _ if strip.is_whole() => put(archive, name, shape, (0..count).map(|id| whole(id).to_le_bytes()), 0_u32),
        Precision::Single => put(archive, name, shape, (0..count).map(|id| (real(id) as f32).to_le_bytes()), 0.0_f32),
        Precision::Double => put(archive, name, shape, (0..count).map(|id| real(id).to_le_bytes()), 0.0_f64),
    }
}

/// The numbers of the system, one after another.
fn system<W: Write + Seek>(archive: &mut Archive<W>, column: &Column, values: &Array) -> io::Result<()> {
    let real = |list: Vec<f64>, archive: &mut Archive<W>| {
        put(archive, &column.name, &[list.len() as u64], list.iter().map(|x| x.to_le_bytes()), 0.0_f64)
    };
    match values {
        Array::Uint(list) => {
            put(archive, &column.name, &[list.len() as u64], list.iter().map(|n| n.to_le_bytes()), 0_u32)
        }
        Array::Float(list) => real(list.clone(), archive),
        Array::Vec3(list) => real(list.iter().flat_map(glam::DVec3::to_array).collect(), archive),
        Array::Vec4(list) => real(list.iter().flat_map(glam::DVec4::to_array).collect(), archive),
    }
}

/// Restart data, in single precision if no number loses a bit.
fn kept<W: Write + Seek>(archive: &mut Archive<W>, name: &str, numbers: &[f64]) -> io::Result<()> {
    let shape = &[numbers.len() as u64];
    #[expect(clippy::cast_possible_truncation, reason = "looked at before")]
    if numbers.iter().all(|x| f64::from(*x as f32).to_bits() == x.to_bits()) {
        return put(archive, name, shape, numbers.iter().map(|x| (*x as f32).to_le_bytes()), 0.0_f32);
    }
    put(archive, name, shape, numbers.iter().map(|x| x.to_le_bytes()), 0.0_f64)
}

/// The size above which a ZIP entry needs its long form \[bytes\].
const LARGE: u64 = 1 << 31;

/// An archive that is written.
struct Archive<W: Write + Seek> {
    to: NpzWriter<W>,
    compress: bool,
}

/// An entry without a date.
fn entry(large: bool, compress: bool) -> FileOptions {
    FileOptions::default()
        .compression_method(if compress { CompressionMethod::Deflated } else { CompressionMethod::Stored })
        .last_modified_time(DateTime::default())
        .large_file(large)
}

/// Writes one array of little-endian numbers of the type of `_like`.
fn put<W: Write + Seek, T: Serialize + AutoSerialize, const N: usize>(
    archive: &mut Archive<W>,
    name: &str,
    shape: &[u64],
    values: impl IntoIterator<Item = [u8; N]>,
    _like: T,
) -> io::Result<()> {
    let options = entry(shape.first().is_some_and(|count| *count >= LARGE / 8), archive.compress);
    let dtype = T::default_dtype();
    let entry = archive.to.array::<T>(name, options)?.dtype(dtype).shape(shape).write_header_only()?;
    let mut entry = BufWriter::with_capacity(PIECE, entry);
    for value in values {
        entry.write_all(&value)?;
    }
    entry.flush()
}
