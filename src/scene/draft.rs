//! A first pass over a scene before its particles are created: sizes, and errors that do not depend on particles.

use crate::render;
use crate::shapes::Amount;

use super::files::Files;
use super::report::{Fault, Report};
use super::resolved::Writer;
use super::walk::Table;
use super::{bounds, column, force, motion, output, particles, shared, simulation, solver};

/// A scene with more particles and links than this is checked first: creating them takes seconds and memory.
const LARGE: f64 = 300_000.0;

/// Whether a scene is large. If so, reports errors that do not depend on its particles, and lack of memory; more
/// than `most` particles are refused at their entry.
pub(super) fn read(sections: &[(&'static str, Table<'_>)], files: &Files, most: u32, report: &mut Report) -> bool {
    let all = |name: &'static str| sections.iter().filter(move |(n, _)| *n == name).map(|(_, table)| table);
    let said = shared::said(all("force"));
    // Errors are reported once it is known that the scene is large; keys of columns are then known, too.
    let amounts: Vec<_> =
        all("particles").map(|table| (table, particles::amount(table, &said, &[], &mut Report::default()))).collect();
    let mut whole = Amount::default();
    amounts.iter().for_each(|(_, amount)| whole += *amount);
    if whole.elements() <= LARGE {
        return false;
    }
    let one = |name: &'static str| all(name).next();
    let mut out = Writer::default();
    let simulation = simulation::read(one("simulation"), all("force"), report);
    solver::read(one("solver"), &mut out, report);
    let bounds = bounds::read(one("box"), &mut out, report);
    let mut motions = Vec::new();
    for table in all("motion") {
        motions.extend(motion::read(table, &motions, (simulation.dt, &bounds), &mut out, report));
    }
    let faults = report.len();
    let chosen: Vec<_> = all("force").filter_map(|table| force::read(table, (files, &motions), report)).collect();
    let declared = column::read(all("column"), &mut out, report);
    // An invalid force may declare columns that others use.
    if report.len() == faults {
        let forces: Vec<_> = chosen.into_iter().map(force::Chosen::build).collect();
        let known = column::all(&forces, simulation.columns(), &declared, report);
        for table in all("particles") {
            particles::amount(table, &said, &column::givable(&known), report);
        }
        output::read(one("output"), (simulation.steps, simulation.dt), &known, report);
    }
    if let Some(table) = one("picture") {
        table.settings(render::KEYS, &[], report);
    }
    let largest = amounts.iter().max_by(|a, b| a.1.bytes().total_cmp(&b.1.bytes()));
    // No memory is reserved for a number of particles that is refused.
    if whole.particles <= f64::from(most)
        && let (Some((table, _)), Err(why)) = (largest, whole.fits())
    {
        report.push(Fault::at(table.place, why).label("ask for fewer"));
    }
    true
}
