//! `[plan]`: a floor plan in well-known text, which a file or the scene itself holds.

use glam::DVec3;

use crate::floor_plan::{Exit, FloorPlan};
use crate::formats::floor_plan;
use crate::settings::{Key, Kind, Value};

use super::files::Files;
use super::report::{Fault, Report};
use super::resolved::Writer;
use super::tree::{Data, Entry};
use super::value;
use super::walk::Table;

pub(super) const OWN: &[&str] = &["file", "wkt", "exits"];

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

/// Reads a plan, and writes it out.
pub(super) fn read(
    table: Option<&Table<'_>>,
    (files, dimensions): (&Files, u32),
    out: &mut Writer,
    report: &mut Report,
) -> Option<FloorPlan> {
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
            report.push(table.lacks("file", "the name of a file, or `wkt`", "the plan, as well-known text"));
            return None;
        }
    };
    if dimensions != 2 {
        let fault = Fault::at(table.place, "a plan is flat, and this scene has 3 dimensions".to_owned());
        report.push(fault.label("say dimensions = 2 in [box]"));
    }
    let names = table.get("exits").and_then(|entry| names(entry, report));
    let place = &entry.node.place;
    let (text, [key, said]) = if inside {
        let text = value::text(&entry.node, "wkt", "well-known text", report)?;
        (text.to_owned(), ["wkt", text].map(str::to_owned))
    } else {
        let name = value::text(&entry.node, "file", "the name of a file", report)?;
        let located = files.locate("file", name, place).and_then(|file| Ok((file.plan(place)?, file)));
        match located {
            Ok((text, file)) => (text, ["file", file.name()].map(str::to_owned)),
            Err(fault) => {
                report.push(fault);
                return None;
            }
        }
    };
    let bad = |why: String| Fault::at(place, why).in_input();
    let drawn = match floor_plan::read(&text) {
        Ok(drawn) => drawn,
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
    let drawn = drawn.from_origin(origin.truncate());
    let count = drawn.exits.len();
    if let Some((given, place)) = names.as_ref().filter(|(names, _)| names.len() != count) {
        let text = format!("{} names of exits are given, and the plan has {count}: a LINESTRING for each", given.len());
        report.push(Fault::at(place, text));
    }
    if report.len() > faults {
        return None;
    }
    let given = names.map(|(names, _)| names);
    let named = |(path, number): (_, usize)| {
        let name = given.as_ref().and_then(|names| names.get(number - 1).cloned());
        Exit { name: name.unwrap_or_else(|| format!("exit {number}")), path, reach: settings.number("reach") }
    };
    let exits: Vec<Exit> = drawn.exits.into_iter().zip(1..).map(named).collect();
    out.header("[plan]");
    out.text(&key, &said);
    if let Some(names) = &given {
        let list: Vec<_> = names.iter().map(|name| format!("{name:?}")).collect();
        out.line("exits", &format!("[{}]", list.join(", ")));
    }
    out.settings(PLAN_KEYS, &settings);
    match FloorPlan::new(&drawn.polygons, exits, settings.number("cell")) {
        Ok(plan) => Some(plan),
        Err(why) => {
            report.push(bad(why));
            None
        }
    }
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
