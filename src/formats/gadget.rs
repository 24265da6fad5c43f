//! Snapshots of GADGET-2 (Springel 2005) in its binary formats 1 and 2, of either byte order: records between their lengths, a header of
//! 256 bytes, then `POS`, `VEL`, `ID`, `MASS`, and for gas `U`, `RHO`, `HSML`. They are read, and written as HDF5.
//!
//! The type of a particle is its species. Numbers stay in the units of the file, which are comoving where it is cosmological.

use super::binary::{Type, bytes_of};
use super::sheet::{self, ID, Place, Sheet};
use super::{Format, Input, input};
use crate::error::Error;
use crate::kernel::{Bounds, Columns, Side};
use crate::state::State;

/// Its entry in the register.
pub(super) const FORMAT: Format = Format {
    name: "gadget",
    about: "GADGET-2, its binary formats 1 and 2",
    endings: &["gadget", "gad", "g2"],
    begins: |start| order(start).is_some(),
    contents: |path| Ok(sheet(path, &|_| false)?.contents),
    read: Some(read),
    write: None,
    left_out: None,
    compresses: false,
    divides: false,
};

const HEADER: usize = 256;
const TYPES: usize = 6;
/// The blocks of format 1 in their order, those of format 2 by these names: column, components.
const BLOCKS: [(&str, &str, usize); 9] = [
    ("POS ", "position", 3),
    ("VEL ", "velocity", 3),
    ("ID  ", ID, 1),
    ("MASS", "mass", 1),
    ("U   ", "internal_energy", 1),
    ("RHO ", "density", 1),
    ("HSML", "smoothing_length", 1),
    ("POT ", "potential", 1),
    ("ACCE", "acceleration", 3),
];

/// The byte order and the layout of a file.
#[derive(Clone, Copy)]
struct Order {
    big: bool,
    /// Whether each block is named.
    named: bool,
}

/// Determined from the length of the first record.
fn order(start: &[u8]) -> Option<Order> {
    let named = |word: [u8; 4], big| (start.starts_with(&word) && start.get(4..8) == Some(b"HEAD")).then_some(Order { big, named: true });
    let plain = |word: [u8; 4], big| start.starts_with(&word).then_some(Order { big, named: false });
    named([8, 0, 0, 0], false).or(named([0, 0, 0, 8], true)).or(plain([0, 1, 0, 0], false)).or(plain([0, 0, 1, 0], true))
}

/// Reads a state of these columns. Blocks without a column are skipped.
///
/// # Errors
/// [`Error::Input`] with the byte of a record that is truncated or has a length other than that of its particles, or of an invalid number;
/// a file that is a part of a set.
pub fn read(path: &Input<'_>, columns: &Columns) -> Result<State, Error> {
    sheet::read(path, columns, sheet)
}

/// A record: the position of its bytes.
struct Record {
    first: usize,
    length: usize,
}

fn sheet(path: &Input<'_>, wanted: &dyn Fn(&str) -> bool) -> Result<Sheet, Error> {
    let bytes = bytes_of(path)?;
    parsed(&bytes, wanted).map_err(|message| input(path, message))
}

fn record(bytes: &[u8], at: usize, big: bool) -> Result<Record, String> {
    let word = |at: usize| {
        let word = bytes.get(at..at.checked_add(4)?)?;
        word.try_into().ok().map(|word| if big { u32::from_be_bytes(word) } else { u32::from_le_bytes(word) })
    };
    let cut = || format!("byte {at}: a record begins here, and the file ends at byte {} within it", bytes.len());
    let length = word(at).ok_or_else(cut)?;
    let size = length as usize;
    let after = word(at.saturating_add(4).saturating_add(size)).ok_or_else(cut)?;
    if after != length {
        return Err(format!("byte {at}: a record of {length} bytes ends with the length {after}"));
    }
    Ok(Record { first: at + 4, length: size })
}

