//! From light to a picture.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::frame::{CANVAS, COLOR, Frame, NOBODY, OWNER, PIXELS, PROJECTED, STREAK, middle, unpack, whole};
use super::meter::Exposure;
use super::palette::pack;
use crate::error::Error;
use crate::kernel::{Host, Kernel, Scalar, Threads};

const LAMP: DVec3 = DVec3::new(-0.48, 0.6, 0.64);
const HALFWAY: DVec3 = DVec3::new(-0.265_035, 0.331_294, 0.905_537);

/// The kernel.
pub fn kernel(frame: &Frame, exposure: Exposure) -> Result<Kernel, Error> {
    let mut pass = frame.pass(&[crate::shader!("render/tone.wgsl")], Threads::new(frame.area()), 4)?;
    if let Some(binding) = pass.shader.reflection().binding("exposure") {
        let values = [("knee", Scalar::Float(exposure.knee)), ("slope", Scalar::Float(exposure.slope()))];
        pass.uniforms.push(("exposure", binding.packed.pack("exposure", &values)?));
    }
    let frame = *frame;
    let twin = move |host: &Host| {
        let (projected, color, canvas) = (host.read(PROJECTED)?, host.read(COLOR)?, host.read(CANVAS)?);
        let (owner, streak) = (host.read(OWNER)?, host.read(STREAK)?);
        // Opened once: the guards of a host are not for many threads.
        let (projected, color, canvas): (&[_], &[_], &[_]) = (&projected, &color, &canvas);
        let (owner, streak): (&[u32], &[u32]) = (&owner, &streak);
        host.write(PIXELS)?.par_iter_mut().enumerate().for_each(|(at, pixel)| {
            let index = u32::try_from(at).unwrap_or(0);
            let place = middle(index % frame.width, index / frame.width);
            let mut c = background(&frame, place);
            if owner[at] != NOBODY {
                let p = projected[owner[at] as usize];
                let d = (place - p.truncate().truncate()) / p.w;
                c = ball(c, unpack(color[owner[at] as usize]), d, p.w);
            }
            let light = DVec3::from_array([0, 1, 2].map(|k| f64::from(canvas[3 * at + k])));
            c = screen(c, glow(light, exposure));
            if streak[at] != 0 {
                c = screen(c, unpack(color[(streak[at] & 0xffff) as usize]) * (f64::from(streak[at] >> 16) / 65535.0));
            }
            let bytes = c.clamp(DVec3::ZERO, DVec3::ONE) * 255.0 + noise(index);
            let rgb = bytes.to_array().map(|x| u8::try_from(whole(x)).unwrap_or(u8::MAX));
            *pixel = pack(rgb);
        });
        Ok(())
    };
    Ok(frame.kernel("tone", vec![pass], std::sync::Arc::new(twin)))
}

fn background(frame: &Frame, place: DVec2) -> DVec3 {
    let off = place / frame.size() - 0.5;
    let (inner, outer) = (DVec3::new(0.036, 0.043, 0.072), DVec3::new(0.008, 0.009, 0.018));
    frame.sky * inner.lerp(outer, (2.0 * off.length_squared()).clamp(0.0, 1.0))
}

fn ball(under: DVec3, color: DVec3, d: DVec2, radius: f64) -> DVec3 {
    let rho = d.length_squared();
    let normal = DVec3::new(d.x, -d.y, (1.0 - rho).max(0.0).sqrt());
    let lit = normal.dot(LAMP).max(0.0);
    let shine = normal.dot(HALFWAY).max(0.0).powi(32);
    let shade = color * (0.16 + 0.84 * lit) + 0.35 * shine;
    under.lerp(shade, (radius + 0.5 - radius * rho.sqrt()).clamp(0.0, 1.0))
}

fn glow(light: DVec3, exposure: Exposure) -> DVec3 {
    let brightest = light.max_element();
    if brightest <= 0.0 {
        return DVec3::ZERO;
    }
    let t = exposure.slope() * (1.0 + brightest / exposure.knee).log2();
    let bleach = (t - 0.55).clamp(0.0, 0.6);
    (light * (t / brightest)).lerp(DVec3::splat(t), bleach).min(DVec3::ONE)
}

fn screen(a: DVec3, b: DVec3) -> DVec3 {
    a + b - a * b
}

/// A number in [0, 1).
fn noise(n: u32) -> f64 {
    let mut h = n;
    h = (h ^ (h >> 16)).wrapping_mul(0x7feb_352d);
    h = (h ^ (h >> 15)).wrapping_mul(0x846c_a68b);
    f64::from((h ^ (h >> 16)) >> 8) / 16_777_216.0
}
