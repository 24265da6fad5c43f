//! What forces are searched with.

use super::Step;
use crate::neighbors::Grid;
use crate::tree::Tree;

impl Step<'_> {
    /// The grids that forces search and the trees that they walk: each once, however many do.
    pub(super) fn neighbors(&mut self, chosen: impl Fn(usize) -> bool) {
        let mut grids: Vec<(Grid, bool)> = Vec::new();
        let mut trees: Vec<Tree> = Vec::new();
        for (_, force) in self.forces.iter().enumerate().filter(|(place, _)| chosen(*place)) {
            let walked = force.laws().into_iter().filter_map(|law| law.tree(&self.problem));
            walked.for_each(|tree| {
                if !trees.contains(&tree) {
                    trees.push(tree);
                }
            });
            match force.resolved(&self.problem) {
                Ok(resolved) => resolved.cell_lists.into_iter().for_each(|(grid, moving)| {
                    match grids.iter_mut().find(|(known, _)| *known == grid) {
                        Some((_, also)) => *also |= moving,
                        None => grids.push((grid, moving)),
                    }
                }),
                Err(error) => {
                    self.error.get_or_insert(error);
                }
            }
        }
        for (grid, moving) in grids {
            self.add(grid.kernel(&self.problem, moving));
        }
        for tree in trees {
            self.add_all(tree.kernels(&self.problem));
        }
    }
}
