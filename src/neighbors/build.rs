//! Builds a grid: a counting sort by cell, stable by id.

use std::sync::Arc;

use glam::Vec4;

use super::{ARRIVALS, Cells, Grid, KEYS, SLOTS, SORTED_ID, SORTED_POSITION, SORTED_VELOCITY, STARTS};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Name, POSITION, Pass, Problem, SPECIES, Shader, Source, VELOCITY};
use crate::primitives::{fill, scan};

impl Grid {
    /// Its name in a plan.
    #[must_use]
    pub fn title(&self) -> String {
        let [x, y, z] = self.cells;
        format!("grid RANGE={} CELLS={x}×{y}×{z}{}", self.name, self.fitted)
    }

    /// The kernel that builds it from the current positions. `moving`: with a sorted copy of velocities.
    ///
    /// # Errors
    /// When a shader does not compile, or a field does not fit.
    pub fn kernel(&self, problem: &Problem, moving: bool) -> Result<Kernel, Error> {
        let (bins, machine) = (self.bins(), &problem.machine);
        let (_, starts) = self.field(STARTS);
        let sums = scan::scratch(&starts);
        let chosen = if self.of.is_some() {
            crate::shader!("neighbors/species.wgsl")
        } else {
            crate::shader!("neighbors/all_chosen.wgsl")
        };
        let carry = if moving {
            crate::shader!("neighbors/carry_moving.wgsl")
        } else {
            crate::shader!("neighbors/carry_still.wgsl")
        };
        let mut passes = fill::passes(&starts, bins, 0)?;
        let (holding, tables) =
            if self.apart { problem.holding() } else { (crate::shader!("motion/free.wgsl"), Vec::new()) };
        passes.push(self.pass(problem, &[chosen, problem.active(), holding, crate::shader!("neighbors/count.wgsl")])?);
        passes.extend(scan::passes(&starts, &sums, bins, machine)?);
        passes.push(self.pass(problem, &[crate::shader!("neighbors/scatter.wgsl")])?);
        passes.push(self.pass(problem, &[carry, crate::shader!("neighbors/order.wgsl")])?);
        let (grid, all) = (self.clone(), problem.clone());
        let reference = move |host: &Host| grid.sort(host, &all, moving);
        let scratch: Vec<Name> = vec![KEYS.name.into(), ARRIVALS.name.into(), SLOTS.name.into(), sums.clone()];
        Ok(Kernel {
            name: self.title(),
            passes,
            reference: Some(Arc::new(reference)),
            sizes: vec![(starts, u64::from(bins)), (sums, scan::blocks(bins, machine))],
            scratch,
            tables,
        })
    }

    fn pass(&self, problem: &Problem, files: &[Source]) -> Result<Pass, Error> {
        let mut all =
            vec![crate::shader!("world.wgsl"), crate::shader!("fields.wgsl"), crate::shader!("neighbors/cell.wgsl")];
        all.extend_from_slice(files);
        let shader = Shader::join(&all)?;
        let block = shader.reflection().binding("grid").map(|b| self.uniform(b, 0, problem.capacity)).transpose()?;
        let fields = [STARTS, SORTED_ID, SORTED_POSITION, SORTED_VELOCITY].map(|name| self.field(name));
        let uniforms = block.into_iter().map(|bytes| ("grid", bytes)).collect();
        let mut constants = problem.constants(&shader);
        constants.extend(self.constants(&shader));
        Ok(Pass { constants, uniforms, ..Pass::new(shader, problem.capacity) }.on(&fields))
    }

    /// The file with `fn present() -> u32`, the number of particles in its slots; a shader that joins it also joins
    /// `neighbors/starts.wgsl`, and gets [`Grid::constants`].
    #[must_use]
    pub fn present(&self, problem: &Problem) -> Source {
        // If it contains only one species, every particle searches, by id.
        if problem.has_inactive && self.of.is_none() {
            return crate::shader!("neighbors/present_living.wgsl");
        }
        crate::shader!("neighbors/present.wgsl")
    }
    /// The values of a shader's `override`s that depend on the grid: its cells, those with active particles, and the number of lists.
    #[must_use]
    pub fn constants(&self, shader: &Shader) -> Vec<(&'static str, f64)> {
        let (cells, layers) = (self.bins() - 1, self.layers());
        let known =
            |name: &str, usual: u32, value: u32| value != usual && shader.reflection().overrides.contains_key(name);
        let all = [("CELLS", 0, cells), ("LAYERS", 1, layers)];
        all.into_iter().filter(|(n, usual, v)| known(n, *usual, *v)).map(|(n, _, v)| (n, f64::from(v))).collect()
    }
    /// The ids in its slots, slot by slot.
    ///
    /// # Errors
    /// When it has not been built.
    pub fn occupants(&self, host: &Host) -> Result<Vec<u32>, Error> {
        let ids = host.reading::<u32>(&self.field(SORTED_ID).1)?;
        let starts = self.field(STARTS).1;
        // Where no kernel binds the cells, they contain all particles.
        let all = ids.len();
        let end =
            if host.contains(&starts) { host.reading::<u32>(&starts)?.last().map_or(0, |n| *n as usize) } else { all };
        Ok(ids[..end.min(all)].to_vec())
    }
    /// The reference.
    fn sort(&self, host: &Host, problem: &Problem, moving: bool) -> Result<(), Error> {
        let position = host.read(POSITION)?;
        let count = (host.world().count as usize).min(position.len());
        let species = if self.of.is_some() { host.read(SPECIES)?.to_vec() } else { Vec::new() };
        let is_active = host.is_active()?;
        let chosen = |i: usize| is_active(i) && self.of.is_none_or(|of| species.get(i) == Some(&of));
        let places = position[..count].iter().map(|x| x.truncate());
        let cells = Cells::sort(self, host.world().bounds, places, chosen, |i| self.apart && problem.is_held(i));

        host.writing::<u32>(&self.field(STARTS).1)?.copy_from_slice(&cells.starts);
        let mut ids = host.writing::<u32>(&self.field(SORTED_ID).1)?;
        let mut positions = host.writing::<Vec4>(&self.field(SORTED_POSITION).1)?;
        for (slot, id) in cells.ids.iter().enumerate() {
            let i = *id as usize;
            (ids[slot], positions[slot]) = (*id, cells.wrapped_places[i].as_dvec3().extend(position[i].w));
        }
        if moving {
            let velocity = host.read(VELOCITY)?;
            let mut velocities = host.writing::<Vec4>(&self.field(SORTED_VELOCITY).1)?;
            for (to, id) in velocities.iter_mut().zip(&cells.ids) {
                *to = velocity[*id as usize];
            }
        }
        Ok(())
    }
}
