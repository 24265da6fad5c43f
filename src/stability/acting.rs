//! Links as the springs that they are for small motions, by all laws that act on them.

use crate::links::Link;
use crate::simulation::Setup;
use crate::visit::{Jacobian, Law, Over};

/// The links of a setup with the stiffness along and across that their laws have together, at their lengths at the start; empty where no law
/// acts on them. What pairs of all particles add is not in it.
#[must_use]
pub fn acting(setup: &Setup) -> Vec<Link> {
    let laws: Vec<Law> = setup.forces.iter().flat_map(|force| force.laws()).collect();
    let springs = laws.iter().filter(|law| is_spring(law)).count() as f64;
    let bonds: Vec<f64> = laws.iter().filter(|law| law.over == Over::Links).filter_map(|law| law.longest).collect();
    if springs == 0.0 && bonds.is_empty() {
        return Vec::new();
    }
    let times = springs + bonds.len() as f64;
    let of = |link: &Link| {
        let damping = times * link.damping;
        if bonds.is_empty() {
            return Link { stiffness: springs * link.stiffness, damping, ..*link };
        }
        let places = link.ends.map(|id| setup.state.position().get(id as usize).copied().unwrap_or_default());
        let length = setup.bounds.shortest(places[1] - places[0]).length();
        // Along and across, in units of the stiffness of the link.
        let taut = !link.rope || length > link.rest;
        let slack = if length > 0.0 { (1.0 - link.rest / length).max(0.0) } else { 1.0 };
        let (mut along, mut across) = if taut { (springs, springs * slack) } else { (0.0, 0.0) };
        for longest in &bonds {
            // One that is too long ends the run, and has no stiffness.
            let part = (length / longest).powi(2);
            if part < 1.0 {
                along += (1.0 + part) / (1.0 - part).powi(2);
                across += 1.0 / (1.0 - part);
            }
        }
        let rest = if along > 0.0 { length * (1.0 - across / along) } else { 0.0 };
        Link { rest, stiffness: along * link.stiffness, damping, rope: false, ..*link }
    };
    setup.state.links.springs.iter().map(of).collect()
}

/// Whether a law is that of linear springs: one of links with a known Jacobian, at any length.
fn is_spring(law: &Law) -> bool {
    matches!(law.jacobian, Some(Jacobian::Links(_))) && law.longest.is_none()
}
