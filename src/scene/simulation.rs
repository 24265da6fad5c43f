//! `[simulation]`: the time step, the number of steps and the integrator.

use crate::integrators::{self, BlockLeapfrog, INTEGRATORS, Integrator};
use crate::interactions::gravity;
use crate::kernel::{AdaptiveStep, BlockSteps, Column, LEAST_PART, Precision};
use crate::settings::{Key, Kind, Settings, Value};

use super::report::{Fault, Place, Report};
use super::resolved::Writer;
use super::shared;
use super::tree::Entry;
use super::value;
use super::walk::{self, Table};

/// The device counts steps in 32 bits.
const MOST_STEPS: f64 = 4_294_967_295.0;

pub(super) const KEYS: &[Key] = &[
    Key::required("dt", Kind::Positive, "the length of a step, of the longest where they are adaptive [time]"),
    Key::new(
        "adaptive",
        Kind::Flag,
        Value::Flag(false),
        "whether the time step adapts to the limits of the forces; `steps` and `every` then count longest steps",
    ),
    Key::new(
        "dt_min",
        Kind::NotNegative,
        Value::Number(0.0),
        "the shortest adaptive step, below which a run ends; 0 for a thousandth of dt, with gauss_radau a millionth [time]",
    ),
    Key::new(
        "dt_before",
        Kind::NotNegative,
        Value::Number(0.0),
        "the adaptive step before the first one, from which steps grow by a fifth at most; 0: none [time]",
    ),
    Key::new(
        "cfl",
        Kind::Fraction,
        Value::Number(0.25),
        "the Courant number of adaptive steps, a factor of every limit of forces",
    ),
    Key::new(
        "block_levels",
        Kind::Whole,
        Value::Number(0.0),
        "above 0: block time steps: each particle has a step dt / 2ˡ of its own, with a level l up to this; 10 at most",
    ),
    Key::new(
        "block_eta",
        Kind::Positive,
        Value::Number(0.025),
        "the accuracy η of block time steps, which are at most √(2 η ε / |a|)",
    ),
    Key::new(
        "block_length",
        Kind::NotNegative,
        Value::Number(0.0),
        "the length ε of that; 0 for the softening of gravity [length]",
    ),
    Key::new(
        "block_mass",
        Kind::NotNegative,
        Value::Number(0.0),
        "particles that are heavier take the shortest of these steps; 0 for a hundred times the median [mass]",
    ),
    Key::new("block_shared", Kind::Flag, Value::Flag(false), "whether all particles take the shortest of these steps"),
    Key::new(
        "precision",
        Kind::Choice(&Precision::NAMES),
        Value::Text(std::borrow::Cow::Borrowed("single")),
        "how positions and velocities are kept: one number of single precision, or the sum of two (\"compensated\"), from which differences of positions are formed too (\"double_single\")",
    ),
];
/// The keys of block time steps only.
const BLOCK: [&str; 4] = ["block_eta", "block_length", "block_mass", "block_shared"];
/// The least tolerance of an integrator that estimates its error: above what rounding makes of it in double precision.
const LEAST_TOLERANCE: f64 = 1e-11;
/// The keys of adaptive steps only.
const ADAPTIVE: [&str; 3] = ["dt_min", "dt_before", "cfl"];
pub(super) const OWN: &[&str] = &["steps", "until", "until_redshift", "integrator"];

pub(super) struct Simulation {
    pub(super) dt: f64,
    pub(super) steps: u64,
    pub(super) integrator: &'static integrators::Entry,
    pub(super) integrator_settings: Settings,
    /// The adaptive time step, if steps are adaptive, and its place in the scene.
    pub(super) adaptive_step: Option<(AdaptiveStep, Place)>,
    /// The block time steps, if particles have steps of their own, and their place in the scene.
    pub(super) block_steps: Option<(BlockSteps, Place)>,
    /// The precision of positions and velocities.
    pub(super) precision: Precision,
    /// The end time.
    pub(super) until: f64,
    /// The step given in the scene, if it was reduced so that an integer of steps ends at `until`.
    pub(super) given_dt: Option<f64>,
    /// A remark for the user.
    pub(super) remark: Option<String>,
}

