//! Other limits of the step besides springs: joints, and laws of single particles with a Jacobian.

use glam::DVec3;

use crate::kernel::{Array, Host, POSITION, SPECIES, VELOCITY, World};
use crate::simulation::Setup;
use crate::visit::{Jacobian, View};

/// The largest ω² of the joints by Gershgorin's theorem, with their lengths at the start: each is k g gᵀ, with g the change of
/// its angle by the places of the three, across the way 1 / l₁, 1 / l₁ + 1 / l₂ and 1 / l₂.
pub fn joints(setup: &Setup, masses: &[f64]) -> f64 {
    let at = |id: u32| setup.state.position().get(id as usize).copied().unwrap_or_default();
    let mut rows = vec![0.0; masses.len()];
    for joint in &setup.state.links.joints {
        let [a, b, c] = joint.ids;
        let inverse = |from: u32, to: u32| 1.0 / setup.bounds.shortest(at(to) - at(from)).length();
        let (before, after) = (inverse(a, b), inverse(b, c));
        let light = |id: u32| masses.get(id as usize).map_or(0.0, |mass| 1.0 / mass.sqrt());
        let parts = [(a, before * light(a)), (b, (before + after) * light(b)), (c, after * light(c))];
        let all: f64 = parts.iter().map(|(_, part)| part).sum();
        for (id, part) in parts.iter().filter(|(_, part)| *part > 0.0) {
            if let Some(row) = rows.get_mut(*id as usize) {
                *row += joint.stiffness * part * all;
            }
        }
    }
    rows.into_iter().filter(|row| row.is_finite()).fold(0.0, f64::max)
}

/// The largest stiffness and damping that laws of each particle add, by the largest sums of columns of their Jacobians at the
/// start, which bound the eigenvalues.
pub fn each(setup: &Setup) -> (f64, f64) {
    let particles = &setup.state;
    let laws: Vec<_> = setup.forces.iter().flat_map(|force| force.laws()).collect();
    let jacobians = laws.iter().filter_map(|law| match &law.jacobian {
        Some(Jacobian::Each(jvp)) => Some(jvp),
        _ => None,
    });
    let count = u32::try_from(particles.len()).unwrap_or(u32::MAX);
    let world = World { time: 0.0, dt: setup.dt, step: 0, count, free: 0, bounds: setup.bounds };
    let mut host = Host::default();
    let masses = particles.position().iter().zip(particles.mass()).map(|(x, mass)| x.extend(*mass));
    host.insert(POSITION.name, Array::Vec4(masses.collect()));
    host.insert(VELOCITY.name, Array::Vec4(particles.velocity().iter().map(|v| v.extend(0.0)).collect()));
    host.insert(SPECIES.name, Array::Uint(particles.species().to_vec()));
    host.set_world(world);
    let Ok(view) = View::of(&host) else { return (0.0, 0.0) };
    let (mut stiffness, mut damping) = (0.0, 0.0);
    for jvp in jacobians {
        let norms = view.particles().into_iter().map(|me| {
            let norm = |product: &dyn Fn(DVec3) -> DVec3| {
                [DVec3::X, DVec3::Y, DVec3::Z]
                    .map(|axis| product(axis).abs().element_sum())
                    .into_iter()
                    .fold(0.0, f64::max)
            };
            (norm(&|axis| jvp(&me, &world, axis, DVec3::ZERO)), norm(&|axis| jvp(&me, &world, DVec3::ZERO, axis)))
        });
        let most = norms.fold((0.0, 0.0), |(k, c): (f64, f64), (more, damped)| (k.max(more), c.max(damped)));
        stiffness += most.0;
        damping += most.1;
    }
    (stiffness, damping)
}
