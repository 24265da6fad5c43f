//! NPZ, `NumPy`'s archive of named arrays: `id`, `x`, `y`, `z`, `vx`, `vy`, `vz`, `mass`, `radius`,
//! `species`, `life`, `time`, `step`.
//!
//! `numpy.load("snapshot.npz")["x"]` is the array of x by id.

use std::io::{self, BufWriter, Seek, Write};
use std::path::Path;

use glam::DVec3;
use npyz::npz::NpzWriter;
use npyz::zip::write::FileOptions;
use npyz::zip::{CompressionMethod, DateTime};
use npyz::{AutoSerialize, Serialize, WriterBuilder};

use super::archive::Arrays;
use super::csv::NUMBERS;
use super::problems::{Problems, order};
use super::{Precision, input, open};
use crate::error::Error;
use crate::life::Life;
use crate::state::State;

/// Bytes that are written at once.
const PIECE: usize = 1 << 16;
/// Reads a snapshot. Arrays may be f4, f8 or integers of 4 or 8 bytes, stored or deflated; `x`, `y`, `z` must be there; left
/// out, velocities, radii, species, time and step are 0 and masses are 1; with `id`, entries may come in any order.
///
/// # Errors
/// [`Error::Input`] that lists every array that is missing, unknown, of another length than `x`, larger than the file can
/// hold, not of numbers, not finite, or negative where that makes no sense; and every id that is missing or given twice.
pub fn read(path: &Path) -> Result<State, Error> {
    let (file, _) = open(path)?;
    let mut arrays = Arrays::opened(file).map_err(|error| input(path, error.to_string()))?;
    let time = arrays.single("time");
    let step = arrays.single("step");
    let columns = NUMBERS.map(|(name, _)| arrays.column(name));
    let (ids, species, life) = (arrays.column("id"), arrays.column("species"), arrays.column("life"));
    let mut problems = arrays.problems;
    let rows = columns[0].as_ref().map(Vec::len);
    for (values, name) in
        columns.iter().zip(NUMBERS.map(|(name, _)| name)).chain([(&ids, "id"), (&species, "species"), (&life, "life")])
    {
        check(name, values.as_deref(), rows, &mut problems);
    }
    if !problems.none() {
        return problems.check(path).map(|()| State::default());
    }
    let filled = |(values, (_, default)): (Option<Vec<f64>>, (_, f64))| {
        values.unwrap_or_else(|| vec![default; rows.unwrap_or(0)])
    };
    let mut columns = columns.into_iter().zip(NUMBERS).map(filled);
    let mut next = || columns.next().unwrap_or_default();
    let (position, velocity) = (vectors(&next(), &next(), &next()), vectors(&next(), &next(), &next()));
    let mut state = State::default();
    (state.time, state.step) = (time, whole(step));
    for (((x, v), mass), size) in position.iter().zip(&velocity).zip(next()).zip(next()) {
        state.push(*x, *v, mass, size);
    }
    if let Some(species) = species {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked")]
        state.species_mut().iter_mut().zip(species).for_each(|(to, from)| *to = from as u32);
    }
    if let Some(life) = life {
        state.set_lives(&life.into_iter().filter_map(word).collect::<Vec<_>>())?;
    }
    if let Some(ids) = ids {
        let ids: Vec<u64> = ids.iter().map(|id| whole(*id)).collect();
        let order = order(&ids, |place| format!("id[{place}]"), &mut problems);
        problems.check(path)?;
        state = state.picked(&order);
    }
    Ok(state)
}

/// Notes a column of the wrong length, and values that it must not hold.
fn check(name: &str, values: Option<&[f64]>, rows: Option<usize>, problems: &mut Problems) {
    let Some(values) = values else { return };
    if let Some(count) = rows.filter(|count| values.len() != *count) {
        problems.note(|| format!("the array `{name}` holds {} numbers, but `x` holds {count}", values.len()));
    }
    for (place, value) in values.iter().enumerate() {
        if !value.is_finite() {
            problems.note(|| format!("{name}[{place}] is {value}, which is not finite"));
        } else if *value < 0.0 && matches!(name, "mass" | "radius") {
            problems.note(|| format!("{name}[{place}] is {value}, which is below 0"));
        } else if name == "life" && word(*value).is_none() {
            problems.note(|| format!("{name}[{place}] is {value}, none of 0 (waits), 1 (lives) and 2 (is dead)"));
        } else if matches!(name, "id" | "species")
            && !(value.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(value))
        {
            problems.note(|| format!("{name}[{place}] is {value}, not a whole number from 0 to {}", u32::MAX));
        }
    }
}

