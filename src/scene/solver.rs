//! `[solver]`: tolerances of implicit integrators.

use crate::kernel::{LEAST_TOLERANCE, MOST_ITERATIONS, MOST_SOLVES, Solver};
use crate::settings::{Key, Kind, Value};

use super::report::{Fault, Report};
use super::resolved::Writer;
use super::walk::Table;

/// The keys of the section.
pub const SOLVER_KEYS: &[Key] = &[
    Key::new(
        "tolerance",
        Kind::Positive,
        Value::Number(1e-3),
        "the tolerance of an implicit step: the residual over the initial one",
    ),
    Key::new("iterations", Kind::Count, Value::Number(100.0), "iterations of one linear solve, at most"),
    Key::new("solves", Kind::Count, Value::Number(8.0), "linear solves of one step by Newton's method, at most"),
];

/// Reads the section, and writes it out.
pub(super) fn read(table: Option<&Table<'_>>, out: &mut Writer, report: &mut Report) -> Solver {
    let settings = match table {
        Some(table) => table.settings(SOLVER_KEYS, &[], report),
        None => crate::settings::Settings::defaults(SOLVER_KEYS),
    };
    let whole = |name: &str| u32::try_from(settings.whole(name)).unwrap_or(u32::MAX);
    let solver =
        Solver { tolerance: settings.number("tolerance"), iterations: whole("iterations"), solves: whole("solves") };
    if let Some(table) = table {
        let range = |good: bool, key: &str, label: String, report: &mut Report| {
            if let Some(entry) = table.get(key).filter(|_| !good) {
                report.push(Fault::at(&entry.node.place, format!("`{key}` is out of range")).label(label));
            }
        };
        let tolerance = (LEAST_TOLERANCE..1.0).contains(&solver.tolerance);
        range(
            tolerance,
            "tolerance",
            format!("it must be at least {LEAST_TOLERANCE:e}, the limit of single precision, and below 1"),
            report,
        );
        range(solver.iterations <= MOST_ITERATIONS, "iterations", format!("at most {MOST_ITERATIONS}"), report);
        range(solver.solves <= MOST_SOLVES, "solves", format!("at most {MOST_SOLVES}"), report);
    }
    out.header("[solver]");
    out.settings(SOLVER_KEYS, &settings);
    solver
}
