//! Parts of a step, to which particles go from its start.

use std::sync::Arc;

use glam::{DVec3, DVec4, Vec4};

use super::polynomial::{NODES, integrals};
use super::{DIFFERENCES, STEP_CLOCK, sizes};
use crate::error::Error;
use crate::integrators::verbs::compensated;
use crate::kernel::{
    Field, Host, Kernel, POSITION, POSITION_LOW, Problem, Shader, Source, TICKS, VELOCITY, VELOCITY_LOW,
};

/// The start of a step: six vectors for each particle.
pub const START: Field<Vec4> = Field::new("step_start");
pub const SLOTS: usize = 6;
pub const START_VELOCITY: usize = 1;
pub const START_ACCELERATION: usize = 2;
pub const LOW_POSITION: usize = 3;
pub const LOW_VELOCITY: usize = 4;
pub const BEFORE: usize = 5;

/// A part of a step, to which particles go.
#[derive(Clone)]
pub struct Part {
    h: f64,
    once: [f64; NODES as usize],
    twice: [f64; NODES as usize],
    /// Whether positions and velocities have two words.
    is_double: bool,
    /// The step, or the longest one.
    dt: f64,
    is_adaptive: bool,
    /// What the part of the step in single precision lacks; `None`: the device computes it.
    lacks: Option<f64>,
}

