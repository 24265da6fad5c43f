//! Forces that take far groups as one.

use glam::DVec3;

use super::Remark;
use crate::error::Error;
use crate::forces::{Law, Over};
use crate::kernel::Machine;
use crate::simulation::Setup;
use crate::visit;

/// A tree has 2²¹ cells along each axis of the box of all: beyond this, the middle has but a few of them.
const FAR: f64 = 3e4;

/// The choice of the laws with `over = "auto"` on a machine: all pairs, or a tree.
pub fn remarks(setup: &Setup, machine: Machine) -> Result<Vec<Remark>, Error> {
    let problem = setup.problem(machine)?;
    let from = visit::crossing(&machine);
    let remark = |law: Law| match (law.over, law.chosen(&problem)) {
        (Over::Tree { auto: true, .. }, Over::Pairs) => Some({
            let why = if problem.capacity < from {
                format!("a tree is faster from about {from} particles on here")
            } else {
                "a tree cannot approximate nearest images".to_owned()
            };
            let text = format!("`{}` uses direct summation: {why}", law.name);
            Remark::note("direct-summation", text).with("crossing", f64::from(from))
        }),
        (Over::Tree { auto, opening, .. }, _) => Some({
            let since = if auto { format!("; faster from about {from} particles on here") } else { String::new() };
            let text = format!(
                "`{}` approximates far groups by a tree ({opening}{since}): `motes compare` measures the error",
                law.name
            );
            Remark::note("tree", text).with("crossing", f64::from(from))
        }),
        _ => None,
    };
    let mut all: Vec<_> = setup.forces.iter().flat_map(|force| force.laws()).filter_map(remark).collect();
    let walks = setup.forces.iter().flat_map(|force| force.laws()).any(|law| law.tree(&problem).is_some());
    if let Some(ratio) = Some(spread(setup.state.position())).filter(|ratio| walks && *ratio > FAR) {
        let text = format!(
            "one particle is {ratio:.0e} times as far from the centre as 98 % of all particles: the tree cannot resolve the others, and takes as long \
             as direct summation"
        );
        let stray = Remark::note("stray-particle", text).with("ratio", ratio);
        all.push(stray.advice("remove stray particles, or set over = \"pairs\""));
    }
    Ok(all)
}

/// The extent of all particles relative to that of the middle 98 %, each along its longest axis.
fn spread(places: &[DVec3]) -> f64 {
    let axis = |axis: usize| {
        let mut along: Vec<f64> = places.iter().map(|x| x[axis]).collect();
        along.sort_by(f64::total_cmp);
        let at =
            |hundredth: usize| along.get((along.len().saturating_sub(1)) * hundredth / 100).copied().unwrap_or(0.0);
        (at(100) - at(0), at(99) - at(1))
    };
    let sides = [axis(0), axis(1), axis(2)];
    let [all, middle] = [|s: &(f64, f64)| s.0, |s: &(f64, f64)| s.1].map(|of| sides.iter().map(of).fold(0.0, f64::max));
    if middle > 0.0 { all / middle } else { 1.0 }
}
