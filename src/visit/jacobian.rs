//! Jacobians of laws, for implicit integrators.

use std::sync::Arc;

use glam::{DVec3, DVec4, Vec4};
use rayon::prelude::*;

use super::particle::{Particle, View};
use super::reference::PIECE;
use super::{Law, Over};
use crate::error::Error;
use crate::kernel::{Field, Host, Kernel, Pass, Problem, Shader, Source, World};
use crate::links::Half;

/// The rows of the linear system, four vectors each: see `shaders/integrators/solve_row.wgsl`.
pub const ROWS: Field<Vec4> = Field::new("rows");
/// Vectors in a row.
pub const ROW: usize = 4;

/// Contents of uniform blocks, by name.
pub type Uniforms = Vec<(&'static str, Vec<u8>)>;
type OfEach = dyn Fn(&Particle, &World, DVec3, DVec3) -> DVec3 + Send + Sync;
type OfLinks = dyn Fn(&Particle, &Particle, DVec3, &Half, DVec3, DVec3) -> DVec3 + Send + Sync;

/// The product of a law's Jacobian with a change of position and a change of velocity. In WGSL it is `fn jvp`.
#[derive(Clone)]
pub enum Jacobian {
    /// `(me, world, dx, dv)`: the change of acceleration when I move by dx and my velocity changes by dv. If it is not symmetric, its
    /// symmetric part is used.
    Each(Arc<OfEach>),
    /// `(me, you, r, link, dx, dv)`: the change of the force on me when you move by dx and by dv in velocity, relative to
    /// me. It must be symmetric, and must not be negative.
    Links(Arc<OfLinks>),
}

impl Law {
    /// The same law with a Jacobian, which implicit integrators include in their matrix.
    #[must_use]
    pub fn with_jacobian(self, jacobian: Jacobian) -> Self {
        Self { jacobian: Some(jacobian), ..self }
    }
    /// The kernel that adds a law of each particle alone to the rows of the system, for a part of the step; `start`: the law is linearized
    /// about the start of the step.
    ///
    /// # Errors
    /// When it has no such Jacobian, or its WGSL does not compile.
    pub fn rows(&self, problem: &Problem, factor: f64, start: bool) -> Result<Kernel, Error> {
        let Some(Jacobian::Each(jvp)) = self.jacobian.clone() else {
            return Err(Error::Scene(format!("`{}` has no Jacobian of each particle alone", self.name)));
        };
        let own = [crate::shader!("integrators/solve_row.wgsl"), crate::shader!("visit/each_jacobian.wgsl")];
        let (shader, uniforms) = self.beside(&own, problem)?;
        let mut constants = problem.constants(&shader);
        constants.extend([("FACTOR", factor), ("START", f64::from(u8::from(start)))]);
        let reference = move |host: &Host| {
            let view = View::of(host)?;
            let (bodies, world) = (view.particles(), host.world());
            let h = factor * world.dt;
            let mut rows = host.write(ROWS)?;
            rows.par_chunks_mut(ROW).zip(&bodies).with_min_len(PIECE).for_each(|(row, me)| {
                let weight = row[1].w;
                let column = |axis: DVec3| weight * jvp(me, &world, h * h * axis, h * axis);
                let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(column);
                row[0] -= DVec4::new(x.x, y.y, z.z, 0.0);
                row[1] -= 0.5 * DVec4::new(x.y + y.x, y.z + z.y, z.x + x.z, 0.0);
                if start {
                    row[3] += (weight * jvp(me, &world, h * h * me.velocity, DVec3::ZERO)).extend(0.0);
                }
            });
            Ok(())
        };
        let pass = Pass { constants, uniforms, ..Pass::new(shader, problem.capacity) };
        Ok(Kernel {
            name: format!("{} rows", self.name),
            passes: vec![pass],
            reference: Some(Arc::new(reference)),
            sizes: Vec::new(),
            scratch: Vec::new(),
            tables: Vec::new(),
        })
    }
    /// Joins files with the law, whose `jvp` they call; returns the shader and the law's own uniform blocks.
    ///
    /// # Errors
    /// When the law has no `jvp` in its WGSL, or the WGSL does not compile.
    pub fn beside(&self, files: &[Source], problem: &Problem) -> Result<(Arc<Shader>, Uniforms), Error> {
        let signature = match self.over {
            Over::Each => "fn jvp(me: Particle, dx: vec3f, dv: vec3f) -> vec3f",
            _ => "fn jvp(me: Particle, you: Particle, r: vec3f, link: Link, dx: vec3f, dv: vec3f) -> vec3f",
        };
        self.requires(&[("jvp", signature)])?;
        let mut all =
            vec![crate::shader!("world.wgsl"), crate::shader!("fields.wgsl"), crate::shader!("particle.wgsl")];
        all.extend_from_slice(files);
        all.extend(self.files(problem));
        let shader = Shader::join(&all)?;
        // A Jacobian may not use the parameters.
        let uniforms = match shader.reflection().binding("params") {
            Some(_) => self.uniforms(&shader)?,
            None => Vec::new(),
        };
        Ok((shader, uniforms))
    }
}