impl Part {
    pub fn new(h: f64, problem: &Problem) -> Self {
        let [once, twice] = integrals(h);
        #[expect(clippy::cast_possible_truncation, reason = "as the device multiplies")]
        let product = f64::from(h as f32 * problem.dt as f32);
        // At a node of an adaptive step it does not matter: what is computed there are accelerations, which are single.
        let is_adaptive = problem.adaptive_step.is_some();
        let lacks = if is_adaptive { (h < 1.0).then_some(0.0) } else { Some(h * problem.dt - product) };
        Self { h, once, twice, is_double: problem.precision.is_double(), dt: problem.dt, is_adaptive, lacks }
    }
    fn files(&self) -> Vec<Source> {
        let mut files =
            vec![crate::shader!("integrators/radau/differences.wgsl"), crate::shader!("integrators/radau/move.wgsl")];
        if self.is_double {
            files.extend([
                compensated::sums(),
                crate::shader!("integrators/radau/two_product.wgsl"),
                crate::shader!("integrators/radau/go_compensated.wgsl"),
                if self.lacks.is_some() {
                    crate::shader!("integrators/radau/rest_even.wgsl")
                } else {
                    crate::shader!("integrators/radau/rest_adaptive.wgsl")
                },
            ]);
        } else {
            files.push(crate::shader!("integrators/radau/go.wgsl"));
        }
        files
    }
    fn constants(&self) -> Vec<(&'static str, f64)> {
        const TWICE: [&str; 7] = ["X0", "X1", "X2", "X3", "X4", "X5", "X6"];
        const ONCE: [&str; 7] = ["V0", "V1", "V2", "V3", "V4", "V5", "V6"];
        let mut all = vec![("H", self.h)];
        all.extend(TWICE.into_iter().zip(self.twice));
        all.extend(ONCE.into_iter().zip(self.once));
        if self.is_double {
            #[expect(clippy::cast_possible_truncation, reason = "as the device holds it")]
            let rest = self.dt - f64::from(self.dt as f32);
            match self.lacks {
                Some(lacks) => all.push(("REST", lacks)),
                None => all.extend([("UNIT", self.dt), ("UNIT_REST", rest)]),
            }
        }
        all
    }
    /// Saves positions and velocities at the start of a step.
    pub fn save(&self, host: &Host) -> Result<(), Error> {
        let (x, v) = (host.read(POSITION)?, host.read(VELOCITY)?);
        let mut start = host.write(START)?;
        for (i, its) in start.chunks_exact_mut(SLOTS).enumerate() {
            (its[0], its[START_VELOCITY]) = (x[i], v[i]);
        }
        if self.is_double {
            let (x, v) = (host.read(POSITION_LOW)?, host.read(VELOCITY_LOW)?);
            for (i, its) in start.chunks_exact_mut(SLOTS).enumerate() {
                (its[LOW_POSITION], its[LOW_VELOCITY]) = (x[i], v[i]);
            }
        }
        Ok(())
    }
    /// The length of the step, with what single precision lacks: the way by the velocity at its start is the largest by far.
    fn length(&self, host: &Host) -> Result<f64, Error> {
        Ok(match self.lacks {
            Some(_) if self.is_double && !self.is_adaptive => self.dt,
            None if self.is_double => f64::from(host.read(STEP_CLOCK)?[2]) / f64::from(TICKS) * self.dt,
            _ => host.world().dt,
        })
    }
    /// To the part of the step, or back to its start.
    pub fn go(&self, host: &Host, back: bool) -> Result<(), Error> {
        let (whole, dt) = (self.length(host)?, host.world().dt);
        let (start, differences) = (host.read(START)?, host.read(DIFFERENCES)?);
        let (mut x, mut v) = (host.write(POSITION)?, host.write(VELOCITY)?);
        let mut low = if self.is_double { Some((host.write(POSITION_LOW)?, host.write(VELOCITY_LOW)?)) } else { None };
        for (i, its) in start.chunks_exact(SLOTS).enumerate() {
            let v0 = its[START_VELOCITY];
            if back {
                (x[i], v[i]) = (its[0], v0);
                if let Some((x_low, v_low)) = &mut low {
                    (x_low[i], v_low[i]) = (its[LOW_POSITION], its[LOW_VELOCITY]);
                }
                continue;
            }
            let a = its[START_ACCELERATION].truncate();
            let (mut drift, mut kick) = (0.5 * self.h * self.h * a, self.h * a);
            for (k, g) in differences[i * NODES as usize..][..NODES as usize].iter().enumerate() {
                drift += self.twice[k] * g.truncate();
                kick += self.once[k] * g.truncate();
            }
            let lows = if low.is_some() { [its[LOW_POSITION], its[LOW_VELOCITY]] } else { [DVec4::ZERO; 2] };
            let moved = lows[0].truncate() + self.h * whole * (v0 + lows[1]).truncate() + dt * dt * drift;
            let faster = lows[1].truncate() + dt * kick;
            let (position, rest) = two_sum(its[0].truncate(), moved);
            let (velocity, slower) = two_sum(v0.truncate(), faster);
            x[i] = position.extend(its[0].w);
            v[i] = velocity.extend(v0.w);
            if let Some((x_low, v_low)) = &mut low {
                (x_low[i], v_low[i]) = (rest.extend(0.0), slower.extend(0.0));
            }
        }
        Ok(())
    }
    /// A kernel that ends by going there.
    pub fn kernel(
        &self,
        name: &str,
        file: Source,
        constants: &[(&'static str, f64)],
        problem: &Problem,
        reference: impl Fn(&Host) -> Result<(), Error> + Send + Sync + 'static,
    ) -> Result<Kernel, Error> {
        let mut files = vec![crate::shader!("world.wgsl")];
        files.extend(self.files());
        files.push(file);
        let all = [self.constants(), constants.to_vec()].concat();
        let kernel = Kernel::new(name, Shader::join(&files)?, all, problem.capacity, Arc::new(reference));
        Ok(Kernel { name: name.to_owned(), sizes: sizes(problem), ..kernel }.alone())
    }
}

/// A sum and its rounding error.
pub fn two_sum(a: DVec3, b: DVec3) -> (DVec3, DVec3) {
    let s = a + b;
    let t = s - a;
    (s, (a - (s - t)) + (b - t))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A first number and its rest are the exact sum.
    #[test]
    fn sums_keep_their_rest() {
        let (sum, rest) = two_sum(DVec3::splat(1.0), DVec3::splat(1e-20));
        assert_eq!((sum.x, rest.x), (1.0, 1e-20));
        let (sum, rest) = two_sum(DVec3::splat(1e-20), DVec3::splat(1.0));
        assert_eq!((sum.x, rest.x), (1.0, 1e-20));
    }
}
