//! From light to pixels: balls, lights, trails, bloom and the sky behind them.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::super::Exposure;
use super::super::frame::{Frame, SHRINK, middle, whole};
use super::super::light::LAMP;
use super::Canvas;

/// Between the lamp and the eye.
const HALFWAY: DVec3 = DVec3::new(-0.265_035, 0.331_294, 0.905_537);

const SLATE: DVec3 = DVec3::new(0.26, 0.31, 0.47);
const ROSE: DVec3 = DVec3::new(0.76, 0.55, 0.58);
const AMBER: DVec3 = DVec3::new(0.94, 0.68, 0.46);
const SUN: DVec3 = DVec3::new(0.10, 0.09, 0.01);
const ZENITH: DVec3 = DVec3::new(0.60, 0.72, 0.86);
const HAZE: DVec3 = DVec3::new(0.93, 0.94, 0.95);
const SEA: [DVec3; 2] = [DVec3::new(0.06, 0.31, 0.36), DVec3::new(0.015, 0.12, 0.20)];
const NIGHT: [DVec3; 2] = [DVec3::new(0.036, 0.043, 0.072), DVec3::new(0.008, 0.009, 0.018)];

/// The sky at a place in the picture.
pub fn background(frame: &Frame, place: DVec2) -> DVec3 {
    let part = place / frame.size();
    if frame.sky > 3.0 {
        return DVec3::ONE;
    }
    if frame.sky > 2.0 {
        return SEA[0].lerp(SEA[1], smoothstep(0.0, 0.5, (part - 0.5).length_squared()));
    }
    if frame.ink == 0.0 {
        let off = (part - 0.5).length_squared();
        return frame.sky * NIGHT[0].lerp(NIGHT[1], (2.0 * off).clamp(0.0, 1.0));
    }
    if frame.sky > 1.0 {
        return ZENITH.lerp(HAZE, smoothstep(0.0, 0.8, part.y));
    }
    let air = SLATE.lerp(ROSE, smoothstep(0.0, 0.7, part.y)).lerp(AMBER, smoothstep(0.5, 1.0, part.y));
    let off = (place - frame.size() * DVec2::new(0.62, 1.04)) / (0.42 * frame.size().y);
    air + SUN * (-off.length_squared()).exp2()
}

pub fn smoothstep(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

impl Canvas<'_> {
    /// Red, green and blue of each pixel, as bytes before they are cut off.
    pub fn tones(&self, exposure: Exposure) -> Vec<DVec3> {
        let frame = &self.frame;
        let bloom = if frame.bloom > 0.0 { self.bloom(exposure) } else { Vec::new() };
        let pixel = |i: u32| {
            let place = middle(i % frame.width, i / frame.width);
            let light = if bloom.is_empty() { DVec3::ZERO } else { frame.bloom * between(frame, &bloom, place) };
            let behind = self.behind[i as usize];
            let under = background(frame, place).lerp(behind.truncate(), behind.w);
            let c = screen(self.shaded(i, under, exposure), light / (1.0 + light));
            c.clamp(DVec3::ZERO, DVec3::ONE) * 255.0 + noise(i)
        };
        (0..frame.area()).into_par_iter().map(pixel).collect()
    }
    /// A pixel without bloom, in front of a background.
    fn shaded(&self, i: u32, under: DVec3, exposure: Exposure) -> DVec3 {
        let (frame, at) = (&self.frame, i as usize);
        let mut c = under;
        if let Some((id, disc)) = self.ball[at].and_then(|id| Some((id, self.discs[id]?))) {
            let place = middle(i % frame.width, i / frame.width);
            c = ball(c, self.color[id], (place - disc.place) / disc.radius, disc.radius);
        }
        let light = self.light[at];
        let brightest = light.max_element();
        if brightest > 0.0 {
            let toned = exposure.slope() * (1.0 + brightest / exposure.knee).log2();
            c = if frame.ink > 0.0 {
                c.lerp(light * (frame.tint / brightest), frame.ink * (exposure.body(frame) * toned).min(1.0))
            } else {
                let bleach = (toned - 0.55).clamp(0.0, frame.bleach);
                screen(c, (light * (toned / brightest)).lerp(DVec3::splat(toned), bleach).min(DVec3::ONE))
            };
        }
        let (bright, id) = self.trail[at];
        if bright > 0.0 {
            let trail = self.color[id];
            c = if frame.ink > 0.0 {
                c.lerp(frame.tint * trail, frame.ink * bright)
            } else {
                screen(c, trail * bright)
            };
        }
        c.clamp(DVec3::ZERO, DVec3::ONE)
    }
    /// The picture at a quarter of its size, blurred along rows and columns.
    fn bloom(&self, exposure: Exposure) -> Vec<DVec3> {
        let (columns, rows) = self.frame.shrunk();
        let block = |i: u32| {
            let (left, top) = (i % columns * SHRINK, i / columns * SHRINK);
            let mut sum = DVec3::ZERO;
            for y in top..(top + SHRINK).min(self.frame.height) {
                for x in left..(left + SHRINK).min(self.frame.width) {
                    sum += self.shaded(y * self.frame.width + x, DVec3::ZERO, exposure);
                }
            }
            sum / f64::from(SHRINK * SHRINK)
        };
        let small: Vec<DVec3> = (0..columns * rows).into_par_iter().map(block).collect();
        let (columns, rows) = (columns as usize, rows as usize);
        let blurred = blur(&small, self.frame.reach, columns, 1, |at| at % columns);
        blur(&blurred, self.frame.reach, rows, columns, |at| at / columns)
    }
}

