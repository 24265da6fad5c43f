//! What the force of a fluid says for the shapes that make it: one lattice for all.

use crate::forces;
use crate::particles::Shape;

use super::tree::{Data, Entry};
use super::walk::Table;

/// What shapes and forces of fluids share.
const SHARED: [&str; 5] = ["spacing", "density", "support", "kernel", "wall_mass"];

/// What the first force that makes a fluid says of it.
pub(super) fn said<'a>(mut tables: impl Iterator<Item = &'a Table<'a>>) -> Vec<Entry> {
    let is_fluid = |table: &&Table<'_>| {
        let kind = table.get("kind").and_then(|entry| match &entry.node.data {
            Data::Text(kind) => forces::entry(kind),
            _ => None,
        });
        kind.is_some_and(|force| {
            ["spacing", "density"].iter().all(|name| force.keys.iter().any(|key| key.name == *name))
        })
    };
    let Some(table) = tables.find(is_fluid) else { return Vec::new() };
    SHARED.iter().filter_map(|key| table.get(key).cloned()).collect()
}

/// The entries of a shape's table, and what it leaves to the force.
pub(super) fn completed(table: &Table<'_>, shape: &Shape, said: &[Entry]) -> Vec<Entry> {
    let has = |name: &str| shape.keys.iter().any(|key| key.name == name);
    let of_fluid = has("spacing") && has("density");
    let missing = said.iter().filter(|entry| of_fluid && has(&entry.key) && table.get(&entry.key).is_none());
    table.entries.iter().chain(missing).cloned().collect()
}
