//! The mass along the line of sight: what a telescope, or a plot of a simulation of matter, shows. Each particle is smoothed over the
//! radius of a light.

use glam::{DVec3, DVec4};

use super::{Canvas, Style, Subject};
use crate::error::Error;
use crate::kernel::{Plan, Threads};
use crate::render::frame::whole;
use crate::render::palette::along;
use crate::render::{Exposure, Picture, passes};

/// `density`
pub struct Density;

impl Style for Density {
    /// A dozen particles and more share a pixel where they are spread evenly: less is noise.
    fn glow(&self, of: &Subject) -> f64 {
        (2.5 * of.apart).clamp(2.0, (of.short / 40.0).max(2.0))
    }
    fn unused(&self) -> &'static [&'static str] {
        &["background", "color", "tail", "size", "drop", "clarity", "foam"]
    }
    fn has_trails(&self) -> bool {
        false
    }
    fn light(&self, picture: &Picture, plan: &mut Plan) -> Result<(), Error> {
        let frame = &picture.frame;
        let across = u64::from(whole(2.0 * frame.glow)) + 2;
        plan.add(frame.simple("density", &[crate::shader!("render/density.wgsl")], frame.count, across * across)?);
        plan.add(passes::histogram(frame)?);
        Ok(())
    }
    fn develop(&self, picture: &Picture, exposure: Exposure, plan: &mut Plan) -> Result<(), Error> {
        let frame = &picture.frame;
        let mut pass =
            frame.pass(&[crate::shader!("render/density_scale.wgsl")], Threads::new(frame.area()), 4)?;
        passes::expose(&mut pass, frame, exposure)?;
        plan.add(frame.kernel("density scale", vec![pass]));
        Ok(())
    }
    fn plain(&self, canvas: &mut Canvas) {
        let mean = canvas.frame.mean;
        // Where nothing has mass, particles are counted.
        let part = |mass: f64| 0.5 * canvas.frame.unit * if mean > 0.0 { mass / mean } else { 1.0 };
        let lights: Vec<_> = canvas.lights().map(|(mass, disc)| (part(mass), disc.place)).collect();
        for (light, place) in lights {
            for (at, q) in canvas.about(place) {
                canvas.light[at].x += light * q * q;
            }
        }
    }
    fn plain_pixels(&self, canvas: &Canvas, exposure: Exposure) -> Vec<DVec3> {
        let pixel = |(light, behind): (&DVec3, &DVec4)| {
            let t = (exposure.slope() * (1.0 + light.x / exposure.knee).log2()).min(1.0);
            let under = COLORS[0].lerp(behind.truncate(), behind.w);
            under.lerp(along(&COLORS, t), (4.0 * t).min(1.0)) * 255.0 + 0.5
        };
        canvas.light.iter().zip(&canvas.behind).map(pixel).collect()
    }
}

/// The colours of the scale, evenly spaced; lightness grows along it.
const COLORS: [DVec3; 6] = [
    DVec3::new(0.01, 0.01, 0.03),
    DVec3::new(0.13, 0.06, 0.31),
    DVec3::new(0.43, 0.09, 0.43),
    DVec3::new(0.78, 0.22, 0.32),
    DVec3::new(0.97, 0.55, 0.16),
    DVec3::new(0.99, 0.95, 0.7),
];
