//! How far a device may be from a reference.

use glam::DVec4;
use motes::kernel::Array;

/// Of a place or a depth, as a part of it: 2⁻²⁴ for each of the about ten operations that lead to it, and as much again
/// for roots and divisions.
const PART: f64 = 2e-5;
/// Elements for which a rounded number may have decided otherwise, beside one in some hundreds.
const FEW: usize = 2;

/// Whether a device's field is as the reference's.
pub fn alike(kernel: &str, name: &str, want: &Array, got: &Array) -> bool {
    match (want, got) {
        (Array::Vec4(want), Array::Vec4(got)) => want.len() == got.len() && want.iter().zip(got).all(near),
        // Depths and thicknesses of a fluid: where the reach is a whole number, or a depth at the end of the range, a last place
        // may decide.
        (Array::Float(want), Array::Float(got)) => {
            let near = |(w, g): &(&f64, &f64)| (*w - *g).abs() <= PART * (1.0 + w.abs());
            let off = want.iter().zip(got).filter(|pair| !near(pair)).count();
            want.len() == got.len() && off <= FEW + want.len() / 500
        }
        (Array::Uint(want), Array::Uint(got)) => want.len() == got.len() && counts(kernel, name, want, got),
        _ => false,
    }
}

fn near((want, got): (&DVec4, &DVec4)) -> bool {
    let within = |k: usize| (want[k] - got[k]).abs() <= PART * (1.0 + want[k].abs());
    (0..4).all(within)
}

fn counts(kernel: &str, name: &str, want: &[u32], got: &[u32]) -> bool {
    let pairs = || want.iter().zip(got).map(|(w, g)| (*w, *g));
    let differ = pairs().filter(|(w, g)| w != g).count();
    match name {
        // A place is known to 1e-5 pixels, which moves a light of 256 units, or of 4096, by some hundredths of one at most.
        "canvas" => pairs().all(|(w, g)| w.abs_diff(g) <= 1) && differ <= FEW + want.len() / 500,
        // A level is 2⁸ times as coarse as what is known of a colour, which decides one in some hundreds.
        "color" | "pixels" => {
            let level =
                |(w, g): (u32, u32)| w.to_le_bytes().iter().zip(g.to_le_bytes()).all(|(w, g)| w.abs_diff(g) <= 1);
            pairs().all(level) && differ <= FEW + want.len() / 1000
        }
        // Brightness in 65 535 parts, of a distance that is known to 1e-5 pixels and a few more.
        "streak" => {
            let same = |(w, g): (u32, u32)| w & 0xffff == g & 0xffff && (w >> 16).abs_diff(g >> 16) <= 8;
            pairs().all(same)
        }
        // A depth is known to some tens of its last places, but for samples at an edge, which may belong to another facet.
        "nearest" | "lit" => pairs().filter(|(w, g)| w.abs_diff(*g) > 512).count() <= FEW + want.len() / 1000,
        "front" if kernel == "shade" => pairs().filter(|(w, g)| w.abs_diff(*g) > 512).count() <= FEW,
        "holder" => differ <= FEW + want.len() / 1000,
        // A level, but where a sample is of another facet, or on the rim of a shadow.
        "scenery" => {
            let far = |(w, g): &(u32, u32)| w.to_le_bytes().iter().zip(g.to_le_bytes()).any(|(w, g)| w.abs_diff(g) > 1);
            pairs().filter(far).count() <= FEW + want.len() / 500 && differ <= FEW + want.len() / 100
        }
        // A byte of a mean, rounded six times.
        "dye" => {
            let far = |(w, g): &(u32, u32)| w.to_le_bytes().iter().zip(g.to_le_bytes()).any(|(w, g)| w.abs_diff(g) > 1);
            pairs().filter(far).count() <= FEW && differ <= FEW + want.len() / 50
        }
        "crest" => pairs().all(|(w, g)| w.abs_diff(g) <= 512),
        // Each drop that there is gives a unit more or less.
        "volume" | "rim" => pairs().all(|(w, g)| w.abs_diff(g) <= 1) && differ <= FEW + want.len() / 500,
        "source" => differ <= FEW,
        "wet" => {
            let far = |(w, g): &(u32, u32)| w.to_le_bytes().iter().zip(g.to_le_bytes()).any(|(w, g)| w.abs_diff(g) > 1);
            pairs().filter(far).count() <= FEW && differ <= FEW + want.len() / 200
        }
        _ => differ == 0,
    }
}