/// A ball under a lamp; `d` is from its middle, in radii.
fn ball(under: DVec3, color: DVec3, d: DVec2, radius: f64) -> DVec3 {
    let rho = d.length_squared();
    let normal = DVec3::new(d.x, -d.y, (1.0 - rho).max(0.0).sqrt());
    let shade = color * (0.16 + 0.84 * normal.dot(LAMP).max(0.0)) + 0.35 * normal.dot(HALFWAY).max(0.0).powi(32);
    under.lerp(shade, (radius + 0.5 - radius * rho.sqrt()).clamp(0.0, 1.0))
}

/// Two lights on one pixel never pass white.
fn screen(a: DVec3, b: DVec3) -> DVec3 {
    a + b - a * b
}

/// Along a line of `len` that an element's neighbours are `stride` away in; `place` says where in its line it is.
fn blur(light: &[DVec3], reach: u32, len: usize, stride: usize, place: impl Fn(usize) -> usize + Sync) -> Vec<DVec3> {
    let weight = |k: u32| (1.0 - (f64::from(k) / f64::from(reach + 1)).powi(2)).powi(4);
    let weights: Vec<f64> = (0..=reach).map(weight).collect();
    let total = 2.0 * weights.iter().sum::<f64>() - weights[0];
    let one = |at: usize| {
        let mut sum = weights[0] * light[at];
        for (k, weight) in weights.iter().enumerate().skip(1) {
            // Beyond the edge it is dark.
            if place(at) >= k {
                sum += *weight * light[at - k * stride];
            }
            if place(at) + k < len {
                sum += *weight * light[at + k * stride];
            }
        }
        sum / total
    };
    (0..light.len()).into_par_iter().map(one).collect()
}

/// Between four pixels of the bloom.
fn between(frame: &Frame, bloom: &[DVec3], place: DVec2) -> DVec3 {
    let (columns, rows) = frame.shrunk();
    let q = place / f64::from(SHRINK) - 0.5;
    let (low, part) = (q.floor(), q - q.floor());
    let near = |dx: f64, dy: f64| {
        let x = whole((low.x + dx).clamp(0.0, f64::from(columns - 1)));
        let y = whole((low.y + dy).clamp(0.0, f64::from(rows - 1)));
        bloom[(y * columns + x) as usize]
    };
    near(0.0, 0.0).lerp(near(1.0, 0.0), part.x).lerp(near(0.0, 1.0).lerp(near(1.0, 1.0), part.x), part.y)
}

/// A number in [0, 1) instead of bands (Wellons 2018).
fn noise(n: u32) -> f64 {
    let mut h = n;
    h = (h ^ (h >> 16)).wrapping_mul(0x7feb_352d);
    h = (h ^ (h >> 15)).wrapping_mul(0x846c_a68b);
    f64::from((h ^ (h >> 16)) >> 8) / 16_777_216.0
}
