//! The fixed and kinematic particles of a `[[particles]]`.

use std::collections::BTreeSet;

use crate::motion::{Held, Hold, Motion};
use crate::settings::Kind;
use crate::state::State;

use super::report::{Fault, Report};
use super::resolved::Writer;
use super::tree::Data;
use super::value;
use super::walk::{self, Table};

pub(super) const OWN: &[&str] = &["fixed", "motion"];

/// All of an entry.
const ALL: &str = "all";

/// Fixes the particles given by the entry's `fixed`, in addition to those that its shape or its bodies fix already; all of them follow
/// `motion`, if it is given.
pub(super) fn read(
    table: &Table<'_>,
    motions: &[Motion],
    particles: &mut State,
    out: &mut Writer,
    report: &mut Report,
) {
    let faults = report.len();
    fixed(table, particles, out, report);
    let Some(entry) = table.get("motion") else { return };
    let names: Vec<_> = motions.iter().map(|motion| motion.name.as_str()).collect();
    let Some(name) = motion(table, &names, report) else { return };
    if particles.held.is_empty() && report.len() == faults {
        let fault = Fault::at(
            &entry.node.place,
            format!("no particle in {} is fixed, so the motion moves nothing", table.name),
        );
        report.push(fault.label("fix some, as in fixed = [0] or \"all\""));
    }
    let number = names.iter().position(|known| *known == name).and_then(|n| u32::try_from(n).ok()).unwrap_or(0);
    particles.held.iter_mut().for_each(|held| held.by = Hold::Motion(number));
    out.text("motion", name);
}

/// The motion given by the key `motion` of an entry; `None` if there is no name, or no such motion.
pub(super) fn motion<'a>(table: &Table<'_>, names: &[&'a str], report: &mut Report) -> Option<&'a str> {
    let entry = table.get("motion")?;
    if let (Data::Text(text), true) = (&entry.node.data, names.is_empty())
        && !text.is_empty()
    {
        let fault = Fault::at(&entry.node.place, format!("there is no motion \"{}\"", super::report::shorten(text)));
        report.push(fault.note(
            "help: add\n\n         [[motion]]\n         name = \"…\"\n         keys = [{ time = 0 }, { time = 1, shift = [1, 0, 0] }]",
        ));
        return None;
    }
    walk::choice(entry, "motion", names, report)
}

fn fixed(table: &Table<'_>, particles: &mut State, out: &mut Writer, report: &mut Report) {
    let Some(entry) = table.get("fixed") else { return };
    let mut known: BTreeSet<u32> = particles.held.iter().map(|held| held.id).collect();
    if matches!(&entry.node.data, Data::Text(word) if word == ALL) {
        let ids = 0..u32::try_from(particles.len()).unwrap_or(u32::MAX);
        particles.held.extend(ids.filter(|id| !known.contains(id)).map(|id| Held { id, by: Hold::Fixed }));
        out.text("fixed", ALL);
        return;
    }
    let Data::List(list) = &entry.node.data else {
        value::refuse::<()>(&entry.node, "fixed", "\"all\", or a list of whole numbers, as in [0, 7]", report);
        return;
    };
    let mut ids = Vec::new();
    for node in list {
        let Some(id) = value::number(node, "fixed", Kind::Whole, "a list of whole numbers, zero or above", report)
        else {
            continue;
        };
        let count = particles.len();
        if id >= count as f64 {
            let fault = Fault::at(&node.place, format!("there is no particle {id} in {}", table.name));
            report.push(fault.label(format!("it has {count}, counted from 0")));
            continue;
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole, and below the count")]
        let id = id as u32;
        if !known.insert(id) {
            report.push(Fault::at(&node.place, format!("particle {id} is fixed already")).label("name it once"));
        }
        ids.push(id.to_string());
        particles.held.push(Held { id, by: Hold::Fixed });
    }
    out.line("fixed", &format!("[{}]", ids.join(", ")));
}
