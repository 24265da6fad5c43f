//! Floor plans as pictures (PNG): what is dark is a wall, what is coloured is an exit, and the light area that an exit can be reached from is the floor.
//!
//! Outlines go through the middles of the sides between pixels of the floor and others, so that walls along rows, columns and diagonals are straight
//! lines at their places. Other walls are straightened within 0.4 pixels, which keeps corners where they are.

mod areas;
pub mod colors;
mod outline;

use std::collections::HashMap;

use glam::DVec2;

use super::{Drawn, ExitLine, Landing, Plan};
use crate::floor_plan::Polygon;
use areas::{Areas, FLOOR};
pub use areas::{EXIT, OPEN, WALL};
pub use colors::Picture;

/// Exits are at least as long as this \[m\].
const SHORTEST: f64 = 0.4;
/// Closed rooms without an exit are remarked on from this area on \[m²\]: letters and the insides of walls are smaller.
const ROOM: f64 = 2.0;
/// What is narrower is the inside of a wall \[m\].
const NARROW: f64 = 0.4;
/// How far outlines are straightened \[pixels\].
const STRAIGHT: f64 = 0.4;

/// The floor goes on outside of exits up to this distance \[m\].
const LANDING: f64 = 1.0;

/// A place of an exit, and its name if it has one \[pixels\].
#[derive(Debug, Clone)]
pub struct Mark {
    pub x: usize,
    pub y: usize,
    pub name: Option<String>,
}

/// Reads a plan whose pixels have sides of this length \[m\]. Its floor goes on for a metre outside of each exit.
///
/// # Errors
/// A sentence, with the place in metres from the lower left corner: what is no PNG, has no exit, has a coloured spot that is too short for an exit, or an
/// exit whose room is open to the edge of the picture.
#[cfg(feature = "images")]
pub fn read(bytes: &[u8], side: f64) -> Result<Plan, String> {
    plan(colors::read(bytes)?, side, DVec2::ZERO, &[])
}

