//! Parameters of pairs of species: `[{ species = [0, 1], epsilon = 1.0 }, …]`.

use std::collections::BTreeSet;

use crate::forces::{self, Component};
use crate::settings::{Key, Kind, Pair};
use crate::visit::{MOST_SPECIES, PairRow, PairTable};

use super::force;
use super::report::{Fault, Report};
use super::tree::{Data, Node};
use super::value;
use super::walk::Table;

/// A table of numbers with declared keys.
pub(super) fn read(node: &Node, key: &str, keys: &[Key], report: &mut Report) -> Option<Vec<Pair>> {
    let values = |table: &Table<'_>, report: &mut Report| {
        let settings = table.settings(keys, &["species"], report);
        keys.iter().map(|key| (key.name.to_owned(), settings.number(key.name))).collect()
    };
    let rows = rows(node, key, report, values)?;
    Some(rows.into_iter().map(|Row { species, values }| Pair { species, values }).collect())
}

/// A table of a user's law, whose members are defined by its shader.
pub(super) fn of_any_names(node: &Node, report: &mut Report) -> Option<PairTable> {
    let values = |table: &Table<'_>, report: &mut Report| {
        let others = table.entries.iter().filter(|entry| entry.key != "species");
        others.filter_map(|entry| Some((entry.key.clone(), forces::scalar(&force::param(entry, report)?)))).collect()
    };
    let rows = rows(node, "pairs", report, values)?;
    Some(PairTable { rows: rows.into_iter().map(|Row { species, values }| PairRow { species, values }).collect() })
}

/// A pair of species, and its values.
struct Row<T> {
    species: [u32; 2],
    values: Vec<(String, T)>,
}

fn rows<T>(
    node: &Node,
    key: &str,
    report: &mut Report,
    read: impl Fn(&Table<'_>, &mut Report) -> Vec<(String, T)>,
) -> Option<Vec<Row<T>>> {
    let Data::List(list) = &node.data else { return value::refuse(node, key, &Kind::Pairs(&[]).wanted(), report) };
    let faults = report.len();
    let (mut rows, mut given) = (Vec::new(), BTreeSet::new());
    for node in list {
        let Data::Table(entries) = &node.data else {
            value::refuse::<()>(node, key, &Kind::Pairs(&[]).wanted(), report);
            continue;
        };
        let one = Table { entries, place: &node.place, name: format!("a pair of `{key}`") };
        let species = species(&one, report);
        let values = read(&one, report);
        let Some(species) = species else { continue };
        let [a, b] = species;
        if !given.insert([a.min(b), a.max(b)]) {
            let fault = Fault::at(&node.place, format!("the pair of species {a} and {b} is given twice"));
            report.push(fault.label("remove one of them: the order of the two is irrelevant"));
        }
        rows.push(Row { species, values });
    }
    (report.len() == faults).then_some(rows)
}

/// The two species of a row.
fn species(table: &Table<'_>, report: &mut Report) -> Option<[u32; 2]> {
    const TWO: &str = "two whole numbers";
    let Some(entry) = table.get("species") else {
        report.push(table.lacks("species", TWO, "the pair, as in species = [0, 1]"));
        return None;
    };
    let Data::List(two) = &entry.node.data else { return value::refuse(&entry.node, "species", TWO, report) };
    let [a, b] = &two[..] else { return value::refuse(&entry.node, "species", TWO, report) };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a species fits 32 bits")]
    let whole = |node: &Node, report: &mut Report| {
        let number = value::number(node, "species", Kind::Species, "a whole number from 0 on", report)? as u32;
        if number >= MOST_SPECIES {
            let fault = Fault::at(&node.place, format!("species {number} is too large for parameters of pairs"));
            report.push(fault.label(format!("it may be at most {}: number species from 0 on", MOST_SPECIES - 1)));
            return None;
        }
        Some(number)
    };
    let (a, b) = (whole(a, report), whole(b, report));
    Some([a?, b?])
}

/// Reports every pair of existing species for which a force has no parameters.
pub(super) fn complete(table: &Table<'_>, force: &dyn Component, species: &[u32], report: &mut Report) {
    let place = table.get("pairs").map_or(table.place, |entry| &entry.place);
    for pairs in force.laws().into_iter().filter_map(|law| law.pairs) {
        for [a, b] in pairs.missing(species) {
            let message = format!("`pairs` has no entry for species {a} and {b}");
            report.push(Fault::at(place, message).label(format!("add {{ species = [{a}, {b}], … }}")));
        }
    }
}
