//! Tipsy, the binary format of n-body codes (Quinn, Katz & others; the N-Body Shop's TIPSY): gas, dark and star particles in
//! f32, in either byte order, with a header of 28 or 32 bytes.
//!
//! Header: time f64, nbodies, ndim, nsph, ndark, nstar i32, and in the standard form 4 bytes of padding that may hold anything.
//! Every record starts with mass, position and velocity. Of what follows, the softening is read where a scene has softenings of particles
//! (of gas it is the smoothing length, as in PKDGRAV); density, temperature, metals and potential are not.
//!
//! The codes that write Tipsy files end the spline of a softening ε at 2 ε, and motes at 2.8 ε: softenings are read as 2 / 2.8 of the
//! file's, and written as 2.8 / 2 of a state's.

use std::io::{self, Read, Write};

use glam::DVec3;

use super::problems::Problems;
use super::{Contents, Format, Heading, Input, input};
use crate::error::Error;
use crate::interactions::gravity::SOFTENING_LENGTH;
use crate::kernel::{Array, Columns, Kind};
use crate::state::State;

/// Its entry in the register. A header contains small counts, and therefore zeros; text does not.
pub(super) const FORMAT: Format = Format {
    name: "tipsy",
    about: "Tipsy, the binary format of n-body codes: positions, velocities, masses and softenings",
    endings: &["tipsy", "bin", "std", "tip"],
    begins: |start| start.contains(&0),
    contents: |_| Ok(Contents { headings: HELD.map(|title| Heading { title: title.to_owned(), whole: false }).to_vec(), ..Contents::default() }),
    read: Some(read),
    write: Some(|out, state, _| write_tipsy(out, state, 0.0).map(drop)),
    left_out: Some(left_out),
    compresses: false,
    divides: false,
};

/// Bytes of the header without its padding, and of the padding.
const HEADER: usize = 28;
const PADDING: usize = 4;
/// The kinds of records in the order of the file, their bytes, and the word that is the softening.
const KINDS: [(&str, u64, usize); 3] = [("gas", 48, 9), ("dark", 36, 7), ("star", 44, 9)];
/// The titles that it can hold.
const HELD: [&str; 8] = ["x", "y", "z", "vx", "vy", "vz", "mass", SOFTENING_LENGTH];
/// The support of the spline of a softening in a file \[softenings\], relative to that of motes.
const SUPPORT: f64 = 2.0 / 2.8;
/// The longest record.
const LONGEST: usize = 48;

/// The byte order of a file.
#[derive(Clone, Copy)]
enum Bytes {
    Big,
    Little,
}

impl Bytes {
    fn i32(self, bytes: &[u8], at: usize) -> i32 {
        let word = array(bytes, at);
        match self {
            Self::Big => i32::from_be_bytes(word),
            Self::Little => i32::from_le_bytes(word),
        }
    }

    fn f32(self, bytes: &[u8], at: usize) -> f64 {
        let word = array(bytes, at);
        f64::from(match self {
            Self::Big => f32::from_be_bytes(word),
            Self::Little => f32::from_le_bytes(word),
        })
    }

    fn f64(self, bytes: &[u8], at: usize) -> f64 {
        let word = array(bytes, at);
        match self {
            Self::Big => f64::from_be_bytes(word),
            Self::Little => f64::from_le_bytes(word),
        }
    }
}

/// Some bytes of a record; zeros beyond its end.
fn array<const N: usize>(bytes: &[u8], at: usize) -> [u8; N] {
    bytes.get(at..at + N).and_then(|part| part.try_into().ok()).unwrap_or([0; N])
}

/// Reads particles and the time: gas first, then dark, then stars. Radii are 0. Softenings are read where `columns` has them.
///
/// # Errors
/// [`Error::Input`] with byte offsets: a file shorter than its header, no byte order in which `ndim` is 1 to 3, counts that do
/// not add up or do not fit the file's size (found before memory is reserved), numbers that are not finite, negative masses and softenings.
pub fn read(path: &Input<'_>, columns: &Columns) -> Result<State, Error> {
    let (mut file, length) = path.open()?;
    let failed = |error: io::Error| input(path, error.to_string());
    let mut header = [0; HEADER];
    if length < HEADER as u64 {
        return Err(input(path, format!("{length} bytes; a Tipsy header alone has {HEADER}")));
    }
    file.read_exact(&mut header).map_err(failed)?;
    let (order, counts) = counted(&header).map_err(|message| input(path, message))?;
    let size = HEADER as u64 + counts.iter().zip(KINDS).map(|(count, (_, bytes, _))| count * bytes).sum::<u64>();
    if length == size + PADDING as u64 {
        file.read_exact(&mut [0; PADDING]).map_err(failed)?;
    } else if length != size {
        let [gas, dark, star] = counts;
        return Err(input(
            path,
            format!(
                "byte 8: the header announces {gas} gas, {dark} dark and {star} star particles, which take {size} bytes (or {} \
                 with a padded header), but the file has {length}",
                size + PADDING as u64
            ),
        ));
    }
    let mut problems = Problems::default();
    let time = order.f64(&header, 0);
    if !time.is_finite() {
        problems.note(|| format!("byte 0: the time {time} is not finite"));
    }
    let mut particles = State::default();
    let own = columns.get(SOFTENING_LENGTH).filter(|column| column.kind == Kind::Scalar);
    let mut softenings = Vec::new();
    let mut offset = length - size + HEADER as u64;
    for (count, (kind, bytes, place)) in counts.into_iter().zip(KINDS) {
        let mut record = [0; LONGEST];
        let record = &mut record[..usize::try_from(bytes).unwrap_or(LONGEST)];
        for index in 0..count {
            file.read_exact(record).map_err(failed)?;
            let mut values = [0.0; 8];
            let words = (0..7).chain(own.is_some().then_some(place));
            for (value, word) in values.iter_mut().zip(words) {
                *value = order.f32(record, 4 * word);
                if !value.is_finite() {
                    let at = offset + 4 * word as u64;
                    problems.note(|| format!("byte {at}: {kind} particle {index} holds {value}, which is not finite"));
                }
            }
            let [mass, x, y, z, vx, vy, vz, softening] = values;
            for (what, word, value) in [("mass", 0, mass), ("softening", place, softening)] {
                if value < 0.0 {
                    let at = offset + 4 * word as u64;
                    problems.note(|| format!("byte {at}: {kind} particle {index} has the {what} {value}, below 0"));
                }
            }
            softenings.push(SUPPORT * softening);
            particles.push(DVec3::new(x, y, z), DVec3::new(vx, vy, vz), mass, 0.0);
            offset += bytes;
        }
    }
    problems.check(path)?;
    if let Some(column) = own {
        particles.declare(column)?;
        particles.set(SOFTENING_LENGTH, Array::Float(softenings))?;
    }
    particles.time = time;
    Ok(particles)
}

