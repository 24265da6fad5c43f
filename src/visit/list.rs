//! Each particle and its neighbours on the list, which is kept over several steps.

mod build;
mod reference;

pub use build::{is_list, kernel as build};
pub use reference::{Memory, remembering};

use super::{Law, Over};
use crate::error::Error;
use crate::kernel::{ALARM, ALARM_WORDS, Kernel, ListShape, Pass, Problem, Shader, Source, Threads};
use crate::links::too_many_bonds;
use crate::neighbors::{HISTORY, LIST, List};

/// Rows of one dispatch, at most. It is an integer of workgroups.
const ROWS: u32 = 1 << 20;
/// The skin at the start where none is given, as a part of the range.
const SKIN: f64 = 0.2;
/// Words of history of a pair that are held in registers, at most: the length of an array in `shaders/visit/history_held.wgsl`.
const HELD: u32 = 8;
/// The number of neighbours for which there is room where they have not been counted.
pub const UNCOUNTED: u32 = 128;

/// The list that laws share, if any is over one: it reaches as far as the longest range and skin.
///
/// # Errors
/// [`Error::Scene`] when a range or a skin is invalid.
pub fn shared(laws: &[Law], problem: &Problem) -> Result<Option<ListShape>, Error> {
    let mut shape: Option<ListShape> = None;
    let mut reach = 0.0_f64;
    // Laws that name no skin follow those that do.
    let given = laws.iter().filter_map(|law| match law.faster(problem) {
        Over::List { skin, .. } => skin,
        _ => None,
    });
    let given = given.reduce(f64::max).or(problem.skin);
    for law in laws {
        let Over::List { range, skin, slots } = law.faster(problem) else { continue };
        law.check_exclusions(problem)?;
        let (tuned, usual) = (skin.is_none(), given.unwrap_or(SKIN * range));
        let own =
            ListShape { range, skin: skin.unwrap_or(usual), exclude: law.exclude, tuned, words: slots, capacity: 4 };
        // Errors of a law's own list are reported for that law.
        let own = List::new(own, problem)?.shape;
        reach = reach.max(own.reach());
        let known = shape.unwrap_or(own);
        if shape.is_some() && known.words > 0 && slots > 0 {
            return Err(Error::Scene(format!(
                "two laws keep history of pairs, `{}` the second of them, and a list has slots for one: remove one of them, or make one \
                 law of both",
                law.name
            )));
        }
        if known.exclude != law.exclude {
            return Err(Error::Scene(format!(
                "`{}` has exclude = {}, and another law over the same list has {}: one list serves both, and lacks the same pairs for both; give \
                 them the same `exclude`, or remove it; without a barostat, over = \"near\" serves the one that has none, too",
                law.name, law.exclude, known.exclude
            )));
        }
        let (range, words, tuned) = (known.range.max(range), known.words.max(slots), known.tuned && tuned);
        shape = Some(ListShape { range, words, tuned, ..known });
    }
    // References of a law over `auto` cannot tell which of both searches it has.
    let whole = |law: &&Law| matches!(law.over, Over::Auto { .. }) && !matches!(law.faster(problem), Over::List { .. });
    if let (Some(shape), Some(law)) = (shape.filter(|shape| shape.exclude > 0), laws.iter().find(whole)) {
        return Err(Error::Scene(format!(
            "`{}` has over = \"auto\" and exclude = 0 beside a list that leaves out pairs up to {} bonds apart: set over = \"near\", or the \
             same `exclude`",
            law.name, shape.exclude
        )));
    }
    let shape = shape.map(|shape| ListShape { skin: reach - shape.range, ..shape });
    Ok(shape.map(|shape| shape.with_room(UNCOUNTED, problem.capacity)))
}

impl Law {
    /// Checks that pairs of few bonds can be left out.
    pub(super) fn check_exclusions(&self, problem: &Problem) -> Result<(), Error> {
        let (name, bonds) = (&self.name, self.exclude);
        if bonds == 0 {
            return Ok(());
        }
        if let Some(why) = too_many_bonds(f64::from(bonds)) {
            return Err(Error::Scene(format!("`{name}` has {why}")));
        }
        if !matches!(self.faster(problem), Over::List { .. }) {
            return Err(Error::Scene(format!(
                "`{name}` has exclude = {bonds}, and over = \"{}\": only a list lacks pairs that are left out; set over = \"list\"",
                self.over.name()
            )));
        }
        if problem.breaks {
            return Err(Error::Scene(format!(
                "`{name}` has exclude = {bonds}, and springs of the scene may break: the list would go on without pairs that are bonded no \
                 more; set exclude = 0, or remove what breaks them"
            )));
        }
        Ok(())
    }
    /// The file with the data of a neighbour on the list.
    fn listed(&self) -> Result<Source, Error> {
        let Some(search) = &self.search else { return Ok(crate::shader!("visit/list_neighbor.wgsl")) };
        search
            .candidate
            .listed
            .clone()
            .ok_or_else(|| Error::Scene(format!("`{}` has no visit over a kept list", self.name)))
    }
    /// The error of a law with history that names a word beyond its slots.
    pub(crate) fn lacks(&self, word: u32) -> Error {
        let Over::List { slots, .. } = self.over else { return Error::Scene(format!("`{}` has no slots", self.name)) };
        Error::Scene(format!(
            "{}: the law names word {word} of a pair's history, counted from 0, and slots = {slots}: what it remembers there would be lost; set \
             slots = {}",
            self.wgsl.file,
            word.saturating_add(1)
        ))
    }
}

