//! All pairs: the choice among three shaders, and the division of pair evaluations into dispatches.

use std::sync::Arc;

use super::{Law, due};
use crate::error::Error;
use crate::kernel::{Kernel, Machine, Pass, Problem, Scalar, Shader, Source, Threads};
use crate::neighbors::checked;

/// The maximum number of sources that one invocation evaluates in one dispatch: half of the 65 535 loop iterations that lavapipe allows.
const SOURCES: u32 = 1 << 15;
/// The number of particles up to which each source is added to a compensated sum, and not each block: there the time of a step does not
/// depend on it.
const FEW: u32 = 2048;
/// The maximum number of layers: more cost more to add up than they gain.
const LAYERS: u32 = 64;

/// The division of the pair evaluations of `count` particles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cut {
    /// Slices of the sources that are evaluated in parallel, each by invocations of its own.
    pub layers: u32,
    /// Sources in one slice of one dispatch; a multiple of the block.
    pub slice: u32,
}

impl Cut {
    /// Enough layers to keep the machine busy, then dispatches that are short enough; one invocation evaluates at most `sources` in one of
    /// them.
    #[must_use]
    pub fn new(count: u32, targets: u32, block: u32, machine: &Machine, sources: u32) -> Self {
        let blocks = count.div_ceil(block).max(1);
        let invocations = count.div_ceil(targets).max(1);
        let layers = (machine.invocations / invocations).clamp(1, LAYERS).min(blocks);
        let by_layers = blocks.div_ceil(layers);
        let by_work = u32::try_from(machine.meetings / u64::from(count.max(1)) / u64::from(block) / u64::from(layers))
            .unwrap_or(u32::MAX);
        let slice = by_layers.min(by_work.max(1)).min((sources / block).max(1)) * block;
        Self { layers, slice }
    }
    /// Sources that one dispatch evaluates.
    #[must_use]
    pub fn sources(self) -> u64 {
        u64::from(self.layers) * u64::from(self.slice)
    }
}

fn variant(machine: &Machine) -> Source {
    match (machine.software, machine.subgroup) {
        (true, 8) => crate::shader!("visit/pairs_subgroup.wgsl"),
        (true, _) => crate::shader!("visit/pairs_loop.wgsl"),
        (false, _) => crate::shader!("visit/pairs_tile.wgsl"),
    }
}

fn join(visit: Source, law: &Law, problem: &Problem) -> Result<Arc<Shader>, Error> {
    let mut files = vec![
        crate::shader!("world.wgsl"),
        crate::shader!("fields.wgsl"),
        problem.precision.particle(),
        crate::shader!("visit/span.wgsl"),
        if law.over.range().is_some() { crate::shader!("visit/within.wgsl") } else { crate::shader!("visit/all.wgsl") },
        if law.of_due(problem) {
            crate::shader!("visit/targets_due.wgsl")
        } else {
            crate::shader!("visit/targets_all.wgsl")
        },
        visit,
    ];
    files.push(law.result());
    files.extend(law.choice());
    files.extend(law.alarm_file());
    files.extend(law.files_with(law.sums_over_all(problem), problem));
    Shader::join(&files)
}

pub fn kernel(law: Law, problem: &Problem) -> Result<Kernel, Error> {
    let (count, machine) = (problem.capacity, &problem.machine);
    law.requires_gather()?;
    law.requires_merge()?;
    law.over.range().map_or(Ok(()), checked)?;
    let shader = join(variant(machine), &law, problem)?;
    let reflection = shader.reflection();
    let (targets, block) = (reflection.constant("TARGETS"), reflection.constant("BLOCK"));
    let sources = law.sources(SOURCES, targets, machine.software);
    let cut = Cut::new(problem.particles, targets, block, machine, sources);
    let params = law.uniforms(&shader)?;
    let mut common = problem.constants(&shader);
    common.extend(law.over.range().map(|range| ("RANGE", range)));
    common.extend(law.mark());
    // Few additions more cost nothing; many round at random.
    common.extend(
        shader.reflection().overrides.contains_key("EACH").then_some(("EACH", f64::from(u8::from(count <= FEW)))),
    );
    let whole = cut.sources() >= u64::from(count) && cut.layers == 1;

    let mut passes = Vec::new();
    let mut first = 0;
    while first < count {
        let end = u32::try_from((u64::from(first) + cut.sources()).min(u64::from(count))).unwrap_or(count);
        let values = [("first", first), ("end", end), ("slice", cut.slice)].map(|(name, n)| (name, Scalar::Uint(n)));
        let span = reflection.binding("span").map_or(Ok(Vec::new()), |b| b.packed.pack("span", &values))?;
        let mut uniforms = params.clone();
        uniforms.push(("span", span));
        passes.push(Pass {
            constants: [common.clone(), vec![("WHOLE", f64::from(u8::from(whole)))]].concat(),
            uniforms,
            threads: Threads { count: count.div_ceil(targets), layers: cut.layers },
            work: u64::from(count) * u64::from(end - first),
            ..Pass::new(shader.clone(), count)
        });
        first = end;
    }
    if !whole {
        let shader = join(crate::shader!("visit/pairs_finish.wgsl"), &law, problem)?;
        let mut constants = vec![("LAYERS", f64::from(cut.layers))];
        constants.extend(law.mark());
        // All uses of the parameters may be in `gather`.
        let used = shader.reflection().binding("params").is_some();
        let uniforms = if used { params } else { Vec::new() };
        let work = u64::from(count) * u64::from(cut.layers);
        passes.push(Pass { constants, uniforms, work, ..Pass::new(shader, count) });
    }
    let parts = if whole { 1 } else { u64::from(cut.layers) * u64::from(count) };
    let mut sizes = law.alarm();
    sizes.push(("parts".into(), parts));
    sizes.push((due::ROWS.into(), u64::from(count) + 1));
    let reference = if law.of_due(problem) { law.reference.map(due::of_due) } else { law.reference };
    Ok(Kernel { name: law.name, passes, reference, sizes, scratch: vec!["parts".into()], tables: Vec::new() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_source_is_met_once_and_no_invocation_loops_too_long() {
        let gpu = Machine { software: false, subgroup: 0, invocations: 1 << 18, ..Machine::HOST };
        let large = Machine { meetings: 1 << 33, ..gpu };
        let cpu = Machine { software: true, subgroup: 8, invocations: 1, ..Machine::HOST };
        for machine in [gpu, large, cpu] {
            for count in [1, 2, 127, 128, 129, 1000, 4096, 65_537, 1 << 20, 8_388_608, 134_217_728] {
                let cut = Cut::new(count, 4, 128, &machine, SOURCES);
                assert_eq!(cut.slice % 128, 0, "{cut:?}");
                assert!((1..=LAYERS).contains(&cut.layers) && cut.slice > 0 && cut.slice <= SOURCES, "{cut:?}");
                let met = cut.sources().min(u64::from(count)) * u64::from(count);
                // One block for each layer is the least that a dispatch can evaluate.
                let least = u64::from(cut.layers) * 128 * u64::from(count);
                assert!(met <= machine.meetings.max(least), "{count}: {cut:?} meets {met} at once");
                let dispatches = u64::from(count).div_ceil(cut.sources());
                let few = (u64::from(count) * u64::from(count) / machine.meetings).max(u64::from(count / SOURCES));
                assert!(dispatches <= 2 * few + 2, "{count}: {cut:?} is {dispatches} dispatches, of {few} at least");
            }
        }
    }
}
