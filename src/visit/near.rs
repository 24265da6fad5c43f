//! Everybody meets who is within a range, through the grid.

use super::{Law, Over};
use crate::error::Error;
use crate::kernel::{ALARM, ALARM_WORDS, Kernel, Machine, Name, Pass, Problem, Shader, Source, Threads};
use crate::neighbors::{Grid, SORTED_ID, SORTED_POSITION, SORTED_VELOCITY, STARTS};

/// Targets of one dispatch, at most. It is a whole number of workgroups.
const TARGETS: u32 = 1 << 20;

/// The grid that a law searches, and whether it asks there for velocities.
pub fn grid(law: &Law, problem: &Problem) -> Result<Option<(Grid, bool)>, Error> {
    let Over::Near { range, of } = law.over else { return Ok(None) };
    Ok(Some((Grid::new(range, of, problem)?, moving(law))))
}

fn moving(law: &Law) -> bool {
    law.wgsl.says(&["velocity_of", "("])
}

fn variant(machine: &Machine) -> Vec<Source> {
    match (machine.software, machine.subgroup) {
        (true, 8) => vec![crate::shader!("visit/near_subgroup.wgsl")],
        _ => vec![crate::shader!("visit/near_walk.wgsl"), crate::shader!("visit/near_lanes.wgsl")],
    }
}

pub fn kernel(law: Law, problem: &Problem) -> Result<Kernel, Error> {
    law.requires_meetings()?;
    let Some((grid, moving)) = grid(&law, problem)? else {
        return Err(Error::Scene(format!("`{}` searches no grid", law.name)));
    };
    let mut files = vec![
        crate::shader!("world.wgsl"),
        crate::shader!("fields.wgsl"),
        crate::shader!("neighbors/cell.wgsl"),
        if moving { crate::shader!("visit/near_moving.wgsl") } else { crate::shader!("visit/near_still.wgsl") },
        if grid.of.is_some() { crate::shader!("visit/near_ids.wgsl") } else { crate::shader!("visit/near_slots.wgsl") },
        crate::shader!("visit/near_rows.wgsl"),
    ];
    files.extend(variant(&problem.machine));
    files.extend(law.files());
    let shader = Shader::join(&files)?;
    let (params, constants) = (law.uniforms(&shader)?, problem.constants(&shader));
    let fields = [STARTS, SORTED_ID, SORTED_POSITION, SORTED_VELOCITY].map(|name| grid.field(name));
    let mut passes = Vec::new();
    let mut first = 0;
    while first < problem.count {
        let end = problem.count.min(first + TARGETS);
        let mut uniforms = params.clone();
        if let Some(binding) = shader.reflection().binding("grid") {
            uniforms.push(("grid", grid.uniform(binding, first, end)?));
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an estimate")]
        let work = (f64::from(end - first) * grid.candidates(problem)) as u64;
        let threads = Threads::new(end - first);
        let pass = Pass { constants: constants.clone(), uniforms, threads, work, ..Pass::new(shader.clone(), 0) };
        passes.push(pass.on(&fields));
        first = end;
    }
    // The law does not make these, but it binds them: they are as long as the grid makes them.
    let sizes: Vec<(Name, u64)> =
        vec![(grid.field(STARTS).1, u64::from(grid.count()) + 1), (ALARM.name.into(), ALARM_WORDS)];
    Ok(Kernel { name: law.name, passes, twin: law.twin, sizes, scratch: Vec::new() })
}
