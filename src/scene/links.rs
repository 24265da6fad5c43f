//! `[[links]]`: springs, ropes and rods between particles, from a file or written out.

use std::borrow::Cow;

use glam::DVec3;

use crate::formats::links::{self, Tie, Usual};
use crate::kernel::Bounds;
use crate::links::Links;
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;

use super::files::Files;
use super::report::{Fault, Report};
use super::resolved::Writer;
use super::tree::{Data, Entry, Node};
use super::value;
use super::walk::Table;

/// The keys of the section.
pub const LINKS_KEYS: &[Key] = &[
    Key::new(
        "tie",
        Kind::Choice(Tie::NAMES),
        Value::Text(Cow::Borrowed("spring")),
        "the kind of link; a file's own column takes precedence, as for the other keys",
    ),
    Key::new("rest", Kind::NotNegative, Value::Number(1.0), "the length at rest, as a part of the distance of the two"),
    Key::new("stiffness", Kind::NotNegative, Value::Number(1000.0), "Hooke's constant [mass / time²]"),
    Key::new("damping", Kind::NotNegative, Value::Number(0.0), "the damping along the spring [mass / time]"),
];
/// The file, or the pairs of ids.
pub(super) const OWN: &[&str] = &["file", "pairs"];

/// Reads a section for existing particles, and adds its links to theirs.
pub(super) fn read(
    table: &Table<'_>,
    particles: &mut State,
    bounds: &Bounds,
    files: &Files,
    out: &mut Writer,
    report: &mut Report,
) {
    let faults = report.len();
    let settings = table.settings(LINKS_KEYS, OWN, report);
    let Some(entry) = table.one_of(OWN, report) else { return };
    let usual = usual(&settings);
    out.header("[[links]]");
    let links = match entry.key.as_str() {
        "file" => from_file(entry, particles.position(), bounds, &usual, files, out, report),
        _ => from_pairs(entry, particles.position(), bounds, &usual, out, report),
    };
    out.settings(LINKS_KEYS, &settings);
    let Some(links) = links.filter(|_| report.len() == faults) else { return };
    particles.links.append(&links, 0);
    if let Err(why) = particles.links.check(particles.mass()) {
        report.push(Fault::at(&entry.node.place, why.to_string()));
    }
}

fn usual(settings: &Settings) -> Usual {
    let [rest, stiffness, damping] = ["rest", "stiffness", "damping"].map(|key| settings.number(key));
    Usual { tie: Tie::from_name(settings.text("tie")).unwrap_or_default(), rest, stiffness, damping }
}

fn from_file(
    entry: &Entry,
    positions: &[DVec3],
    bounds: &Bounds,
    usual: &Usual,
    files: &Files,
    out: &mut Writer,
    report: &mut Report,
) -> Option<Links> {
    let name = value::text(&entry.node, "file", "the name of a file", report)?;
    let place = &entry.node.place;
    let read = files.locate("file", name, place).and_then(|located| {
        match links::read(&located.input(), positions, bounds, usual) {
            Ok(links) => Ok((links, located.name().to_owned())),
            Err(why) => Err(Fault::at(place, why.to_string()).in_input()),
        }
    });
    match read {
        Ok((links, path)) => {
            out.text("file", &path);
            Some(links)
        }
        Err(fault) => {
            report.push(fault);
            None
        }
    }
}

fn from_pairs(
    entry: &Entry,
    positions: &[DVec3],
    bounds: &Bounds,
    usual: &Usual,
    out: &mut Writer,
    report: &mut Report,
) -> Option<Links> {
    const WANTED: &str = "a list of pairs of ids, as in [[0, 1], [1, 2]]";
    let Data::List(list) = &entry.node.data else { return value::refuse(&entry.node, "pairs", WANTED, report) };
    let (mut links, mut text) = (Links::default(), Vec::new());
    for node in list {
        let Data::List(pair) = &node.data else {
            value::refuse::<()>(node, "pairs", WANTED, report);
            continue;
        };
        let [a, b] = pair.as_slice() else {
            value::refuse::<()>(node, "pairs", "two ids", report);
            continue;
        };
        let (Some(a), Some(b)) = (id(a, positions.len(), report), id(b, positions.len(), report)) else { continue };
        if a == b {
            report.push(Fault::at(&node.place, format!("particle {a} is linked to itself")));
            continue;
        }
        usual.tie(&mut links, [a, b], bounds.shortest(positions[b as usize] - positions[a as usize]).length(), None);
        text.push(format!("[{a}, {b}]"));
    }
    out.line("pairs", &format!("[{}]", text.join(", ")));
    Some(links)
}

/// The id of an existing particle.
fn id(node: &Node, count: usize, report: &mut Report) -> Option<u32> {
    let number = value::number(node, "pairs", Kind::Whole, "the id of a particle", report)?;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked against the count")]
    if number < count as f64 {
        return Some(number as u32);
    }
    let fault = Fault::at(&node.place, format!("there is no particle {number}"));
    report.push(fault.label(format!("there are {count}, counted from 0")));
    None
}
