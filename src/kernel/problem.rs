//! The problem for which a plan is written: particles, box, links, motions.

use std::sync::Arc;

use glam::DVec3;

use super::{
    AdaptiveStep, BlockSteps, Bounds, Columns, ListShape, Machine, Name, Precision, Shader, Side, Solver, Source, Table,
};
use crate::floor_plan::FloorPlan;
use crate::life::{Birth, Drain};
use crate::links::{Links, Network};
use crate::motion::{self, Held, Motion};

/// The machine, the number and initial positions of the particles, and their box. A plan uses the positions only to estimate speed:
/// particles may move anywhere.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// Rows of particles, in use and free: as many as buffers hold and dispatches cover.
    pub capacity: u32,
    /// Rows in use when the plan is written. The shapes of searches and the division of sums are chosen by it, so that free rows change no bit.
    pub particles: u32,
    /// Whether ids are a column, separate from rows.
    pub has_ids: bool,
    /// The machine that the plan will run on.
    pub machine: Machine,
    /// The box and its boundaries.
    pub bounds: Bounds,
    /// How far the box may change, if a barostat changes it.
    pub elastic: Option<Elastic>,
    /// The lowest and the highest corner of the initial positions \[length\].
    pub extent: (DVec3, DVec3),
    /// The number of particles of each species; empty where there is only one.
    pub species: Vec<(u32, u32)>,
    /// Links between them.
    pub network: Arc<Network>,
    /// Whether links may break.
    pub breaks: bool,
    /// The fixed and kinematic particles, in the order of [`motion::sorted`].
    pub held: Arc<Vec<Held>>,
    /// One word for each particle, 1 where it is fixed; empty where no particle is.
    pub mask: Arc<Vec<u32>>,
    /// The motions of kinematic particles and obstacles.
    pub motions: Arc<Vec<Motion>>,
    /// The particles that are to be spawned.
    pub births: Arc<Vec<Birth>>,
    /// The drains.
    pub drains: Arc<Vec<Drain>>,
    /// The floor plan, if there is one.
    pub floor_plan: Option<Arc<FloorPlan>>,
    /// Whether some particles are not active all the time.
    pub has_inactive: bool,
    /// The step size \[time\]: motions are given in steps.
    pub dt: f64,
    /// While a plan is written: the part of the step by which positions have been advanced at the end of the current drift.
    pub reached: f64,
    /// The tolerances of implicit integrators.
    pub solver: Solver,
    /// The adaptive time step; `None`: all steps have the same length.
    pub adaptive_step: Option<AdaptiveStep>,
    /// Whether adaptive steps are limited by the error that the integrator estimates, and not by forces.
    pub estimates_error: bool,
    /// The block time steps; `None`: all particles have the same steps.
    pub block_steps: Option<BlockSteps>,
    /// The precision of positions and velocities.
    pub precision: Precision,
    /// The columns of the simulation.
    pub columns: Arc<Columns>,
    /// The neighbour list that laws share, if any law is over one.
    pub list: Option<ListShape>,
    /// The skin of a neighbour list for which no law names one, where a simulation has chosen it \[length\].
    pub skin: Option<f64>,
    /// The neighbour counts at the start within the ranges for which a law requires them.
    pub neighbors: Vec<Neighbors>,
}

/// How far a box may change before plans are written anew.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elastic {
    /// The part of its sides, as they are when a plan is written, for which cells are wide enough.
    pub least: f64,
    /// The multiple of these sides for which there are waves enough.
    pub most: f64,
    /// The sides at the start of the run \[length\], which determine the order of waves.
    pub start: DVec3,
}

/// The mean number of neighbours within a range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Neighbors {
    /// The range \[length\].
    pub range: f64,
    /// The mean number.
    pub mean: f64,
}

