//! Near pairs, and far groups as one, through a tree.

use std::ops::Range;
use std::sync::Arc;

use super::{Law, Over};
use crate::error::Error;
use crate::kernel::{
    ALARM, ALARM_WORDS, Access, Binding, Indirect, Kernel, Machine, Pass, Precision, Problem, Scalar, Shader, Side,
    Source, Threads,
};
use crate::tree::{GROUP, LEAF, Opening, Tree};

/// Storage buffers that every device can bind in a stage.
const STORAGE: usize = 8;
/// Extra dispatches in which walks continue: each stops one check too late.
const MORE: u32 = 4;
/// A walk is assumed to search the targets of its group for one of this many nodes: the others are far from all of them, or near to one
/// that has just been found. Where more are searched, the run ends with an alarm.
const SEARCHED: u64 = 4;
/// The maximum number of dispatches that continue walks: a plan contains them all.
const MOST: u32 = 1 << 15;
/// Bytes of the saved state of walks that continue.
const KEPT: u64 = 1 << 27;
/// The maximum number of targets of one dispatch: an integer of groups.
const TARGETS: u32 = 1 << 20;

/// The lowest θ: for smaller ones l / θ overflows single precision.
const LEAST: f64 = 1e-30;

/// The number of particles from which the tree is faster than direct summation. Measured on lavapipe by
/// `cargo bench --bench baselines -- tree`; for GPUs it is an estimate from an H200: all pairs take 0.2 ms for 16 384
/// and 2.6 ms for 65 536 particles; the tree takes 8 ns for each, and some 0.4 ms for launches.
#[must_use]
pub fn crossing(machine: &Machine) -> u32 {
    if machine.software { 6144 } else { 32_768 }
}

impl Over {
    /// The visit for a problem.
    #[must_use]
    pub fn chosen(self, problem: &Problem) -> Self {
        match self {
            Self::Tree { auto: true, .. } if problem.particles < crossing(&problem.machine) => Self::Pairs,
            other => other,
        }
    }
}

fn join(
    law: &Law,
    tree: &Tree,
    problem: &Problem,
    variant: Vec<Source>,
    alarm: Option<Source>,
) -> Result<Arc<Shader>, Error> {
    let mut files = vec![
        crate::shader!("world.wgsl"),
        crate::shader!("fields.wgsl"),
        crate::shader!("particle.wgsl"),
        crate::shader!("visit/tree_nodes.wgsl"),
        match tree.opening {
            Opening::Geometric { .. } => crate::shader!("visit/tree_geometric.wgsl"),
            Opening::Relative { .. } => crate::shader!("visit/tree_relative.wgsl"),
        },
        if law.of_due(problem) {
            crate::shader!("visit/tree_due.wgsl")
        } else {
            crate::shader!("visit/tree_every.wgsl")
        },
        law.distant.wgsl.clone().unwrap_or(crate::shader!("visit/tree_monopole.wgsl")),
    ];
    if law.of_due(problem) && !tree.opening.is_relative() {
        files.push(crate::shader!("visit/tree_demand.wgsl"));
    }
    files.extend(variant);
    files.push(law.result());
    files.extend(law.choice());
    files.extend(alarm);
    files.extend(law.files(problem));
    Shader::join(&files)
}

fn variant(machine: &Machine) -> Vec<Source> {
    match (machine.software, machine.subgroup) {
        (true, 8) => vec![
            crate::shader!("visit/tree_kept.wgsl"),
            crate::shader!("visit/tree_four.wgsl"),
            crate::shader!("visit/tree_broadcast.wgsl"),
            crate::shader!("visit/tree_look.wgsl"),
            crate::shader!("visit/tree_subgroup.wgsl"),
        ],
        (true, _) => vec![
            crate::shader!("visit/tree_kept.wgsl"),
            crate::shader!("visit/tree_four.wgsl"),
            crate::shader!("visit/tree_alone.wgsl"),
        ],
        (false, _) => vec![crate::shader!("visit/tree_tile.wgsl")],
    }
}

