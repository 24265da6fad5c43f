//! The masses of wall particles.

use glam::DVec3;

use super::Boxed;
use crate::error::Error;
use crate::kernel::{Kernel, POSITION, Problem, Scalar, World};
use crate::visit::{Candidate, Law, Outcome, Over, Particle, Search};

/// The mass of wall particles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WallMass {
    /// That of the fluid that they replace, if they are a layer (Akinci et al. 2012): ρ₀ / Σ W, over the walls.
    Sampled,
    /// A share of the lattice each, ρ₀ d^D, where they are several layers of it (Adami, Hu & Adams 2012).
    Lattice,
}

/// The positions, whose fourth numbers are masses, in a shader that reads them elsewhere.
const WEIGHED: &str = "weighed";

/// The kernel that gives fixed particles their masses.
///
/// # Errors
/// When the range is invalid, or a shader does not compile.
pub fn walls(of: &Boxed, weighs: WallMass, problem: &Problem) -> Result<Kernel, Error> {
    let (of, wgsl) = (of.clone(), crate::shader!("sph/walls.wgsl"));
    let over = Over::Near { range: of(&problem.bounds)?.range(), of: None };
    let law = Law::outlined("fluid walls", over, wgsl, &[WEIGHED], move |law, problem| {
        let medium = of(&problem.bounds)?;
        let search = Search { fixed: true, ..medium.search(law.over, Candidate::STILL, &[], problem)? };
        // 0: computed by the sum.
        let mass = if weighs == WallMass::Sampled { 0.0 } else { medium.mass() };
        let smoothed = medium.smoothed();
        let (walls, held) = (problem.clone(), problem.clone());
        let gather = move |_: &Particle, you: &Particle, r, _: &World, sum: &mut f64| {
            *sum += if walls.is_held(you.index) { smoothed.kernel(r) } else { 0.0 };
        };
        let finish = move |me: &Particle, sum: &f64, _: &World, outcome: &mut Outcome| {
            let sampled = medium.density / (sum + smoothed.kernel(DVec3::ZERO));
            if held.is_held(me.index) {
                let mass = if weighs == WallMass::Sampled { sampled } else { medium.mass() };
                outcome.set(POSITION.name, me.position.extend(mass));
            }
        };
        Ok(law.searched(search, vec![("mass", Scalar::Float(mass))], gather, finish))
    });
    let mut kernel = law.kernel(problem)?;
    kernel.passes.iter_mut().for_each(|pass| pass.fields.push((WEIGHED.into(), POSITION.name.into())));
    Ok(kernel)
}
