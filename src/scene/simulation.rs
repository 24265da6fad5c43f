//! `[simulation]`: the step, how many of them, and by which integrator.

use crate::integrators::{self, INTEGRATORS};
use crate::settings::{Key, Kind, Settings};

use super::report::{Fault, Place, Report};
use super::resolved::Writer;
use super::value;
use super::walk::{self, Table};

/// The device counts steps in 32 bits.
const MOST_STEPS: f64 = 4_294_967_295.0;

pub(super) const KEYS: &[Key] = &[Key::required("dt", Kind::Positive, "the length of a step [time]")];
pub(super) const OWN: &[&str] = &["steps", "until", "integrator"];

pub(super) struct Simulation {
    pub(super) dt: f64,
    pub(super) steps: u64,
    pub(super) integrator: &'static integrators::Entry,
    /// What the user may want to know.
    pub(super) remark: Option<String>,
}

pub(super) fn read(table: Option<&Table<'_>>, report: &mut Report) -> Simulation {
    let integrator = INTEGRATORS.iter().find(|i| i.name == "leapfrog").unwrap_or(&INTEGRATORS[0]);
    let mut simulation = Simulation { dt: 1.0, steps: 1, integrator, remark: None };
    let Some(table) = table else {
        let fault = Fault::missing(&Place::end(), "the section [simulation] is missing");
        report.push(fault.note("help: add\n\n         [simulation]\n         dt = 0.001\n         steps = 1000"));
        return simulation;
    };
    let faults = report.len();
    let settings: Settings = table.settings(KEYS, OWN, report);
    let has_dt = report.len() == faults || settings.number("dt") > 0.0;
    if has_dt {
        simulation.dt = settings.number("dt");
    }
    let length = table.one_of(&["steps", "until"], report);
    if let Some(entry) = length.filter(|e| e.key == "steps") {
        simulation.steps = walk::whole_from_one(entry, report).unwrap_or(1);
        #[expect(clippy::cast_precision_loss, reason = "a comparison of magnitudes")]
        if simulation.steps as f64 > MOST_STEPS {
            report.push(Fault::at(&entry.node.place, "`steps` is too large").label(format!("at most {MOST_STEPS}")));
        }
    }
    if let Some(entry) = length.filter(|e| e.key == "until") {
        let until = value::number(&entry.node, "until", Kind::Positive, &value::wanted(Kind::Positive), report);
        if let (Some(until), true) = (until, has_dt) {
            match steps(until, simulation.dt) {
                Some(steps) => {
                    simulation.steps = steps;
                    simulation.remark = remark(until, simulation.dt, steps);
                }
                None => report.push(Fault::at(&entry.node.place, "`until` is too far").label(format!(
                    "{:.3e} steps of dt = {:?}, at most {MOST_STEPS}",
                    until / simulation.dt,
                    simulation.dt
                ))),
            }
        }
    }
    if let Some(entry) = table.get("integrator") {
        let names: Vec<_> = INTEGRATORS.iter().map(|i| i.name).collect();
        if let Some(name) = walk::choice(entry, "integrator", &names, report) {
            simulation.integrator = INTEGRATORS.iter().find(|i| i.name == name).unwrap_or(integrator);
        }
    }
    simulation
}

/// The steps that reach `until`: the quotient, with its rounding forgiven, and the next whole number when it is none.
fn steps(until: f64, dt: f64) -> Option<u64> {
    let quotient = until / dt;
    // A few roundings of the quotient, of `until` and of `dt`; and never so much that a visible part of a step is lost.
    let forgiven = (quotient * 4.0 * f64::EPSILON).max(1e-9);
    let steps = (quotient - forgiven).ceil().max(1.0);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole, between 1 and 1e12")]
    (steps <= MOST_STEPS).then_some(steps as u64)
}

fn remark(until: f64, dt: f64, steps: u64) -> Option<String> {
    #[expect(clippy::cast_precision_loss, reason = "at most 1e12")]
    let end = steps as f64 * dt;
    ((end - until).abs() > 1e-6 * dt.max(until * 1e-6))
        .then(|| format!("until = {until:?} is no whole number of steps of dt = {dt:?}: {steps} steps end at {end:?}"))
}

impl Simulation {
    pub(super) fn write(&self, out: &mut Writer) {
        out.header("[simulation]");
        out.number("dt", self.dt);
        out.line("steps", &self.steps.to_string());
        out.text("integrator", self.integrator.name);
    }
}