/// The plan of a picture whose lower left corner is at a place \[m\]. Exits are in the order of marks, and then from the top.
pub fn plan(picture: Picture, side: f64, low: DVec2, marks: &[Mark]) -> Result<Plan, String> {
    if !(1e-4..=10.0).contains(&side) {
        return Err(format!("pixels of {side} m are no scale of a floor plan: give between 0.0001 and 10 m"));
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most ten thousand pixels")]
    let margin = (LANDING / side).ceil() as u32 + 1;
    let high = f64::from(picture.height + margin);
    let metres = |x: f64, y: f64| low + DVec2::new(x - f64::from(margin), high - y) * side;
    let picture = picture.within(margin);
    let mut areas = Areas::of(&picture);
    if areas.exits.is_empty() {
        return Err("it has no exit, so that no way leads out: draw a coloured line, such as a green one, across each door that leads out".to_owned());
    }
    let (mut exits, mut landings) = (Vec::new(), Vec::new());
    let first = first_marks(marks, margin);
    let mark = |exit: &[(u32, u32)]| exit.iter().filter_map(|at| first.get(at)).min().copied().unwrap_or(marks.len());
    areas.exits.sort_by_key(|exit| mark(exit));
    for exit in &areas.exits {
        let [a, b] = outline::axis(exit);
        let (middle, length) = (metres(0.5 * (a.x + b.x), 0.5 * (a.y + b.y)), (a.distance(b) + 2.0) * side);
        let at = format!("{:.2} {:.2}", middle.x, middle.y);
        if length < SHORTEST {
            return Err(format!(
                "the coloured spot at {at}, {length:.2} m long, is too short for an exit, of {SHORTEST} m or more: draw it longer, take it out, or check the length of a pixel"
            ));
        }
        if !areas.is_inside(exit) {
            return Err(format!(
                "the exit at {at} has no closed room beside it: what is beside it reaches the edge of the picture; close the walls, also at the ends of the exit"
            ));
        }
        if let Some(outside) = areas.outside_of(exit) {
            let across = (metres(b.x, b.y) - metres(a.x, a.y)).perp();
            let outward = across * across.dot(metres(outside.x, outside.y) - middle).signum();
            landings.push(Landing { middle, outward, radius: LANDING + 0.5 * length });
        }
        let name = marks.get(mark(exit)).and_then(|mark| mark.name.clone());
        exits.push(ExitLine { path: vec![metres(a.x, a.y), metres(b.x, b.y)], name });
    }
    let remarks = areas
        .rooms_without_exit()
        .filter(|room| room.area() * side * side >= ROOM && room.thickness() * side >= NARROW)
        .map(|room| {
            let at = metres(f64::from(room.first.0) + 0.5, f64::from(room.first.1) + 0.5);
            let area = room.area() * side * side;
            format!(
                "the closed room at {:.2} {:.2}, of {area:.1} m², has no way to an exit: it is left out",
                at.x, at.y
            )
        })
        .collect();
    areas.land(LANDING / side);
    areas.part_corners();
    let rings = outline::rings(&areas.mask, areas.width, areas.height, |kind| kind == FLOOR);
    let points = |ring: &outline::Ring| {
        let points = outline::straightened(&ring.points, STRAIGHT);
        points.into_iter().map(|x| metres(x.x, x.y)).collect::<Vec<_>>()
    };
    let outer: Vec<&outline::Ring> = rings.iter().filter(|ring| !ring.is_hole).collect();
    let polygon = |one: &&outline::Ring| {
        let holes = rings.iter().filter(|ring| ring.is_hole && ring.area == one.area);
        Polygon { outline: points(one), holes: holes.map(points).collect() }
    };
    Ok(Plan { drawn: Drawn { polygons: outer.iter().map(polygon).collect(), exits }, landings, remarks })
}

/// The first of the marks at each place, with a margin.
fn first_marks(marks: &[Mark], margin: u32) -> HashMap<(u32, u32), usize> {
    let mut first = HashMap::new();
    for (mark, number) in marks.iter().zip(0..) {
        let place = [mark.x, mark.y].map(|x| u32::try_from(x).unwrap_or(u32::MAX).saturating_add(margin));
        first.entry((place[0], place[1])).or_insert(number);
    }
    first
}

#[cfg(all(test, feature = "images"))]
mod tests {
    use super::*;

    /// A picture drawn by a function of the middle of each pixel.
    fn png(width: u32, height: u32, color: impl Fn(f64, f64) -> [u8; 3]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, width, height);
        encoder.set_color(png::ColorType::Rgb);
        let mut writer = encoder.write_header().expect("a header");
        let pixel = |n: u32| color(f64::from(n % width) + 0.5, f64::from(n / width) + 0.5);
        let rgb: Vec<u8> = (0..width * height).flat_map(pixel).collect();
        writer.write_image_data(&rgb).expect("pixels");
        writer.finish().expect("an end");
        bytes
    }

    const WHITE: [u8; 3] = [255; 3];
    const BLACK: [u8; 3] = [0; 3];
    const GREEN: [u8; 3] = [0, 160, 60];

    /// A room of 100 by 80 pixels in a margin of 10, with walls of 4, a door of 24 to the right whose exit is `color`, and a round pillar.
    fn room(color: [u8; 3], gap: f64) -> Vec<u8> {
        png(120, 100, |x, y| {
            let (inside, outer) = (
                (14.0..106.0).contains(&x) && (14.0..86.0).contains(&y),
                (10.0..110.0).contains(&x) && (10.0..90.0).contains(&y),
            );
            let door = (106.0..110.0).contains(&x) && (38.0..62.0 + gap).contains(&y);
            if door && y < 62.0 {
                color
            } else if door || (inside && (x - 50.0).hypot(y - 50.0) >= 9.0) || !outer {
                WHITE
            } else {
                BLACK
            }
        })
    }

    fn area(ring: &[DVec2]) -> f64 {
        ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| 0.5 * a.perp_dot(*b)).sum::<f64>().abs()
    }

    #[test]
    fn walls_exits_and_pillars_lie_where_they_are_drawn() {
        let Plan { drawn, remarks, landings } = read(&room(GREEN, 0.0), 0.05).expect("a plan");
        assert!(remarks.is_empty(), "{remarks:?}");
        let [floor] = &drawn.polygons[..] else { panic!("{} polygons", drawn.polygons.len()) };
        // 92 by 72 pixels and the door, of 4 by 24; corners are cut by an eighth of a pixel.
        // Outside a metre, of 20 pixels, from the exit: a rectangle beside it, and a quarter of a disc around the end of each wall.
        let landing = (20.0 * 24.0 + 0.5 * std::f64::consts::PI * 400.0) * 0.0025;
        let wanted = (92.0 * 72.0 + 4.0 * 24.0) * 0.0025 + landing;
        assert!((area(&floor.outline) - wanted).abs() < 0.05 * landing, "{}", area(&floor.outline));
        assert!(floor.outline.len() <= 40, "{:?}", floor.outline);
        let [landing] = &landings[..] else { panic!("{landings:?}") };
        assert!(landing.holds(DVec2::new(5.9, 2.5)) && !landing.holds(DVec2::new(5.0, 2.5)), "{landing:?}");
        let [pillar] = &floor.holes[..] else { panic!("{} holes", floor.holes.len()) };
        let round = std::f64::consts::PI * 0.45 * 0.45;
        assert!((area(pillar) / round - 1.0).abs() < 0.03, "{} for {round}", area(pillar));
        assert!(pillar.iter().all(|x| (x.distance(DVec2::new(2.5, 2.5)) - 0.45).abs() < 0.04), "{pillar:?}");
        let [ExitLine { path: exit, .. }] = &drawn.exits[..] else { panic!("{:?}", drawn.exits) };
        let ends = [DVec2::new(5.4, 1.95), DVec2::new(5.4, 3.05)];
        let away = |at: DVec2| exit.iter().map(|x| x.distance(at)).fold(f64::INFINITY, f64::min);
        assert!(exit.len() == 2 && ends.iter().all(|end| away(*end) < 0.03), "{exit:?}");
    }
    #[test]
    fn oblique_walls_are_within_a_pixel() {
        // A square of 60 pixels, turned by 20 degrees, with an exit within.
        let (sine, cosine) = 20f64.to_radians().sin_cos();
        let turned = png(110, 110, |x, y| {
            let (x, y) = (x - 55.0, y - 55.0);
            let (u, v) = ((cosine * x + sine * y).abs(), (cosine * y - sine * x).abs());
            match u.max(v) {
                most if most > 34.0 => WHITE,
                most if most > 30.0 => BLACK,
                _ if v < 1.5 && u < 12.0 => GREEN,
                _ => WHITE,
            }
        });
        let Plan { drawn, .. } = read(&turned, 0.1).expect("a plan");
        let floor = &drawn.polygons[0];
        assert!((area(&floor.outline) - 36.0).abs() < 0.2, "{}", area(&floor.outline));
        assert!(floor.outline.len() < 100, "{} points", floor.outline.len());
        for x in &floor.outline {
            let (x, y) = (x.x - 5.5, 5.5 - x.y);
            let most = (cosine * x + sine * y).abs().max((cosine * y - sine * x).abs());
            assert!((most - 3.0).abs() < 0.1, "{x} {y}: {most}");
        }
        let along = drawn.exits[0].path[1] - drawn.exits[0].path[0];
        assert!((along.length() - 2.3).abs() < 0.15 && (along.y / along.x).abs() - sine / cosine < 0.05, "{along}");
    }
    #[test]
    fn faults_are_said_with_their_places() {
        let fault = |bytes: &[u8], side: f64| read(bytes, side).expect_err("a fault");
        assert!(fault(b"POLYGON ((0 0))", 0.05).contains("no PNG"));
        assert!(fault(&room(BLACK, 0.0), 0.05).contains("has no exit"));
        // Two pixels beside the exit are open.
        let open = fault(&room(GREEN, 2.0), 0.05);
        assert!(open.contains("the exit at 5.40 2.50 has no closed room beside it"), "{open}");
        let short = fault(&room(GREEN, 0.0), 0.01);
        assert!(short.contains("the coloured spot at 1.08 0.50, 0.24 m long, is too short"), "{short}");
        assert!(fault(&room(GREEN, 0.0), 50.0).contains("no scale"));
        assert!(fault(&room(GREEN, 0.0)[..200], 0.05).contains("no PNG"));
    }
    #[test]
    fn closed_rooms_are_said() {
        let rooms = png(100, 60, |x, y| {
            let wall = !(4.0..96.0).contains(&x) || !(4.0..56.0).contains(&y) || (48.0..52.0).contains(&x);
            if wall {
                BLACK
            } else if (90.0..94.0).contains(&x) && (20.0..40.0).contains(&y) {
                GREEN
            } else {
                WHITE
            }
        });
        let Plan { drawn, remarks, landings } = read(&rooms, 0.1).expect("a plan");
        assert_eq!((drawn.polygons.len(), landings.len()), (1, 0));
        assert!((area(&drawn.polygons[0].outline) - 4.4 * 5.2).abs() < 0.01);
        assert!(remarks.len() == 1 && remarks[0].contains("of 22.9 m², has no way"), "{remarks:?}");
    }
}
