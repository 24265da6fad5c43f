//! Settings that a force shares with the shapes and emitters of the particles on which it acts: the lattice of a fluid, the universe of gravity.
//! An entry that leaves one out takes that of the first force that has it.

use crate::forces;
use crate::settings::{Key, Value};
use crate::shapes::{SHAPES, emitter};

use super::emitter::EMITTER_KEYS;
use super::report::Report;
use super::tree::{Data, Entry, Node};
use super::value;
use super::walk::Table;

/// A key of particles or of an emitter that has its value from a force.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Shared {
    /// The place of the force in the scene.
    pub force: usize,
    /// The key, in the form of an override: `particles.0.density`.
    pub path: String,
}

fn kind<'a>(table: &Table<'_>, key: &str, of: impl Fn(&str) -> Option<&'a [Key]>) -> Option<&'a [Key]> {
    let keys = table.get(key).and_then(|entry| match &entry.node.data {
        Data::Text(kind) => of(kind),
        _ => None,
    });
    keys.filter(|keys| shared(keys).next().is_some())
}

/// The keys that are shared.
fn shared(keys: &[Key]) -> impl Iterator<Item = &'static str> {
    keys.iter().filter(|key| key.shared).map(|key| key.name)
}

fn force_keys(table: &Table<'_>) -> Option<&'static [Key]> {
    kind(table, "kind", |kind| forces::entry(kind).map(|force| force.keys))
}

/// The first force that has a shared key, its place and its keys.
pub(super) fn first_with<'a>(
    mut forces: impl Iterator<Item = &'a Table<'a>>,
    name: &str,
) -> Option<(usize, &'a Table<'a>, &'static [Key])> {
    let mut place = 0;
    forces.find_map(|table| {
        let keys = force_keys(table).filter(|keys| shared(keys).any(|key| key == name));
        place += 1;
        Some((place - 1, table, keys?))
    })
}

/// The settings that forces give to shapes and emitters.
pub(super) fn said<'a>(tables: impl Iterator<Item = &'a Table<'a>>) -> Vec<Entry> {
    let tables: Vec<_> = tables.collect();
    let mut all: Vec<Entry> = Vec::new();
    for name in tables.iter().copied().filter_map(force_keys).flat_map(shared) {
        let Some((_, table, keys)) =
            first_with(tables.iter().copied(), name).filter(|_| !all.iter().any(|entry| entry.key == name))
        else {
            continue;
        };
        let preset = || {
            let (said, (_, value)) = table.presets(keys).find(|(_, (key, _))| *key == name)?;
            let data = match value {
                Value::Number(x) => Data::Float(*x),
                Value::Text(word) => Data::Text(word.to_string()),
                Value::Flag(is) => Data::Flag(*is),
                Value::Vector(_) | Value::Pairs(_) => return None,
            };
            let place = said.place.clone();
            Some(Entry { key: name.to_owned(), node: Node { place: place.clone(), data }, place })
        };
        all.extend(table.get(name).cloned().or_else(preset));
    }
    all
}

/// The keys that a shape or an emitter with these keys leaves to a force.
fn left_out(table: &Table<'_>, keys: &[Key]) -> impl Iterator<Item = &'static str> {
    shared(keys).filter(|key| table.get(key).is_none())
}

/// The entries of a shape or an emitter for these keys, completed by those of the forces.
pub(super) fn completed(table: &Table<'_>, keys: &[Key], said: &[Entry]) -> Vec<Entry> {
    let from_force = |entry: &&Entry| left_out(table, keys).any(|key| key == entry.key);
    table.entries.iter().chain(said.iter().filter(from_force)).cloned().collect()
}

/// The keys of an emitter that may be those of a fluid: a spray has none.
pub(super) fn emitter_keys(table: &Table<'_>) -> &'static [Key] {
    if table.get(emitter::SPRAY).is_some() { &[] } else { EMITTER_KEYS }
}

fn shape_keys(table: &Table<'_>) -> Option<&'static [Key]> {
    kind(table, "shape", |name| SHAPES.iter().find(|s| s.name == name).map(|s| s.keys))
}

/// The keys of shapes and emitters that leave them to a force.
pub(super) fn left<'a>(sections: &'a [(&'static str, Table<'a>)]) -> Vec<Shared> {
    let all = |name: &'static str| sections.iter().filter(move |(n, _)| *n == name).map(|(_, table)| table);
    let shapes =
        all("particles").enumerate().filter_map(|(place, table)| Some((place, "particles", table, shape_keys(table)?)));
    let emitters = all("emitter").enumerate().map(|(place, table)| (place, "emitter", table, emitter_keys(table)));
    let named = shapes.chain(emitters).flat_map(|(place, section, table, keys)| {
        left_out(table, keys).filter_map(move |key| {
            let (force, ..) = first_with(all("force"), key)?;
            Some(Shared { force, path: format!("{section}.{place}.{key}") })
        })
    });
    named.collect()
}

/// The contradictions between shapes or emitters and the first force that has a key of theirs.
pub(super) fn contradictions<'a>(sections: &'a [(&'static str, Table<'a>)]) -> Vec<String> {
    let all = |name: &'static str| sections.iter().filter(move |(n, _)| *n == name).map(|(_, table)| table);
    let shapes = all("particles").filter_map(|table| Some((table, shape_keys(table)?)));
    let mut remarks = Vec::new();
    for (table, own) in shapes.chain(all("emitter").map(|table| (table, EMITTER_KEYS))) {
        for name in shared(own) {
            let (Some(mine), Some((_, force, keys))) = (given(table, own, name), first_with(all("force"), name)) else {
                continue;
            };
            let preset = || force.presets(keys).find(|(_, (key, _))| *key == name).map(|(_, (_, value))| value.clone());
            let theirs = given(force, keys, name).or_else(preset);
            let theirs = theirs.or_else(|| keys.iter().find(|key| key.name == name)?.default.clone());
            let Some(theirs) = theirs.filter(|theirs| *theirs != mine) else { continue };
            let named = force.get("kind").and_then(|kind| value::text(&kind.node, "kind", "", &mut Report::default()));
            remarks.push(format!(
                "{} has {name} = {}, and its {} has {name} = {}: leave it out to take the value of the force",
                table.name,
                super::resolved::value(&mine),
                named.unwrap_or_default(),
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
