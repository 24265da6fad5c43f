//! Everybody meets who is near, and far groups as one, through a tree.

use super::{Law, Over};
use crate::error::Error;
use crate::kernel::{
    ALARM, ALARM_WORDS, Binding, Kernel, Machine, Pass, Problem, Scalar, Shader, Side, Source, Threads,
};
use crate::tree::{GROUP, LEAF, Opening, Tree};

/// Turns that loops may take where a driver ends them after 65 535.
const TURNS: u32 = 60_000;
/// Targets of one dispatch, at most: a whole number of groups.
const TARGETS: u32 = 1 << 18;
/// What one dispatch meets, at most: about a tenth of a second on a GPU that is not fast.
const MEETINGS: f64 = (1 << 30) as f64;

/// The θ that is none: single precision holds l / θ of what is larger.
const LEAST: f64 = 1e-30;

/// How many particles there must be before the tree is faster than that everybody meets everybody. Measured on lavapipe by
/// `motes bench tree`; for hardware it is an estimate, from the interactions of both and the rates of others.
#[must_use]
pub fn crossing(machine: &Machine) -> u32 {
    if machine.software { 6144 } else { 49_152 }
}

impl Over {
    /// What is visited for such a problem.
    #[must_use]
    pub fn chosen(self, problem: &Problem) -> Self {
        match self {
            Self::Tree { auto: true, .. } if problem.count < crossing(&problem.machine) => Self::Pairs,
            other => other,
        }
    }
}

fn join(law: &Law, tree: &Tree, machine: &Machine) -> Result<std::sync::Arc<Shader>, Error> {
    let mut files = vec![
        crate::shader!("world.wgsl"),
        crate::shader!("fields.wgsl"),
        crate::shader!("particle.wgsl"),
        crate::shader!("visit/tree_nodes.wgsl"),
        match tree.opening {
            Opening::Geometric { .. } => crate::shader!("visit/tree_geometric.wgsl"),
            Opening::Relative { .. } => crate::shader!("visit/tree_relative.wgsl"),
        },
        law.distant.wgsl.clone().unwrap_or(crate::shader!("visit/tree_monopole.wgsl")),
    ];
    files.extend(variant(machine));
    files.push(law.result());
    files.extend(law.choice());
    files.extend(law.files());
    Shader::join(&files)
}

fn variant(machine: &Machine) -> Vec<Source> {
    match (machine.software, machine.subgroup) {
        (true, 8) => vec![crate::shader!("visit/tree_broadcast.wgsl"), crate::shader!("visit/tree_subgroup.wgsl")],
        (true, _) => vec![crate::shader!("visit/tree_alone.wgsl")],
        (false, _) => vec![crate::shader!("visit/tree_tile.wgsl")],
    }
}

pub fn kernel(law: Law, tree: &Tree, problem: &Problem) -> Result<Kernel, Error> {
    law.requires_meetings()?;
    let theta = tree.opening.theta();
    if !(theta > LEAST && theta <= 1.0) {
        return Err(Error::Scene(format!(
            "`{}` walks a tree with θ = {theta}: it must be above 0, and 1 at most",
            law.name
        )));
    }
    if !law.distant.images && problem.bounds.has(Side::Periodic) {
        return Err(Error::Scene(format!(
            "`{}` walks a tree in a periodic box: the nearest image jumps from side to side half a box away, and no group can \
             be met as one there; meet everybody (over = \"pairs\"), or open the box",
            law.name
        )));
    }
    let shader = join(&law, tree, &problem.machine)?;
    let params = law.uniforms(&shader)?;
    let mut constants = problem.constants(&shader);
    let most = if problem.machine.software { TURNS } else { u32::MAX };
    constants.extend([("GROUP", GROUP), ("LEAF", LEAF), ("MOST", most)].map(|(name, n)| (name, f64::from(n))));
    constants.extend(law.mark());
    let each = meetings(tree, problem);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "few")]
    let groups = (MEETINGS / each / f64::from(GROUP)).clamp(1.0, f64::from(TARGETS / GROUP)) as u32;
    let mut passes = Vec::new();
    let mut first = 0;
    while first < problem.count {
        let end = problem.count.min(first.saturating_add(groups * GROUP));
        let mut uniforms = params.clone();
        if let Some(binding) = shader.reflection().binding("tree") {
            uniforms.push(("tree", uniform(tree, binding, first, end)?));
        }
        let lanes = (end - first).div_ceil(GROUP) * shader.reflection().workgroup;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an estimate")]
        let work = (each * f64::from(end - first)) as u64;
        let threads = Threads::new(lanes);
        let pass = Pass { constants: constants.clone(), uniforms, threads, work, ..Pass::new(shader.clone(), 0) };
        passes.push(pass.on(&tree.fields()));
        first = end;
    }
    let mut sizes = tree.sizes();
    sizes.push((ALARM.name.into(), ALARM_WORDS as u64));
    Ok(Kernel { name: law.name, passes, twin: law.distant.walk, sizes, scratch: Vec::new(), tables: Vec::new() })
}

/// About how many meetings of two a target's walk is worth: a guess of time alone.
fn meetings(tree: &Tree, problem: &Problem) -> f64 {
    let levels = f64::from(tree.height()) + 1.0;
    let theta = match tree.opening {
        Opening::Geometric { theta } => theta,
        Opening::Relative { .. } => 0.6,
    };
    // Far groups are those of a few shells on each level; one costs about as much as three meetings.
    (700.0 + 180.0 * levels / theta.powi(2)).min(f64::from(problem.count))
}

/// The block `tree` of a shader, for the targets `first` ≤ k < `end`.
fn uniform(tree: &Tree, binding: &Binding, first: u32, end: u32) -> Result<Vec<u8>, Error> {
    let values = [
        ("first", Scalar::Uint(first)),
        ("end", Scalar::Uint(end)),
        ("count", Scalar::Uint(tree.count)),
        ("leaves", Scalar::Uint(tree.leaves())),
        ("height", Scalar::Uint(tree.height())),
        ("widened", Scalar::Float(1.0 / tree.opening.theta() - 1.0)),
    ];
    binding.packed.pack("tree", &values)
}