fn parsed(bytes: &[u8], wanted: &dyn Fn(&str) -> bool) -> Result<Sheet, String> {
    let order = order(bytes).ok_or("byte 0: neither 256 nor 8, in either byte order: no snapshot of GADGET-2")?;
    let mut at = 0;
    let next = |at: &mut usize| -> Result<(Option<String>, Record), String> {
        let mut name = None;
        if order.named {
            let label = record(bytes, *at, order.big)?;
            if label.length != 8 {
                return Err(format!("byte {at}: a record of {} bytes, where a block is named in 8", label.length));
            }
            name = Some(String::from_utf8_lossy(&bytes[label.first..label.first + 4]).into_owned());
            *at = label.first + label.length + 4;
        }
        let record = record(bytes, *at, order.big)?;
        *at = record.first + record.length + 4;
        Ok((name, record))
    };
    let (_, head) = next(&mut at)?;
    if head.length != HEADER {
        return Err(format!("byte {}: the header has {} bytes, not {HEADER}", head.first, head.length));
    }
    let header = &bytes[head.first..head.first + HEADER];
    let number = |kind: Type, place: usize| kind.number(&header[place..], order.big);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "words of 32 bits")]
    let counts: Vec<usize> = (0..TYPES).map(|kind| number(Type::U32, 4 * kind) as usize).collect();
    let table: Vec<f64> = (0..TYPES).map(|kind| number(Type::F64, 24 + 8 * kind)).collect();
    let rows: usize = counts.iter().sum();
    if rows as u128 * 12 > bytes.len() as u128 {
        return Err(format!(
            "byte {}: the header announces {rows} particles, more than {} bytes can hold",
            head.first,
            bytes.len()
        ));
    }
    let files = number(Type::I32, 124);
    if files > 1.0 {
        return Err(format!("byte {}: is one of {files} files; sets are read as HDF5", head.first + 124));
    }
    let mut sheet = Sheet { time: number(Type::F64, 72), ..Sheet::default() };
    sheet.contents.rows = rows;
    let size = number(Type::F64, 128);
    if size.is_finite() && size > 0.0 {
        let (low, high) = ([0.0; 3].into(), [size; 3].into());
        sheet.contents.bounds = Some(Bounds { low, high, sides: [Side::Periodic; 3], dimensions: 3 });
    }
    let listed: usize = (0..TYPES).filter(|kind| table[*kind] == 0.0).map(|kind| counts[kind]).sum();
    let mut masses: Option<(Vec<f64>, usize)> = None;
    let mut there = 0;
    for number in 0.. {
        if at == bytes.len() {
            break;
        }
        // Masses are left out where the header has them all.
        let place = if listed == 0 && number >= 3 { number + 1 } else { number };
        let (name, record) = next(&mut at)?;
        let block = match &name {
            Some(name) => BLOCKS.iter().find(|(known, ..)| known == name),
            None => BLOCKS.get(place),
        };
        let Some((label, column, components)) = block else { continue };
        let has = match *column {
            "mass" => listed,
            "internal_energy" | "density" | "smoothing_length" => counts[0],
            _ => rows,
        };
        let numbers = has * components;
        let whole = *column == ID;
        let kind = match (record.length, numbers.checked_mul(4), numbers.checked_mul(8), whole) {
            (length, Some(four), _, false) if length == four => Type::F32,
            (length, _, Some(eight), false) if length == eight => Type::F64,
            (length, Some(four), _, true) if length == four => Type::U32,
            (length, _, Some(eight), true) if length == eight => Type::U64,
            // In format 1 the later blocks depend on the code that wrote the file.
            _ if name.is_none() && place > 3 => continue,
            (length, ..) => {
                return Err(format!(
                    "byte {}: the block {} has {length} bytes, and {has} particles need {} or {}",
                    record.first,
                    label.trim(),
                    4 * numbers as u128,
                    8 * numbers as u128
                ));
            }
        };
        there += usize::from(*column == "position");
        let one = |n: usize| kind.number(&bytes[record.first + n * kind.width()..], order.big);
        if *column == "mass" {
            masses = Some(((0..if wanted("mass") { has } else { 0 }).map(one).collect(), record.first));
            continue;
        }
        for (k, title) in sheet::titles_of(column, *components).into_iter().enumerate() {
            let place = Place::Byte {
                first: (record.first + k * kind.width()) as u64,
                stride: (components * kind.width()) as u64,
            };
            sheet.enter(&title, whole, wanted, || {
                let mut list: Vec<f64> = (0..has).map(|row| one(row * components + k)).collect();
                list.resize(rows, 0.0);
                (list, place)
            });
        }
    }
    if there != 1 {
        return Err(format!("byte {}: the file ends here without the positions that its header announces", bytes.len()));
    }
    if listed > 0 && masses.is_none() {
        return Err(format!("byte {}: the file ends here without the masses of {listed} particles", bytes.len()));
    }
    let (given, first) = masses.unwrap_or_default();
    sheet.enter("mass", false, wanted, || {
        let mut given = given.into_iter();
        let of = |kind: usize| if table[kind] == 0.0 { None } else { Some(table[kind]) };
        let list = (0..TYPES).flat_map(|kind| std::iter::repeat_n(kind, counts[kind]));
        let list = list.map(|kind| of(kind).or_else(|| given.next()).unwrap_or(0.0)).collect();
        (list, Place::Named(format!("MASS at byte {first}")))
    });
    sheet.enter("species", true, wanted, || {
        let kinds = (0..TYPES).flat_map(|kind| std::iter::repeat_n(kind as f64, counts[kind]));
        (kinds.collect(), Place::Named("type".to_owned()))
    });
    Ok(sheet)
}