pub(super) fn read<'a>(
    table: Option<&Table<'_>>,
    forces: impl Iterator<Item = &'a Table<'a>> + Clone,
    report: &mut Report,
) -> Simulation {
    let integrator = INTEGRATORS.iter().find(|i| i.name == "leapfrog").unwrap_or(&INTEGRATORS[0]);
    let integrator_settings = Settings::defaults(integrator.keys);
    let mut simulation = Simulation {
        dt: 1.0,
        steps: 1,
        integrator,
        integrator_settings,
        adaptive_step: None,
        block_steps: None,
        precision: Precision::Single,
        until: 1.0,
        given_dt: None,
        remark: None,
    };
    let Some(table) = table else {
        let fault = Fault::missing(&Place::end(), "the section [simulation] is missing");
        report.push(fault.note("help: add\n\n         [simulation]\n         dt = 0.001\n         steps = 1000"));
        return simulation;
    };
    let faults = report.len();
    if let Some(entry) = table.get("integrator") {
        let names: Vec<_> = INTEGRATORS.iter().map(|i| i.name).collect();
        if let Some(name) = walk::choice(entry, "integrator", &names, report) {
            simulation.integrator = INTEGRATORS.iter().find(|i| i.name == name).unwrap_or(integrator);
        }
    }
    let keys = [KEYS, simulation.integrator.keys].concat();
    let settings: Settings = table.settings(&keys, OWN, report);
    let its = settings.0.iter().filter(|(name, _)| simulation.integrator.keys.iter().any(|key| key.name == **name));
    simulation.integrator_settings = Settings(its.map(|(name, value)| (*name, value.clone())).collect());
    let has_dt = report.len() == faults || settings.number("dt") > 0.0;
    if has_dt {
        simulation.dt = settings.number("dt");
    }
    simulation.precision = Precision::named(settings.text("precision")).unwrap_or_default();
    let length = table.one_of(&["steps", "until", "until_redshift"], report);
    if let Some(entry) = length.filter(|e| e.key == "steps") {
        simulation.steps = walk::whole_from_one(entry, report).unwrap_or(1);
        #[expect(clippy::cast_precision_loss, reason = "a comparison of magnitudes")]
        if simulation.steps as f64 > MOST_STEPS {
            report.push(Fault::at(&entry.node.place, "`steps` is too large").label(format!("at most {MOST_STEPS}")));
        }
    }
    simulation.until = simulation.steps as f64 * simulation.dt;
    if let Some(entry) = length.filter(|e| e.key != "steps") {
        let until = if entry.key == "until" {
            value::number(&entry.node, "until", Kind::Positive, &Kind::Positive.wanted(), report)
        } else {
            until_redshift(entry, forces, report)
        };
        if let (Some(until), true) = (until, has_dt) {
            match steps(until, simulation.dt) {
                Some(steps) => {
                    simulation.steps = steps;
                    simulation.until = until;
                    if let Some((dt, remark)) = divided(until, simulation.dt, steps) {
                        // The lengths of adaptive steps are determined during the run.
                        if !settings.flag("adaptive") {
                            simulation.given_dt = Some(simulation.dt);
                            simulation.dt = dt;
                            // The time of a redshift is a whole number of steps by chance alone.
                            simulation.remark = Some(remark).filter(|_| entry.key == "until");
                        }
                    }
                }
                None => report.push(Fault::at(&entry.node.place, format!("`{}` is too large", entry.key)).label(
                    format!("{:.3e} steps of dt = {:?}, at most {MOST_STEPS}", until / simulation.dt, simulation.dt),
                )),
            }
        }
    }
    simulation.adaptive_step = adaptive_step(table, &settings, &simulation, report);
    simulation.block_steps = block_steps(table, &settings, &simulation, report);
    if simulation.adaptive_step.is_some() {
        let lost = simulation.integrator.by_default().is_symplectic();
        simulation.remark = lost.then(|| {
            format!(
                "{} is not symplectic in adaptive steps: energy, which it keeps in bounds by a fixed dt, may drift (Skeel & Gear 1992)",
                simulation.integrator.name
            )
        });
    }
    simulation
}