/// The number of dispatches that continue a walk, given the number of iterations that loops may take: enough for one that opens every node,
/// searches targets for a quarter of them, and evaluates every body.
fn rounds(tree: &Tree, machine: &Machine) -> u32 {
    if !machine.software {
        return 0;
    }
    let (leaves, group) = (u64::from(tree.leaves()), u64::from(GROUP));
    // Iterations of all loops, and of those that search among single targets. Eight lanes look at eight nodes at once, of which
    // each holds eight of the next, and evaluate two leaves at once; a lane alone looks at a node, or at a body.
    let (walk, search) = if machine.subgroup == 8 {
        let looks = leaves / 7 + 10;
        (5 * looks + 2 * leaves + 12 * (leaves / 64 + 2) + 2 * group, (2 * group + 16) * looks)
    } else {
        let nodes = 2 * leaves + 32;
        (2 * (nodes + u64::from(LEAF) * leaves) + group, group * nodes)
    };
    // Each dispatch starts over, and stops one check too late.
    let turns = u64::from(machine.turns).saturating_sub(2 * group).max(1);
    if walk + search <= turns {
        return 0;
    }
    u32::try_from((walk + search / SEARCHED) / turns).unwrap_or(u32::MAX).saturating_add(MORE)
}

/// Refuses columns for which the relative criterion leaves no binding; references bind nothing.
fn binds_few(law: &Law, tree: &Tree, problem: &Problem, shader: &Shader) -> Result<(), Error> {
    let machine = &problem.machine;
    let storage = shader.reflection().bindings.iter().filter(|binding| binding.access != Access::Uniform).count();
    let is_relative = tree.opening.is_relative();
    let has_demands = is_relative || law.of_due(problem);
    if storage <= STORAGE || !has_demands || *machine == Machine::HOST {
        return Ok(());
    }
    if !is_relative && storage > STORAGE + 1 {
        // Without block time steps it has too many as well, which is reported where it is compiled.
        return Ok(());
    }
    if !is_relative {
        return Err(Error::Scene(format!(
            "`{}` over a tree binds {storage} storage buffers in block time steps, and devices have {STORAGE}: leave block_levels out, or take \
             over = \"pairs\"",
            law.name
        )));
    }
    let of = if machine.software { "a software adapter" } else { "a device" };
    Err(Error::Scene(format!(
        "`{}` over a tree binds {storage} storage buffers with the relative opening criterion on {of}, and devices have {STORAGE}: \
         open by θ alone (alpha = 0), which takes one less, or take over = \"pairs\"",
        law.name
    )))
}

