//! Floor plans: the same two rooms in each format are the same plan, and what is no plan is an error that says where.

#![cfg(feature = "images")]

mod drawings;
mod faults;
mod fuzz;
mod geojson;
mod rooms;

use glam::DVec2;
use motes::floor_plan::{Exit, FloorPlan};
use motes::formats::floor_plan::{self, Measure, Plan, Scale};

/// Reads a plan of which the length of a unit is given.
fn read(text: &str, scale: Option<Scale>) -> Result<Plan, String> {
    floor_plan::read(text.as_bytes(), &Measure { scale, pixel: None })
}

#[track_caller]
fn fault(text: &str, scale: Option<Scale>) -> String {
    read(text, scale).expect_err(text)
}

/// The plan of `scenes/two_rooms.wkt`.
fn two_rooms() -> Plan {
    read(include_str!("../../../scenes/two_rooms.wkt"), None).expect("a plan")
}

/// The sides of the floor.
fn walls(plan: &Plan) -> Vec<[DVec2; 2]> {
    let rings = plan.drawn.polygons.iter().flat_map(|one| std::iter::once(&one.outline).chain(&one.holes));
    rings.flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| [*a, *b])).collect()
}

/// The largest distance of a place on some lines from others.
fn farthest(from: &[[DVec2; 2]], to: &[[DVec2; 2]]) -> f64 {
    let distance = |x: DVec2, [a, b]: &[DVec2; 2]| {
        let along = ((x - *a).dot(*b - *a) / (*b - *a).length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        x.distance(a.lerp(*b, along))
    };
    let places = from.iter().flat_map(|[a, b]| (0..=40).map(move |k| a.lerp(*b, f64::from(k) / 40.0)));
    places.map(|x| to.iter().map(|line| distance(x, line)).fold(f64::INFINITY, f64::min)).fold(0.0, f64::max)
}

/// Two plans have the same walls and exits within a length, and both can be used.
#[track_caller]
fn are_same(plan: &Plan, other: &Plan, within: f64, what: &str) {
    let [here, there] = [plan, other].map(walls);
    let apart = farthest(&here, &there).max(farthest(&there, &here));
    assert!(apart <= within, "{what}: walls are {apart} m apart: {here:?}");
    let lines = |plan: &Plan| -> Vec<Vec<[DVec2; 2]>> {
        let pieces = |path: &[DVec2]| path.windows(2).map(|pair| [pair[0], pair[1]]).collect();
        plan.drawn.exits.iter().map(|exit| pieces(&exit.path)).collect()
    };
    let [here, there] = [plan, other].map(lines);
    assert_eq!(here.len(), there.len(), "{what}");
    for (a, b) in here.iter().zip(&there) {
        let apart = farthest(a, b).max(farthest(b, a));
        assert!(apart <= within, "{what}: exits are {apart} m apart: {a:?} {b:?}");
    }
    usable(plan, what);
}

/// Makes the walls and exits of a plan.
#[track_caller]
fn usable(plan: &Plan, what: &str) -> FloorPlan {
    let exits = plan.drawn.exits.iter().zip(plan.names(&[]));
    let exits = exits.map(|(exit, name)| Exit { name, path: exit.path.clone(), reach: 0.25 }).collect();
    FloorPlan::new(&plan.drawn.polygons, exits, 0.1).unwrap_or_else(|why| panic!("{what}: {why}"))
}
