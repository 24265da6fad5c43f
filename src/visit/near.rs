//! All pairs within a range, through the cell list.

use super::{Law, Loads, Over};
use crate::error::Error;
use crate::kernel::{ALARM, ALARM_WORDS, Kernel, Machine, Name, Pass, Problem, Shader, Source, Threads};
use crate::neighbors::{Grid, SORTED_ID, SORTED_POSITION, SORTED_VELOCITY, STARTS};

/// Targets of one dispatch, at most. It is an integer of workgroups.
const TARGETS: u32 = 1 << 20;

/// The maximum number of neighbours of one particle in a search of the nearest: their list is kept in registers.
pub const MOST_NEAREST: u32 = 16;

/// The grid that a law searches, and whether it reads velocities there.
pub fn grid(law: &Law, problem: &Problem) -> Result<Option<(Grid, bool)>, Error> {
    if let Some(search) = &law.search {
        return Ok(search.grid.clone().map(|grid| (grid, true)));
    }
    match law.over {
        Over::Near { range, of } => Ok(Some((Grid::new(range, of, problem)?, law.loads() == Loads::Velocities))),
        Over::Nearest { count } => {
            if !(1..=MOST_NEAREST).contains(&count) {
                let text =
                    format!("`{}` searches {count} nearest neighbours: 1 to {MOST_NEAREST} are possible", law.name);
                return Err(Error::Scene(text));
            }
            // Such that the first cube of 27 cells contains about three times the list.
            Ok(Some((Grid::sparse(f64::from(count) / 3.0, problem), false)))
        }
        _ => Ok(None),
    }
}

/// The data of a neighbour that a search loads.
#[derive(Debug, Clone)]
pub struct Candidate {
    /// The file with `struct Particle` and `fn candidate(slot: u32) -> Particle`.
    pub particle: Source,
    /// The file with `fn broadcast0(q: Particle) -> Particle` to `broadcast7`: the particle loaded by lane 0 to 7. It is joined only with
    /// the walk of subgroups, since devices without subgroups refuse it.
    pub broadcast: Source,
    /// The same over a kept list: the file with `struct Particle` and `fn neighbor(id: u32, pair: u32) -> Particle`; none where no law with
    /// this data is over one.
    pub listed: Option<Source>,
}

impl Candidate {
    /// Position and mass.
    pub const STILL: Self = Self {
        particle: crate::shader!("visit/near_still.wgsl"),
        broadcast: crate::shader!("visit/near_broadcast.wgsl"),
        listed: Some(crate::shader!("visit/list_neighbor.wgsl")),
    };
    /// Position, mass and velocity.
    pub const MOVING: Self = Self {
        particle: crate::shader!("visit/near_moving.wgsl"),
        broadcast: crate::shader!("visit/near_broadcast.wgsl"),
        listed: Some(crate::shader!("visit/list_neighbor.wgsl")),
    };
}

/// The files for a search of all neighbours in range, of which a law evaluates each.
pub fn search(grid: &Grid, machine: &Machine, candidate: Candidate) -> Vec<Source> {
    search_by(grid, machine, candidate, crate::shader!("visit/near_eight.wgsl"))
}

/// The same with the file of `fn consider_eight`, which subgroups call for eight candidates.
pub fn search_by(grid: &Grid, machine: &Machine, candidate: Candidate, eight: Source) -> Vec<Source> {
    let by = match grid.of {
        Some(_) => crate::shader!("visit/near_ids.wgsl"),
        None => crate::shader!("visit/near_slots.wgsl"),
    };
    let mut files = vec![candidate.particle, by];
    if broadcasts(machine) {
        files.extend([candidate.broadcast, eight, crate::shader!("visit/near_subgroup.wgsl")]);
    } else {
        files.extend([crate::shader!("visit/near_walk.wgsl"), crate::shader!("visit/near_lanes.wgsl")]);
    }
    files
}

