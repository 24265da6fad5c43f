//! Floor plans as well-known text (WKT, OGC 06-103r4): POLYGON and MULTIPOLYGON are the floor, with walls as their sides; each LINESTRING is an exit,
//! and so is a MULTILINESTRING as a whole. Several of them stand in a GEOMETRYCOLLECTION, as GIS programs write and read them. WKT has no names;
//! scenes give names to exits, in their order in the file.

use std::str::FromStr;

use glam::DVec2;
use wkt::Wkt;
use wkt::types::{LineString, Polygon as Text};

use crate::floor_plan::Polygon;

/// How deep a text may be nested: a parser that calls itself has a stack.
const DEEPEST: usize = 16;

/// What a file has.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Drawn {
    /// The floor.
    pub polygons: Vec<Polygon>,
    /// The lines of each exit.
    pub exits: Vec<Vec<DVec2>>,
}

/// Reads a plan.
///
/// # Errors
/// A sentence: what is not WKT, is nested too deeply, is not closed, or is neither floor nor exit.
pub fn read(text: &str) -> Result<Drawn, String> {
    let mut depth = 0_usize;
    for letter in text.chars() {
        match letter {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth > DEEPEST {
            return Err(format!(
                "it is nested more than {DEEPEST} deep: a plan is a GEOMETRYCOLLECTION of a POLYGON and LINESTRINGs"
            ));
        }
    }
    let geometry = Wkt::from_str(text.trim()).map_err(|why| {
        format!("it is no WKT ({why}): a plan is a text such as GEOMETRYCOLLECTION (POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0)), LINESTRING (8 4, 8 5))")
    })?;
    let mut drawn = Drawn::default();
    add(&geometry, &mut drawn)?;
    Ok(drawn)
}

fn add(geometry: &Wkt<f64>, drawn: &mut Drawn) -> Result<(), String> {
    match geometry {
        Wkt::Polygon(polygon) => drawn.polygons.push(closed(polygon, drawn.polygons.len() + 1)?),
        Wkt::MultiPolygon(all) => {
            for polygon in all.polygons() {
                drawn.polygons.push(closed(polygon, drawn.polygons.len() + 1)?);
            }
        }
        Wkt::LineString(line) => drawn.exits.push(points(line)),
        Wkt::MultiLineString(all) => drawn.exits.extend(all.line_strings().iter().map(points)),
        Wkt::GeometryCollection(all) => all.geometries().iter().try_for_each(|one| add(one, drawn))?,
        Wkt::Point(_) | Wkt::MultiPoint(_) => {
            return Err("it has a POINT, which is neither floor nor exit: remove it".to_owned());
        }
    }
    Ok(())
}

fn points(line: &LineString<f64>) -> Vec<DVec2> {
    line.coords().iter().map(|at| DVec2::new(at.x, at.y)).collect()
}

fn closed(polygon: &Text<f64>, number: usize) -> Result<Polygon, String> {
    let mut rings = Vec::new();
    for (ring, place) in polygon.rings().iter().zip(0..) {
        let mut ring = points(ring);
        let name = if place == 0 { "the outline".to_owned() } else { format!("hole {place}") };
        if let (Some(first), Some(last)) = (ring.first().copied(), ring.last().copied())
            && first != last
        {
            return Err(format!(
                "{name} of POLYGON {number} is not closed: it begins at {} {} and ends at {} {}; repeat the first point at the end",
                first.x, first.y, last.x, last.y
            ));
        }
        ring.pop();
        rings.push(ring);
    }
    let mut rings = rings.into_iter();
    let outline = rings.next().ok_or_else(|| format!("POLYGON {number} is empty"))?;
    Ok(Polygon { outline, holes: rings.collect() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floors_and_exits_are_read() {
        let text =
            "GEOMETRYCOLLECTION (POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (1 1, 2 1, 2 2, 1 1)), LINESTRING (8 4, 8 5),
            MULTILINESTRING ((1 8, 2 8), (3 8, 4 8, 4 7)))";
        let drawn = read(text).expect("a plan");
        assert_eq!(
            (drawn.polygons.len(), drawn.polygons[0].outline.len(), drawn.polygons[0].holes[0].len()),
            (1, 4, 3)
        );
        assert_eq!(drawn.exits.iter().map(Vec::len).collect::<Vec<_>>(), [2, 2, 3]);
        assert_eq!(drawn.exits[0][1], DVec2::new(8.0, 5.0));
        assert_eq!(
            read("MULTIPOLYGON (((0 0, 1 0, 1 1, 0 0)), ((2 0, 3 0, 3 1, 2 0)))").expect("two").polygons.len(),
            2
        );
    }

    #[test]
    fn what_is_no_plan_is_refused_with_the_place() {
        for (text, why) in [
            ("POLYGON ((0 0, 9 0, 9 9, 0 9))", "begins at 0 0 and ends at 0 9"),
            ("POLYGON ((0 0, 9 0, 9 9, 0 0), (1 1, 2 1, 2 2))", "hole 1 of POLYGON 1"),
            ("POINT (1 2)", "neither floor nor exit"),
            ("<svg/>", "no WKT"),
            ("", "no WKT"),
            ("POLYGON EMPTY", "is empty"),
            (&"GEOMETRYCOLLECTION (".repeat(100_000), "nested"),
        ] {
            let said = read(text).expect_err(text);
            assert!(said.contains(why), "{said}");
        }
    }
}
