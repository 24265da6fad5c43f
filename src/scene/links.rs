//! `[[links]]`: springs, ropes, rods, joints and dihedrals of particles, from a file or written out.

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
        "pairs: spring, rope or rod. A file's own column takes precedence, as for the other keys",
    ),
    Key::new("rest", Kind::NotNegative, Value::Number(1.0), "the length at rest, as a part of the distance of the two"),
    Key::new(
        "stiffness",
        Kind::NotNegative,
        Value::Number(1000.0),
        "Hooke's constant [mass / time²], or k of a joint, or of a dihedral, where it may be negative [energy]",
    ),
    Key::new("damping", Kind::NotNegative, Value::Number(0.0), "the damping along the spring [mass / time]"),
    Key::new("angle", Kind::NotNegative, Value::Number(180.0), "joints: the angle at rest [degrees]; 180: straight"),
    Key::new("multiplicity", Kind::Count, Value::Number(1.0), "dihedrals: n of k (1 + cos(n φ − δ)), 1 to 12"),
    Key::new("phase", Kind::Number, Value::Number(0.0), "dihedrals: δ of k (1 + cos(n φ − δ)) [degrees]"),
    Key::new("copies", Kind::Count, Value::Number(1.0), "how many times these links are there: once in each molecule"),
    Key::new(
        "stride",
        Kind::Whole,
        Value::Number(0.0),
        "by how many ids a copy is further than the one before it: the number of particles of a molecule; 0: as many as the links span",
    ),
];
/// The file, or the particles' ids.
pub(super) const OWN: &[&str] = &["file", "pairs", "joints", "dihedrals"];

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
    // A term of a dihedral may have either sign.
    let signed =
        |key: &Key| if key.name == "stiffness" { Key { kind: Kind::Number, ..key.clone() } } else { key.clone() };
    let keys: Vec<Key> = match table.get("dihedrals") {
        Some(_) => LINKS_KEYS.iter().map(signed).collect(),
        None => LINKS_KEYS.to_vec(),
    };
    let settings = table.settings(&keys, OWN, report);
    let Some(entry) = table.one_of(OWN, report) else { return };
    if particles.is_empty() && report.len() > 0 {
        // What is wrong with them says more than that their ids do not exist.
        return;
    }
    let mut usual = usual(&settings);
    let source = entry.key.as_str();
    let none = match source {
        "file" => Vec::new(),
        "pairs" => Tie::Spring.lacks().to_vec(),
        "joints" => [&["tie"], Tie::Joint.lacks()].concat(),
        _ => [&["tie"], Tie::Dihedral.lacks()].concat(),
    };
    for given in none.iter().filter_map(|key| table.get(key)) {
        let fault = Fault::at(&given.place, format!("`{}` has no effect on `{source}`", given.key));
        report.push(fault.label("remove it"));
    }
    match source {
        "pairs" if usual.tie.ids() > 2 => {
            let place = table.get("tie").map_or(&entry.node.place, |tie| &tie.node.place);
            let (name, number) = (usual.tie.name(), usual.tie.ids());
            let fault = Fault::at(place, format!("a {name} has {number} particles, and `pairs` have two"));
            report.push(fault.label(format!("list them in `{name}s`, without `tie`")));
            usual.tie = Tie::Spring;
        }
        "joints" => usual.tie = Tie::Joint,
        "dihedrals" => usual.tie = Tie::Dihedral,
        _ => {}
    }
    out.header("[[links]]");
    let links = match source {
        "file" => from_file(entry, particles.position(), bounds, &usual, files, out, report),
        _ => from_ids(entry, particles.position(), bounds, &usual, out, report),
    };
    // What has no effect is not written.
    let shown = settings.0.iter().filter(|(key, _)| !none.contains(key));
    out.settings(LINKS_KEYS, &Settings(shown.map(|(key, value)| (*key, value.clone())).collect()));
    let Some(links) = links.filter(|_| report.len() == faults) else { return };
    let links = match copied(&links, settings.whole("copies"), settings.whole("stride"), particles.len()) {
        Ok(links) => links,
        Err(why) => {
            let place = table.get("copies").map_or(&entry.node.place, |copies| &copies.node.place);
            report.push(Fault::at(place, why).label("`copies` or `stride` is too large"));
            return;
        }
    };
    let before = particles.links.clone();
    particles.links.append(&links, 0);
    if let Err(why) = particles.links.check(particles.mass()) {
        report.push(Fault::at(&entry.node.place, why.to_string()));
        // The next section is not reported for this one.
        particles.links = before;
    }
}