/// The time at which the universe of the forces has a redshift.
fn until_redshift<'a>(
    entry: &Entry,
    forces: impl Iterator<Item = &'a Table<'a>> + Clone,
    report: &mut Report,
) -> Option<f64> {
    let redshift = value::number(&entry.node, "until_redshift", Kind::Number, "a redshift above -1", report)?;
    let place = &entry.node.place;
    let universe = shared::first_with(forces, "hubble").map(|(_, table, keys)| {
        // What is wrong with the force is reported where it is read.
        gravity::expansion(&table.settings(keys, &["kind"], &mut Report::default()))
    });
    if matches!(universe, Some(Err(_))) {
        return None;
    }
    let Some(Ok(Some(expansion))) = universe else {
        let fault = Fault::at(place, "`until_redshift` needs a space that expands");
        report.push(fault.label("give the force gravity a valid `hubble` above 0, or this run `until` or `steps`"));
        return None;
    };
    let time = if redshift > -1.0 { expansion.time_at(redshift) } else { f64::NAN };
    if time > 0.0 && time < expansion.end() {
        return Some(time);
    }
    let start = 1.0 / expansion.start - 1.0;
    let fault =
        Fault::at(place, format!("`until_redshift` is {redshift:?}, and the run starts at redshift {start:.6}"));
    report
        .push(fault.label("choose one below that of the start, and well above -1, where the scale factor is infinite"));
    None
}

/// The adaptive time step, if steps are adaptive.
fn adaptive_step(
    table: &Table<'_>,
    settings: &Settings,
    of: &Simulation,
    report: &mut Report,
) -> Option<(AdaptiveStep, Place)> {
    let entry = table.get("adaptive").filter(|_| settings.flag("adaptive"));
    let Some(entry) = entry else {
        for entry in ADAPTIVE.iter().filter_map(|key| table.get(key)) {
            let fault = Fault::at(&entry.place, format!("`{}` is for adaptive steps, and dt is fixed", entry.key));
            report.push(fault.label("remove it, or set adaptive = true"));
        }
        if let Some(entry) = table.get("tolerance").filter(|_| of.made().estimates_error()) {
            let fault = Fault::at(&entry.place, "`tolerance` is for adaptive steps, and dt is fixed");
            report.push(fault.label("remove it, or set adaptive = true"));
        }
        return None;
    };
    let own = of.made().estimates_error();
    if let Some(entry) = table.get("cfl").filter(|_| own) {
        let fault = format!("`cfl` is for the limits of forces, and {} estimates its error", of.integrator.name);
        report.push(Fault::at(&entry.place, fault).label("remove it; `tolerance` is what this integrator has"));
    }
    if let Some(entry) = table.get("tolerance").filter(|_| own && settings.number("tolerance") < LEAST_TOLERANCE) {
        let fault = Fault::at(&entry.node.place, "`tolerance` is out of range");
        report.push(fault.label(format!(
            "at least {LEAST_TOLERANCE:e}: rounding in double precision makes 4e-12, on a device 2e-3"
        )));
    }
    let some = |key| Some(settings.number(key)).filter(|x| *x > 0.0);
    let adaptive_step = AdaptiveStep {
        least: some("dt_min").unwrap_or(of.dt * if own { LEAST_PART } else { 1e-3 }),
        courant: settings.number("cfl"),
        before: some("dt_before"),
    };
    if let Err(error) = adaptive_step.check(of.dt) {
        report.push(Fault::at(&entry.place, "the adaptive time step is out of range").label(error.to_string()));
    }
    if let Some(why) = of.made().fixed_step() {
        let fault = format!("steps cannot be adaptive: {why}");
        report.push(Fault::at(&entry.place, fault).label("choose integrator = \"leapfrog\", or leave this out"));
    }
    Some((adaptive_step, entry.place.clone()))
}

