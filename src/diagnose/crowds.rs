//! Remarks on crowds: steps that friction between pedestrians does not allow.

use super::Remark;
use super::steps::digits;
use crate::crowds::{self, Press};
use crate::error::Error;
use crate::simulation::Setup;

/// Steps above this part of the stability limit of two are remarked on at least: sliding velocities change their sign in each of them.
const ALTERNATING: f64 = 0.5;

/// The most pedestrians that one may touch in a plane: discs of the smallest radius around one of the largest.
fn contacts(radii: impl Iterator<Item = f64>) -> f64 {
    let (small, large) = radii.filter(|r| *r > 0.0).fold((f64::INFINITY, 0.0_f64), |(a, b), r| (a.min(r), b.max(r)));
    // Of one radius six: rounding must not make five of them.
    if large > 0.0 { (std::f64::consts::PI / (small / (small + large)).asin() + 1e-9).floor() } else { 1.0 }
}

/// The fastest rate of a contact of two pedestrians that meet head on, each at the largest speed that there is.
struct Fastest {
    /// The largest overlap, at which all of the energy is in the body force \[length\].
    overlap: f64,
    /// What sets the rate.
    what: &'static str,
    /// The longest step at which it is stable \[time\].
    dt: f64,
}

impl Fastest {
    fn of(press: &Press, (mass, speed, radius): (f64, f64, f64)) -> Self {
        let [pressing, rubbing] = [press.stiffness, press.friction].map(|x| 2.0 * x / mass);
        // Half of a mass at twice the speed, against k g² / 2; discs overlap by no more than their radii.
        let free = if pressing > 0.0 { 2.0 * speed / pressing.sqrt() } else { f64::INFINITY };
        let overlap = free.min(2.0 * radius);
        let steepness = pressing + 2.0 * press.repulsion / (press.decay * mass) * (overlap / press.decay).exp();
        let friction = Self { overlap, what: "friction", dt: 2.0 / (rubbing * overlap) };
        let push = Self { overlap, what: "repulsion", dt: 2.0 / steepness.sqrt() };
        if friction.dt < push.dt { friction } else { push }
    }
}

/// The remarks; none where no pedestrians press.
///
/// # Errors
/// [`Error::Scene`] for steps in which contacts are unstable, and for particles or exits without a way.
pub fn remarks(setup: &Setup) -> Result<Vec<Remark>, Error> {
    ways(setup)?;
    let (state, dt) = (&setup.state, setup.dt);
    let mut remarks: Vec<Remark> = walls(setup).into_iter().collect();
    let presses = setup.forces.iter().filter_map(|force| force.properties().presses);
    let column = |name: &str| state.scalar(name).unwrap_or_default().iter().copied();
    // Of what is there at the start, and what is to be spawned, which has no mass until then.
    let masses = state.mass().iter().copied().chain(state.births.iter().map(|birth| birth.mass));
    let mass = masses.filter(|mass| *mass > 0.0).fold(f64::INFINITY, f64::min);
    let velocities = state.velocity().iter().chain(state.births.iter().map(|birth| &birth.velocity));
    let speeds = velocities.map(|v| v.length()).chain(column("desired_speed"));
    let extremes = (mass, speeds.fold(0.0, f64::max), column("radius").fold(0.0, f64::max));
    let Some(fastest) = presses.map(|press| Fastest::of(&press, extremes)).min_by(|a, b| a.dt.total_cmp(&b.dt)) else {
        return Ok(remarks);
    };
    // Each contact acts along, or across, its own direction only: of n all around half of the sum along any one.
    let contacts = contacts(column("radius"));
    let safe = fastest.dt * ALTERNATING.min(2.0 / contacts);
    if dt <= safe {
        return Ok(remarks);
    }
    let Fastest { overlap, what, dt: limit } = fastest;
    let text = format!(
        "dt = {dt} is too long for the {what} of pedestrians: two that meet at {} each overlap by {}, and their {what} is stable up to dt = {}",
        digits(extremes.1),
        digits(overlap),
        digits(limit)
    );
    let way = format!("the largest dt that is safe is {}: set it, or choose a smaller `{what}`", digits(safe));
    if dt > limit {
        return Err(Error::Scene(format!("{text}: they would be thrown about, and through walls; {way}")));
    }
    let crowd = format!(
        "in a crowd each touches {contacts} at most, whose {what} together is stable up to dt = {}",
        digits(limit * 2.0 / contacts)
    );
    let remark = Remark::warning(
        "long-step",
        format!("{text}; {crowd}: beyond half of a limit velocities change their sign in each step"),
    );
    let remark = remark.with("dt", dt).with("largest_dt", safe).with("contacts", contacts);
    remarks.push(remark.advice(way));
    Ok(remarks)
}

