//! Errors of forces through a tree: truncation, by the approximation of groups, and rounding.

use glam::DVec4;

use crate::error::Error;
use crate::forces::{Component, Problem};
use crate::gpu::Gpu;
use crate::integrators::Step;
use crate::kernel::{ACCELERATION, Array, Backend, Host, POSITION, POSITION_LOW, Plan, Precision};

use super::fields;

/// Relative errors |a − a′| / |a′| of the accelerations of a sample: median, 99th percentile, maximum.
#[derive(Debug, Clone, PartialEq)]
pub struct Truncation {
    /// The law.
    pub law: String,
    /// Targets of the sample.
    pub targets: usize,
    /// The device against direct summation, in f64.
    pub device: [f64; 3],
    /// A walk of the same tree in f64 against the direct sum: truncation.
    pub walk: [f64; 3],
    /// The device against the walk in f64: rounding.
    pub rounding: [f64; 3],
}

/// Measures every law that walks a tree, at the current state of a device: evaluates it alone, and compares `targets` of its
/// particles, spread evenly over their ids. It overwrites accelerations.
///
/// # Errors
/// Errors of the device.
pub async fn truncation(
    gpu: &mut Gpu,
    forces: &[Box<dyn Component>],
    problem: &Problem,
    targets: usize,
) -> Result<Vec<Truncation>, Error> {
    let last = gpu.read(ACCELERATION.name, &Array::Vec4(Vec::new()), problem.capacity as usize).await?;
    let mut all = Vec::new();
    for force in forces {
        let law = force.laws().into_iter().find(|law| law.tree(problem).is_some());
        let Some((law, tree)) = law.and_then(|law| Some((law.clone(), law.tree(problem)?))) else { continue };
        let (Some(walk), Some(sample)) = (law.distant.walk.clone(), law.distant.sample.clone()) else { continue };
        // With the relative criterion, the last accelerations determine which nodes are opened.
        gpu.write(ACCELERATION.name, &last)?;
        let mut step = Step::new(std::slice::from_ref(force), problem.clone());
        step.evaluate();
        let plan = step.finished()?;
        let program = gpu.compile(&plan)?;
        gpu.run(&program, 1)?;
        let host = host(gpu, &plan, problem).await?;
        let Some(Array::Vec4(device)) = host.get(ACCELERATION.name) else { continue };
        // Other contributions of a force, such as long-range waves, are the same for all three, and included in the reference magnitude of errors.
        let beside = beside(gpu, &plan, &law.name, &device, problem).await?;
        host.write(ACCELERATION)?.fill(DVec4::ZERO);
        walk(&host)?;
        let Some(Array::Vec4(walked)) = host.get(ACCELERATION.name) else { continue };
        let count = device.len();
        let wanted = targets.clamp(1, count.max(1));
        let ids: Vec<usize> = (0..wanted.min(count)).map(|k| k * count / wanted).collect();
        if problem.precision == Precision::DoubleSingle {
            let low = host.read(POSITION_LOW)?.to_vec();
            host.write(POSITION)?.iter_mut().zip(low).for_each(|(x, rest)| *x += rest.with_w(0.0));
        }
        let exact: Vec<_> = sample(&host, &ids)?.into_iter().zip(&ids).map(|(a, id)| a + beside[*id]).collect();
        let device: Vec<_> = ids.iter().map(|id| device[*id]).collect();
        let walked: Vec<_> = ids.iter().map(|id| walked[*id] + beside[*id]).collect();
        all.push(Truncation {
            law: format!("{} {}", law.name, tree.name()),
            targets: ids.len(),
            device: percentiles(&device, &exact),
            walk: percentiles(&walked, &exact),
            rounding: percentiles(&device, &walked),
        });
    }
    gpu.write(ACCELERATION.name, &last)?;
    Ok(all)
}

/// The accelerations that the plan's kernels after that of a law have added, on the device.
async fn beside(gpu: &mut Gpu, plan: &Plan, law: &str, all: &[DVec4], problem: &Problem) -> Result<Vec<DVec4>, Error> {
    let mut behind = plan.steps().skip_while(|kernel| kernel.name != law);
    let (Some(law), Some(_)) = (behind.next(), behind.next()) else { return Ok(vec![DVec4::ZERO; all.len()]) };
    // The tree is built; accelerations are cleared and summed again, for this law only.
    let zeros = Array::Vec4(vec![DVec4::ZERO; all.len()]);
    gpu.write(ACCELERATION.name, &zeros)?;
    let program = gpu.compile(&Plan::of([law.clone()]))?;
    gpu.run(&program, 1)?;
    let own = gpu.read(ACCELERATION.name, &zeros, problem.capacity as usize).await?;
    let Array::Vec4(own) = own else { return Ok(vec![DVec4::ZERO; all.len()]) };
    Ok(all.iter().zip(own).map(|(all, own)| *all - own).collect())
}

/// The fields of a plan, on the host.
async fn host(gpu: &mut Gpu, plan: &Plan, problem: &Problem) -> Result<Host, Error> {
    let mut host = Host::default();
    for kernel in &plan.kernels {
        for (name, bytes, kind, _) in fields(kernel, problem.capacity) {
            if !host.contains(&name) && gpu.size(&name) >= bytes {
                host.insert(&name, kind.like(&gpu.bytes(&name, 0, bytes).await?));
            }
        }
    }
    for name in [crate::kernel::POSITION.name, crate::kernel::VELOCITY.name] {
        if !host.contains(name) {
            let bytes = 16 * u64::from(problem.capacity);
            host.insert(name, Array::Vec4(Vec::new()).like(&gpu.bytes(name, 0, bytes).await?));
        }
    }
    host.set_world(gpu.world().await?);
    Ok(host)
}

/// Over the particles of which the reference has an acceleration.
fn percentiles(got: &[DVec4], want: &[DVec4]) -> [f64; 3] {
    let accelerated = got.iter().zip(want).filter(|(_, want)| want.truncate().length() > 0.0);
    let mut errors: Vec<f64> =
        accelerated.map(|(got, want)| (*got - *want).truncate().length() / want.truncate().length()).collect();
    errors.sort_by(f64::total_cmp);
    let at = |q: usize| errors.get((errors.len() * q / 100).min(errors.len().saturating_sub(1))).copied();
    [50, 99, 100].map(|q| at(q).unwrap_or(0.0))
}
