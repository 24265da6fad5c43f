//! `[[emitter]]`: pending particles, spawned by a schedule.

use crate::error::Error;
use crate::kernel::Columns;
use crate::life::Birth;
use crate::settings::{Key, Kind, Settings, Value};
use crate::shapes::emitter;
use crate::state::State;

use super::color;
use super::column;
use super::report::{Fault, Report};
use super::resolved::Writer;
use super::shared;
use super::tree::Entry;
use super::walk::Table;

pub(super) const OWN: &[&str] = &["color", "species", "first"];
/// The key of every emitter in addition to those of the library.
const SPECIES: Key = Key::new("species", Kind::Whole, Value::Number(0.0), "the species of its particles");

/// The keys of an emitter in a scene.
pub use crate::shapes::emitter::KEYS as EMITTER_KEYS;

/// An entry that was read: the number of its particles, and their colour.
pub(super) struct Emitted {
    pub(super) count: u32,
    pub(super) color: Option<[u8; 3]>,
}

/// Reads an entry, and adds its particles to the existing ones; or only their births, if a file holds these particles as pending,
/// from the id `first` on. A run of duration t continues from its state with `start` reduced by t, `first`
/// and a `count`: particles that are spawned already are not spawned again.
pub(super) fn read(
    table: &Table<'_>,
    (dimensions, end, room, said): (u32, f64, u32, &[Entry]),
    known: &Columns,
    particles: &mut State,
    out: &mut Writer,
    report: &mut Report,
) -> Option<Emitted> {
    let faults = report.len();
    let entries = shared::completed(table, shared::emitter_keys(table), said);
    let table = &Table { entries: &entries, ..table.clone() };
    let columns = column::givable(known);
    let names: Vec<&str> = OWN.iter().copied().chain(columns.iter().map(|column| column.name.as_ref())).collect();
    let settings = table.settings(EMITTER_KEYS, &names, report);
    let color = table.get("color").and_then(|e| color::read(&e.node, "color", report));
    let own: Settings = [("species", SPECIES), ("first", Key::new("first", Kind::Whole, Value::Number(0.0), ""))]
        .into_iter()
        .filter_map(|(name, key)| Some((key, table.get(name)?)))
        .filter_map(|(key, entry)| Some((key.name, super::value::read(&entry.node, key.name, key.kind, report)?)))
        .fold(Settings::default(), |all, (name, value)| all.with(name, value));
    if report.len() > faults {
        return None;
    }
    let first = table.get("first").map(|entry| (entry, own.whole("first")));
    let room = if first.is_some() { u32::MAX } else { room };
    let mut made = match emitter::build(&settings, dimensions, end, room) {
        Ok(made) => made,
        Err(Error::Scene(why) | Error::Limit(why)) => {
            report.push(Fault::at(table.place, why));
            return None;
        }
        Err(why) => {
            report.push(Fault::at(table.place, why.to_string()));
            return None;
        }
    };
    out.header("[[emitter]]");
    out.settings(EMITTER_KEYS, &settings);
    if let Some(rgb) = color {
        out.text("color", &color::shown(rgb));
    }
    out.line("species", &own.whole("species").to_string());
    let count = u32::try_from(made.len()).unwrap_or(u32::MAX);
    let Some((entry, first)) = first else {
        column::give(table, (&columns, EMITTER_KEYS), &mut made, out, report);
        let species = u32::try_from(own.whole("species")).unwrap_or(u32::MAX);
        if let Err(why) = particles.append(&made.of_species(species)) {
            report.push(Fault::at(table.place, why.to_string()));
        }
        return Some(Emitted { count, color });
    };
    out.line("first", &first.to_string());
    let keys = columns.iter().filter(|column| EMITTER_KEYS.iter().all(|key| key.name != column.name));
    for given in keys.filter_map(|column| table.get(&column.name)) {
        let fault =
            Fault::at(&given.place, format!("`{}` comes from the file where an emitter has `first`", given.key));
        report.push(fault.label("remove it"));
    }
    let have = particles.len() as u64;
    if first + u64::from(count) > have {
        let fault = Fault::at(
            &entry.node.place,
            format!("{count} particles to spawn from id {first} on are more than there are"),
        );
        report.push(fault.label(format!("there are {have}; the file must hold the pending particles of its emitters")));
        return None;
    }
    let mut births = State::default();
    births.births = made.births;
    let first = u32::try_from(first).unwrap_or(u32::MAX);
    births.births.iter_mut().for_each(|birth| *birth = Birth { id: birth.id + first, ..*birth });
    let mut emitters = State::default();
    emitters.births.clone_from(&particles.births);
    if let Err(why) = emitters.append(&births) {
        report.push(Fault::at(table.place, why.to_string()));
    }
    particles.births = emitters.births;
    Some(Emitted { count: 0, color })
}
