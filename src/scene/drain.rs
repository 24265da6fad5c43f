//! `[[drain]]`: a region in which particles are removed.

use std::borrow::Cow;

use glam::DVec3;

use crate::life::{self, Drain};
use crate::settings::{Key, Kind, Value};
use crate::solids::{self, Solid};

use super::report::{Fault, Report};
use super::resolved::Writer;
use super::walk::Table;

/// The keys of the section.
pub const DRAIN_KEYS: &[Key] = &[
    Key::new(
        "shape",
        Kind::Choice(solids::SHAPES),
        Value::Text(Cow::Borrowed("sphere")),
        "its shape; a plane is the half space behind it",
    ),
    Key::new("position", Kind::Vector, Value::Vector(DVec3::ZERO), "its centre, or a point on the plane [length]"),
    Key::new("radius", Kind::Positive, Value::Number(0.5), "sphere and capsule: the radius [length]"),
    Key::new("size", Kind::Vector, Value::Vector(DVec3::ONE), "box: its sides [length]"),
    Key::new("normal", Kind::Direction, Value::Vector(DVec3::Z), "plane: the direction away from the drain"),
    Key::new(
        "axis",
        Kind::Vector,
        Value::Vector(DVec3::X),
        "capsule: from the centre of one end to the other's [length]",
    ),
    Key::new("outside", Kind::Flag, Value::Flag(false), "whether it removes particles outside of it, and not inside"),
    Key::new(
        "species",
        Kind::Species,
        Value::Text(Cow::Borrowed("all")),
        "the species that it removes, or \"all\" that are not fixed",
    ),
];

/// Reads a drain, and writes it out.
pub(super) fn read(table: &Table<'_>, dimensions: u32, out: &mut Writer, report: &mut Report) -> Option<Drain> {
    let faults = report.len();
    let settings = table.settings(DRAIN_KEYS, &[], report);
    if report.len() > faults {
        return None;
    }
    let radius = settings.number("radius");
    let solid = match settings.text("shape") {
        "box" if dimensions == 2 => Solid::Box(settings.vector("size").with_z(0.0)),
        "box" => Solid::Box(settings.vector("size")),
        "plane" => Solid::Plane(settings.vector("normal").normalize_or(DVec3::Z)),
        "capsule" => Solid::Capsule(settings.vector("axis"), radius),
        _ => Solid::Sphere(radius),
    };
    let outside = settings.flag("outside");
    let drain = Drain { solid, position: settings.vector("position"), outside, species: settings.species("species") };
    if let Err(why) = life::check((&[], &[], &[drain]), &[], 0, dimensions) {
        report.push(Fault::at(table.place, why.to_string()));
        return None;
    }
    out.header("[[drain]]");
    out.settings(DRAIN_KEYS, &settings);
    Some(drain)
}
