//! One array in `NumPy`'s format NPY (`NumPy` Enhancement Proposal 1), versions 1 to 3, read as untrusted data.
//!
//! `npyz` can read these headers too, but it allocates up to 4 GiB as a header demands, descends without limit into nested brackets, and
//! overflows on shapes whose product does not fit. Here a header is short, flat and checked, or an error.

use std::io::Read;

/// The longest header that is read; `NumPy` itself stops at 10 000 bytes.
const LONGEST: u32 = 10_000;
/// The number of bytes read at once; memory grows as data arrives, not as the header states.
const PIECE: usize = 1 << 16;

/// The header of an array.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Header {
    /// The type of its numbers.
    pub kind: Kind,
    /// Whether they are big-endian.
    pub big: bool,
    /// Lengths along its axes; none for a single number.
    pub shape: Vec<u64>,
    /// Bytes of the header itself.
    pub bytes: u64,
}

/// A type of number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    F4,
    F8,
    I4,
    I8,
    U4,
    U8,
}

impl Kind {
    /// Bytes of one number.
    pub(super) fn width(self) -> usize {
        match self {
            Self::F4 | Self::I4 | Self::U4 => 4,
            Self::F8 | Self::I8 | Self::U8 => 8,
        }
    }
}

impl Header {
    /// Reads a header up to the first byte of the data.
    pub(super) fn read(mut from: impl Read) -> Result<Self, String> {
        let mut start = [0; 8];
        fill(&mut from, &mut start)?;
        let [0x93, b'N', b'U', b'M', b'P', b'Y', version, _] = start else {
            return Err("is no NPY array".into());
        };
        let (length, before) = match version {
            1 => {
                let mut bytes = [0; 2];
                fill(&mut from, &mut bytes)?;
                (u32::from(u16::from_le_bytes(bytes)), 10)
            }
            2 | 3 => {
                let mut bytes = [0; 4];
                fill(&mut from, &mut bytes)?;
                (u32::from_le_bytes(bytes), 12)
            }
            _ => return Err(format!("has NPY version {version}; 1 to 3 are known")),
        };
        if length > LONGEST {
            return Err(format!("announces a header of {length} bytes; more than {LONGEST} are not read"));
        }
        let mut text = vec![0; length as usize];
        fill(&mut from, &mut text)?;
        let text = String::from_utf8_lossy(&text);
        let descr = value(&text, "descr")?;
        let (kind, big) = number(descr)?;
        Ok(Self { kind, big, shape: lengths(value(&text, "shape")?)?, bytes: before + u64::from(length) })
    }

    /// The array's numbers, widened.
    pub(super) fn numbers(&self, mut from: impl Read, count: u64) -> Result<Vec<f64>, String> {
        let width = self.kind.width();
        let mut values = Vec::new();
        let mut piece = vec![0; PIECE];
        let mut left = count.saturating_mul(width as u64);
        while left > 0 {
            let part = &mut piece[..usize::try_from(left).unwrap_or(PIECE).min(PIECE)];
            let broken = |error| format!("ends after {} of {count} numbers ({error})", values.len());
            from.read_exact(part).map_err(broken)?;
            left -= part.len() as u64;
            if self.big {
                part.chunks_exact_mut(width).for_each(<[u8]>::reverse);
            }
            values.extend(part.chunks_exact(width).map(|bytes| widened(self.kind, bytes)));
        }
        Ok(values)
    }
}

/// One number, from little-endian bytes.
#[expect(
    clippy::cast_precision_loss,
    reason = "8-byte integers are steps and ids, which fit 53 bits or are refused later"
)]
fn widened(kind: Kind, bytes: &[u8]) -> f64 {
    let mut long = [0; 8];
    long[..bytes.len()].copy_from_slice(bytes);
    let [a, b, c, d, ..] = long;
    let short = [a, b, c, d];
    match kind {
        Kind::F4 => f64::from(f32::from_le_bytes(short)),
        Kind::F8 => f64::from_le_bytes(long),
        Kind::I4 => f64::from(i32::from_le_bytes(short)),
        Kind::I8 => i64::from_le_bytes(long) as f64,
        Kind::U4 => f64::from(u32::from_le_bytes(short)),
        Kind::U8 => u64::from_le_bytes(long) as f64,
    }
}

fn fill(from: &mut impl Read, bytes: &mut [u8]) -> Result<(), String> {
    from.read_exact(bytes).map_err(|error| format!("ends within its header ({error})"))
}

/// The text after a key of the header's dictionary, up to the end of the header.
fn value<'a>(text: &'a str, key: &str) -> Result<&'a str, String> {
    let missing = || format!("has a header without `{key}`");
    let (_, rest) = ["'", "\""].iter().find_map(|q| text.split_once(&format!("{q}{key}{q}"))).ok_or_else(missing)?;
    Ok(rest.trim_start().strip_prefix(':').ok_or_else(missing)?.trim_start())
}

/// The type in a string such as `'<f4'`.
fn number(text: &str) -> Result<(Kind, bool), String> {
    let quote = text.chars().next().filter(|c| matches!(c, '\'' | '"'));
    let descr = quote.and_then(|q| text[1..].split(q).next());
    let Some(descr) = descr else {
        return Err("holds records with fields; each array must hold plain numbers".into());
    };
    let (order, rest) = match descr.chars().next() {
        Some(order @ ('<' | '>' | '=' | '|')) => (order, &descr[1..]),
        _ => ('=', descr),
    };
    let kind = match rest {
        "f4" => Kind::F4,
        "f8" => Kind::F8,
        "i4" => Kind::I4,
        "i8" => Kind::I8,
        "u4" => Kind::U4,
        "u8" => Kind::U8,
        _ if rest.starts_with('O') => {
            return Err("holds Python objects, which are not read: they can run code".into());
        }
        _ => {
            let descr: String = descr.chars().take(20).collect();
            return Err(format!("holds `{descr}`; f4, f8, i4, i8, u4 and u8 are read"));
        }
    };
    Ok((kind, order == '>' || (order == '=' && cfg!(target_endian = "big"))))
}

/// The lengths in a tuple such as `(1000,)`.
fn lengths(text: &str) -> Result<Vec<u64>, String> {
    let inside = text.strip_prefix('(').and_then(|rest| rest.split_once(')')).map(|(inside, _)| inside);
    let inside = inside.ok_or("has a header without a tuple as `shape`")?;
    let parts = inside.split(',').map(str::trim).filter(|part| !part.is_empty());
    parts.map(|part| part.parse().map_err(|_| format!("has the length `{part}`, which is no whole number"))).collect()
}
