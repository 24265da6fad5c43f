//! Rebuilds the list when a particle has moved too far; otherwise its dispatches have no workgroups.

use std::sync::Arc;

use crate::error::Error;
use crate::kernel::{ALARM, ALARM_WORDS, Host, Indirect, Kernel, Name, Pass, Problem, Shader, Source, Threads};
use crate::neighbors::{HISTORY, LIST, LIST_STATE, List, SORTED_ID, SORTED_POSITION, STARTS};
use crate::visit::near::{self, Candidate};

/// Neighbours in the order in which the cells are visited.
const FOUND: &str = "list_found";
/// Indirect arguments of the dispatches that build it: the present ones, and those of a rebuild.
const GO: &str = "arguments of the list";
const ALL: &str = "list_all";
/// The constant with the capacity for neighbours of each particle; it changes no bit of what a step writes.
const ROOM: &str = "ROOM";
/// The list and the history of its pairs before it is rebuilt, and the row of each particle.
const BEFORE: &str = "list_before";
const ROW_BEFORE: &str = "row_before";
const HISTORY_BEFORE: &str = "history_before";
/// Words of the arguments of a dispatch.
const EACH: u32 = 3;
/// Neighbours that an invocation puts in their places.
const SORTED: u32 = 16;
/// Candidates of one search of a subgroup for a list with room for so many, at most; see `shaders/visit/near_rows.wgsl`. Eight candidates take
/// a turn of the search and one of `shaders/neighbors/list_eight.wgsl`, which has one more for each neighbour that a lane stores, and never more than
/// eight: of both searches fewer than 65 535 for each room.
fn most(room: u32) -> u32 {
    120_000_u32.saturating_sub(16 * room.min(7_500)).max(28_000)
}
/// The approximate number of checks for each rebuild.
const SELDOM: u64 = 8;

/// Whether a kernel keeps a list up to date.
#[must_use]
pub fn is_list(kernel: &Kernel) -> bool {
    kernel.tables.iter().any(|(name, _)| name == ALL)
}

/// The kernel that keeps the list up to date.
///
/// # Errors
/// When a shader does not compile, or a field does not fit.
pub fn kernel(list: List, problem: &Problem) -> Result<Kernel, Error> {
    let list = list.excluding(problem)?;
    let grid = list.grid.kernel(problem, false)?;
    let count = problem.capacity;
    let search = search(&list, problem)?;
    let order = order(&list, problem)?;
    let mut builds: Vec<Pass> = grid.passes.into_iter().chain(search).collect();
    let exclude = list.exclusions.is_some().then(|| exclude(&list, problem)).transpose()?;
    if list.shape.words > 0 {
        let [save, fit] = history(&list, problem)?;
        builds.extend([Some(save), Some(order), exclude, Some(fit)].into_iter().flatten());
    } else {
        builds.extend([Some(order), exclude].into_iter().flatten());
    }
    let mut all = Vec::new();
    for (pass, word) in builds.iter_mut().zip((0..).step_by(EACH as usize)) {
        all.extend(pass.workgroups(problem.machine.workgroups)?);
        pass.indirect = Some(Indirect { field: GO.into(), word, rests: false });
        pass.work /= SELDOM;
    }
    let words = u64::try_from(all.len()).unwrap_or(u64::MAX);
    let decide = [crate::shader!("world.wgsl"), state(), crate::shader!("neighbors/list_decide.wgsl")];
    let decide = Pass { constants: vec![("WORDS", words as f64)], ..Pass::new(Shader::join(&decide)?, 1) };
    let decide = decide.on(&[("list_go", GO.into())]);
    let passes = [moved(&list, problem)?, decide].into_iter().chain(builds).collect();

    let [(_, starts), (_, ids), (_, places)] = [STARTS, SORTED_ID, SORTED_POSITION].map(|name| list.grid.field(name));
    let elements = list.elements(count);
    let mut sizes: Vec<(Name, u64)> = grid.sizes;
    sizes.extend([
        (LIST.into(), elements),
        (FOUND.into(), elements),
        (LIST_STATE.into(), 1),
        (GO.into(), words),
        (ALL.into(), words),
        (ALARM.name.into(), ALARM_WORDS as u64),
        (BEFORE.into(), elements),
        (HISTORY.into(), list.words(count)),
        (HISTORY_BEFORE.into(), list.words(count) / 2),
    ]);
    let mut tables: Vec<(Name, Arc<Vec<u32>>)> = vec![(ALL.into(), Arc::new(all))];
    for (name, words) in list.tables() {
        sizes.push((name.clone(), words.len() as u64));
        tables.push((name, words));
    }
    let mut scratch = grid.scratch;
    scratch.extend([starts, ids, places]);
    scratch.extend([FOUND, GO, BEFORE, ROW_BEFORE, HISTORY_BEFORE].map(Name::from));
    Ok(Kernel {
        name: list.title(),
        passes,
        reference: Some(Arc::new(move |host: &Host| list.update(host).map(|_| ()))),
        sizes,
        scratch,
        tables,
    })
}

