//! Other limits of the step besides springs: joints, dihedrals, and laws of single particles with a Jacobian.

use glam::DVec3;

use crate::kernel::{Array, Host, POSITION, SPECIES, VELOCITY, World};
use crate::links::{Dihedral, Joint};
use crate::simulation::Setup;
use crate::visit::{Jacobian, View};

/// The largest ω² of joints and dihedrals by Gershgorin's theorem, with their lengths at the start: each is k g gᵀ, with g the
/// change of its angle by the places of its particles; how g turns is left out. That of a joint is, across the way, 1 / l₁, 1 / l₁ + 1 / l₂ and 1 / l₂; that of a
/// dihedral one over the distance of its ends from the axis, and for those between as their levers say; its k is n² times its stiffness.
/// So often each kind is evaluated.
pub fn corners(setup: &Setup, masses: &[f64], bends: f64, twists: f64) -> f64 {
    let at = |id: u32| setup.state.position().get(id as usize).copied().unwrap_or_default();
    let way = |from: u32, to: u32| setup.bounds.shortest(at(to) - at(from));
    let light = |id: u32| masses.get(id as usize).map_or(0.0, |mass| 1.0 / mass.sqrt());
    let mut rows = vec![0.0; masses.len()];
    let mut add = |stiffness: f64, changes: &[(u32, f64)]| {
        let parts: Vec<_> = changes.iter().map(|(id, change)| (*id, change * light(*id))).collect();
        let all: f64 = parts.iter().map(|(_, part)| part).sum();
        for (id, part) in parts.into_iter().filter(|(_, part)| *part > 0.0) {
            if let Some(row) = rows.get_mut(id as usize) {
                *row += stiffness * part * all;
            }
        }
    };
    let links = &setup.state.links;
    for Joint { ids: [a, b, c], stiffness, .. } in &links.joints {
        let (before, after) = (1.0 / way(*a, *b).length(), 1.0 / way(*b, *c).length());
        add(bends * stiffness, &[(*a, before), (*b, before + after), (*c, after)]);
    }
    for Dihedral { ids: [a, b, c, d], stiffness, multiplicity, .. } in &links.dihedrals {
        let axis = way(*b, *c);
        let [near, far] = [way(*a, *b), way(*c, *d)].map(|bond| axis.length() / bond.cross(axis).length());
        // By the levers of both ends along the axis.
        let [before, after] = [way(*a, *b), way(*c, *d)].map(|bond| bond.dot(axis) / axis.length_squared());
        // Three in a line are in no plane, and exert nothing.
        if !(near.is_finite() && far.is_finite()) {
            continue;
        }
        let second = near * (1.0 + before).abs() + far * after.abs();
        let third = far * (1.0 + after).abs() + near * before.abs();
        let n = f64::from(*multiplicity);
        add(twists * stiffness.abs() * n * n, &[(*a, near), (*b, second), (*c, third), (*d, far)]);
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