/// Whether a search passes candidates round its subgroup.
pub fn broadcasts(machine: &Machine) -> bool {
    machine.software && machine.subgroup == 8
}

/// The files of every search.
pub fn ground() -> Vec<Source> {
    vec![
        crate::shader!("world.wgsl"),
        crate::shader!("fields.wgsl"),
        crate::shader!("neighbors/cell.wgsl"),
        crate::shader!("neighbors/starts.wgsl"),
        crate::shader!("visit/near_rows.wgsl"),
    ]
}

pub fn kernel(law: Law, problem: &Problem) -> Result<Kernel, Error> {
    law.requires_gather()?;
    let Some((grid, moving)) = grid(&law, problem)? else {
        return Err(Error::Scene(format!("`{}` searches no cell list", law.name)));
    };
    let mut sources = ground();
    sources.push(grid.present(problem));
    sources.push(crate::shader!("visit/near_conclude.wgsl"));
    let usual = if moving { Candidate::MOVING } else { Candidate::STILL };
    let candidate = law.search.as_ref().map_or(usual, |search| search.candidate.clone());
    sources.extend(match law.over {
        Over::Nearest { .. } => vec![crate::shader!("particle.wgsl"), crate::shader!("visit/nearest.wgsl")],
        _ => search(&grid, &problem.machine, candidate),
    });
    sources.extend(law.search.iter().flat_map(|search| search.files.clone()));
    sources.push(law.result());
    sources.extend(law.choice());
    sources.extend(law.files(problem));
    // A user's law may have such a function of its own.
    let tables = if law.search.is_some() { problem.hold(&mut sources) } else { Vec::new() };
    let shader = Shader::join(&sources)?;
    let (params, mut constants) = (law.uniforms(&shader)?, problem.constants(&shader));
    constants.extend(law.mark());
    if let Over::Nearest { count } = law.over {
        constants.push(("COUNT", f64::from(count)));
    }
    let mut targets = problem.capacity;
    if let Some(search) = &law.search {
        targets = search.targets(problem);
        constants.extend(shader.reflection().known(&search.constants));
    }
    let passes = passes(&grid, &Pass { constants, uniforms: params, ..Pass::new(shader, 0) }, targets, problem)?;
    let (reference, sizes) = (law.reference, sizes(&grid));
    let mut kernel = Kernel { name: law.name, passes, reference, sizes, scratch: Vec::new(), tables };
    law.search.iter().for_each(|search| search.bind(&mut kernel));
    Ok(kernel)
}

/// The dispatches of a search for the first `targets` targets, each for a part of them.
pub fn passes(grid: &Grid, all: &Pass, targets: u32, problem: &Problem) -> Result<Vec<Pass>, Error> {
    let fields = [STARTS, SORTED_ID, SORTED_POSITION, SORTED_VELOCITY].map(|name| grid.field(name));
    let narrow = all.shader.reflection().overrides.contains_key("NARROW") && grid.narrow(problem);
    let mut passes = Vec::new();
    let mut first = 0;
    while first < targets {
        let end = targets.min(first.saturating_add(TARGETS));
        let mut pass = all.clone().on(&fields);
        if let Some(binding) = all.shader.reflection().binding("grid") {
            pass.uniforms.push(("grid", grid.uniform(binding, first, end)?));
        }
        pass.constants.extend(grid.constants(&all.shader));
        if narrow {
            pass.constants.push(("NARROW", 1.0));
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an estimate")]
        let work = (f64::from(end - first) * grid.candidates(problem)) as u64;
        passes.push(Pass { threads: Threads::new(end - first), work, ..pass });
        first = end;
    }
    Ok(passes)
}

/// The sizes of the fields that a search binds but does not create: those of the grid.
pub fn sizes(grid: &Grid) -> Vec<(Name, u64)> {
    vec![(grid.field(STARTS).1, u64::from(grid.bins())), (ALARM.name.into(), ALARM_WORDS as u64)]
}
