//! Links, motions, births and drains of the particles of a simulation.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::Simulation;
use crate::error::Error;
use crate::floor_plan::FloorPlan;
use crate::kernel::{Array, Backend, Element};
use crate::life::{Birth, Drain};
use crate::links::{Link, Links, Network, WORDS};
use crate::motion::{Held, Motion};
use crate::state::State;
use crate::visit::LINK;

/// All parts of a state that are not columns.
pub(super) struct Ties {
    links: Links,
    held: Vec<Held>,
    motions: Vec<Motion>,
    births: Vec<Birth>,
    drains: Vec<Drain>,
    floor_plan: Option<Arc<FloorPlan>>,
}

impl Ties {
    /// The ties of a state.
    pub fn of(state: &State) -> Self {
        let State { held, motions, births, drains, .. } = state;
        let (links, held, motions) = (state.all_links().into_owned(), held.clone(), motions.clone());
        let floor_plan = state.floor_plan.clone();
        Self { links, held, motions, births: births.clone(), drains: drains.clone(), floor_plan }
    }
    /// Replaces the motions from now on.
    pub fn lead(&mut self, motions: Vec<Motion>) {
        self.motions = motions;
    }
    /// The springs, by rows.
    pub fn springs(&self) -> &[Link] {
        &self.links.springs
    }
    /// The drains.
    pub fn drains(&self) -> &[Drain] {
        &self.drains
    }
    /// The floor plan.
    pub fn floor_plan(&self) -> Option<&FloorPlan> {
        self.floor_plan.as_deref()
    }
    /// The rows of particles that are linked, fixed or kinematic.
    pub fn bound(&self) -> BTreeSet<u32> {
        let springs = self.links.springs.iter().flat_map(|link| link.ends);
        let rods = self.links.rods.iter().flat_map(|rod| rod.ends);
        let corners = self.links.corners().flatten().copied();
        springs.chain(rods).chain(corners).chain(self.held.iter().map(|held| held.id)).collect()
    }
    /// The rows of particles that move at constant velocity after they are spawned.
    pub fn guided(&self) -> impl Iterator<Item = u32> {
        self.births.iter().filter(|birth| birth.guided > 0.0).map(|birth| birth.id)
    }
    /// Adds it to a state; the links are those of the start, including springs that had broken before.
    pub fn give(&self, state: &mut State) {
        (state.links, state.held) = (self.links.clone(), self.held.clone());
        (state.motions, state.births, state.drains) = (self.motions.clone(), self.births.clone(), self.drains.clone());
        state.floor_plan.clone_from(&self.floor_plan);
    }
}

impl<B: Backend> Simulation<B> {
    /// The present links, where springs may break; `None` where none can.
    ///
    /// # Errors
    /// As for [`Simulation::links`].
    pub async fn torn(&mut self) -> Result<Option<Links>, Error> {
        if self.breaks { self.links().await.map(Some) } else { Ok(None) }
    }
    /// The links as they are now: those of the setup, without the springs that broke. They may go into another setup,
    /// which continues from here.
    ///
    /// # Errors
    /// When the device is lost, or does not answer in time.
    pub async fn links(&mut self) -> Result<Links, Error> {
        self.settle().await?;
        self.links_now().await
    }
    /// Like [`Self::links`], whether or not the list had enough capacity.
    pub(super) async fn links_now(&mut self) -> Result<Links, Error> {
        if !self.breaks {
            return Ok(self.ties.links.clone());
        }
        let network = Network::new(self.capacity(), &self.ties.links);
        let ends = network.ends() as usize;
        let table = self.backend.read(LINK, &Array::Uint(Vec::new()), ends * WORDS).await?;
        Ok(self.ties.links.intact(&network, u32::view(&table).map_or(&[], Vec::as_slice)))
    }
}