/// Finds the neighbours of all particles, fixed ones too, in the order of the cells.
fn search(list: &List, problem: &Problem) -> Result<Vec<Pass>, Error> {
    let candidate = Candidate {
        particle: if near::broadcasts(&problem.machine) {
            crate::shader!("neighbors/list_stored.wgsl")
        } else {
            crate::shader!("neighbors/list_candidate.wgsl")
        },
        broadcast: crate::shader!("neighbors/list_broadcast.wgsl"),
        listed: None,
    };
    let mut sources = near::ground();
    sources.push(list.grid.present(problem));
    let eight = crate::shader!("neighbors/list_eight.wgsl");
    sources.extend(near::search_by(&list.grid, &problem.machine, candidate, eight));
    sources.extend([crate::shader!("own/no_turns.wgsl"), crate::shader!("neighbors/list_search.wgsl")]);
    let shader = Shader::join(&sources)?;
    let mut constants = problem.constants(&shader);
    constants.extend([("REACH", list.shape.reach()), (ROOM, f64::from(list.shape.capacity))]);
    if near::broadcasts(&problem.machine) {
        constants.push(("MOST", f64::from(most(list.shape.capacity))));
    }
    near::passes(&list.grid, &Pass { constants, ..Pass::new(shader, 0) }, problem.capacity, problem)
}

fn state() -> Source {
    crate::shader!("neighbors/list_state.wgsl")
}

/// Checks whether a particle has moved too far.
fn moved(list: &List, problem: &Problem) -> Result<Pass, Error> {
    let shader = Shader::join(&[
        crate::shader!("world.wgsl"),
        crate::shader!("fields.wgsl"),
        problem.active(),
        state(),
        crate::shader!("neighbors/list_moved.wgsl"),
    ])?;
    let mut constants = problem.constants(&shader);
    constants.push(("LIMIT", list.limit()));
    if problem.elastic.is_some() {
        constants.push(("REACH", list.shape.reach()));
    }
    Ok(Pass { constants, ..Pass::new(shader, problem.capacity) })
}

/// Saves the history of pairs, and restores it after the rebuild.
fn history(list: &List, problem: &Problem) -> Result<[Pass; 2], Error> {
    let pass = |file: Source, layers: u32| -> Result<Pass, Error> {
        let ground = [
            crate::shader!("world.wgsl"),
            crate::shader!("fields.wgsl"),
            state(),
            crate::shader!("neighbors/history.wgsl"),
        ];
        let shader = Shader::join(&[&ground[..], &[file]].concat())?;
        let constants = vec![("SLOTS", f64::from(list.shape.words))];
        let threads = Threads { count: problem.capacity, layers };
        let work = u64::from(problem.capacity) * u64::from(list.shape.capacity);
        Ok(Pass { constants, threads, work, ..Pass::new(shader, problem.capacity) })
    };
    let save = pass(crate::shader!("neighbors/list_save.wgsl"), list.shape.capacity / 4)?;
    Ok([save, pass(crate::shader!("neighbors/list_match.wgsl"), 1)?])
}

/// Takes pairs of few bonds out of each row.
fn exclude(list: &List, problem: &Problem) -> Result<Pass, Error> {
    let files =
        [crate::shader!("world.wgsl"), crate::shader!("fields.wgsl"), crate::shader!("neighbors/list_exclude.wgsl")];
    let work = u64::from(problem.capacity) * u64::from(list.shape.capacity);
    Ok(Pass { work, ..Pass::new(Shader::join(&files)?, problem.capacity) })
}

/// Sorts the neighbours of each row by their ids.
fn order(list: &List, problem: &Problem) -> Result<Pass, Error> {
    let shader = Shader::join(&[
        crate::shader!("world.wgsl"),
        crate::shader!("fields.wgsl"),
        crate::shader!("neighbors/starts.wgsl"),
        list.grid.present(problem),
        problem.active(),
        state(),
        crate::shader!("neighbors/list_order.wgsl"),
    ])?;
    let mut constants = problem.constants(&shader);
    constants.extend(list.grid.constants(&shader));
    constants.push((ROOM, f64::from(list.shape.capacity)));
    let threads = Threads { count: problem.capacity, layers: list.shape.capacity.div_ceil(SORTED) };
    let work = u64::from(problem.capacity) * u64::from(list.shape.capacity);
    let pass = Pass { constants, threads, work, ..Pass::new(shader, problem.capacity) };
    Ok(pass.on(&[list.grid.field(STARTS)]))
}
