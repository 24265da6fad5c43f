//! `[[measure]]`: tables that a run writes in addition to its states.

use crate::error::Error;
use crate::measure::{MEASURES, Measure, Times, measure};
use crate::settings::Settings;

use super::Scene;
use super::output::interval;
use super::report::{Fault, Report};
use super::resolved::Writer;
use super::walk::{self, Table};

pub(super) const OWN: &[&str] = &["kind", "every"];

/// A measure as the scene gives it.
#[derive(Debug, Clone, PartialEq)]
pub struct Chosen {
    /// The measure.
    pub measure: &'static Measure,
    /// Its settings.
    pub settings: Settings,
    /// Steps of dt from one row to the next; `None`: one for each output.
    pub every: Option<u64>,
}

/// Reads an entry, and writes it out.
pub(super) fn read(table: &Table<'_>, dt: f64, out: &mut Writer, report: &mut Report) -> Option<Chosen> {
    let faults = report.len();
    let Some(entry) = table.get("kind") else {
        report.push(table.lacks("kind", "a measure by its name", "what is measured"));
        return None;
    };
    let names: Vec<_> = MEASURES.iter().map(|measure| measure.name).collect();
    let measure = measure(walk::choice(entry, "measure", &names, report)?)?;
    let table = table.named(format!("{} {}", table.name, measure.name));
    let settings = table.settings(measure.keys, OWN, report);
    let every = table.get("every").and_then(|entry| interval(entry, dt, report));
    if measure.times == Times::Outputs && every.is_some() {
        let text = format!("`{}` is measured at each output, and `every` is not for it", measure.name);
        let fault = Fault::at(table.place, text);
        report.push(fault.label("remove `every`, or set [output] every"));
    }
    if report.len() > faults {
        return None;
    }
    out.header("[[measure]]");
    out.text("kind", measure.name);
    every.iter().for_each(|every| out.line("every", &every.to_string()));
    out.settings(measure.keys, &settings);
    Some(Chosen { measure, settings, every })
}

/// Reports measures that a run of the scene cannot take, each at the key concerned, or else at its table.
pub(super) fn check(scene: &mut Scene, tables: &[&Table<'_>], report: &mut Report) {
    let setup = scene.setup();
    for (one, table) in scene.measures.iter().zip(tables) {
        match (one.measure.begin)(&setup, &one.settings) {
            Ok(_) => {}
            Err(Error::Setting { key, why }) => {
                let place = table.get(key).map_or(table.place, |entry| &entry.node.place);
                report.push(Fault::at(place, why));
            }
            Err(Error::Scene(why)) => report.push(Fault::at(table.place, why)),
            Err(why) => report.push(Fault::at(table.place, why.to_string())),
        }
    }
    (scene.particles, scene.forces) = (setup.state, setup.forces);
}
