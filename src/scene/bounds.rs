//! `[box]`: the box and its sides.

use std::borrow::Cow;

use glam::DVec3;

use crate::boundary;
use crate::kernel::{Bounds, Side};
use crate::settings::{Key, Kind, Value};

use super::report::{Fault, Place, Report};
use super::resolved::Writer;
use super::tree::Data;
use super::value;
use super::walk::{self, Table};

/// The keys of the section.
pub const BOX_KEYS: &[Key] = &[
    Key::required("size", Kind::Vector, "the lengths of its sides [length]; the third may be 0: a flat box"),
    Key::new("low", Kind::Vector, Value::Vector(DVec3::ZERO), "its lowest corner [length]"),
    Key::new("boundary", Kind::Choice(Side::NAMES), PERIODIC, "the boundary at its sides"),
];
const PERIODIC: Value = Value::Text(Cow::Borrowed("periodic"));
/// Axes with sides of their own, and `dimensions`.
pub(super) const OWN: &[&str] = &["x", "y", "z", "dimensions"];
const AXES: [&str; 3] = ["x", "y", "z"];

/// Reads the section, and writes it out; without it space is open.
pub(super) fn read(table: Option<&Table<'_>>, out: &mut Writer, report: &mut Report) -> Bounds {
    let Some(table) = table else { return Bounds::default() };
    let faults = report.len();
    let settings = table.settings(BOX_KEYS, OWN, report);
    let (low, size) = (settings.vector("low"), settings.vector("size"));
    let flat = size.z == 0.0;
    let mut sides = [Side::from_name(settings.text("boundary")).unwrap_or_default(); 3];
    if flat {
        sides[2] = Side::Open;
    }
    for (side, key) in sides.iter_mut().zip(AXES) {
        let word = table.get(key).and_then(|entry| walk::choice(entry, "boundary", Side::NAMES, report));
        *side = word.and_then(Side::from_name).unwrap_or(*side);
    }
    let dimensions = dimensions(table, report).unwrap_or(if flat { 2 } else { 3 });
    let bounds = Bounds { low, high: low + size, sides, dimensions };
    if report.len() == faults {
        sizes(table, size, sides, report);
    }
    if report.len() == faults
        && let Err(why) = boundary::check(&bounds)
    {
        let at = table.get(if dimensions == 2 && sides[2] != Side::Open { "dimensions" } else { "size" });
        report.push(Fault::at(at.map_or(table.place, |entry| &entry.node.place), why.to_string()));
    }
    out.header("[box]");
    out.settings(BOX_KEYS, &settings);
    for (side, key) in sides.into_iter().zip(AXES) {
        out.text(key, side.name());
    }
    out.line("dimensions", &dimensions.to_string());
    bounds
}

fn dimensions(table: &Table<'_>, report: &mut Report) -> Option<u32> {
    let node = &table.get("dimensions")?.node;
    match value::number(node, "dimensions", Kind::Whole, "2 or 3", report)? {
        2.0 => Some(2),
        3.0 => Some(3),
        _ => value::refuse(node, "dimensions", "2 or 3", report),
    }
}

/// Along a closed axis the size must be positive.
fn sizes(table: &Table<'_>, size: DVec3, sides: [Side; 3], report: &mut Report) {
    let Some(entry) = table.get("size") else { return };
    let place = |axis: usize| -> &Place {
        match &entry.node.data {
            Data::List(list) => list.get(axis).map_or(&entry.node.place, |node| &node.place),
            _ => &entry.node.place,
        }
    };
    for (axis, name) in AXES.into_iter().enumerate() {
        let (length, side) = (size[axis], sides[axis]);
        if length > 0.0 || length == 0.0 && side == Side::Open {
            continue;
        }
        let fault =
            Fault::at(place(axis), format!("the box is {length} long along {name}, where it is {}", side.name()));
        report.push(match side {
            Side::Open => fault.label("a length is zero or above"),
            _ => fault.label(format!("a length above zero; or set {name} = \"open\"")),
        });
    }
}