fn usual(settings: &Settings) -> Usual {
    let [rest, stiffness, damping, angle, phase] =
        ["rest", "stiffness", "damping", "angle", "phase"].map(|key| settings.number(key));
    let tie = Tie::from_name(settings.text("tie")).unwrap_or_default();
    let multiplicity = u32::try_from(settings.whole("multiplicity")).unwrap_or(u32::MAX);
    Usual { tie, rest, stiffness, damping, angle, multiplicity, phase }
}

/// Links, so many times, each time among particles so many ids further.
fn copied(links: &Links, copies: u64, stride: u64, count: usize) -> Result<Links, String> {
    let pairs = links.springs.iter().map(|link| link.ends).chain(links.rods.iter().map(|rod| rod.ends));
    let all = || pairs.clone().flatten().chain(links.corners().flatten().copied());
    let (Some(low), Some(high)) = (all().min(), all().max()) else { return Ok(Links::default()) };
    let stride = if stride == 0 { u64::from(high - low) + 1 } else { stride };
    let last = copies.saturating_sub(1).saturating_mul(stride).saturating_add(high.into());
    if last >= count as u64 {
        return Err(format!(
            "{copies} copies, each {stride} ids further, reach particle {last}; there are {count}, counted from 0"
        ));
    }
    let mut result = Links::default();
    for first in (0..copies).map(|copy| copy * stride) {
        result.append(links, u32::try_from(first).unwrap_or(u32::MAX));
    }
    Ok(result)
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

fn from_ids(
    entry: &Entry,
    positions: &[DVec3],
    bounds: &Bounds,
    usual: &Usual,
    out: &mut Writer,
    report: &mut Report,
) -> Option<Links> {
    let (key, number) = (entry.key.as_str(), usual.tie.ids());
    let (wanted, each) = match number {
        3 => ("a list of three ids each, as in [[0, 1, 2], [1, 2, 3]]", "three ids"),
        4 => ("a list of four ids each, as in [[0, 1, 2, 3]]", "four ids"),
        _ => ("a list of pairs of ids, as in [[0, 1], [1, 2]]", "two ids"),
    };
    let Data::List(list) = &entry.node.data else { return value::refuse(&entry.node, key, wanted, report) };
    let (mut links, mut text) = (Links::default(), Vec::new());
    for node in list {
        let Data::List(ids) = &node.data else {
            value::refuse::<()>(node, key, wanted, report);
            continue;
        };
        if ids.len() != number {
            value::refuse::<()>(node, key, each, report);
            continue;
        }
        let read: Vec<_> = ids.iter().map(|node| id(node, key, positions.len(), report)).collect();
        let Some(ids) = read.into_iter().collect::<Option<Vec<u32>>>() else { continue };
        if let Some((_, id)) = ids.iter().enumerate().find(|(place, id)| ids[..*place].contains(id)) {
            report.push(Fault::at(&node.place, format!("particle {id} is linked to itself")));
            continue;
        }
        usual.tie(&mut links, &ids, positions, bounds, None);
        let ids: Vec<_> = ids.iter().map(u32::to_string).collect();
        text.push(format!("[{}]", ids.join(", ")));
    }
    out.line(key, &format!("[{}]", text.join(", ")));
    Some(links)
}

/// The id of an existing particle.
fn id(node: &Node, key: &str, count: usize, report: &mut Report) -> Option<u32> {
    let number = value::number(node, key, Kind::Whole, "the id of a particle", report)?;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked against the count")]
    if number < count as f64 {
        return Some(number as u32);
    }
    let fault = Fault::at(&node.place, format!("there is no particle {number}"));
    report.push(fault.label(format!("there are {count}, counted from 0")));
    None
}
