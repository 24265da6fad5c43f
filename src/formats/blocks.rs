//! Arrays of VTK's files that are compressed: counts of blocks and their bytes, then blocks of zlib (RFC 1950). Format: the VTK file
//! formats page, "Compressed Data".

use std::io::{self, Read, Write};

use flate2::Compression;
use flate2::read::ZlibDecoder;
use flate2::write::ZlibEncoder;

use super::binary::Type;
use super::tags::base64;

/// The name of the compressor in a file.
pub(super) const ZLIB: &str = "vtkZLibDataCompressor";
/// Bytes of a block before it is compressed.
const BLOCK: usize = 1 << 20;
/// The effort of deflate, from 1 to 9.
const EFFORT: u32 = 4;
/// The maximum ratio of deflate: 258 bytes from 2 bits.
const DEFLATED: usize = 1032;

/// Compresses the bytes of an array; counts have 64 bits.
pub(super) fn packed(bytes: &[u8]) -> io::Result<Vec<u8>> {
    let mut blocks = Vec::new();
    let mut counts = vec![bytes.len().div_ceil(BLOCK) as u64, BLOCK as u64, (bytes.len() % BLOCK) as u64];
    for block in bytes.chunks(BLOCK) {
        let before = blocks.len();
        let mut encoder = ZlibEncoder::new(&mut blocks, Compression::new(EFFORT));
        encoder.write_all(block)?;
        encoder.finish()?;
        counts.push((blocks.len() - before) as u64);
    }
    Ok(counts.into_iter().flat_map(u64::to_le_bytes).chain(blocks).collect())
}

/// The type of a file's counts, and whether the data is in base 64: counts and blocks are then encoded separately.
#[derive(Clone, Copy)]
pub(super) struct Coding {
    pub counts: Type,
    pub big: bool,
    pub encoded: bool,
}

impl Coding {
    /// `bytes` bytes of a part, decoded, and the text after the part.
    fn take(self, from: &[u8], bytes: usize) -> Option<(Vec<u8>, &[u8])> {
        if !self.encoded {
            return Some((from.get(..bytes)?.to_vec(), &from[bytes..]));
        }
        let letters = bytes.div_ceil(3).checked_mul(4)?;
        let part = base64(from.get(..letters)?)?;
        Some((part.get(..bytes)?.to_vec(), &from[letters..]))
    }
    /// The array of `needed` bytes at the start of some bytes.
    ///
    /// # Errors
    /// Counts that do not agree with the array or the available bytes; a damaged block.
    pub fn unpacked(self, from: &[u8], needed: usize) -> Result<Vec<u8>, String> {
        let from = if self.encoded { from.trim_ascii_start() } else { from };
        let width = self.counts.width();
        let cut = || "is cut within the counts of its blocks".to_owned();
        let counts = |bytes: &[u8]| -> Vec<u64> { bytes.chunks_exact(width).map(|word| self.count(word)).collect() };
        let (head, _) = self.take(from, 3 * width).ok_or_else(cut)?;
        let head = counts(&head);
        let (blocks, full, last) = (head[0], head[1], head[2]);
        // A partial block is counted among the blocks.
        let announced = match (blocks, last) {
            (0, _) => Some(0),
            (_, 0) => blocks.checked_mul(full),
            _ => (blocks - 1).checked_mul(full).and_then(|sum| sum.checked_add(last)),
        };
        if announced != Some(needed as u64) || needed / DEFLATED > from.len() {
            return Err(format!(
                "announces {blocks} blocks of {full} bytes and a last one of {last}, and needs {needed} bytes"
            ));
        }
        let words = usize::try_from(blocks).ok().and_then(|blocks| blocks.checked_add(3)?.checked_mul(width));
        let words = words.filter(|bytes| *bytes <= from.len()).ok_or_else(cut)?;
        let (head, rest) = self.take(from, words).ok_or_else(cut)?;
        let sizes = counts(&head[3 * width..]);
        let sum = sizes.iter().try_fold(0_u64, |sum, size| sum.checked_add(*size));
        let sum = sum.and_then(|sum| usize::try_from(sum).ok()).filter(|sum| *sum <= rest.len());
        let (mut rest, _) =
            sum.and_then(|sum| self.take(rest, sum)).ok_or_else(|| "is cut within its blocks".to_owned())?;
        let mut out = Vec::with_capacity(needed);
        for (number, size) in sizes.iter().enumerate() {
            #[expect(clippy::cast_possible_truncation, reason = "not above the length of the file")]
            let behind = rest.split_off(*size as usize);
            let wanted = if number + 1 == sizes.len() { needed as u64 - out.len() as u64 } else { full };
            let before = out.len() as u64;
            // One more byte, so that a longer block is detected.
            let read = ZlibDecoder::new(&rest[..]).take(wanted.saturating_add(1)).read_to_end(&mut out);
            read.map_err(|why| format!("has a damaged block {number} ({why})"))?;
            let there = out.len() as u64 - before;
            if there != wanted {
                return Err(format!("has a block {number} of {there} bytes or more, not {wanted}"));
            }
            rest = behind;
        }
        Ok(out)
    }
    /// A count, exactly.
    fn count(self, word: &[u8]) -> u64 {
        let digit = |sum: u64, byte: &u8| sum << 8 | u64::from(*byte);
        if self.big { word.iter().fold(0, digit) } else { word.iter().rev().fold(0, digit) }
    }
}