/// Where nothing keeps pedestrians on the floor of a plan.
fn walls(setup: &Setup) -> Option<Remark> {
    let keeps_in = setup.forces.iter().any(|force| force.properties().keeps_in);
    let plan = setup.state.floor_plan.as_ref().filter(|_| !keeps_in)?;
    let text = format!(
        "the plan has {} walls, and no force makes pedestrians stop at them: those that are pushed, or are fast, walk through",
        plan.segments().len()
    );
    Some(
        Remark::warning("open-walls", text)
            .with("walls", plan.segments().len() as f64)
            .advice("add a [[force]] of kind = \"social_wall\""),
    )
}

/// Remarks on what a component does that sets velocities: what leads pedestrians, and what is lost.
pub fn overridden(setup: &Setup, name: &str) -> Vec<Remark> {
    let mut remarks = Vec::new();
    let all = || setup.forces.iter().map(|force| (force, force.properties()));
    let gives = |law: &crate::visit::Law| law.into.iter().any(|column| column == crowds::DIRECTION.name);
    if !all().any(|(force, its)| its.leads || force.laws().iter().any(gives)) {
        let text =
            format!("`{name}` follows the desired directions of pedestrians, and nothing gives them any: they stand");
        remarks
            .push(Remark::warning("no-direction", text).advice("add a [[force]] of kind = \"walk\" or \"navigate\""));
    }
    let lost = all().filter(|(force, its)| !its.leads && !its.sets_velocities && !force.laws().is_empty());
    let lost: Vec<String> = lost.map(|(force, _)| format!("`{}`", force.laws()[0].name)).collect();
    if !lost.is_empty() {
        let text = format!(
            "`{name}` sets velocities after all forces: of its pedestrians what is added by {} is lost",
            lost.join(", ")
        );
        remarks.push(Remark::note("velocities-set", text));
    }
    remarks
}

