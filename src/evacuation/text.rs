//! Plans as well-known text, for scenes.

use std::fmt::Write as _;

use glam::DVec2;

use crate::floor_plan::{Exit, Polygon};

/// A plan as well-known text: a POLYGON for each part of the floor, a LINESTRING for each exit.
#[must_use]
pub fn text(polygons: &[Polygon], exits: &[Exit]) -> String {
    let points = |points: &mut dyn Iterator<Item = &DVec2>| {
        points.map(|x| format!("{:?} {:?}", x.x, x.y)).collect::<Vec<_>>().join(", ")
    };
    let ring = |ring: &Vec<DVec2>| format!("({})", points(&mut ring.iter().chain(ring.first())));
    let mut parts = Vec::new();
    for polygon in polygons {
        let rings: Vec<String> = std::iter::once(&polygon.outline).chain(&polygon.holes).map(ring).collect();
        parts.push(format!("POLYGON ({})", rings.join(",\n    ")));
    }
    parts.extend(exits.iter().map(|exit| format!("LINESTRING ({})", points(&mut exit.path.iter()))));
    let mut text = "GEOMETRYCOLLECTION (\n".to_owned();
    // Writing to a String cannot fail.
    let _ = write!(text, "  {}\n)", parts.join(",\n  "));
    text
}
