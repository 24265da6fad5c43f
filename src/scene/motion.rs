//! `[[motion]]`: motions of kinematic particles and obstacles, by keyframes.

use std::fmt::Write as _;

use glam::DVec3;

use crate::kernel::Bounds;
use crate::motion::{self, Keyframe, Motion};
use crate::settings::{Key, Kind, Value};

use super::report::{Fault, Report, shorten};
use super::resolved::{self, Writer};
use super::tree::{Data, Node};
use super::value;
use super::walk::Table;

/// The keys of the section, beside its name and its keys.
pub const MOTION_KEYS: &[Key] = &[
    Key::new("about", Kind::Vector, Value::Vector(DVec3::ZERO), "the centre of turning [length]"),
    Key::new("smooth", Kind::Flag, Value::Flag(false), "whether it accelerates and slows down smoothly at each key"),
    Key::new("repeat", Kind::Flag, Value::Flag(false), "whether it starts over at the first key after the last one"),
];
pub(super) const OWN: &[&str] = &["name", "keys"];
const KEYFRAME: &[Key] = &[
    Key::required("time", Kind::Number, "when [time]"),
    Key::new("shift", Kind::Vector, Value::Vector(DVec3::ZERO), "how far it has moved [length]"),
    Key::new("turn", Kind::Vector, Value::Vector(DVec3::ZERO), "how far it has turned: a rotation vector [degrees]"),
];
const LIST: &str = "a list of tables, as in [{ time = 0 }, { time = 2, shift = [1, 0, 0] }]";

/// Reads a motion and writes it out. An invalid one keeps its name, so that references to it are not reported too.
pub(super) fn read(
    table: &Table<'_>,
    earlier: &[Motion],
    (dt, bounds): (f64, &Bounds),
    out: &mut Writer,
    report: &mut Report,
) -> Option<Motion> {
    let faults = report.len();
    let settings = table.settings(MOTION_KEYS, OWN, report);
    let name = if let Some(entry) = table.get("name") {
        value::text(&entry.node, "name", "a name", report).map(|name| (name, &entry.node.place))
    } else {
        report.push(table.lacks("name", "a text", "the name by which particles and obstacles refer to it"));
        None
    };
    if let Some((name, place)) = name.filter(|(name, _)| earlier.iter().any(|motion| motion.name == *name)) {
        report.push(
            Fault::at(place, format!("two motions are called \"{}\"", shorten(name))).label("rename one of them"),
        );
    }
    let mut text = String::from("[\n");
    let keys = if let Some(entry) = table.get("keys") {
        keys(&entry.node, &mut text, report)
    } else {
        report.push(table.lacks("keys", LIST, "poses by time"));
        Vec::new()
    };
    let (name, place) = name?;
    let motion = Motion {
        name: name.to_owned(),
        about: settings.vector("about"),
        keys,
        smooth: settings.flag("smooth"),
        repeat: settings.flag("repeat"),
    };
    if report.len() > faults {
        return Some(motion);
    }
    if let Err(why) = motion::check(&[], std::slice::from_ref(&motion), 0, bounds.dimensions, dt) {
        report.push(Fault::at(place, why.to_string()));
    }
    out.header("[[motion]]");
    out.text("name", name);
    out.settings(MOTION_KEYS, &settings);
    out.line("keys", &(text + "]"));
    Some(motion)
}

fn keys(node: &Node, text: &mut String, report: &mut Report) -> Vec<Keyframe> {
    let Data::List(list) = &node.data else {
        value::refuse::<()>(node, "keys", LIST, report);
        return Vec::new();
    };
    if list.is_empty() {
        value::refuse::<()>(node, "keys", LIST, report);
    }
    let mut keys: Vec<Keyframe> = Vec::new();
    for node in list {
        let Data::Table(entries) = &node.data else {
            value::refuse::<()>(node, "keys", LIST, report);
            continue;
        };
        let faults = report.len();
        let table = Table { entries, place: &node.place, name: "a keyframe".to_owned() };
        let settings = table.settings(KEYFRAME, &[], report);
        let (time, shift, turn) = (settings.number("time"), settings.vector("shift"), settings.vector("turn"));
        if let (Some(last), true) = (keys.last(), report.len() == faults)
            && time <= last.time
        {
            let place = table.get("time").map_or(&node.place, |entry| &entry.node.place);
            report.push(
                Fault::at(place, format!("a keyframe at {time} comes after one at {}", last.time))
                    .label("times must increase"),
            );
        }
        let [shift_text, turn_text] = [shift, turn].map(resolved::vector);
        // Writing to a String cannot fail.
        let _ = writeln!(text, "  {{ time = {}, shift = {shift_text}, turn = {turn_text} }},", resolved::number(time));
        let turn = DVec3::from_array(turn.to_array().map(f64::to_radians));
        keys.push(Keyframe { time, shift, turn });
    }
    keys
}
