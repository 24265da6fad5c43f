//! The mutants of a file in one stage, compiled together where they can be.

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicUsize, Ordering};

use motes::kernel::Plan;

use crate::stages::Stage;
use crate::support::joint::{self, MOST, declaration, with_buffer};
use crate::support::mutants::Mutant;

/// How often a stage was shown a mutant among others, and alone.
pub static JOINED: AtomicUsize = AtomicUsize::new(0);
pub static APART: AtomicUsize = AtomicUsize::new(0);

/// A file with its mutants.
pub struct File {
    pub name: String,
    pub text: String,
    pub mutants: Vec<Mutant>,
}

/// Several mutants in the plan of a stage, of which a number chooses one.
struct Together {
    plan: Plan,
    inside: BTreeSet<usize>,
}

impl Together {
    /// Those of the mutants that compile together, if there are two and the stage is good while none of them is chosen.
    fn of(stage: &Stage, file: &File, wanted: &[usize]) -> Option<Self> {
        if !stage.shaders(&file.name).all(joint::has_room) {
            return None;
        }
        let single: BTreeSet<String> = stage.shaders(&file.name).flat_map(|s| joint::single(s.module())).collect();
        let together = Self::compiled(stage, file, wanted, &single)?;
        (together.inside.len() > 1
            && stage.verdict(&together.plan, Some(joint::choice(None))).is_ok_and(|fault| fault.is_none()))
        .then_some(together)
    }
    /// As many as compile: where all of them do not, the halves are tried.
    fn compiled(stage: &Stage, file: &File, wanted: &[usize], single: &BTreeSet<String>) -> Option<Self> {
        let (text, inside) = joint::joined(&file.text, &file.mutants, wanted, &|name| !single.contains(name));
        if inside.is_empty() {
            return None;
        }
        if let Some(plan) = stage.with(&file.name, &text, declaration) {
            return Some(Self { plan: with_buffer(plan), inside: inside.into_iter().collect() });
        }
        if inside.len() == 1 {
            return None;
        }
        let (first, second) = inside.split_at(inside.len() / 2);
        let [first, second] = [first, second].map(|half| Self::compiled(stage, file, half, single));
        let (Some(first), Some(second)) = (&first, &second) else { return first.or(second) };
        let both: Vec<usize> = first.inside.union(&second.inside).copied().collect();
        let (text, inside) = joint::joined(&file.text, &file.mutants, &both, &|name| !single.contains(name));
        let plan = with_buffer(stage.with(&file.name, &text, declaration)?);
        Some(Self { plan, inside: inside.into_iter().collect() })
    }
}

/// Whether what mutants of a file change is chosen as the language groups it: brackets around all of it change nothing.
pub fn grouped(stage: &Stage, file: &File) -> bool {
    let bracketed = joint::bracketed(&file.text, &file.mutants);
    let expressions = |text: &str| {
        let plan = stage.with(&file.name, text, |_| Vec::new()).unwrap_or_else(|| panic!("{}: brackets", file.name));
        let passes = plan.kernels.iter().flat_map(|kernel| &kernel.passes).map(|pass| pass.shader.module().clone());
        let functions = |module: naga::Module| {
            let entries: Vec<_> =
                module.entry_points.iter().map(|entry| format!("{:?}", entry.function.expressions)).collect();
            let functions = module.functions.iter().map(|(_, function)| format!("{:?}", function.expressions));
            functions.chain(entries).collect::<Vec<_>>()
        };
        passes.flat_map(functions).collect::<Vec<_>>()
    };
    expressions(&bracketed) == expressions(&file.text)
}

/// Those of the mutants that a stage does not notice.
pub fn unnoticed(stage: &Stage, file: &File, mutants: &[usize]) -> Vec<usize> {
    let all = mutants.chunks(MOST).flat_map(|some| few_unnoticed(stage, file, some)).collect();
    stage.forget();
    all
}

fn few_unnoticed(stage: &Stage, file: &File, mutants: &[usize]) -> Vec<usize> {
    let together = if mutants.len() > 1 { Together::of(stage, file, mutants) } else { None };
    let alone = |mutant: usize| {
        // A mutant that does not compile is noticed.
        stage.mutated(&file.name, &file.mutants[mutant].text).is_some_and(|plan| stage.good(&plan))
    };
    let lives = |mutant: &usize| match &together {
        // One that is too slow in company may be quick enough alone.
        Some(all) if all.inside.contains(mutant) => {
            JOINED.fetch_add(1, Ordering::Relaxed);
            stage
                .verdict(&all.plan, Some(joint::choice(Some(*mutant))))
                .map_or_else(|_| alone(*mutant), |fault| fault.is_none())
        }
        _ => {
            APART.fetch_add(1, Ordering::Relaxed);
            alone(*mutant)
        }
    };
    mutants.iter().copied().filter(lives).collect()
}
