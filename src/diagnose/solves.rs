//! The laws that an implicit integrator solves for.

use glam::DVec3;

use super::advice::acceleration_at;
use super::{Remark, flow};
use crate::error::Error;
use crate::forces::{Law, Over};
use crate::integrators::implicit;
use crate::kernel::Machine;
use crate::simulation::Setup;

/// The laws that an implicit integrator solves for, and those that it evaluates at the start of the solve.
pub fn remark(setup: &Setup) -> Result<Remark, Error> {
    let integrator = setup.integrator.name();
    let (mut solved, mut limiting, mut constant) = (Vec::new(), Vec::new(), Vec::new());
    for (force, is_solved) in setup.forces.iter().zip(implicit(&setup.forces)) {
        for law in force.laws().into_iter().filter(|law| law.outlined.is_none()) {
            let name = format!("`{}`", law.name);
            match is_solved {
                true => solved.push(name),
                false if is_constant(&law, setup)? => constant.push(name),
                false => limiting.push(name),
            }
        }
    }
    limiting.extend(flow::flows(&setup.forces).then(|| "`fluid`".to_owned()));
    let listed = |names: Vec<String>| if names.is_empty() { "none".to_owned() } else { names.join(", ") };
    let free = if constant.is_empty() { String::new() } else { format!("; constant: {}", constant.join(", ")) };
    let (solved, limiting) = (listed(solved), listed(limiting));
    let text =
        format!("{integrator} solves for {solved}; explicit in the same step, with a limit on dt: {limiting}{free}");
    Ok(Remark::note("solved-laws", text))
}

/// Whether a law is the same everywhere, at any velocity: no step is too long for it.
fn is_constant(law: &Law, setup: &Setup) -> Result<bool, Error> {
    let (Over::Each, Some(reference)) = (law.over, &law.reference) else { return Ok(false) };
    if !law.accelerates() || law.depends_on_velocity(&setup.problem(Machine::HOST)?)? {
        return Ok(false);
    }
    let places = [DVec3::ZERO, DVec3::new(0.31, -0.23, 0.17), DVec3::new(-11.0, 17.0, 13.0)];
    let pulls = places.map(|x| acceleration_at(reference, (0.0, 0), x, setup.bounds).map(glam::DVec4::truncate));
    let [a, b, c] = pulls;
    let (a, b, c) = (a?, b?, c?);
    Ok(a == b && b == c)
}
