//! From light to looks: what is in a pixel, without its halo.

use glam::{DVec2, DVec3, DVec4};

use super::Exposure;
use super::frame::{CANVAS, COLOR, Frame, NONE, OWNER, PROJECTED, STREAK, middle, unpack};
use crate::error::Error;
use crate::kernel::{Host, Pass, Scalar};

const TINT: f64 = 0.13;
const LAMP: DVec3 = DVec3::new(-0.48, 0.6, 0.64);
const HALFWAY: DVec3 = DVec3::new(-0.265_035, 0.331_294, 0.905_537);

/// Fills the uniform block of `shaders/render/look.wgsl`.
pub fn expose(pass: &mut Pass, frame: &Frame, exposure: Exposure) -> Result<(), Error> {
    if let Some(binding) = pass.shader.reflection().binding("exposure") {
        let values = [("knee", exposure.knee), ("slope", exposure.slope()), ("body", body(frame, exposure))];
        let values = values.map(|(name, x)| (name, Scalar::Float(x)));
        pass.uniforms.push(("exposure", binding.packed.pack("exposure", &values)?));
    }
    Ok(())
}

/// How much darker ink is than light would be light. Where birds are alone each is to be seen; where many are on one pixel,
/// how many.
fn body(frame: &Frame, exposure: Exposure) -> f64 {
    1.0 + 0.7 * frame.unit / exposure.white
}

/// The fields that are looked at.
pub struct Look<'a> {
    frame: Frame,
    exposure: Exposure,
    projected: &'a [DVec4],
    color: &'a [u32],
    canvas: &'a [u32],
    owner: &'a [u32],
    streak: &'a [u32],
}

impl Look<'_> {
    /// Opens the fields of a host for as long as `run` takes.
    pub fn at<T>(host: &Host, frame: &Frame, exposure: Exposure, run: impl FnOnce(&Look) -> T) -> Result<T, Error> {
        let (projected, color, canvas) = (host.read(PROJECTED)?, host.read(COLOR)?, host.read(CANVAS)?);
        let (owner, streak) = (host.read(OWNER)?, host.read(STREAK)?);
        Ok(run(&Look {
            frame: *frame,
            exposure,
            projected: &projected,
            color: &color,
            canvas: &canvas,
            owner: &owner,
            streak: &streak,
        }))
    }
    /// A pixel in front of a background.
    pub fn pixel(&self, x: u32, y: u32, under: DVec3) -> DVec3 {
        let at = self.frame.pixel(x, y);
        let mut c = under;
        let owner = self.owner[at];
        if owner != NONE {
            let (p, color) = (self.projected[owner as usize], unpack(self.color[owner as usize]));
            c = ball(c, color, (middle(x, y) - p.truncate().truncate()) / p.w, p.w);
        }
        let light = DVec3::from_array([0, 1, 2].map(|k| f64::from(self.canvas[3 * at + k])));
        c = if self.frame.ink > 0.0 { self.ink(c, light) } else { screen(c, self.glow(light)) };
        let streak = self.streak[at];
        if streak != 0 {
            let trail = unpack(self.color[(streak & 0xffff) as usize]);
            let bright = f64::from(streak >> 16) / 65535.0;
            let ink = self.frame.ink;
            c = if ink > 0.0 { c.lerp(TINT * trail, ink * bright) } else { screen(c, trail * bright) };
        }
        c.clamp(DVec3::ZERO, DVec3::ONE)
    }
    /// A brightness on the canvas, as one on the screen.
    fn toned(&self, brightest: f64) -> f64 {
        self.exposure.slope() * (1.0 + brightest / self.exposure.knee).log2()
    }
    fn glow(&self, light: DVec3) -> DVec3 {
        let brightest = light.max_element();
        if brightest <= 0.0 {
            return DVec3::ZERO;
        }
        let t = self.toned(brightest);
        let bleach = (t - 0.55).clamp(0.0, self.frame.bleach);
        (light * (t / brightest)).lerp(DVec3::splat(t), bleach).min(DVec3::ONE)
    }
    fn ink(&self, under: DVec3, light: DVec3) -> DVec3 {
        let brightest = light.max_element();
        if brightest <= 0.0 {
            return under;
        }
        under.lerp(
            light * (TINT / brightest),
            self.frame.ink * (body(&self.frame, self.exposure) * self.toned(brightest)).min(1.0),
        )
    }
}

fn ball(under: DVec3, color: DVec3, d: DVec2, radius: f64) -> DVec3 {
    let rho = d.length_squared();
    let normal = DVec3::new(d.x, -d.y, (1.0 - rho).max(0.0).sqrt());
    let lit = normal.dot(LAMP).max(0.0);
    let shine = normal.dot(HALFWAY).max(0.0).powi(32);
    let shade = color * (0.16 + 0.84 * lit) + 0.35 * shine;
    under.lerp(shade, (radius + 0.5 - radius * rho.sqrt()).clamp(0.0, 1.0))
}

/// Two lights on one pixel never pass white.
pub fn screen(a: DVec3, b: DVec3) -> DVec3 {
    a + b - a * b
}