fn word(value: f64) -> Option<Life> {
    [Life::Waiting, Life::Living, Life::Dead].into_iter().find(|life| (f64::from(life.word()) - value).abs() == 0.0)
}

fn vectors(x: &[f64], y: &[f64], z: &[f64]) -> Vec<DVec3> {
    x.iter().zip(y).zip(z).map(|((x, y), z)| DVec3::new(*x, *y, *z)).collect()
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "saturates, which suits a step; ids are checked"
)]
fn whole(x: f64) -> u64 {
    x as u64
}

/// Writes a snapshot, uncompressed: `id` (u4), `x` … `vz`, `mass`, `radius` (f4 or f8), `species` (u4) where any is not 0,
/// `life` (u4) where any does not live, and
/// the single numbers `time` (f8) and `step` (u8). The same snapshot gives the same bytes: no date is stored.
///
/// # Errors
/// Those of `out`.
pub fn write_npz(
    out: impl Write + Seek,
    particles: &State,
    time: f64,
    step: u64,
    precision: Precision,
) -> io::Result<()> {
    let count = particles.len() as u64;
    let mut archive = NpzWriter::new(out);
    put(&mut archive, "time", &[], [time.to_le_bytes()], 0.0_f64)?;
    put(&mut archive, "step", &[], [step.to_le_bytes()], 0_u64)?;
    let ids = u32::try_from(count).map_err(|_| io::Error::other(format!("{count} particles; ids have 32 bits")))?;
    put(&mut archive, "id", &[count], (0..ids).map(u32::to_le_bytes), 0_u32)?;
    for (column, (name, _)) in NUMBERS.iter().enumerate() {
        let values = (0..particles.len()).map(|id| match column {
            0..3 => particles.position()[id][column],
            3..6 => particles.velocity()[id][column - 3],
            6 => particles.mass()[id],
            _ => particles.size()[id],
        });
        #[expect(clippy::cast_possible_truncation, reason = "single precision was asked for")]
        match precision {
            Precision::Single => put(&mut archive, name, &[count], values.map(|x| (x as f32).to_le_bytes()), 0.0_f32)?,
            Precision::Double => put(&mut archive, name, &[count], values.map(f64::to_le_bytes), 0.0_f64)?,
        }
    }
    if particles.species().iter().any(|species| *species != 0) {
        put(&mut archive, "species", &[count], particles.species().iter().map(|of| of.to_le_bytes()), 0_u32)?;
    }
    if particles.life().iter().any(|life| *life != Life::Living) {
        let of = |id: usize| particles.life().get(id).copied().unwrap_or_default().word();
        put(&mut archive, "life", &[count], (0..particles.len()).map(|id| of(id).to_le_bytes()), 0_u32)?;
    }
    archive.zip_writer().finish().map(drop).map_err(io::Error::other)
}

/// Writes one array of little-endian numbers of the type of `_like`.
fn put<W: Write + Seek, T: Serialize + AutoSerialize, const N: usize>(
    archive: &mut NpzWriter<W>,
    name: &str,
    shape: &[u64],
    values: impl IntoIterator<Item = [u8; N]>,
    _like: T,
) -> io::Result<()> {
    let large = shape.first().is_some_and(|count| *count >= (1 << 28)); // beyond 2 GiB a ZIP entry needs its long form
    let options = FileOptions::default()
        .compression_method(CompressionMethod::Stored)
        .last_modified_time(DateTime::default())
        .large_file(large);
    let dtype = T::default_dtype();
    let entry = archive.array::<T>(name, options)?.dtype(dtype).shape(shape).write_header_only()?;
    let mut entry = BufWriter::with_capacity(PIECE, entry);
    for value in values {
        entry.write_all(&value)?;
    }
    entry.flush()
}