/// Refuses cells too large for pedestrians, pedestrians that have no way to an exit, and exits to which no way leads.
///
/// # Errors
/// [`Error::Scene`] with the place.
pub fn ways(setup: &Setup) -> Result<(), Error> {
    let (state, navigates) = (&setup.state, setup.forces.iter().any(|force| force.properties().navigates));
    let Some(plan) = state.floor_plan.as_ref().filter(|_| navigates) else { return Ok(()) };
    let refuse = |text: String| Err(Error::Scene(text));
    if plan.exits().is_empty() {
        return refuse("the plan has no exit, so that no way leads out: add a LINESTRING on its floor".to_owned());
    }
    // The nearest centre is nearer than cell / √2, so that no wall that the disc does not overlap by 0.3 of its radius is before it.
    let radii = state.scalar("radius").unwrap_or_default().iter().copied().filter(|radius| *radius > 0.0);
    let (smallest, cell) = (radii.fold(f64::INFINITY, f64::min), plan.cell());
    if cell > smallest {
        return refuse(format!(
            "the cells of the plan have sides of {cell}, and the smallest pedestrian has the radius {smallest}: it would be led by cells on the \
             other side of a thin wall; choose cell = {} in [plan], or smaller",
            digits(smallest)
        ));
    }
    let cells = plan.cells();
    let shut = plan.exits().iter().find(|exit| !cells.reaches(plan, exit));
    if let Some(exit) = shut {
        let at = exit.path[0];
        return refuse(format!(
            "no way leads to the exit \"{}\" at {} {}: no cell of {cell} has its centre next to it in front of all walls; choose smaller cells, or \
             move it",
            exit.name, at.x, at.y
        ));
    }
    let starts = state.step == 0;
    // In a run that goes on, pedestrians may be anywhere where no walls keep them, and only few may be left.
    if starts || setup.forces.iter().any(|force| force.properties().keeps_in) {
        crowds::have_ways(plan, state)?;
    }
    if starts { crowds::reach_exits(plan, state) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::kernel::{Array, Bounds, Solver};
    use crate::settings::{Settings, Value};
    use crate::state::State;

    fn setup(dt: f64, speed: f64, friction: f64) -> Setup {
        let entry = crate::forces::entry("social_force").expect("it");
        let settings = Settings::defaults(entry.keys).with("friction", Value::Number(friction));
        let mut state = State::default();
        for x in [0.0, 2.0] {
            state.push(DVec3::X * x, DVec3::Y * speed, 80.0, 0.0);
        }
        state.declare(&crate::crowds::radius()).expect("a column");
        state.set("radius", Array::Float(vec![0.3, 0.25])).expect("radii");
        let integrator = crate::integrators::entry("leapfrog").expect("it").by_default();
        let (bounds, solver) = (Bounds::default(), Solver::default());
        Setup { state, forces: vec![(entry.build)(&settings)], integrator, dt, bounds, solver }
    }

    /// Discs of one radius have six around one; of 0.25 around 0.35 there are π / asin(0.25 / 0.6) = 7.3; a small one has room beside many large ones, of
    /// which the widest counts.
    #[test]
    fn contacts_of_discs() {
        let cases = [
            (vec![0.3, 0.3], 6.0),
            (vec![0.25, 0.35], 7.0),
            (vec![0.3], 6.0),
            (vec![0.0, 0.1, 1.0], 34.0),
            (vec![], 1.0),
        ];
        for (radii, want) in cases {
            let found = contacts(radii.iter().copied());
            assert!((found - want).abs() < 1e-9, "{radii:?}: {found}");
        }
    }

    /// Pedestrians that an emitter is to spawn have no mass at the start, and weigh a quarter of the others then: friction is four times as fast per overlap, of
    /// which there is half.
    #[test]
    fn births_count() {
        let mut later = setup(0.0015, 2.0, 2.4e5);
        later.state.births =
            vec![crate::life::Birth { id: 1, time: 1.0, velocity: DVec3::ZERO, mass: 20.0, guided: 0.0, emitter: 0 }];
        let warned = remarks(&later).expect("a warning");
        assert!((warned[0].number("largest_dt").expect("a limit") - 2.0 / 876.4 / 3.0).abs() < 2e-6, "{warned:?}");
        later.state.births[0].velocity = DVec3::X * 4.0;
        assert!(remarks(&later).expect_err("too long").to_string().contains("two that meet at 4 each"));
    }

    /// At 2 m/s each: g = 2 · 2 / √(2 · 1.2e5 / 80) = 0.0730 m, friction 2 κ g / m = 438 / s, so that steps of 2 / 438 = 4.56 ms are the limit
    /// of two; of six around one, whose directions are all about, it is a third of that. Without friction repulsion is: ω² = 3000 + 2 · 2000 / (0.08 · 80) e^(0.0730 / 0.08) = 4557 / s², 2 / ω = 29.6 ms.
    #[test]
    fn steps_that_are_too_long_are_refused_with_the_longest() {
        assert!(remarks(&setup(0.0015, 2.0, 2.4e5)).expect("short").is_empty());
        let warned = remarks(&setup(0.002, 2.0, 2.4e5)).expect("a warning");
        let largest = warned[0].number("largest_dt").expect("a limit");
        assert!(warned[0].id == "long-step" && (largest - 2.0 / 438.2 / 3.0).abs() < 2e-6, "{largest}");
        let why = remarks(&setup(0.005, 2.0, 2.4e5)).expect_err("long").to_string();
        assert!(why.contains("friction") && why.contains("dt = 0.00456") && why.contains("0.00152"), "{why}");
        assert!(remarks(&setup(0.009, 2.0, 0.0)).expect("short").is_empty());
        assert_eq!(remarks(&setup(0.011, 2.0, 0.0)).expect("a warning").len(), 1);
        let why = remarks(&setup(0.03, 2.0, 0.0)).expect_err("long").to_string();
        assert!(why.contains("repulsion") && why.contains("dt = 0.0296"), "{why}");
    }
}
