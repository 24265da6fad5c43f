//! Beeman's method (Beeman 1976): the positions are those of leapfrog, and the velocities, which use accelerations at three times, are one
//! order more accurate. x ← x + v dt + (4 a − a') dt² / 6, v ← v + (2 a(x) + 5 a − a') dt / 6, with a' of the previous step. A particle in
//! its first step has no a', and uses a instead, which is leapfrog.

use std::sync::Arc;

use super::{Integrator, Step};
use crate::error::Error;
use crate::kernel::{ACCELERATION, Column, Field, Host, Kernel, Kind, Shader, VELOCITY};

/// `beeman`
#[derive(Clone)]
pub struct Beeman;

/// The acceleration at the start of the previous step. xyz
const EARLIER: Field<glam::Vec4> = Field::new("earlier_acceleration");

impl Integrator for Beeman {
    fn name(&self) -> &'static str {
        "beeman"
    }
    fn order(&self) -> u32 {
        2
    }
    fn ends_with_forces(&self) -> bool {
        true
    }
    fn fixed_step(&self) -> Option<&'static str> {
        Some("beeman requires accelerations at three equally spaced times")
    }
    fn columns(&self) -> Vec<Column> {
        let about = "the acceleration at the start of the previous step, which Beeman's method uses";
        let has = "1 where there is such an acceleration, 0 before a particle's first step";
        vec![
            Column::new(EARLIER.name, Kind::Vector, "length / time²", about),
            Column::new("earlier_is_known", Kind::Scalar, "", has).within(EARLIER.name, 3),
        ]
    }
    fn start(&self, s: &mut Step) {
        s.evaluate();
    }
    fn step(&self, s: &mut Step) {
        s.kick_by(first(s.count()), 0.5);
        s.drift(1.0);
        s.at(1.0);
        s.evaluate();
        s.kick_by(last(s.count()), 0.5);
    }
}

/// v ← v + (4 a − a') dt / 6, a' ← a
fn first(count: u32) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("integrators/beeman_first.wgsl")])?;
    let reference = move |host: &Host| {
        let dt = host.world().dt;
        let (mut velocity, acceleration) = (host.write(VELOCITY)?, host.read(ACCELERATION)?);
        let mut earlier = host.write(EARLIER)?;
        for ((v, a), before) in velocity.iter_mut().zip(acceleration.iter()).zip(earlier.iter_mut()) {
            let a = a.truncate();
            let a_before = if before.w > 0.5 { before.truncate() } else { a };
            *v += ((4.0 * a - a_before) * (dt / 6.0)).extend(0.0);
            *before = a.extend(1.0);
        }
        Ok(())
    };
    Ok(Kernel::new("kick, Beeman's first", shader, Vec::new(), count, Arc::new(reference)).alone())
}

/// v ← v + (2 a + a') dt / 6
fn last(count: u32) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("integrators/beeman_last.wgsl")])?;
    let reference = move |host: &Host| {
        let dt = host.world().dt;
        let (mut velocity, acceleration) = (host.write(VELOCITY)?, host.read(ACCELERATION)?);
        let earlier = host.read(EARLIER)?;
        for ((v, a), before) in velocity.iter_mut().zip(acceleration.iter()).zip(earlier.iter()) {
            *v += ((2.0 * a.truncate() + before.truncate()) * (dt / 6.0)).extend(0.0);
        }
        Ok(())
    };
    Ok(Kernel::new("kick, Beeman's last", shader, Vec::new(), count, Arc::new(reference)).alone())
}
