//! Numbers in binary files, of either byte order, with checks of the length.

use std::io::Read;

use super::{Input, input};
use crate::error::Error;

/// A type of number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Type {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

impl Type {
    /// Bytes of one number.
    pub fn width(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }
    /// Whether its numbers are integers that are not negative.
    pub fn is_whole(self) -> bool {
        matches!(self, Self::U8 | Self::U16 | Self::U32 | Self::U64)
    }
    /// The number at the start of some bytes, which must be long enough; integers above 2⁵³ are rounded.
    pub fn number(self, bytes: &[u8], big: bool) -> f64 {
        macro_rules! of {
            ($type:ty) => {{
                let word = word(bytes);
                if big { <$type>::from_be_bytes(word) } else { <$type>::from_le_bytes(word) }
            }};
        }
        match self {
            Self::I8 => f64::from(of!(i8)),
            Self::U8 => f64::from(of!(u8)),
            Self::I16 => f64::from(of!(i16)),
            Self::U16 => f64::from(of!(u16)),
            Self::I32 => f64::from(of!(i32)),
            Self::U32 => f64::from(of!(u32)),
            Self::I64 => of!(i64) as f64,
            Self::U64 => of!(u64) as f64,
            Self::F32 => f64::from(of!(f32)),
            Self::F64 => of!(f64),
        }
    }
}

/// The first bytes of some; zeros where there are none.
fn word<const N: usize>(bytes: &[u8]) -> [u8; N] {
    bytes.get(..N).and_then(|part| part.try_into().ok()).unwrap_or([0; N])
}

/// All bytes of a file: as many as are read, not as many as its metadata states.
pub(super) fn bytes_of(path: &Input<'_>) -> Result<Vec<u8>, Error> {
    let (mut file, _) = path.open()?;
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes).map_err(|error| input(path, error.to_string()))?;
    Ok(bytes)
}

/// A finite number as an f32.
///
/// # Errors
/// It is beyond the range of f32.
pub(super) fn single(number: f64) -> std::io::Result<f32> {
    #[expect(clippy::cast_possible_truncation, reason = "single precision was asked for")]
    let narrow = number as f32;
    if number.is_finite() && !narrow.is_finite() {
        return Err(std::io::Error::other(format!(
            "{number:?} does not fit single precision, which ends at {:?}: choose other units",
            f32::MAX
        )));
    }
    Ok(narrow)
}