/// The block time steps, if particles have steps of their own.
fn block_steps(
    table: &Table<'_>,
    settings: &Settings,
    of: &Simulation,
    report: &mut Report,
) -> Option<(BlockSteps, Place)> {
    let levels = settings.whole("block_levels");
    let entry = table.get("block_levels").filter(|_| levels > 0);
    let Some(entry) = entry else {
        for entry in BLOCK.iter().filter_map(|key| table.get(key)) {
            let fault =
                Fault::at(&entry.place, format!("`{}` is for block time steps, and all have one length", entry.key));
            report.push(fault.label("remove it, or set block_levels above 0"));
        }
        return None;
    };
    let steps = BlockSteps {
        levels: u32::try_from(levels).unwrap_or(u32::MAX),
        eta: settings.number("block_eta"),
        length: settings.number("block_length"),
        mass: settings.number("block_mass"),
        shared: settings.flag("block_shared"),
    };
    if let Err(error) = steps.check() {
        report.push(Fault::at(&entry.place, "block time steps are out of range").label(error.to_string()));
    }
    let of_leapfrog = |key: &str, label: &'static str| {
        let place = table.get(key).map_or(&entry.place, |entry| &entry.place);
        Fault::at(place, "block time steps are those of leapfrog, of single precision and a fixed dt").label(label)
    };
    if of.integrator.name != "leapfrog" {
        report.push(of_leapfrog("integrator", "choose \"leapfrog\", or leave out block_levels"));
    }
    if of.precision != Precision::Single {
        report.push(of_leapfrog("precision", "choose \"single\", or leave out block_levels"));
    }
    if of.adaptive_step.is_some() {
        report.push(of_leapfrog("adaptive", "leave this out, or block_levels"));
    }
    Some((steps, entry.place.clone()))
}

/// The number of steps to `until`: the quotient up to rounding errors, and the next integer if it is none.
fn steps(until: f64, dt: f64) -> Option<u64> {
    let quotient = until / dt;
    // A few rounding errors of the quotient, of `until` and of `dt`; but never a visible part of a step.
    let forgiven = (quotient * 4.0 * f64::EPSILON).max(1e-9);
    let steps = (quotient - forgiven).ceil().max(1.0);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole, between 1 and 1e12")]
    (steps <= MOST_STEPS).then_some(steps as u64)
}

/// The step with which `steps` steps end at `until`, if steps of `dt` end after it, and the remark on that.
fn divided(until: f64, dt: f64, steps: u64) -> Option<(f64, String)> {
    #[expect(clippy::cast_precision_loss, reason = "at most 1e12")]
    let count = steps as f64;
    let even = until / count;
    let text = || {
        format!(
            "until = {until:?} is no whole number of steps of dt = {dt:?}: {} of dt = {even:?} reach it",
            if steps == 1 { "one step".to_owned() } else { format!("{steps} steps") }
        )
    };
    ((count * dt - until).abs() > 1e-6 * dt.max(until * 1e-6)).then(|| (even, text()))
}

impl Simulation {
    /// The integrator, as the scene has it.
    pub(super) fn made(&self) -> Box<dyn Integrator> {
        (self.integrator.build)(&self.integrator_settings)
    }
    /// The columns of the integrator, with block time steps.
    pub(super) fn columns(&self) -> Vec<Column> {
        match &self.block_steps {
            Some((steps, _)) => BlockLeapfrog(*steps).columns(),
            None => self.made().columns(),
        }
    }
    pub(super) fn write(&self, out: &mut Writer) {
        out.header("[simulation]");
        out.number("dt", self.dt);
        match &self.adaptive_step {
            Some((adaptive_step, _)) => {
                out.number("until", self.until);
                out.line("adaptive", "true");
                out.number("dt_min", adaptive_step.least);
                adaptive_step.before.into_iter().for_each(|before| out.number("dt_before", before));
                if !self.made().estimates_error() {
                    out.number("cfl", adaptive_step.courant);
                }
            }
            None => out.line("steps", &self.steps.to_string()),
        }
        if let Some((steps, _)) = &self.block_steps {
            out.line("block_levels", &steps.levels.to_string());
            out.number("block_eta", steps.eta);
            out.number("block_length", steps.length);
            out.number("block_mass", steps.mass);
            out.line("block_shared", if steps.shared { "true" } else { "false" });
        }
        out.text("precision", self.precision.name());
        out.text("integrator", self.integrator.name);
        // What is for adaptive steps alone would be refused without them.
        if self.adaptive_step.is_some() || !self.made().estimates_error() {
            out.settings(self.integrator.keys, &self.integrator_settings);
        }
    }
}