/// The kernel of a law over the list, with `slots` words of history.
pub fn kernel(law: Law, range: f64, slots: u32, problem: &Problem) -> Result<Kernel, Error> {
    law.requires_gather()?;
    let asks = ["recall", "remember"].into_iter().find(|function| law.wgsl.needs(function));
    if let Some(function) = asks.filter(|_| slots == 0) {
        return Err(Error::Scene(format!(
            "{}: `{function}` is for a law with history of pairs: set the number of variables of each pair, as in slots = 3",
            law.wgsl.file
        )));
    }
    let list = match problem.list {
        Some(shape) => List::new(shape, problem)?,
        None => match shared(std::slice::from_ref(&law), problem)? {
            Some(shape) => List::new(shape, problem)?,
            None => return Err(Error::Scene(format!("`{}` uses no neighbour list", law.name))),
        },
    };
    let mut sources = vec![
        crate::shader!("world.wgsl"),
        crate::shader!("fields.wgsl"),
        law.listed()?,
        crate::shader!("visit/list.wgsl"),
        crate::shader!("visit/near_conclude.wgsl"),
        law.result(),
    ];
    sources.extend(law.search.iter().flat_map(|search| search.files.clone()));
    sources.extend(law.choice());
    sources.extend(law.alarm_file());
    let mut sizes = law.alarm();
    match slots {
        0 => sources.push(crate::shader!("visit/list_plain.wgsl")),
        _ => sources.extend([
            crate::shader!("neighbors/history.wgsl"),
            crate::shader!("visit/list_history.wgsl"),
            if slots <= HELD {
                crate::shader!("visit/history_held.wgsl")
            } else {
                crate::shader!("visit/history_stored.wgsl")
            },
        ]),
    }
    sources.extend(law.files(problem));
    // A user's law may have such a function of its own.
    let tables = if law.search.is_some() { problem.hold(&mut sources) } else { Vec::new() };
    let known = [sources.clone(), vec![crate::shader!("own/no_words.wgsl")]].concat();
    let mut shader = Shader::join(if slots > 0 { &known } else { &sources })?;
    // Contacts of ours name words beyond those that a material keeps, which are 0.
    let words = shader.words();
    if let Some(word) = words.highest.filter(|word| slots > 0 && law.wgsl.law && *word >= slots) {
        return Err(law.lacks(word));
    }
    if slots > 0 && law.wgsl.law && words.computed {
        if sizes.is_empty() {
            sources.push(crate::shader!("own/alarm.wgsl"));
            sizes.push((ALARM.name.into(), ALARM_WORDS as u64));
        }
        sources.push(crate::shader!("own/words.wgsl"));
        shader = Shader::join(&sources)?;
    }
    let (uniforms, mut constants) = (law.uniforms(&shader)?, problem.constants(&shader));
    constants.extend(law.mark());
    constants.push(("RANGE", range));
    if slots > 0 {
        constants.push(("SLOTS", f64::from(slots)));
    }
    constants.extend(law.search.iter().flat_map(|search| shader.reflection().known(&search.constants)));
    let mut passes = Vec::new();
    let mut first = 0;
    while first < problem.capacity {
        let rows = ROWS.min(problem.capacity - first);
        let mut pass =
            Pass { constants: constants.clone(), uniforms: uniforms.clone(), ..Pass::new(shader.clone(), 0) };
        if first > 0 {
            pass.constants.push(("FIRST_ROW", f64::from(first)));
        }
        let work = u64::from(rows) * u64::from(list.shape.capacity);
        passes.push(Pass { threads: Threads::new(rows), work, ..pass });
        first += rows;
    }
    sizes.extend([(LIST.into(), list.elements(problem.capacity)), (HISTORY.into(), list.words(problem.capacity))]);
    let tables = tables.into_iter().chain(list.excluding(problem)?.tables()).collect();
    let mut kernel = Kernel { name: law.name, passes, reference: law.reference, sizes, scratch: Vec::new(), tables };
    law.search.iter().for_each(|search| search.bind(&mut kernel));
    Ok(kernel)
}
