//! Hilbert's curve through a cube of 2²¹ cells each way (J. Skilling, Programming the Hilbert curve, AIP Conf. Proc. 707,
//! 381, 2004).

/// Bits of a cell along each axis.
pub(super) const BITS: u32 = 21;
/// Bits of a key's lower word.
pub(super) const LOWER: u32 = 31;
/// And of its upper word.
pub(super) const UPPER: u32 = 3 * BITS - LOWER;

/// A cell's index along the curve. Each coordinate of the cell is below 2²¹.
#[must_use]
pub fn hilbert(cell: [u32; 3]) -> u64 {
    let mut x = cell;
    for level in (1..BITS).rev() {
        let (bit, below) = (1 << level, (1 << level) - 1);
        for axis in 0..3 {
            if x[axis] & bit != 0 {
                x[0] ^= below;
            } else {
                let exchange = (x[0] ^ x[axis]) & below;
                x[0] ^= exchange;
                x[axis] ^= exchange;
            }
        }
    }
    x[1] ^= x[0];
    x[2] ^= x[1];
    let odd = (1..BITS).filter(|level| x[2] & 1 << level != 0).fold(0, |odd, level| odd ^ ((1 << level) - 1));
    let bits = (0..BITS).rev().flat_map(|level| x.map(|x| (x ^ odd) >> level & 1));
    bits.fold(0, |key, bit| key << 1 | u64::from(bit))
}
