//! Universes whose matter is not that of the particles, and times at which they have no scale factor.

use super::Remark;
use crate::component::Expands;
use crate::simulation::Setup;

/// The relative difference of mean densities that is accepted.
const CLOSE: f64 = 1e-3;

/// Remarks on forces in an expanding space.
pub fn remarks(setup: &Setup, steps: u64) -> Vec<Remark> {
    let all = setup.forces.iter().filter_map(|force| force.properties().expands);
    all.flat_map(|expands| [matter(setup, &expands), end(setup, &expands, steps)]).flatten().collect()
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
        "the particles have a mean density of {density:.6e}, {share:.4} of the {:.6e} of omega_matter, hubble and g: waves do not grow as in that universe",
        expands.density
    );
    let remark = Remark::warning("mean-density", text).with("density", density).with("expected", expands.density);
    Some(remark.advice("multiply the masses, or divide g by that share, or set omega_matter"))
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
