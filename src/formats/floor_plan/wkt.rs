//! Floor plans as well-known text (WKT, OGC 06-103r4): POLYGON and MULTIPOLYGON are the floor, with walls as their sides; each LINESTRING is an exit,
//! and so is each line of a MULTILINESTRING. Several of them stand in a GEOMETRYCOLLECTION, as GIS programs write and read them, or one after
//! another. A floor is flat: heights (Z) may be given where all are the same. WKT has no names: those of exits are given, in their order in the file.

use std::str::FromStr;

use ::wkt::Wkt;
use ::wkt::types::{Coord, LineString, Polygon as Text};
use glam::DVec2;

use super::{Drawn, ExitLine};
use crate::floor_plan::Polygon;

/// How deep a text may be nested: a parser that calls itself has a stack.
const DEEPEST: usize = 16;

/// Reads a plan: one geometry or several, one after another.
///
/// # Errors
/// A sentence: what is not WKT, is nested too deeply, is not closed, is not flat, or is neither floor nor exit.
pub fn read(text: &str) -> Result<Drawn, String> {
    let mut reader = Reader::default();
    for (part, number) in geometries(text)?.into_iter().zip(1..) {
        let geometry = Wkt::from_str(part.trim()).map_err(|why| {
            let what = if number == 1 { "it is no WKT".to_owned() } else { format!("what follows geometry {} is no WKT", number - 1) };
            format!("{what} ({why}): a plan is a text such as GEOMETRYCOLLECTION (POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0)), LINESTRING (8 4, 8 5))")
        })?;
        reader.add(&geometry)?;
    }
    Ok(reader.drawn)
}

/// The geometries of a text, each up to its last parenthesis or the word EMPTY; between them are spaces, lines or semicolons.
fn geometries(text: &str) -> Result<Vec<&str>, String> {
    let (mut depth, mut start, mut all) = (0_usize, 0, Vec::new());
    let separates = |letter: char| letter.is_whitespace() || letter == ';';
    for (at, letter) in text.char_indices() {
        match letter {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            '\0' => return Err(format!("it has a zero byte at place {at}, where text ends: it is no WKT, or damaged")),
            _ => {}
        }
        if depth > DEEPEST {
            return Err(format!(
                "it is nested more than {DEEPEST} deep: a plan is a GEOMETRYCOLLECTION of a POLYGON and LINESTRINGs"
            ));
        }
        let end = at + letter.len_utf8();
        let is_empty =
            || text.as_bytes()[start..end].last_chunk::<5>().is_some_and(|word| word.eq_ignore_ascii_case(b"EMPTY"));
        if depth == 0 && (letter == ')' || is_empty()) {
            all.push(text[start..end].trim_start_matches(separates));
            start = end;
        }
    }
    let rest = text[start..].trim_matches(separates);
    if all.is_empty() || !rest.is_empty() {
        all.push(rest);
    }
    Ok(all)
}

/// What has been read so far.
#[derive(Default)]
struct Reader {
    drawn: Drawn,
    /// The height of the floor.
    height: Option<f64>,
}

