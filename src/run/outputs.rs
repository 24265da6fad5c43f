//! An output: the present state is measured, and passed to all writers.

use std::any::Any;
use std::sync::Arc;

use super::Run;
use super::course::Course;
use super::images;
use super::measured::Measured;
use super::progress::Progress;
use super::table::Table;
use super::writer::Writer;
use crate::error::Error;
use crate::kernel::Backend;
use crate::measure::{Energies, Energy, Moment, Series};
use crate::simulation::Simulation;
use crate::sph::DENSITY;
use crate::state::State;

impl Run {
    /// Passes the present state to all writers.
    pub(super) async fn write<B: Backend>(
        &mut self,
        simulation: &mut Simulation<B>,
        course: &Course,
        progress: &mut dyn Progress,
    ) -> Result<(), Error> {
        let columns = self.scene.output.columns.clone();
        let wanted: Vec<&str> = columns.iter().map(String::as_str).collect();
        let mut state = Arc::new(simulation.snapshot_of(&wanted).await?);
        let links = simulation.torn().await?;
        let due = |one: &Measured| one.is_due(course.done(), true);
        let (density, virial) = self.needed(simulation, due).await?;
        let clock = course.clock();
        let moment = Moment { state: &state, density: &density, clock, links: links.as_ref(), virial };
        self.measure(&moment, due, progress)?;
        for table in self.tables() {
            table.settle_later(&self.stream)?;
        }
        if self.energies().len() == 1 {
            self.pictures.trail.push(state.position());
        }
        // The energies are written to their table.
        if !wanted.contains(&"potential") {
            Arc::make_mut(&mut state).remove("potential");
        }
        if self.energies().len() == 1 {
            self.states.left_out(&state).iter().for_each(|text| progress.remark(text));
        }
        let moment = Moment { state: &state, density: &density, clock, links: links.as_ref(), virial };
        for number in 0..self.all().len() {
            let writer = &mut self.all()[number];
            writer.take(&moment)?;
            let Some(mut picture) = writer.picture(&moment)? else { continue };
            Box::pin(simulation.scale(&mut picture)).await?;
            let image = images::note(simulation.draw(&picture).await?, &picture, state.time);
            self.all()[number].drawn(state.step, image)?;
        }
        if let Some(row) = self.energies().last().copied() {
            let first = self.first();
            self.looks.take(&row, &first);
            progress.measured(&row, &first);
        }
        self.springs.1 = links.map(|links| links.springs.len());
        self.last = Some(state);
        Ok(())
    }
    /// Takes the measures that are due between two outputs, or after each step.
    pub(super) async fn enter<B: Backend>(
        &mut self,
        simulation: &mut Simulation<B>,
        course: &Course,
        progress: &mut dyn Progress,
    ) -> Result<(), Error> {
        let state = Arc::new(simulation.snapshot().await?);
        let due = |one: &Measured| one.is_due(course.done(), false);
        let (density, virial) = self.needed(simulation, due).await?;
        let moment = Moment { state: &state, density: &density, clock: course.clock(), links: None, virial };
        self.measure(&moment, due, progress)?;
        self.look(state, course, progress)
    }
    /// Takes in the energy of a state between two outputs.
    pub(super) fn look(
        &mut self,
        state: Arc<State>,
        course: &Course,
        progress: &mut dyn Progress,
    ) -> Result<(), Error> {
        let (row, first) = (Energy::of(&state)?, self.first());
        progress.energy(&row, &first);
        if self.looks.is_due(course.done()) {
            self.looks.take(&row, &first);
        }
        self.last = Some(state);
        Ok(())
    }
    fn measure(
        &mut self,
        moment: &Moment<'_>,
        is_due: impl Fn(&Measured) -> bool,
        progress: &mut dyn Progress,
    ) -> Result<(), Error> {
        for one in self.measures.iter_mut().filter(|one| is_due(one)) {
            one.take(moment)?;
            if let Some(text) = one.series.warning() {
                progress.warning(&text);
            }
        }
        Ok(())
    }
    /// Whether measures are due that are independent of outputs.
    pub(super) fn measures_between(&self, done: u64) -> bool {
        self.measures.iter().any(|one| one.is_due(done, false))
    }
    /// The densities of a fluid and the virial, where a measure that is due needs them.
    async fn needed<B: Backend>(
        &self,
        simulation: &mut Simulation<B>,
        is_due: impl Fn(&Measured) -> bool,
    ) -> Result<(Vec<f32>, Option<[f64; 6]>), Error> {
        let due: Vec<_> = self.measures.iter().filter(|one| is_due(one)).map(|one| one.series.needs()).collect();
        let density = due.iter().any(|needs| needs.density);
        let density = if density { simulation.read(DENSITY).await? } else { Vec::new() };
        let virial = due.iter().any(|needs| needs.virial);
        let virial = if virial { Some(simulation.virial().await?) } else { None };
        Ok((density, virial))
    }
    /// The series of that type, if the run has such a measure: `run.series::<Flocks>()`; the first, if there are several.
    #[must_use]
    pub fn series<S: Series>(&self) -> Option<&S> {
        self.measures.iter().find_map(|one| (&*one.series as &dyn Any).downcast_ref())
    }
    /// The energies at outputs.
    #[must_use]
    pub fn energies(&self) -> &[Energy] {
        self.series::<Energies>().map(Energies::rows).unwrap_or_default()
    }
    /// The energies at the start of the run.
    pub(super) fn first(&self) -> Energy {
        self.energies().first().copied().unwrap_or_default()
    }
    /// All writers.
    pub(super) fn all(&mut self) -> Vec<&mut dyn Writer> {
        let mut all: Vec<&mut dyn Writer> = vec![&mut self.states, &mut self.pictures];
        all.extend(self.writers.iter_mut().map(|one| one.as_mut() as &mut dyn Writer));
        all
    }
    /// All tables.
    pub(super) fn tables(&self) -> Vec<&Table> {
        let measured = self.measures.iter().filter_map(Measured::table);
        measured.chain(self.writers.iter().flat_map(|one| one.tables())).collect()
    }
}
