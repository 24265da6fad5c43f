//! The exposure of a picture.

use super::frame::{BINS, Frame};

/// Eight bins for each doubling.
pub fn bin(light: u32) -> usize {
    let octave = light.ilog2();
    let eighth = if octave >= 3 { light >> (octave - 3) } else { light << (3 - octave) } & 7;
    (8 * octave + eighth) as usize
}

/// The brightness in the middle of a bin.
fn brightness(bin: usize) -> f64 {
    let (octave, eighth) = (u32::try_from(bin / 8).unwrap_or(31), u32::try_from(bin % 8).unwrap_or(7));
    f64::from(octave).exp2() * (1.0 + (f64::from(eighth) + 0.5) / 8.0)
}

/// The tone mapping, in canvas units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exposure {
    /// The value at which the scale turns from linear to logarithmic.
    pub knee: f64,
    /// The value of white.
    pub white: f64,
}

impl Exposure {
    /// From a histogram: almost everything is below white, and most of what is lit above the knee.
    #[must_use]
    pub fn of(histogram: &[u32], frame: &Frame, exposure: f64) -> Self {
        let lit: u64 = histogram.iter().take(BINS).map(|n| u64::from(*n)).sum();
        let quantile = |part: f64| {
            let mut below = 0;
            let found = histogram.iter().position(|n| {
                below += u64::from(*n);
                #[expect(clippy::cast_precision_loss, reason = "pixels")]
                let enough = below as f64 >= part * lit as f64;
                enough
            });
            brightness(found.unwrap_or(0))
        };
        // A single light is never lost, and never white: the bloom has yet to be added.
        let (white, middle) = if lit == 0 { (frame.unit, frame.unit) } else { (quantile(0.998), quantile(0.5)) };
        let white = white.max(frame.unit) * 1.4;
        let knee = (middle / 2.5).min(0.5 * frame.unit);
        Self { knee: knee.max(1e-3 * white) / exposure, white: white / exposure }
    }
    /// Part of the way to another exposure, in f-stops: 0 is this one, 1 the other.
    #[must_use]
    pub fn toward(self, other: Self, part: f64) -> Self {
        let between = |a: f64, b: f64| a.powf(1.0 - part) * b.powf(part);
        Self { knee: between(self.knee, other.knee), white: between(self.white, other.white) }
    }
    /// By how much another exposure is brighter or darker \[f-stops\].
    #[must_use]
    pub fn stops_from(self, other: Self) -> f64 {
        (self.white / other.white).log2().abs().max((self.knee / other.knee).log2().abs())
    }
    /// How much darker ink is than light would be light. Where birds are alone each is to be seen; where many are on one pixel, how
    /// many.
    pub(super) fn body(&self, frame: &Frame) -> f64 {
        1.0 + 0.7 * frame.unit / self.white
    }
    /// 1 / log₂(1 + white / knee)
    #[must_use]
    pub fn slope(&self) -> f64 {
        (1.0 + self.white / self.knee).log2().recip()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bins_are_in_order_and_none_is_left_out() {
        let mut last = 0;
        for light in (1..100_000).chain([u32::MAX / 3, u32::MAX]) {
            let bin = bin(light);
            assert!(bin >= last && bin < BINS);
            assert!((brightness(bin) / f64::from(light)).ln().abs() < 0.5, "{light}");
            last = bin;
        }
    }
}
