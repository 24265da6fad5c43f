//! An output: the present state is measured, and handed to all writers.

use std::sync::Arc;

use super::Run;
use super::course::Course;
use super::fluid::Book;
use super::progress::Progress;
use super::table::Table;
use super::writer::{Moment, Writer};
use crate::error::Error;
use crate::kernel::Backend;
use crate::simulation::Simulation;
use crate::sph::DENSITY;

impl Run {
    /// Hands the present state to all writers.
    pub(super) async fn write<B: Backend>(
        &mut self,
        simulation: &mut Simulation<B>,
        course: &Course,
        progress: &mut dyn Progress,
    ) -> Result<(), Error> {
        let columns = self.scene.output.columns.clone();
        let wanted: Vec<&str> = columns.iter().map(String::as_str).collect();
        let mut state = Arc::new(simulation.snapshot_of(&wanted).await?);
        let (links, density) = (simulation.torn().await?, self.density(simulation).await?);
        let moment = Moment { state: &state, density: &density, clock: course.clock(), links: links.as_ref() };
        for writer in self.all().into_iter().filter(|writer| writer.measures()) {
            writer.take(&moment)?;
        }
        self.warn(progress);
        for table in self.tables() {
            table.settle_later(&self.stream)?;
        }
        if self.energies.rows().len() == 1 {
            self.pictures.trail.push(state.position());
        }
        // The energies are in their table.
        if !wanted.contains(&"potential") {
            Arc::make_mut(&mut state).remove("potential");
        }
        if self.energies.rows().len() == 1 {
            self.states.left_out(&state).iter().for_each(|text| progress.remark(text));
        }
        let moment = Moment { state: &state, density: &density, clock: course.clock(), links: links.as_ref() };
        for number in 0..self.all().len() {
            let writer = &mut self.all()[number];
            if !writer.measures() {
                writer.take(&moment)?;
            }
            let Some(picture) = writer.picture(&moment)? else { continue };
            let image = simulation.draw(&picture).await?;
            self.all()[number].drawn(state.step, image)?;
        }
        if let Some(row) = self.energies.rows().last() {
            let first = self.energies.first();
            self.looks.take(row, &first);
            progress.measured(row, &first);
        }
        self.springs.1 = links.map(|links| links.springs.len());
        self.last = Some(state);
        Ok(())
    }
    /// Enters the present state into the ledger of a fluid alone.
    pub(super) async fn enter<B: Backend>(
        &mut self,
        simulation: &mut Simulation<B>,
        course: &Course,
        progress: &mut dyn Progress,
    ) -> Result<(), Error> {
        let (state, density) = (Arc::new(simulation.snapshot().await?), self.density(simulation).await?);
        if let Some(book) = &mut self.book {
            book.take(&Moment { state: &state, density: &density, clock: course.clock(), links: None })?;
        }
        self.warn(progress);
        Ok(())
    }
    async fn density<B: Backend>(&self, simulation: &mut Simulation<B>) -> Result<Vec<f32>, Error> {
        if self.book.is_some() { simulation.read(DENSITY).await } else { Ok(Vec::new()) }
    }
    fn warn(&mut self, progress: &mut dyn Progress) {
        if let Some(loud) = self.book.as_mut().and_then(Book::warning) {
            progress.warning(&loud);
        }
    }
    /// All writers; the plot of energies is the last file of a run.
    pub(super) fn all(&mut self) -> Vec<&mut dyn Writer> {
        let mut all: Vec<&mut dyn Writer> = Vec::new();
        all.extend(self.book.as_mut().map(|one| one as &mut dyn Writer));
        all.extend(self.flocks.as_mut().map(|one| one as &mut dyn Writer));
        all.extend([&mut self.counts as &mut dyn Writer, &mut self.states, &mut self.pictures]);
        all.extend(self.writers.iter_mut().map(|one| one.as_mut() as &mut dyn Writer));
        all.push(&mut self.energies);
        all
    }
    /// All tables.
    pub(super) fn tables(&self) -> Vec<&Table> {
        let mut all: Vec<&dyn Writer> = Vec::new();
        all.extend(self.book.as_ref().map(|one| one as &dyn Writer));
        all.extend(self.flocks.as_ref().map(|one| one as &dyn Writer));
        all.extend([&self.counts as &dyn Writer, &self.energies]);
        all.extend(self.writers.iter().map(AsRef::as_ref));
        all.into_iter().flat_map(Writer::tables).collect()
    }
}
