//! `[plan]`: a floor plan in a file, or as well-known text in the scene itself.

use glam::DVec3;

use crate::floor_plan::{Exit, FloorPlan};
use crate::formats::floor_plan::{self, Measure, Scale};
use crate::settings::{Key, Kind, Value};

use super::files::Files;
use super::report::{Fault, Report};
use super::resolved::Writer;
use super::tree::{Data, Entry};
use super::value;
use super::walk::Table;

pub(super) const OWN: &[&str] = &["file", "wkt", "exits", "scale", "pixel"];

/// The keys of the section.
pub const PLAN_KEYS: &[Key] = &[
    Key::new(
        "cell",
        Kind::Positive,
        Value::Number(0.1),
        "the side of the cells on which ways to exits are found [length]",
    ),
    Key::new(
        "reach",
        Kind::Positive,
        Value::Number(0.25),
        "the distance from the line of an exit at which a pedestrian has left, where no wall is between [length]",
    ),
    Key::new(
        "origin",
        Kind::Vector,
        Value::Vector(DVec3::ZERO),
        "the point of the file that is at 0 0 of the scene; z must be 0 [length]",
    ),
];

/// A plan, and what one should know about it.
pub(super) struct Floor {
    pub(super) plan: FloorPlan,
    pub(super) remarks: Vec<String>,
}

/// Reads a plan, and writes it out.
pub(super) fn read(
    table: Option<&Table<'_>>,
    (files, dimensions): (&Files, u32),
    out: &mut Writer,
    report: &mut Report,
) -> Option<Floor> {
    let table = table?;
    let faults = report.len();
    let settings = table.settings(PLAN_KEYS, OWN, report);
    let (entry, inside) = match (table.get("file"), table.get("wkt")) {
        (Some(entry), None) => (entry, false),
        (None, Some(entry)) => (entry, true),
        (Some(_), Some(entry)) => {
            let fault = Fault::at(&entry.place, "the plan is given twice, as `file` and as `wkt`".to_owned());
            report.push(fault.label("leave one of them out"));
            return None;
        }
        (None, None) => {
            report.push(table.lacks("file", "the name of a file, or `wkt`", "the plan"));
            return None;
        }
    };
    if dimensions != 2 {
        let fault = Fault::at(table.place, "a plan is flat, and this scene has 3 dimensions".to_owned());
        report.push(fault.label("say dimensions = 2 in [box]"));
    }
    let names = table.get("exits").and_then(|entry| names(entry, report));
    let measure = measure(table, report)?;
    let place = &entry.node.place;
    let (bytes, [key, said]) = if inside {
        let text = value::text(&entry.node, "wkt", "well-known text", report)?;
        (text.as_bytes().to_vec(), ["wkt", text].map(str::to_owned))
    } else {
        let name = value::text(&entry.node, "file", "the name of a file", report)?;
        let located = files.locate("file", name, place).and_then(|file| Ok((file.plan(place)?, file)));
        match located {
            Ok((bytes, file)) => (bytes, ["file", file.name()].map(str::to_owned)),
            Err(fault) => {
                report.push(fault);
                return None;
            }
        }
    };
    let bad = |why: String| Fault::at(place, why).in_input();
    let read = match floor_plan::read(&bytes, &measure) {
        Ok(read) => read,
        Err(why) => {
            report.push(bad(why));
            return None;
        }
    };
    let origin = settings.vector("origin");
    if origin.z != 0.0 {
        let text = format!("the origin of the plan has z = {}, and a plan is flat: give it z = 0", origin.z);
        report.push(Fault::at(table.get("origin").map_or(table.place, |entry| &entry.place), text));
    }
    let read = read.from_origin(origin.truncate());
    let count = read.drawn.exits.len();
    if let Some((given, place)) = names.as_ref().filter(|(names, _)| names.len() != count) {
        let text = format!("{} names of exits are given, and the plan has {count} exits: a name for each", given.len());
        report.push(Fault::at(place, text));
    }
    if report.len() > faults {
        return None;
    }
    let given = names.map(|(names, _)| names);
    let names = read.names(given.as_deref().unwrap_or_default());
    let reach = settings.number("reach");
    let exits = read.drawn.exits.into_iter().zip(names);
    let exits: Vec<Exit> = exits.map(|(exit, name)| Exit { name, path: exit.path, reach }).collect();
    out.header("[plan]");
    out.text(&key, &said);
    if let Some(names) = &given {
        let list: Vec<_> = names.iter().map(|name| format!("{name:?}")).collect();
        out.line("exits", &format!("[{}]", list.join(", ")));
    }
    match measure.scale {
        Some(Scale::Unit(unit)) => out.number("scale", unit),
        Some(Scale::Paper(times)) => out.text("scale", &format!("1:{times}")),
        None => {}
    }
    if let Some(side) = measure.pixel {
        out.number("pixel", side);
    }
    out.settings(PLAN_KEYS, &settings);
    match FloorPlan::new(&read.drawn.polygons, exits, settings.number("cell")) {
        Ok(plan) => Some(Floor { plan, remarks: read.remarks }),
        Err(why) => {
            report.push(bad(why));
            None
        }
    }
}

/// The scale and the side of a pixel.
fn measure(table: &Table<'_>, report: &mut Report) -> Option<Measure> {
    const WANTED: &str = "the length of a unit of the file, or a text such as \"1:100\"";
    let scale = match table.get("scale") {
        None => None,
        Some(Entry { node, .. }) => Some(match &node.data {
            Data::Text(text) => match text.parse() {
                Ok(scale) => scale,
                Err(_) => return value::refuse(node, "scale", WANTED, report),
            },
            _ => Scale::Unit(value::number(node, "scale", Kind::Positive, WANTED, report)?),
        }),
    };
    let pixel = match table.get("pixel") {
        None => None,
        Some(entry) => Some(value::number(&entry.node, "pixel", Kind::Positive, "a length", report)?),
    };
    Some(Measure { scale, pixel })
}

/// The names of exits, and their place.
fn names<'a>(entry: &'a Entry, report: &mut Report) -> Option<(Vec<String>, &'a super::report::Place)> {
    const LIST: &str = "a list of names, as in [\"north\", \"south\"]";
    let Data::List(list) = &entry.node.data else {
        return value::refuse(&entry.node, "exits", LIST, report);
    };
    let names = list.iter().map(|node| value::text(node, "exits", LIST, report).map(str::to_owned));
    Some((names.collect::<Option<_>>()?, &entry.node.place))
}