pub fn kernel(law: Law, tree: &Tree, problem: &Problem) -> Result<Kernel, Error> {
    law.requires_gather()?;
    law.requires_merge()?;
    let theta = tree.opening.theta();
    if !(theta > LEAST && theta <= 1.0) {
        return Err(Error::Scene(format!(
            "`{}` walks a tree with θ = {theta}: it must be above 0, and 1 at most",
            law.name
        )));
    }
    if tree.two_words && law.wgsl.law {
        return Err(Error::Scene(format!(
            "`{}` is a law of your own over a tree, whose bodies have places from a corner where precision = \"{}\": choose over = \"pairs\", \
             or precision = \"{}\"",
            law.name,
            problem.precision.name(),
            Precision::Compensated.name()
        )));
    }
    if !law.distant.images && problem.bounds.has(Side::Periodic) {
        return Err(Error::Scene(format!(
            "`{}` walks a tree in a periodic box: the nearest image jumps from side to side half a box away, and no group can \
             be taken as one there; sum over all pairs (over = \"pairs\"), or open the box",
            law.name
        )));
    }
    let machine = &law.leaves(&problem.machine);
    let shader = join(&law, tree, problem, variant(machine), law.alarm_file())?;
    binds_few(&law, tree, problem, &shader)?;
    let params = law.uniforms(&shader)?;
    let mut constants = problem.constants(&shader);
    constants.extend([("GROUP", f64::from(GROUP)), ("LEAF", f64::from(LEAF))]);
    constants.extend(law.mark());
    constants.extend(shader.reflection().known(&[("WAITING", f64::from(waiting(tree)))]));
    let each = pair_evaluations(tree, problem);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "few")]
    let mut groups = (machine.meetings as f64 / each / f64::from(GROUP)).clamp(1.0, f64::from(TARGETS / GROUP)) as u32;
    if let Some(kept) = shader.reflection().binding("tree_kept") {
        constants.push(("MOST", f64::from(machine.turns)));
        groups = groups.min(u32::try_from(KEPT / kept.stride / u64::from(GROUP)).unwrap_or(groups)).max(1);
    }
    let rounds = rounds(tree, machine).min((MOST / problem.capacity.div_ceil(groups * GROUP).max(1)).max(MORE));
    let rest = if rounds == 0 {
        None
    } else {
        let rest = vec![crate::shader!("visit/tree_kept.wgsl"), crate::shader!("visit/tree_rest.wgsl")];
        Some(join(&law, tree, problem, rest, Some(crate::shader!("own/alarm.wgsl")))?)
    };
    let mut passes = Vec::new();
    let mut first = 0;
    while first < problem.capacity {
        let end = problem.capacity.min(first.saturating_add(groups * GROUP));
        let walk = |again: u32| -> Result<Pass, Error> {
            let mut uniforms = params.clone();
            if let Some(binding) = shader.reflection().binding("tree") {
                uniforms.push(("tree", uniform(tree, binding, first..end, again)?));
            }
            let lanes = (end - first).div_ceil(GROUP) * shader.reflection().workgroup;
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an estimate")]
            let work = (each * f64::from(end - first)) as u64;
            let threads = Threads::new(lanes);
            let pass = Pass { constants: constants.clone(), uniforms, threads, work, ..Pass::new(shader.clone(), 0) };
            Ok(pass.on(&tree.fields()))
        };
        // Checks whether walks of a dispatch had to stop.
        let look = |of: &Pass, rest: &Arc<Shader>| Pass {
            constants: [&constants[..], &[("ROW", f64::from(machine.workgroups))]].concat(),
            uniforms: of.uniforms.iter().filter(|(name, _)| *name == "tree").cloned().collect(),
            fields: [&of.fields[..], &[("tree_go".into(), GO.into())]].concat(),
            ..Pass::new(rest.clone(), rest.reflection().workgroup)
        };
        passes.push(walk(0)?);
        if let Some(rest) = &rest {
            // Few walks continue, if any: the work of all of them would be an overestimate.
            let again = walk(1)?;
            let again = Pass {
                indirect: Some(Indirect { field: GO.into(), word: 0, rests: true }),
                work: again.work / 4,
                ..again
            };
            let (seen, last) = (look(&walk(0)?, rest), look(&again, rest));
            passes.push(seen);
            passes.extend(std::iter::repeat_n(again, rounds as usize));
            passes.push(last);
        }
        first = end;
    }
    let mut sizes = tree.sizes();
    sizes.push((ALARM.name.into(), ALARM_WORDS as u64));
    sizes.push((KEPT_WALKS.into(), u64::from(groups.min(tree.groups()) * GROUP)));
    sizes.push((GO.into(), 3));
    let scratch = vec![KEPT_WALKS.into(), GO.into()];
    Ok(Kernel { name: law.name, passes, reference: law.distant.walk, sizes, scratch, tables: Vec::new() })
}

/// The partial sums of the targets of a dispatch, and the positions of their walks.
const KEPT_WALKS: &str = "tree_kept";
/// The workgroup counts of dispatches that continue walks.
const GO: &str = "tree go";

/// The room for nodes that wait to be tested by `tree_tile.wgsl`: of each level at most two for each lane, or all that there are.
fn waiting(tree: &Tree) -> u32 {
    let wait = |level: u32| 1u32.checked_shl(level).map_or(2 * GROUP, |all| all.min(2 * GROUP));
    (0..=tree.height()).map(wait).sum::<u32>().max(GROUP)
}

/// The approximate number of pair evaluations that equal a target's walk: an estimate of time only.
fn pair_evaluations(tree: &Tree, problem: &Problem) -> f64 {
    let levels = f64::from(tree.height()) + 1.0;
    let theta = match tree.opening {
        Opening::Geometric { theta } => theta,
        Opening::Relative { .. } => 0.6,
    };
    // Far groups are those of a few shells on each level; one costs about as much as three of them.
    (700.0 + 180.0 * levels / theta.powi(2)).min(f64::from(problem.particles))
}

/// The block `tree` of a shader, for some targets, by their indices along the curve.
fn uniform(tree: &Tree, binding: &Binding, targets: Range<u32>, again: u32) -> Result<Vec<u8>, Error> {
    let values = [
        ("first", Scalar::Uint(targets.start)),
        ("end", Scalar::Uint(targets.end)),
        ("height", Scalar::Uint(tree.height())),
        ("widened", Scalar::Float(1.0 / tree.opening.theta() - 1.0)),
        ("again", Scalar::Uint(again)),
    ];
    binding.packed.pack("tree", &values)
}
