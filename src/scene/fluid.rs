//! Settings that the force `fluid` shares with the shapes and emitters of its particles: one lattice for all.

use crate::forces;
use crate::settings::{Key, Value};
use crate::shapes::{SHAPES, emitter};
use crate::state::State;

use super::emitter::EMITTER_KEYS;
use super::report::{Fault, Report};
use super::tree::{Data, Entry, Node};
use super::value;
use super::walk::Table;

fn kind<'a>(table: &Table<'_>, key: &str, of: impl Fn(&str) -> Option<&'a [Key]>) -> Option<&'a [Key]> {
    let keys = table.get(key).and_then(|entry| match &entry.node.data {
        Data::Text(kind) => of(kind),
        _ => None,
    });
    keys.filter(|keys| shared(keys).next().is_some())
}

/// The keys that shapes and the force of a fluid share.
fn shared(keys: &[Key]) -> impl Iterator<Item = &'static str> {
    keys.iter().filter(|key| key.of_fluid).map(|key| key.name)
}

fn force_keys(table: &Table<'_>) -> Option<&'static [Key]> {
    kind(table, "kind", |kind| forces::entry(kind).map(|force| force.keys))
}

/// The settings of the first force `fluid`.
pub(super) fn said<'a>(mut tables: impl Iterator<Item = &'a Table<'a>>) -> Vec<Entry> {
    let Some((table, keys)) = tables.find_map(|table| Some((table, force_keys(table)?))) else { return Vec::new() };
    let preset = |key: &str| {
        let (said, (_, value)) = table.presets(keys).find(|(_, (name, _))| *name == key)?;
        let data = match value {
            Value::Number(x) => Data::Float(*x),
            Value::Text(word) => Data::Text(word.to_string()),
            Value::Flag(is) => Data::Flag(*is),
            Value::Vector(_) | Value::Pairs(_) => return None,
        };
        let place = said.place.clone();
        Some(Entry { key: key.to_owned(), node: Node { place: place.clone(), data }, place })
    };
    shared(keys).filter_map(|key| table.get(key).cloned().or_else(|| preset(key))).collect()
}

/// The keys that a shape or an emitter with these keys leaves to the force.
fn left_out(table: &Table<'_>, keys: &[Key]) -> impl Iterator<Item = &'static str> {
    shared(keys).filter(|key| table.get(key).is_none())
}

/// The entries of a shape or an emitter for these keys, completed by those of the force.
pub(super) fn completed(table: &Table<'_>, keys: &[Key], said: &[Entry]) -> Vec<Entry> {
    let from_force = |entry: &&Entry| left_out(table, keys).any(|key| key == entry.key);
    table.entries.iter().chain(said.iter().filter(from_force)).cloned().collect()
}

/// The keys of an emitter that may be those of the fluid: a spray has none.
pub(super) fn emitter_keys(table: &Table<'_>) -> &'static [Key] {
    if table.get(emitter::SPRAY).is_some() { &[] } else { EMITTER_KEYS }
}

fn shape_keys(table: &Table<'_>) -> Option<&'static [Key]> {
    kind(table, "shape", |name| SHAPES.iter().find(|s| s.name == name).map(|s| s.keys))
}

/// The keys of shapes and emitters that leave them to the force of the fluid, as overrides name them: `particles.0.density`.
pub(super) fn left<'a>(sections: &'a [(&'static str, Table<'a>)]) -> Vec<String> {
    let all = |name: &'static str| sections.iter().filter(move |(n, _)| *n == name).map(|(_, table)| table).enumerate();
    let shapes = all("particles").filter_map(|(place, table)| Some((place, "particles", table, shape_keys(table)?)));
    let emitters = all("emitter").map(|(place, table)| (place, "emitter", table, emitter_keys(table)));
    let named = shapes.chain(emitters).flat_map(|(place, section, table, keys)| {
        left_out(table, keys).map(move |key| format!("{section}.{place}.{key}"))
    });
    named.collect()
}

/// The contradictions between shapes or emitters and the first force `fluid`.
pub(super) fn contradictions<'a>(sections: &'a [(&'static str, Table<'a>)]) -> Vec<String> {
    let all = |name: &'static str| sections.iter().filter(move |(n, _)| *n == name).map(|(_, table)| table);
    let Some((force, keys)) = all("force").find_map(|table| Some((table, force_keys(table)?))) else {
        return Vec::new();
    };
    let shapes = all("particles").filter_map(|table| Some((table, shape_keys(table)?)));
    let mut remarks = Vec::new();
    for (table, own) in shapes.chain(all("emitter").map(|table| (table, EMITTER_KEYS))) {
        for name in shared(own) {
            let (Some(mine), theirs) = (given(table, own, name), given(force, keys, name)) else { continue };
            let preset = || force.presets(keys).find(|(_, (key, _))| *key == name).map(|(_, (_, value))| value.clone());
            let theirs = theirs.or_else(preset);
            let theirs = theirs.or_else(|| keys.iter().find(|key| key.name == name)?.default.clone());
            let Some(theirs) = theirs.filter(|theirs| *theirs != mine) else { continue };
            remarks.push(format!(
                "{} has {name} = {}, and its fluid has {name} = {}: leave it out to take the value of the force",
                table.name,
                super::resolved::value(&mine),
                super::resolved::value(&theirs)
            ));
        }
    }
    remarks
}

/// The value of a key in a table; errors are reported where it is read.
fn given(table: &Table<'_>, keys: &[Key], name: &str) -> Option<Value> {
    let key = keys.iter().find(|key| key.name == name)?;
    value::read(&table.get(name)?.node, key.name, key.kind, &mut Report::default())
}

/// Reports a force that makes a fluid without particles, or a second fluid: `earlier`: there is one already.
pub(super) fn check(table: &Table<'_>, particles: &State, earlier: bool, report: &mut Report) {
    if earlier {
        report.push(Fault::at(table.place, "there are two fluids of all particles: remove one of them"));
    } else if !particles.is_empty() && particles.held.len() == particles.len() {
        let text = "there is a fluid without particles: all particles are fixed, and fixed particles are its walls; add a [[particles]] of \
                    shape = \"block\"";
        report.push(Fault::at(table.place, text));
    }
}