impl Reader {
    fn add(&mut self, geometry: &Wkt<f64>) -> Result<(), String> {
        match geometry {
            Wkt::Polygon(polygon) => self.floor(polygon)?,
            Wkt::MultiPolygon(all) => all.polygons().iter().try_for_each(|one| self.floor(one))?,
            Wkt::LineString(line) => self.exit(line)?,
            Wkt::MultiLineString(all) => all.line_strings().iter().try_for_each(|one| self.exit(one))?,
            Wkt::GeometryCollection(all) => all.geometries().iter().try_for_each(|one| self.add(one))?,
            Wkt::Point(_) | Wkt::MultiPoint(_) => {
                return Err("it has a POINT, which is neither floor nor exit: remove it".to_owned());
            }
        }
        Ok(())
    }
    fn exit(&mut self, line: &LineString<f64>) -> Result<(), String> {
        let path = self.points(line)?;
        self.drawn.exits.push(ExitLine { path, name: None });
        Ok(())
    }
    fn points(&mut self, line: &LineString<f64>) -> Result<Vec<DVec2>, String> {
        line.coords().iter().map(|at| self.point(at)).collect()
    }
    fn point(&mut self, at: &Coord<f64>) -> Result<DVec2, String> {
        if at.m.is_some() {
            return Err(format!(
                "its point {} {} has a measure (M), which floors have none of: write it without",
                at.x, at.y
            ));
        }
        // −0 is 0.
        let height = at.z.unwrap_or(0.0) + 0.0;
        let floor = *self.height.get_or_insert(height);
        if floor.total_cmp(&height).is_ne() {
            return Err(format!(
                "its point {} {} is at the height {height}, and others at {floor}: a plan is one flat floor; write each floor into its own \
                 file, or the points without Z",
                at.x, at.y
            ));
        }
        Ok(DVec2::new(at.x, at.y))
    }
    fn floor(&mut self, polygon: &Text<f64>) -> Result<(), String> {
        let number = self.drawn.polygons.len() + 1;
        let mut rings = Vec::new();
        for (ring, place) in polygon.rings().iter().zip(0..) {
            let mut ring = self.points(ring)?;
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
        self.drawn.polygons.push(Polygon { outline, holes: rings.collect() });
        Ok(())
    }
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
        assert_eq!(drawn.exits.iter().map(|exit| exit.path.len()).collect::<Vec<_>>(), [2, 2, 3]);
        assert_eq!(drawn.exits[0].path[1], DVec2::new(8.0, 5.0));
        assert_eq!(
            read("MULTIPOLYGON (((0 0, 1 0, 1 1, 0 0)), ((2 0, 3 0, 3 1, 2 0)))").expect("two").polygons.len(),
            2
        );
    }

    /// What stands behind the first geometry belongs to the plan as well, as in files with one geometry in each line.
    #[test]
    fn geometries_follow_each_other() {
        let floor = "POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0))";
        let exit = "LINESTRING (8 4, 8 5)";
        for text in
            [format!("{floor}\n{exit}\n"), format!("{floor};{exit};"), format!("{exit} {floor}linestring empty")]
        {
            let drawn = read(&text).expect(&text);
            assert_eq!((drawn.polygons.len(), drawn.exits[0].path.len()), (1, 2), "{text}");
        }
        assert_eq!(read(&format!("{floor}{exit}linestring empty")).expect("three").exits[1].path.len(), 0);
    }

    /// Heights that are all the same are those of one floor; an origin moves floor, holes and exits alike.
    #[test]
    fn flat_floors_and_origins() {
        let text =
            "POLYGON Z ((7 5 3, 9 5 3, 9 9 3, 7 5 3), (8 6 3, 8.5 6 3, 8.5 7 3, 8 6 3)) LINESTRING Z (8 8 3, 8 7.5 3)";
        let plan = super::super::Plan { drawn: read(text).expect("a plan"), ..Default::default() };
        let drawn = plan.from_origin(DVec2::new(7.0, 5.0)).drawn;
        let floor = &drawn.polygons[0];
        assert_eq!(
            [floor.outline[1], floor.holes[0][0], drawn.exits[0].path[0]],
            [[2.0, 0.0], [1.0, 1.0], [1.0, 3.0]].map(DVec2::from)
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
            ("POLYGON ((0 0, 9 0, 9 9, 0 0)) and more", "what follows geometry 1 is no WKT"),
            ("POLYGON ((0 0, 9 0, 9 9, 0 0)))", "what follows geometry 1 is no WKT"),
            ("POLYGON ((0 0, 9 0, 9 9, 0 0))\0LINESTRING (1 1, 2 1)", "zero byte at place 30"),
            ("GEOMETRYCOLLECTION (POLYGON ((0 0, 9 0, 9 9, 0 0)) LINESTRING (1 1, 2 1))", "no WKT"),
            ("POLYGON Z ((0 0 3, 9 0 3, 9 9 3.5, 0 0 3))", "point 9 9 is at the height 3.5, and others at 3"),
            ("POLYGON ((0 0, 9 0, 9 9, 0 0)) LINESTRING Z (1 1 2, 2 1 2)", "at the height 2, and others at 0"),
            ("POLYGON M ((0 0 3, 9 0 3, 9 9 3, 0 0 3))", "has a measure (M)"),
            ("POLYGON EMPTY", "is empty"),
            (&"GEOMETRYCOLLECTION (".repeat(100_000), "nested"),
        ] {
            let said = read(text).expect_err(text);
            assert!(said.contains(why), "{said}");
        }
    }
}
