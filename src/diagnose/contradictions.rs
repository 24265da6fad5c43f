//! Contradictions between the parts of a scene of a fluid.

use crate::error::Error;
use crate::kernel::Machine;
use crate::simulation::Setup;
use crate::sph::{Medium, Start};
use glam::DVec3;

use super::Remark;
use super::fluid::Weight;

/// Parts that differ by less are the same.
const ALIKE: f64 = 0.01;

/// Parts of the largest pull of a force that are rounding.
const ROUNDING: f64 = 1e-9;

/// All of them, with the acceleration of the whole fluid.
pub fn all(setup: &Setup, start: &Start, weight: Weight) -> Result<Vec<Remark>, Error> {
    let mut notes = Vec::new();
    notes.extend(births(setup, &start.medium));
    notes.extend(mouths(setup, &start.medium));
    notes.extend(weighed(setup, weight)?);
    notes.extend(outside(setup));
    Ok(notes)
}

/// Emitters whose particles are not those of the fluid.
fn births(setup: &Setup, medium: &Medium) -> Option<Remark> {
    let birth = setup.state.births.iter().find(|birth| (birth.mass / medium.mass() - 1.0).abs() > ALIKE)?;
    let text = format!(
        "particles of emitter {} have mass {:.4e}, and density × spacing^{} of the force is {:.4e}",
        birth.emitter + 1,
        birth.mass,
        medium.dimensions,
        medium.mass()
    );
    Some(
        Remark::note("emitter-mass", text)
            .with("emitter", f64::from(birth.emitter + 1))
            .with("mass", birth.mass)
            .with("fluid_mass", medium.mass())
            .advice("leave out its `spacing` and `density` to take those of the force"),
    )
}

/// Emitters that spawn particles where others are.
fn mouths(setup: &Setup, medium: &Medium) -> Option<Remark> {
    let particles = &setup.state;
    let mut sites: Vec<(u32, usize)> =
        particles.births.iter().map(|birth| (birth.emitter, birth.id as usize)).collect();
    let place = |id: usize| particles.position()[id];
    // Particles that leave the same point one after another are one site.
    sites.sort_by(|a, b| (a.0, place(a.1).to_array()).partial_cmp(&(b.0, place(b.1).to_array())).unwrap_or(a.cmp(b)));
    sites.dedup_by(|a, b| a.0 == b.0 && place(a.1) == place(b.1));
    let near = 0.9 * medium.spacing;
    let low = sites.iter().map(|(_, id)| place(*id)).reduce(DVec3::min)? - near;
    let high = sites.iter().map(|(_, id)| place(*id)).reduce(DVec3::max)? + near;
    let around = |id: &usize| particles.is_active(*id) && place(*id).cmpge(low).all() && place(*id).cmple(high).all();
    let others: Vec<usize> = (0..particles.len()).filter(around).collect();
    let meets = |(_, site): &&(u32, usize)| {
        others.iter().any(|other| setup.bounds.shortest(place(*other) - place(*site)).length() < near)
    };
    let (emitter, site) = sites.iter().find(meets)?;
    let nearest = |a: &&usize, b: &&usize| {
        let way = |id: usize| setup.bounds.shortest(place(id) - place(*site)).length();
        way(**a).total_cmp(&way(**b))
    };
    let other = others.iter().min_by(nearest)?;
    let distance = setup.bounds.shortest(place(*other) - place(*site)).length();
    let text = format!(
        "emitter {} spawns particles where other particles are: particle {other} is {distance:.3e} from a point of its nozzle, and the spacing \
         is {}",
        emitter + 1,
        medium.spacing
    );
    Some(
        Remark::note("blocked-emitter", text)
            .with("emitter", f64::from(emitter + 1))
            .with("particle", *other as f64)
            .with("distance", distance)
            .advice("move one of them"),
    )
}

/// A weight that the fluid's keys give, and another that forces give.
fn weighed(setup: &Setup, Weight { pull: weight, largest }: Weight) -> Result<Option<Remark>, Error> {
    let problem = setup.problem(Machine::HOST)?;
    let fluid = setup
        .forces
        .iter()
        .find_map(|force| force.resolved(&problem).map(|resolved| resolved.fluid).transpose())
        .transpose()?;
    let Some(given) = fluid.and_then(|fluid| fluid.weight) else { return Ok(None) };
    let off = (given - weight).length();
    let alike = off <= ALIKE * given.length().max(weight.length()) || off <= ROUNDING * largest.max(given.length());
    Ok((!alike).then(|| {
        let text = format!(
            "the fluid has weight = [{}, {}, {}], and forces accelerate all particles by [{}, {}, {}]: a fluid at rest would not stay at rest",
            given.x, given.y, given.z, weight.x, weight.y, weight.z
        );
        Remark::note("fluid-weight", text).with("difference", off).advice("give both the same")
    }))
}

/// Particles that begin out of a box that is open.
fn outside(setup: &Setup) -> Option<Remark> {
    let (particles, bounds) = (&setup.state, &setup.bounds);
    let extent: Vec<usize> = (0..3).filter(|axis| bounds.high[*axis] > bounds.low[*axis]).collect();
    let fixed = particles.fixed();
    let out = |id: &usize| {
        let x = particles.position()[*id];
        let beyond = |axis: &usize| x[*axis] < bounds.low[*axis] || x[*axis] > bounds.high[*axis];
        particles.is_active(*id) && !fixed[*id] && extent.iter().any(beyond)
    };
    let mut all = (0..particles.len()).filter(out);
    let first = all.next()?;
    let count = 1 + all.count();
    let text = format!(
        "{count} particles of the fluid start outside of the box, the first is particle {first} at {}: open sides do not confine particles",
        particles.position()[first]
    );
    Some(Remark::note("fluid-outside", text).with("particles", count as f64).with("particle", first as f64))
}
