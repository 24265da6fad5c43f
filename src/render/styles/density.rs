//! The mass along the line of sight: what a telescope, or a plot of a simulation of matter, shows. Each particle is smoothed over the
//! radius of a light.

use glam::DVec3;
use rayon::prelude::*;

use super::{Style, Subject};
use crate::error::Error;
use crate::kernel::{Host, Kernel, POSITION, Plan, Scalar, Threads};
use crate::render::frame::{CANVAS, Frame, PIXELS, PROJECTED, SCENERY, middle, unpack, whole};
use crate::render::palette::pack;
use crate::render::{Exposure, Picture, meter};

/// `density`
pub struct Density;

impl Style for Density {
    /// A dozen particles and more share a pixel where they are spread evenly: less is noise.
    fn glow(&self, of: &Subject) -> f64 {
        (2.5 * of.apart).clamp(2.0, (of.short / 40.0).max(2.0))
    }
    fn unused(&self) -> &'static [&'static str] {
        &["background", "color", "tail", "drop", "clarity", "foam"]
    }
    fn has_trails(&self) -> bool {
        false
    }
    fn light(&self, picture: &Picture, plan: &mut Plan) -> Result<(), Error> {
        plan.add(projected(&picture.frame)?);
        plan.add(meter::kernel(&picture.frame)?);
        Ok(())
    }
    fn develop(&self, picture: &Picture, exposure: Exposure, plan: &mut Plan) -> Result<(), Error> {
        plan.add(ramp(&picture.frame, exposure)?);
        Ok(())
    }
}

/// How many times the light of the mean mass a particle is; where nothing has mass, particles are counted.
fn part(frame: &Frame, mass: f64) -> f64 {
    if frame.mean > 0.0 { mass / frame.mean } else { 1.0 }
}

fn projected(frame: &Frame) -> Result<Kernel, Error> {
    let across = u64::from(whole(2.0 * frame.glow)) + 2;
    let pass = frame.pass(&[crate::shader!("render/density.wgsl")], Threads::new(frame.count), across * across)?;
    let frame = *frame;
    let reference = move |host: &Host| {
        let (position, seen) = (host.read(POSITION)?, host.read(PROJECTED)?);
        let mut canvas = host.write(CANVAS)?;
        for (x, p) in position.iter().zip(seen.iter()).filter(|(_, p)| p.w == 0.0) {
            let (place, light) = (p.truncate().truncate(), 0.5 * frame.unit * part(&frame, x.w));
            let (columns, rows) = frame.touched(place - frame.glow, place + frame.glow);
            for (x, y) in rows.flat_map(|y| columns.clone().map(move |x| (x, y))) {
                let q = 1.0 - ((middle(x, y) - place) / frame.glow).length_squared();
                if q > 0.0 {
                    canvas[3 * frame.pixel(x, y)] += whole(light * q * q + 0.5);
                }
            }
        }
        Ok(())
    };
    Ok(frame.kernel("density", vec![pass], reference))
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

fn ramp(frame: &Frame, exposure: Exposure) -> Result<Kernel, Error> {
    let mut pass = frame.pass(&[crate::shader!("render/density_scale.wgsl")], Threads::new(frame.area()), 4)?;
    if let Some(binding) = pass.shader.reflection().binding("exposure") {
        let values = [("knee", Scalar::Float(exposure.knee)), ("slope", Scalar::Float(exposure.slope()))];
        pass.uniforms.push(("exposure", binding.packed.pack("exposure", &values)?));
    }
    let frame = *frame;
    let reference = move |host: &Host| {
        let (canvas, scenery, mut pixels) = (host.read(CANVAS)?, host.read(SCENERY)?, host.write(PIXELS)?);
        let (canvas, scenery): (&[u32], &[u32]) = (&canvas, &scenery);
        pixels.par_iter_mut().zip(0..frame.area() as usize).for_each(|(pixel, i)| {
            let light = f64::from(canvas[3 * i]);
            let t = (exposure.slope() * (1.0 + light / exposure.knee).log2()).min(1.0);
            let behind = scenery[i];
            let under = COLORS[0].lerp(unpack(behind), f64::from(behind >> 24) / 255.0);
            let c = under.lerp(color(t), (4.0 * t).min(1.0));
            *pixel = pack((c * 255.0 + 0.5).to_array().map(|x| u8::try_from(whole(x)).unwrap_or(u8::MAX)));
        });
        Ok(())
    };
    Ok(frame.kernel("density scale", vec![pass], reference))
}

/// The colour at a part of the scale, from 0 to 1.
fn color(t: f64) -> DVec3 {
    let steps = COLORS.len() - 1;
    let place = t * steps as f64;
    let low = (whole(place) as usize).min(steps - 1);
    COLORS[low].lerp(COLORS[low + 1], place - low as f64)
}
