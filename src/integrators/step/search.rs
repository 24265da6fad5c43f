//! Searches for neighbours that forces share.

use super::Step;
use crate::error::Error;
use crate::forces::{Law, Over, Problem};
use crate::neighbors::{Grid, List};
use crate::tree::Tree;
use crate::visit;

/// Whether a law needs the rows of particles that are due.
fn lists_due(law: &Law, problem: &Problem) -> bool {
    law.of_due(problem) && law.tree(problem).is_none()
}

impl Step<'_> {
    /// Updates the neighbour list, where laws of chosen forces use it.
    fn list(&mut self, chosen: &impl Fn(usize) -> bool) -> Result<(), Error> {
        let places = self.forces.iter().enumerate();
        let laws: Vec<(usize, Law)> =
            places.flat_map(|(place, force)| force.laws().into_iter().map(move |law| (place, law))).collect();
        let over_list =
            |(place, law): &(usize, Law)| chosen(*place) && matches!(law.chosen(&self.problem), Over::List { .. });
        if !laws.iter().any(over_list) {
            return Ok(());
        }
        if self.problem.list.is_none() {
            let laws: Vec<Law> = laws.into_iter().map(|(_, law)| law).collect();
            self.problem.list = visit::shared_list(&laws, &self.problem)?;
        }
        if let Some(shape) = self.problem.list {
            let kernel = List::new(shape, &self.problem).and_then(|list| visit::list_kernel(list, &self.problem));
            self.add(kernel);
        }
        Ok(())
    }
    /// The cell lists and trees of all forces, each once.
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
        if let Err(error) = self.list(&chosen) {
            self.error.get_or_insert(error);
        }
        for (grid, moving) in grids {
            self.add(grid.kernel(&self.problem, moving));
        }
        if self
            .forces
            .iter()
            .enumerate()
            .any(|(place, force)| chosen(place) && force.laws().iter().any(|law| lists_due(law, &self.problem)))
        {
            self.add(visit::due_rows(&self.problem));
        }
        for tree in trees {
            self.add_all(tree.kernels(&self.problem));
        }
    }
}
