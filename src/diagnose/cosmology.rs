//! Universes with other matter than that of the particles, times at which they have no scale factor, and forces that do not expand with space.

use super::Remark;
use crate::component::{Component, Expands};
use crate::kernel::ACCELERATION;
use crate::settings::plain;
use crate::simulation::Setup;
use crate::visit::Over;

/// The relative difference of mean densities that is accepted.
const CLOSE: f64 = 1e-3;
/// The longest step of ln a of which nothing is said.
const LONGEST: f64 = 0.1;
/// The largest opening angle of which nothing is said, where matter is nearly uniform: before this scale factor, and for this number of particles.
const WIDEST: f64 = 0.45;
const UNIFORM: f64 = 0.2;
const MANY: usize = 4096;

/// Remarks on forces in an expanding space.
pub fn remarks(setup: &Setup, steps: u64) -> Vec<Remark> {
    let all: Vec<Expands> = setup.forces.iter().filter_map(|force| force.properties().expands).collect();
    let Some(expands) = all.first() else { return Vec::new() };
    [
        others(setup, &all),
        matter(setup, expands),
        opening(setup, expands),
        step(setup, expands, steps),
        end(setup, expands, steps),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Forces that act as if space did not expand, or in another universe.
fn others(setup: &Setup, all: &[Expands]) -> Option<Remark> {
    if all.iter().any(|one| one.expansion != all[0].expansion) {
        let text =
            "the forces are of different universes: pictures, measures and `until_redshift` are of the first one";
        return Some(
            Remark::warning("universes", text).advice("give all of them the same hubble, densities and redshift"),
        );
    }
    let accelerates = |force: &&dyn Component| {
        force.properties().expands.is_none()
            && force.laws().iter().any(|law| law.into.iter().any(|name| *name == ACCELERATION.name))
    };
    let names: Vec<&str> = setup.forces.iter().map(AsRef::as_ref).filter(accelerates).map(Component::name).collect();
    let first = names.first()?;
    let text = format!(
        "the force `{first}` acts beside gravity in an expanding space, and does not expand with it: it is a force of comoving positions in supercomoving \
         time, and the measure `expansion` takes its energy for that of gravity"
    );
    Some(Remark::warning("comoving-force", text).advice("remove it, or set hubble = 0"))
}

/// The mass in the box, against that of the universe.
fn matter(setup: &Setup, expands: &Expands) -> Option<Remark> {
    let side = setup.bounds.high - setup.bounds.low;
    let mass: f64 = setup.state.mass().iter().sum();
    let density = mass / side.element_product();
    let share = density / expands.density;
    if (share - 1.0).abs() <= CLOSE || !share.is_finite() {
        return None;
    }
    let text = format!(
        "the particles have a mean density of {density:.6e} in the box, {share:.4e} of the {:.6e} of omega_matter, hubble and g: waves do not grow as in that \
         universe",
        expands.density
    );
    let remark = Remark::warning("mean-density", text).with("density", density).with("expected", expands.density);
    Some(remark.advice("make the box as large as the matter in it, such as `side` of shape = \"cosmological\", or mend the masses or the units of g and hubble"))
}

/// A tree where the forces of nearly uniform matter cancel.
fn opening(setup: &Setup, expands: &Expands) -> Option<Remark> {
    let laws = setup.forces.iter().filter(|force| force.properties().expands.is_some()).flat_map(|force| force.laws());
    let angle = |over: Over| if let Over::Tree { opening, .. } = over { Some(opening.theta()) } else { None };
    let theta = laws.filter_map(|law| angle(law.over)).fold(0.0, f64::max);
    if theta <= WIDEST || expands.expansion.start >= UNIFORM || setup.state.len() < MANY {
        return None;
    }
    let text = format!(
        "gravity over a tree has theta = {theta}, and matter is nearly uniform at redshift {:.1}: its forces nearly cancel, and those of far groups err by a \
         good part of what is left",
        1.0 / expands.expansion.start - 1.0
    );
    Some(
        Remark::note("wide-opening", text)
            .with("theta", theta)
            .advice("set theta = 0.4, which errs by less than 1 % there"),
    )
}

/// Steps that are long for the expansion: ln a at the end of a run.
fn step(setup: &Setup, expands: &Expands, steps: u64) -> Option<Remark> {
    let expansion = &expands.expansion;
    let until = setup.dt * steps as f64;
    let known = steps != super::STEPS && until < expansion.end();
    let a = if known { expansion.scale_factor(until) } else { expansion.start };
    let part = a * a * expansion.cosmology.rate(a) * setup.dt;
    if part <= LONGEST {
        return None;
    }
    let good = setup.dt * 0.5 * LONGEST / part;
    let text = format!(
        "a step of dt = {} is {part:.3} of ln a at redshift {:.2}: growth is not resolved",
        plain(setup.dt),
        1.0 / a - 1.0 + 1e-9
    );
    Some(
        Remark::warning("long-expansion", text)
            .with("part", part)
            .advice(format!("set dt = {good:.1e} or less, or end the run earlier")),
    )
}

/// The end of the run, after that of time.
fn end(setup: &Setup, expands: &Expands, steps: u64) -> Option<Remark> {
    let (until, end) = (setup.dt * steps as f64, expands.expansion.end());
    // Where the length of a run is not known, it is assumed.
    if until < end || steps == super::STEPS {
        return None;
    }
    let text = format!(
        "the run ends at t = {until}, and the scale factor is infinite at t = {end:.6}: there forces are no numbers, and the run ends"
    );
    Some(Remark::warning("end-of-time", text).with("end", end).advice("set until_redshift, or fewer steps"))
}
