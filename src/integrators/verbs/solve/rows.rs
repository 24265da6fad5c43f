//! The rows of the linear system.

use glam::{DVec3, DVec4};
use rayon::prelude::*;

use super::{ALONE, HELD, System, TIED, reference, with};
use crate::error::Error;
use crate::forces::Particle;
use crate::kernel::{Bounds, Host, Kernel};
use crate::links::{Half, WORDS};
use crate::visit::{Jacobian, LINK, LINK_START, ROW, ROWS, View};

/// Links, as read by the references.
pub struct Ties<'a> {
    pub jacobian: &'a Jacobian,
    pub bodies: &'a [Particle<'a>],
    pub bounds: Bounds,
    pub start: &'a [u32],
    pub link: &'a [u32],
}

impl Ties<'_> {
    fn row(&self, id: usize) -> impl Iterator<Item = Half> {
        let [from, to] = [id, id + 1].map(|place| self.start.get(place).map_or(0, |n| *n as usize) * WORDS);
        self.link.get(from..to).unwrap_or_default().chunks_exact(WORDS).map(Half::new)
    }
    /// The sum of the Jacobian's products over a particle's links; `way` returns dx and dv, relative to those of the particle.
    pub fn sum(&self, id: usize, way: impl Fn(usize) -> (DVec3, DVec3)) -> DVec3 {
        let Jacobian::Links(jvp) = self.jacobian else { return DVec3::ZERO };
        let me = &self.bodies[id];
        let one = |half: Half| {
            let you = &self.bodies[half.partner];
            let (dx, dv) = way(half.partner);
            jvp(me, you, self.bounds.shortest(you.position - me.position), &half, dx, dv)
        };
        self.row(id).map(one).sum()
    }
}

/// The rows before laws of each particle alone are added; `start`: the step is linearized about its start.
pub fn kernel(system: &System<'_>, start: bool) -> Result<Kernel, Error> {
    let mask = system.problem.mask.clone();
    let (factor, jacobian) = (system.factor, system.links.as_ref().and_then(|law| law.jacobian.clone()));
    let run = move |host: &Host| {
        let view = View::of(host)?;
        let (bodies, world) = (view.particles(), host.world());
        let h = factor * world.dt;
        let tables = match &jacobian {
            Some(_) => Some((host.reading::<u32>(LINK_START)?, host.reading::<u32>(LINK)?)),
            None => None,
        };
        let ties = jacobian.as_ref().zip(tables.as_ref()).map(|(jacobian, (starts, link))| Ties {
            jacobian,
            bodies: &bodies,
            bounds: world.bounds,
            start: starts,
            link,
        });
        let mut rows = host.write(ROWS)?;
        rows.par_chunks_mut(ROW).zip(&bodies).enumerate().for_each(|(i, (row, me))| {
            let weight = if me.mass > 0.0 { me.mass } else { 1.0 };
            let (mut own, mut pull, mut way) = (DVec3::ZERO, DVec3::ZERO, ALONE);
            if let Some(ties) = &ties {
                let along = |axis: DVec3| ties.sum(i, |_| (h * h * axis, h * axis)).dot(axis);
                own = DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z));
                pull = ties.sum(i, |you| (h * h * (bodies[you].velocity - me.velocity), DVec3::ZERO));
                way = if ties.start[i] < ties.start[i + 1] { TIED } else { ALONE };
            }
            way = if mask.get(i).is_some_and(|held| *held > 0) { HELD } else { way };
            row[0] = DVec3::splat(weight).extend(way);
            row[1] = DVec4::W * weight;
            row[2] = own.extend(0.0);
            row[3] = if start { pull } else { DVec3::ZERO }.extend(me.position.length());
        });
        Ok(())
    };
    let (holding, tables) = system.problem.holding();
    let kernel = system.tied("rows", &[crate::shader!("integrators/solve_rows.wgsl"), holding], reference(run))?;
    let mut kernel = with(kernel, &[("FACTOR", factor), ("START", f64::from(u8::from(start)))]);
    kernel.tables.extend(tables);
    Ok(kernel)
}
