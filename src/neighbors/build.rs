//! Builds a grid: a counting sort by cell, stable by id.

use std::sync::Arc;

use glam::{Vec3, Vec4};

use super::{ARRIVALS, Grid, KEYS, SLOTS, SORTED_ID, SORTED_POSITION, SORTED_VELOCITY, STARTS};
use crate::error::Error;
use crate::kernel::{Bounds, Host, Kernel, Name, POSITION, Pass, Problem, SPECIES, Shader, Side, Source, VELOCITY};
use crate::primitives::{fill, scan};

impl Grid {
    /// What it is called in a plan.
    #[must_use]
    pub fn title(&self) -> String {
        let [x, y, z] = self.cells;
        format!("grid RANGE={} CELLS={x}×{y}×{z}{}", self.name, self.fitted)
    }

    /// The kernel that builds it from where particles are now. `moving`: with a sorted copy of their velocities.
    ///
    /// # Errors
    /// When a shader does not compile, or a field does not fit.
    pub fn kernel(&self, problem: &Problem, moving: bool) -> Result<Kernel, Error> {
        let (bins, machine) = (self.count() + 1, &problem.machine);
        let (_, starts) = self.field(STARTS);
        let sums = scan::scratch(&starts);
        let chosen = if self.of.is_some() {
            crate::shader!("neighbors/species.wgsl")
        } else {
            crate::shader!("neighbors/anybody.wgsl")
        };
        let carry = if moving {
            crate::shader!("neighbors/carry_moving.wgsl")
        } else {
            crate::shader!("neighbors/carry_still.wgsl")
        };
        let mut passes = fill::passes(&starts, bins, 0)?;
        passes.push(self.pass(problem, &[chosen, crate::shader!("neighbors/count.wgsl")])?);
        passes.extend(scan::passes(&starts, &sums, bins, machine)?);
        passes.push(self.pass(problem, &[crate::shader!("neighbors/scatter.wgsl")])?);
        passes.push(self.pass(problem, &[carry, crate::shader!("neighbors/order.wgsl")])?);
        let grid = self.clone();
        let twin = move |host: &Host| grid.sort(host, moving);
        let scratch: Vec<Name> = vec![KEYS.name.into(), ARRIVALS.name.into(), SLOTS.name.into(), sums.clone()];
        Ok(Kernel {
            name: self.title(),
            passes,
            twin: Some(Arc::new(twin)),
            sizes: vec![(starts, u64::from(bins)), (sums, scan::blocks(bins, machine))],
            scratch,
        })
    }

    fn pass(&self, problem: &Problem, files: &[Source]) -> Result<Pass, Error> {
        let mut all =
            vec![crate::shader!("world.wgsl"), crate::shader!("fields.wgsl"), crate::shader!("neighbors/cell.wgsl")];
        all.extend_from_slice(files);
        let shader = Shader::join(&all)?;
        let block = shader.reflection().binding("grid").map(|b| self.uniform(b, 0, problem.count)).transpose()?;
        let fields = [STARTS, SORTED_ID, SORTED_POSITION, SORTED_VELOCITY].map(|name| self.field(name));
        let uniforms = block.into_iter().map(|bytes| ("grid", bytes)).collect();
        Ok(Pass { uniforms, ..Pass::new(shader, problem.count) }.on(&fields))
    }

    /// The twin. A cell is found by the device's own arithmetic, so that who stands at its edge is on one side for both.
    fn sort(&self, host: &Host, moving: bool) -> Result<(), Error> {
        let (position, velocity) = (host.read(POSITION)?, host.read(VELOCITY)?);
        let count = (host.world().count as usize).min(position.len());
        let species = if self.of.is_some() { host.read(SPECIES)?.to_vec() } else { Vec::new() };
        let bounds = host.world().bounds;
        let homes: Vec<Vec3> = (0..count).map(|i| bounds.home(position[i].truncate())).collect();
        let cells: Vec<usize> = homes.iter().map(|x| self.key(*x, &bounds)).collect();
        let chosen = |i: &usize| self.of.is_none_or(|of| species.get(*i) == Some(&of));

        let mut starts = host.writing::<u32>(&self.field(STARTS).1)?;
        starts.fill(0);
        for i in (0..count).filter(chosen) {
            starts[cells[i] + 1] += 1;
        }
        for c in 1..starts.len() {
            starts[c] += starts[c - 1];
        }
        let mut ids = host.writing::<u32>(&self.field(SORTED_ID).1)?;
        let mut positions = host.writing::<Vec4>(&self.field(SORTED_POSITION).1)?;
        let mut next: Vec<u32> = starts.to_vec();
        let mut velocities = if moving { Some(host.writing::<Vec4>(&self.field(SORTED_VELOCITY).1)?) } else { None };
        for i in (0..count).filter(chosen) {
            let slot = next[cells[i]] as usize;
            next[cells[i]] += 1;
            (ids[slot], positions[slot]) = (u32::try_from(i).unwrap_or(u32::MAX), homes[i].as_dvec3().extend(position[i].w));
            if let Some(velocities) = &mut velocities {
                velocities[slot] = velocity[i];
            }
        }
        Ok(())
    }

    /// The cell of a place, folded; see `shaders/neighbors/cell.wgsl`.
    fn key(&self, x: Vec3, bounds: &Bounds) -> usize {
        const FARTHEST: f32 = 536_870_912.0;
        let c: Vec3 = ((x - self.low.as_vec3()) * self.per_cell.as_vec3()).floor();
        let fold = |axis: usize| {
            #[expect(clippy::cast_possible_truncation, reason = "clamped; a number that is none becomes 0")]
            let last = if bounds.sides[axis] == Side::Periodic { self.cells[axis] as f32 - 1.0 } else { FARTHEST };
            let c = i64::from(c[axis].clamp(-FARTHEST, last) as i32);
            usize::try_from(c.rem_euclid(i64::from(self.cells[axis]))).unwrap_or(0)
        };
        let [nx, ny, _] = self.cells.map(|n| n as usize);
        fold(0) + nx * (fold(1) + ny * fold(2))
    }
}