/// The lowest and the highest corner of some positions \[length\].
#[must_use]
pub fn extent(positions: &[DVec3]) -> (DVec3, DVec3) {
    let low = positions.iter().copied().reduce(DVec3::min).unwrap_or_default();
    let high = positions.iter().copied().reduce(DVec3::max).unwrap_or_default();
    (low, high)
}

impl Problem {
    /// A problem of `count` particles in open space, somewhere in a unit cube, without links: a law over links is only checked here, and
    /// runs where [`Problem::tied`] has made its tables.
    #[must_use]
    pub fn new(count: u32, machine: Machine) -> Self {
        Self {
            capacity: count,
            particles: count,
            has_ids: false,
            machine,
            bounds: Bounds::default(),
            elastic: None,
            extent: (DVec3::ZERO, DVec3::ONE),
            species: Vec::new(),
            network: Arc::new(Network { count, ..Network::default() }),
            breaks: false,
            held: Arc::default(),
            mask: Arc::default(),
            motions: Arc::default(),
            births: Arc::default(),
            drains: Arc::default(),
            floor_plan: None,
            has_inactive: false,
            dt: 1.0,
            reached: 1.0,
            solver: Solver::default(),
            adaptive_step: None,
            estimates_error: false,
            block_steps: None,
            precision: Precision::Single,
            columns: Arc::default(),
            list: None,
            skin: None,
            neighbors: Vec::new(),
        }
    }
    /// The mean number of neighbours at the start within a range, if it was counted.
    #[must_use]
    pub fn neighbors_within(&self, range: f64) -> Option<f64> {
        self.neighbors.iter().find(|known| known.range.to_bits() == range.to_bits()).map(|known| known.mean)
    }
    /// The same with positions and velocities of this precision.
    #[must_use]
    pub fn precise(self, precision: Precision) -> Self {
        Self { precision, ..self }
    }
    /// The same with these block time steps.
    #[must_use]
    pub fn in_blocks(self, block_steps: Option<BlockSteps>) -> Self {
        Self { block_steps, ..self }
    }
    /// The same with this neighbour list.
    #[must_use]
    pub fn listed(self, list: Option<ListShape>) -> Self {
        Self { list, ..self }
    }
    /// The same with these columns.
    #[must_use]
    pub fn of_columns(self, columns: Columns) -> Self {
        Self { columns: Arc::new(columns), ..self }
    }
    /// The same with particles at these positions, in this box.
    #[must_use]
    pub fn at(self, positions: &[DVec3], bounds: Bounds) -> Self {
        Self { bounds, extent: extent(positions), ..self }
    }
    /// The same with particles of these species.
    #[must_use]
    pub fn of_species(self, species: &[u32]) -> Self {
        let mut counts = std::collections::BTreeMap::new();
        for kind in species {
            *counts.entry(*kind).or_insert(0) += 1;
        }
        Self { species: counts.into_iter().collect(), ..self }
    }
    /// The same with these links and these fixed and kinematic particles.
    #[must_use]
    pub fn tied(self, links: &Links, held: &[Held]) -> Self {
        let mask = if held.is_empty() { Vec::new() } else { motion::mask(self.capacity, held) };
        let (held, network) = (Arc::new(motion::sorted(held)), Arc::new(Network::new(self.capacity, links)));
        Self { network, held, mask: Arc::new(mask), ..self }
    }
    /// The tables of its motions for `shaders/motion/pose.wgsl`, and their sizes.
    #[must_use]
    pub fn motion_tables(&self) -> (Vec<Table>, [(Name, u64); 2]) {
        let motion::Tables { motions, keys, sizes: [rows, all] } = motion::tables(&self.motions, self.dt);
        let names = ["motions", "keyframes"].map(Name::from);
        let [first, second] = names.clone();
        (names.into_iter().zip([motions, keys]).collect(), [(first, rows), (second, all)])
    }
    /// The same with these motions, in steps of `dt`.
    #[must_use]
    pub fn moved(self, motions: &[Motion], dt: f64) -> Self {
        Self { motions: Arc::new(motions.to_vec()), dt, ..self }
    }
    /// The same with these births and drains; `has_inactive`: some particles may be inactive even without them.
    #[must_use]
    pub fn with_life(self, births: &[Birth], drains: &[Drain], has_inactive: bool) -> Self {
        let has_inactive = has_inactive || !births.is_empty() || !drains.is_empty();
        Self { births: Arc::new(births.to_vec()), drains: Arc::new(drains.to_vec()), has_inactive, ..self }
    }
    /// The same on a floor plan.
    #[must_use]
    pub fn on_floor(self, floor_plan: Option<Arc<FloorPlan>>) -> Self {
        Self { floor_plan, ..self }
    }
    /// The file with `fn is_active(id: u32) -> bool`.
    #[must_use]
    pub fn active(&self) -> Source {
        if self.has_inactive { crate::shader!("life/active.wgsl") } else { crate::shader!("life/all_active.wgsl") }
    }
    /// The same, with `free` free rows at the end.
    #[must_use]
    pub fn with_free(self, free: u32) -> Self {
        Self { particles: self.capacity.saturating_sub(free).max(1), ..self }
    }
    /// The same with ids separate from rows, or not.
    #[must_use]
    pub fn with_ids(self, has_ids: bool) -> Self {
        Self { has_ids, ..self }
    }
    /// The file with `fn id_of(index: u32) -> u32`.
    #[must_use]
    pub fn naming(&self) -> Source {
        if self.has_ids { crate::shader!("id/column.wgsl") } else { crate::shader!("id/row.wgsl") }
    }
    /// The file with `fn is_held(id: u32) -> bool`, and the table that it reads.
    #[must_use]
    pub fn holding(&self) -> (Source, Vec<Table>) {
        if self.mask.is_empty() {
            return (crate::shader!("motion/free.wgsl"), Vec::new());
        }
        (crate::shader!("motion/held.wgsl"), vec![("held".into(), self.mask.clone())])
    }
    /// Adds that file if one of the files calls the function, and returns the table.
    pub(crate) fn hold(&self, files: &mut Vec<Source>) -> Vec<Table> {
        if !files.iter().any(|file| file.needs("is_held")) {
            return Vec::new();
        }
        let (file, table) = self.holding();
        files.push(file);
        table
    }
    /// Whether a particle is fixed.
    #[must_use]
    pub fn is_held(&self, id: usize) -> bool {
        self.mask.get(id).is_some_and(|word| *word > 0)
    }
    /// The same in a box that changes so far; or not.
    #[must_use]
    pub fn stretched(self, elastic: Option<Elastic>) -> Self {
        Self { elastic, ..self }
    }
    /// The same with links that may break.
    #[must_use]
    pub fn breaking(self, breaks: bool) -> Self {
        Self { breaks, ..self }
    }
    /// The same with these tolerances of implicit integrators.
    #[must_use]
    pub fn solved(self, solver: Solver) -> Self {
        Self { solver, ..self }
    }
    /// The number of particles of a species; of all particles for `None`.
    #[must_use]
    pub fn count_of(&self, species: Option<u32>) -> u32 {
        let Some(wanted) = species.filter(|_| !self.species.is_empty()) else { return self.particles };
        self.species.iter().find(|(kind, _)| *kind == wanted).map_or(0, |(_, count)| *count)
    }
    /// The values of a shader's `override`s that depend on the problem.
    #[must_use]
    pub fn constants(&self, shader: &Shader) -> Vec<(&'static str, f64)> {
        let known = [("PERIODIC", self.bounds.has(Side::Periodic)), ("ELASTIC", self.elastic.is_some())];
        let known = known.into_iter().filter(|(name, on)| *on && shader.reflection().overrides.contains_key(*name));
        known.map(|(name, _)| (name, 1.0)).collect()
    }
}