/// Byte order and counts of gas, dark and star particles.
fn counted(header: &[u8; HEADER]) -> Result<(Bytes, [u64; 3]), String> {
    let [big, little] = [Bytes::Big, Bytes::Little].map(|order| order.i32(header, 12));
    let order = match (big, little) {
        (1..=3, _) => Bytes::Big,
        (_, 1..=3) => Bytes::Little,
        _ => {
            return Err(format!(
                "byte 12: no Tipsy file: the number of dimensions is {little} in little-endian and {big} in big-endian order, \
                 and 1, 2 or 3 in neither"
            ));
        }
    };
    let total = order.i32(header, 8);
    let counts = [16, 20, 24].map(|at| order.i32(header, at));
    if let Some((place, count)) = counts.iter().enumerate().find(|(_, count)| **count < 0) {
        return Err(format!("byte {}: the header announces {count} {} particles", 16 + 4 * place, KINDS[place].0));
    }
    let sum: i64 = counts.iter().map(|count| i64::from(*count)).sum();
    if sum != i64::from(total) {
        return Err(format!("byte 8: the header announces {total} particles, but gas, dark and star sum to {sum}"));
    }
    Ok((order, counts.map(|count| u64::try_from(count).unwrap_or(0))))
}

/// The columns that the format cannot hold, and that have other than initial values.
fn left_out(state: &State) -> Vec<String> {
    let titles = super::titles::strips(state).into_iter().map(|strip| strip.text);
    titles.filter(|title| !HELD.contains(&title.as_str())).collect()
}

/// A softening as a file has it, of which what is read is not larger in single precision: a scene refuses what is above its largest.
#[expect(clippy::cast_possible_truncation, reason = "the format is single precision")]
fn stretched(softening: f64) -> f64 {
    let mut narrow = (softening / SUPPORT) as f32;
    while narrow > 0.0 && (SUPPORT * f64::from(narrow)) as f32 > softening as f32 {
        narrow = narrow.next_down();
    }
    f64::from(narrow)
}

/// Writes the standard form: big-endian, padded header, every particle a dark one in the order of the ids, with its own softening, or this
/// one where it has none \[length, that of the file\], and a potential of 0. Numbers are narrowed to f32. The format holds positions, velocities, masses, softenings and the time; returns the
/// names of the columns that it cannot hold, and whose values are not the initial ones.
///
/// # Errors
/// Those of `out`; data that Tipsy cannot hold: more than 2³¹ - 1 particles, numbers beyond the range of f32.
pub fn write_tipsy(mut out: impl Write, state: &State, softening: f64) -> io::Result<Vec<String>> {
    let particles = state;
    let count = i32::try_from(particles.len())
        .map_err(|_| io::Error::other(format!("{} particles; a Tipsy file counts to {}", particles.len(), i32::MAX)))?;
    out.write_all(&state.time.to_be_bytes())?;
    for word in [count, 3, 0, count, 0, 0] {
        out.write_all(&word.to_be_bytes())?;
    }
    let mut record = [0; 36];
    let own = state.scalar(SOFTENING_LENGTH);
    for (id, ((x, v), mass)) in particles.position().iter().zip(particles.velocity()).zip(particles.mass()).enumerate()
    {
        let softening = own.and_then(|own| own.get(id)).map_or(softening, |own| stretched(*own));
        let values = [*mass, x.x, x.y, x.z, v.x, v.y, v.z, softening, 0.0];
        for (value, bytes) in values.iter().zip(record.chunks_exact_mut(4)) {
            #[expect(clippy::cast_possible_truncation, reason = "the format is single precision")]
            let narrow = *value as f32;
            if !narrow.is_finite() {
                return Err(io::Error::other(format!("particle {id} holds {value:?}, which a Tipsy file (f32) cannot")));
            }
            bytes.copy_from_slice(&narrow.to_be_bytes());
        }
        out.write_all(&record)?;
    }
    Ok(left_out(state))
}
