//! The finished picture.

use glam::DVec3;
use rayon::prelude::*;

use super::frame::{Frame, HALO, PIXELS, SCENERY, WET, middle, unpack, whole};
use super::halo::between;
use super::look::{Look, expose, screen};
use super::meter::Exposure;
use super::palette::pack;
use super::sky::background;
use crate::error::Error;
use crate::kernel::{Host, Kernel, Threads};

/// The kernel.
pub fn kernel(frame: &Frame, exposure: Exposure) -> Result<Kernel, Error> {
    let files =
        [crate::shader!("render/look.wgsl"), crate::shader!("render/sky.wgsl"), crate::shader!("render/tone.wgsl")];
    let mut pass = frame.pass(&files, Threads::new(frame.area()), 8)?;
    expose(&mut pass, frame, exposure)?;
    if frame.water.is_there() {
        pass = pass.on(&[("scenery", WET.name.into())]);
    }
    let frame = *frame;
    let reference = move |host: &Host| {
        let (halo, scenery, mut pixels) =
            (host.read(HALO)?, host.read(if frame.water.is_there() { WET } else { SCENERY })?, host.write(PIXELS)?);
        let (halo, scenery, pixels): (&[_], &[u32], &mut [_]) = (&halo, &scenery, &mut pixels);
        Look::at(host, &frame, exposure, |look| {
            pixels.par_iter_mut().zip(0..frame.area()).for_each(|(pixel, i)| {
                let (x, y) = (i % frame.width, i / frame.width);
                let light = frame.bloom * between(&frame, halo, x, y);
                let behind = scenery[i as usize];
                let under = background(&frame, middle(x, y)).lerp(unpack(behind), f64::from(behind >> 24) / 255.0);
                let c = screen(look.pixel(x, y, under), light / (1.0 + light)).clamp(DVec3::ZERO, DVec3::ONE);
                let bytes = c * 255.0 + noise(i);
                *pixel = pack(bytes.to_array().map(|x| u8::try_from(whole(x)).unwrap_or(u8::MAX)));
            });
        })
    };
    Ok(frame.kernel("tone", vec![pass], reference))
}

/// A number in [0, 1).
fn noise(n: u32) -> f64 {
    let mut h = n;
    h = (h ^ (h >> 16)).wrapping_mul(0x7feb_352d);
    h = (h ^ (h >> 15)).wrapping_mul(0x846c_a68b);
    f64::from((h ^ (h >> 16)) >> 8) / 16_777_216.0
}
