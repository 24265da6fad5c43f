//! The rows of the linear system.

use glam::{DVec3, DVec4};
use rayon::prelude::*;

use super::{ALONE, HELD, System, TIED, reference, with};
use crate::error::Error;
use crate::forces::Particle;
use crate::kernel::{Bounds, Host, Kernel};
use crate::links::Half;
use crate::visit::{Jacobian, ROW, ROWS, Tables, Tied, View};

/// Links, as read by the references.
pub struct Ties<'a> {
    pub jacobian: &'a Jacobian,
    pub bodies: &'a [Particle<'a>],
    pub bounds: Bounds,
    pub halves: Vec<Vec<Half>>,
}

impl<'a> Ties<'a> {
    /// Those of a system whose law of links has a Jacobian.
    ///
    /// # Errors
    /// When the host does not have the tables.
    pub fn of(
        jacobian: Option<&'a Jacobian>,
        tables: Tables,
        bodies: &'a [Particle<'a>],
        host: &Host,
    ) -> Result<Option<Self>, Error> {
        let Some(jacobian) = jacobian else { return Ok(None) };
        let tied = Tied::of(host, tables)?;
        let halves = (0..bodies.len()).map(|id| tied.halves(id)).collect();
        Ok(Some(Self { jacobian, bodies, bounds: host.world().bounds, halves }))
    }
    /// The sum of the Jacobian's products over a particle's links; `way` returns dx and dv, relative to those of the particle.
    pub fn sum(&self, id: usize, way: impl Fn(usize) -> (DVec3, DVec3)) -> DVec3 {
        let Jacobian::Links(jvp) = self.jacobian else { return DVec3::ZERO };
        let me = &self.bodies[id];
        let one = |half: &Half| {
            let you = &self.bodies[half.partner];
            let (dx, dv) = way(half.partner);
            jvp(me, you, self.bounds.shortest(you.position - me.position), half, dx, dv)
        };
        self.halves[id].iter().map(one).sum()
    }
}

/// The rows before laws of each particle alone are added; `start`: the step is linearized about its start.
pub fn kernel(system: &System<'_>, start: bool) -> Result<Kernel, Error> {
    let mask = system.problem.mask.clone();
    let (factor, jacobian) = (system.factor, system.links.as_ref().and_then(|law| law.jacobian.clone()));
    let tables = Tables::of(system.problem);
    let run = move |host: &Host| {
        let view = View::of(host)?;
        let (bodies, world) = (view.particles(), host.world());
        let h = factor * world.dt;
        let ties = Ties::of(jacobian.as_ref(), tables, &bodies, host)?;
        let mut rows = host.write(ROWS)?;
        rows.par_chunks_mut(ROW).zip(&bodies).enumerate().for_each(|(i, (row, me))| {
            let weight = if me.mass > 0.0 { me.mass } else { 1.0 };
            let (mut own, mut pull, mut way) = (DVec3::ZERO, DVec3::ZERO, ALONE);
            if let Some(ties) = &ties {
                let along = |axis: DVec3| ties.sum(i, |_| (h * h * axis, h * axis)).dot(axis);
                own = DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z));
                pull = ties.sum(i, |you| (h * h * (bodies[you].velocity - me.velocity), DVec3::ZERO));
                way = if ties.halves[i].is_empty() { ALONE } else { TIED };
            }
            way = if mask.get(i).is_some_and(|held| *held > 0) { HELD } else { way };
            row[0] = DVec3::splat(weight).extend(way);
            row[1] = DVec4::W * weight;
            row[2] = own.extend(0.0);
            row[3] = if start { pull } else { DVec3::ZERO }.extend(me.position.length());
        });
        Ok(())
    };
    let (holding, held) = system.problem.holding();
    let kernel = system.tied("rows", &[crate::shader!("integrators/solve_rows.wgsl"), holding], reference(run))?;
    let mut kernel = with(kernel, &[("FACTOR", factor), ("START", f64::from(u8::from(start)))]);
    kernel.tables.extend(held);
    Ok(kernel)
}
