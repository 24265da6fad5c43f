//! Conversion from one format into another, and the data lost by it.

use std::path::Path;

use super::{Format, Input, Options, Precision, by_ending, contents, input, known, of, read, verified};
use crate::error::Error;
use crate::kernel::Array;
use crate::state::State;

/// The result of a conversion.
#[derive(Debug)]
pub struct Converted {
    /// The format of the file that was read.
    pub from: &'static Format,
    /// The format of the file that was written.
    pub to: &'static Format,
    /// The number of particles.
    pub count: usize,
    /// The precision of the numbers written.
    pub precision: Precision,
    /// The data of the old file that the new one does not hold, found by reading it back.
    pub lost: Vec<String>,
}

/// Reads a file with all of its columns, and writes it in the format of the other's extension. Without a given precision, numbers are
/// written in single precision if none of them loses a bit.
///
/// # Errors
/// [`Error::Input`] when the file cannot be read, [`Error::Output`] when the other's extension is that of no format that can be written,
/// when it is the file that is read, or when it cannot be written or read back: an existing file is then unchanged.
pub fn convert(from: &Path, to: &Path, precision: Option<Precision>) -> Result<Converted, Error> {
    let refuse = |message: String| Error::Output { file: to.to_owned(), message };
    let format = by_ending(to).ok_or_else(|| {
        let names: Vec<_> = writable().flat_map(|format| format.endings).map(|ending| format!(".{ending}")).collect();
        refuse(format!("its extension names no format: use one of {}", names.join(", ")))
    })?;
    let write = format.write.ok_or_else(|| {
        let names: Vec<_> = writable().map(|format| format.name).collect();
        refuse(format!("files of {} are read, not written: choose one of {}", format.about, names.join(", ")))
    })?;
    if std::fs::canonicalize(to).is_ok_and(|to| std::fs::canonicalize(from).is_ok_and(|from| from == to)) {
        return Err(refuse("is the file that is read: choose another name".to_owned()));
    }
    let source = of(from)?.ok_or_else(|| input(from, "is not of a known format"))?;
    let before = contents(from)?;
    let state = read(from, &known(&before))?;
    let precision = precision.unwrap_or_else(|| if is_single(&state) { Precision::Single } else { Precision::Double });
    let options = Options { precision, bounds: before.bounds, ..Options::default() };
    let (after, back) = verified(
        to,
        |out| write(out, &state, &options),
        |temporary| {
            let back = || -> Result<_, Error> {
                let temporary = &Input::disk(temporary);
                let after = (format.contents)(temporary)?;
                let columns = known(&after);
                let state = format.read.map(|read| read(temporary, &columns)).transpose()?;
                Ok((after, state.unwrap_or_default()))
            };
            let whole = |(after, back): (_, State)| {
                let (wrote, found) = (state.len(), back.len());
                if found == wrote {
                    Ok((after, back))
                } else {
                    Err(input(to, format!("{found} of {wrote} particles are there")))
                }
            };
            back().and_then(whole).map_err(|why| {
                refuse(format!("what was written cannot be read back, so it is discarded: {}", reported(&why)))
            })
        },
    )?;
    let mut lost = lost(&state, &back);
    lost.extend(before.left_out);
    if before.bounds.is_some() && after.bounds.is_none() {
        lost.push("the box".to_owned());
    }
    Ok(Converted { from: source, to: format, count: state.len(), precision, lost })
}

/// The message of an error, without the name of the file.
fn reported(error: &Error) -> String {
    if let Error::Input { message, .. } = error { message.clone() } else { error.to_string() }
}

fn writable() -> impl Iterator<Item = &'static Format> {
    super::FORMATS.iter().filter(|format| format.write.is_some())
}

/// Whether all numbers are exact in single precision.
fn is_single(state: &State) -> bool {
    #[expect(clippy::cast_possible_truncation, reason = "this is the question")]
    let fits = |x: &f64| f64::from(*x as f32).to_bits() == x.to_bits();
    state.columns().all(|(_, values)| match values {
        Array::Float(list) => list.iter().all(fits),
        Array::Vec3(list) => list.iter().all(|v| v.to_array().iter().all(fits)),
        Array::Vec4(list) => list.iter().all(|v| v.to_array().iter().all(fits)),
        Array::Uint(_) => true,
    })
}

/// The data that one state has and the other does not.
fn lost(state: &State, back: &State) -> Vec<String> {
    let mut lost = Vec::new();
    if back.time.to_bits() != state.time.to_bits() {
        lost.push(format!("the time ({:?})", state.time));
    }
    if back.step != state.step {
        lost.push(format!("the step ({})", state.step));
    }
    if back.ids() != state.ids() {
        lost.push("ids".to_owned());
    }
    if state.keeps() && !back.keeps() {
        lost.push("restart data of the last step, with which a run continues bit for bit".to_owned());
    }
    for (column, values) in state.columns().filter(|(column, _)| column.name != "id") {
        match back.get(&column.name) {
            Some(same) if same == values => {}
            None => lost.push(format!("`{}`", column.name)),
            Some(other) => lost.push(match widest(values, other) {
                Some(worst) => format!("digits of `{}` (relative error up to {worst:.1e})", column.name),
                None => format!("`{}`", column.name),
            }),
        }
    }
    lost
}

/// The largest relative difference of two arrays of one kind, where single precision explains it.
fn widest(a: &Array, b: &Array) -> Option<f64> {
    let flat = |values: &Array| -> Option<Vec<f64>> {
        Some(match values {
            Array::Float(list) => list.clone(),
            Array::Vec3(list) => list.iter().flat_map(glam::DVec3::to_array).collect(),
            Array::Vec4(list) => list.iter().flat_map(glam::DVec4::to_array).collect(),
            Array::Uint(_) => return None,
        })
    };
    let (a, b) = (flat(a)?, flat(b)?);
    let worst =
        a.iter().zip(&b).map(|(a, b)| (a - b).abs() / a.abs().max(f64::from(f32::MIN_POSITIVE))).fold(0.0, f64::max);
    (a.len() == b.len() && worst <= f64::from(f32::EPSILON)).then_some(worst)
}
