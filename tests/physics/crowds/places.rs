//! Plans that cannot be as they are meant: nested outlines, large coordinates, exits across and behind walls, places without a way; at the start, in
//! births, in spawning, and where a run goes on.

use glam::{DVec2, DVec3};
use motes::floor_plan::{Exit, FloorPlan, MOST_PIECES, Polygon};
use motes::life::{Birth, Life};
use motes::{Setup, State};
use pollster::block_on;

use super::plans::{exit, outline, plan};
use super::{PERSON, Person, setup, state};
use crate::matter::on_cpu;
use crate::support::states::force;

fn square(low: f64, high: f64) -> Vec<DVec2> {
    outline(&[[low, low], [high, low], [high, high], [low, high]])
}

/// A floor, its holes, and another floor: each in the order of those that cannot be.
#[test]
fn outlines_within_outlines_are_refused_or_face_the_right_way() {
    let polygon = |outline: Vec<DVec2>, holes: Vec<Vec<DVec2>>| Polygon { outline, holes };
    let why = |all: &[Polygon]| FloorPlan::new(all, vec![], 0.1).expect_err("nested").clone();
    let holes = why(&[polygon(square(0.0, 9.0), vec![square(1.0, 8.0), square(2.0, 3.0)])]);
    assert!(holes.starts_with("hole 2 of the floor is within hole 1 of the floor at 2 "), "{holes}");
    let floors = why(&[polygon(square(0.0, 9.0), vec![]), polygon(square(2.0, 3.0), vec![])]);
    assert!(floors.starts_with("polygon 2 is within polygon 1 at 2 2"), "{floors}");
    let floors = why(&[polygon(square(2.0, 3.0), vec![]), polygon(square(0.0, 9.0), vec![])]);
    assert!(floors.starts_with("polygon 1 is within polygon 2 at 2 2"), "{floors}");
    // A floor in a hole of another, with a hole in it: each wall has the floor at its left.
    let rooms = [polygon(square(0.0, 9.0), vec![square(1.0, 8.0)]), polygon(square(2.0, 7.0), vec![square(3.0, 4.0)])];
    let plan = FloorPlan::new(&rooms, vec![], 0.1).expect("rooms");
    assert_eq!(plan.segments().len(), 16);
    for wall in plan.segments() {
        let middle = 0.5 * (wall.a + wall.b);
        let left = (wall.b - wall.a).perp().normalize();
        assert!(plan.holds(middle + 0.01 * left) && !plan.holds(middle - 0.01 * left), "{wall:?}");
    }
}

/// At 500 000 m numbers of single precision are 2⁻⁵ m apart, and walls of 5 cm would be moved onto each other; from an origin near it the plan is what it was.
#[test]
fn large_coordinates_are_refused_with_the_way_out() {
    let far = |shift: DVec2| -> Vec<[f64; 2]> {
        [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]].map(|x| (DVec2::from(x) + shift).to_array()).to_vec()
    };
    let why = plan(&far(DVec2::new(500_000.5, 5_300_000.25)), vec![], 0.1).expect_err("far");
    assert!(why.contains("up to 5300010.25") && why.contains("0.5 apart"), "{why}");
    assert!(why.contains("the most is 0.001") && why.contains("origin = [500000, 5300000, 0]"), "{why}");
    // Below 2¹⁴ m numbers are 2⁻¹⁰ m apart, within a hundredth of a cell, and beyond 2⁻⁹ m; larger cells allow more.
    assert!(plan(&far(DVec2::X * 16_300.0), vec![], 0.1).is_ok());
    assert!(
        plan(&far(DVec2::X * 16_400.0), vec![], 0.1).is_err() && plan(&far(DVec2::X * 16_400.0), vec![], 0.2).is_ok()
    );
}

/// Two rooms of 5 by 10, with a wall of 10 cm between them that has a door from 4 to 6 or none.
fn rooms(door: bool, exits: Vec<Exit>) -> Result<FloorPlan, String> {
    let with = [
        [0.0, 0.0],
        [5.0, 0.0],
        [5.0, 4.0],
        [5.1, 4.0],
        [5.1, 0.0],
        [10.0, 0.0],
        [10.0, 10.0],
        [5.1, 10.0],
        [5.1, 6.0],
        [5.0, 6.0],
        [5.0, 10.0],
        [0.0, 10.0],
    ];
    let right = |x: &DVec2| DVec2::new(x.x + 5.1, x.y);
    let room = outline(&[[0.0, 0.0], [5.0, 0.0], [5.0, 10.0], [0.0, 10.0]]);
    let apart = [room.iter().map(right).collect(), room].map(|outline| Polygon { outline, holes: vec![] });
    if door { plan(&with, exits, 0.1) } else { FloorPlan::new(&apart, exits, 0.1) }
}

/// A line may end at walls, where numbers of six digits put it, and not cross one, however thin.
#[test]
fn exits_that_leave_the_floor_are_refused_with_the_place() {
    let ok = |path: &[[f64; 2]]| rooms(true, vec![exit(path, 0.25)]);
    assert!(ok(&[[5.05, 4.0], [5.05, 6.0]]).is_ok() && ok(&[[5.05, 3.999_999], [5.05, 6.000_001]]).is_ok());
    assert!(ok(&[[1.0, 5.0], [9.0, 5.0]]).is_ok(), "through the door");
    for (path, place) in [
        (&[[4.0, 3.0], [6.0, 3.0]][..], "crosses a wall at 5 3:"),
        (&[[1.0, 5.0], [1.0, 3.0], [6.0, 3.0]], "crosses a wall at 5 3:"),
        (&[[6.0, 2.0], [4.0, 2.0]], "crosses a wall at 5.1 2:"),
        (&[[9.0, 1.0], [11.0, 1.0]], "crosses a wall at 10 1:"),
        (&[[0.0, 2.0], [0.0, 4.0]], "is not on the floor at 0 3:"),
        (&[[10.0, 2.0], [10.0, 4.0]], "is not on the floor at 10 3:"),
        (&[[5.05, 3.0], [5.05, 5.0]], "is not on the floor at 5.05 3.5:"),
    ] {
        let why = ok(path).expect_err(place);
        assert!(why.contains(place), "{why}");
    }
    // Of 256 pieces and no more.
    let long = |pieces: usize| -> Vec<[f64; 2]> { (0..=pieces).map(|k| [1.0 + 0.01 * k as f64, 2.0]).collect() };
    assert!(ok(&long(MOST_PIECES)).is_ok());
    let why = ok(&long(MOST_PIECES + 1)).expect_err("long");
    assert!(why.contains("257 straight pieces, and the most is 256"), "{why}");
    assert!(rooms(true, vec![exit(&[[1.0, 1.0], [1.0, 2.0]], -1.0)]).expect_err("reach").contains("the reach -1"));
}

fn people(at: &[[f64; 2]]) -> State {
    let person = |at: &[f64; 2]| Person { position: DVec2::from(*at).extend(0.0), speed: 0.0, ..PERSON };
    state(&at.iter().map(person).collect::<Vec<_>>())
}

fn resting(plan: FloorPlan, at: &[[f64; 2]]) -> Setup {
    let mut people = people(at).on_floor(plan);
    // At rest, and not driven.
    people.velocity_mut().iter_mut().for_each(|v| *v = DVec3::ZERO);
    setup(people, vec![force("navigate", &[])], 1e-3)
}

/// The line of an exit 0.1 in front of a wall of 0.1, with a reach of 1: pedestrians beyond the wall stay, unless they see it through the door.
#[test]
fn drains_do_not_act_through_walls() {
    let at =
        [[4.5, 2.0], [5.3, 2.0], [5.4, 3.5], [4.2, 2.9], [3.0, 2.0], [4.4, 4.05], [5.05, 4.2], [5.3, 4.3], [5.15, 4.6]];
    // Of the last three only the first, on the line through the door's corner (5, 4) from (4.9, 3.8), is in sight, and the last one is too.
    let line = exit(&[[4.9, 1.0], [4.9, 3.8]], 1.0);
    let free = |x: [f64; 2]| rooms(true, vec![line.clone()]).expect("rooms").free_distance(&line, x.into()).is_some();
    let want: Vec<bool> = at.iter().map(|x| line.distance((*x).into()) < 1.0 && free(*x)).collect();
    assert_eq!(want, [true, false, false, true, false, true, true, false, true]);
    let setup = resting(rooms(true, vec![line.clone()]).expect("rooms"), &at);
    let left = |state: &State| -> Vec<bool> { (0..state.len()).map(|i| !state.is_active(i)).collect() };
    let mut cpu = on_cpu(&setup);
    cpu.step(1).expect("a step");
    assert_eq!(left(&block_on(cpu.snapshot()).expect("a state")), want);
    let shared = crate::support::device();
    let mut gpu = motes::Simulation::new(&shared.found.device, &shared.found.queue, &setup).expect("a simulation");
    gpu.step(1).expect("a step");
    assert_eq!(left(&block_on(gpu.snapshot()).expect("a state")), want);
}

fn diagnosed(setup: &Setup) -> String {
    block_on(motes::diagnose::diagnose(setup)).expect_err("a fault").to_string()
}

/// Every pedestrian needs a way, and every exit a pedestrian that has one, by what is in front of walls: not by cells that are nearer behind one.
#[test]
fn sealed_rooms_are_refused() {
    let left = || exit(&[[1.0, 4.0], [1.0, 6.0]], 0.25);
    let right = || exit(&[[9.0, 4.0], [9.0, 6.0]], 0.25);
    let both = diagnosed(&resting(rooms(false, vec![left(), right()]).expect("rooms"), &[[3.0, 3.0]]));
    assert!(both.contains("no way leads to the exit \"door\" at 9 4 from where any particle is"), "{both}");
    assert!(
        block_on(motes::diagnose::diagnose(&resting(
            rooms(true, vec![left(), right()]).expect("rooms"),
            &[[3.0, 3.0]]
        )))
        .is_ok()
    );
    // 2 cm before the wall, where cells of both rooms are around.
    let near = diagnosed(&resting(rooms(false, vec![left()]).expect("rooms"), &[[3.0, 3.0], [5.12, 3.0]]));
    assert!(near.contains("1 particles have no way to an exit, the first of them particle 1 at 5.12 3"), "{near}");
}

/// Cells larger than a radius lead by what is behind a thin wall.
#[test]
fn cells_larger_than_pedestrians_are_refused() {
    let room = |cell| {
        plan(&[[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]], vec![exit(&[[9.0, 4.0], [9.0, 6.0]], 0.25)], cell)
            .expect("a room")
    };
    let why = diagnosed(&resting(room(0.31), &[[3.0, 3.0]]));
    assert!(why.contains("sides of 0.31") && why.contains("radius 0.3") && why.contains("cell = 0.3"), "{why}");
    assert!(block_on(motes::diagnose::diagnose(&resting(room(0.3), &[[3.0, 3.0]]))).is_ok());
}

/// Pedestrians to be spawned, by an emitter or between two steps, and those of a run that goes on, are asked as well.
#[test]
fn births_and_spawned_ones_are_on_the_floor_with_a_way() {
    let exits = || vec![exit(&[[1.0, 4.0], [1.0, 6.0]], 0.25)];
    let later = |at: [f64; 2]| {
        let mut setup = resting(rooms(false, exits()).expect("rooms"), &[[3.0, 3.0], at]);
        setup.state.set_life(1, Life::Pending);
        setup.state.births =
            vec![Birth { id: 1, time: 0.5, velocity: DVec3::ZERO, mass: 80.0, guided: 0.0, emitter: 0 }];
        setup
    };
    assert!(block_on(motes::diagnose::diagnose(&later([4.0, 3.0]))).is_ok());
    let why = later([12.0, 3.0]).check().expect_err("off the floor").to_string();
    assert!(why.contains("off the floor of the plan, the first of them particle 1 at 12 3"), "{why}");
    let why = diagnosed(&later([7.0, 3.0]));
    assert!(why.contains("have no way to an exit, the first of them particle 1 at 7 3"), "{why}");

    let mut simulation = on_cpu(&resting(rooms(false, exits()).expect("rooms"), &[[3.0, 3.0]]));
    simulation.step(2).expect("steps");
    for (at, said) in [
        ([12.0, 3.0], "off the floor of the plan, the first of them particle 0 at 12 3"),
        ([7.0, 3.0], "no way to an exit"),
    ] {
        let why = block_on(simulation.spawn(&people(&[at]))).expect_err("refused").to_string();
        assert!(why.contains(said), "{why}");
    }
    assert_eq!(block_on(simulation.spawn(&people(&[[4.0, 3.0]]))).expect("room for one"), [1]);

    // In a run that goes on walls have kept all; where none do, pedestrians may be anywhere.
    let mut goes_on = resting(rooms(true, exits()).expect("rooms"), &[[3.0, 3.0], [12.0, 3.0]]);
    (goes_on.state.step, goes_on.state.time) = (5, 5e-3);
    goes_on.check().expect("anywhere");
    goes_on.forces.push(force("social_wall", &[]));
    assert!(goes_on.check().expect_err("off the floor").to_string().contains("particle 1 at 12 3"));
}

/// One that is spawned beside a wall is not put back to where its row was before.
#[test]
fn spawned_pedestrians_stay_where_they_are() {
    let exits = vec![exit(&[[1.0, 4.0], [1.0, 6.0]], 0.25)];
    let mut setup = resting(rooms(true, exits).expect("rooms"), &[[3.0, 3.0]]);
    setup.forces.push(force("social_wall", &[]));
    let mut simulation = on_cpu(&setup);
    simulation.step(2).expect("steps");
    block_on(simulation.spawn(&people(&[[8.0, 3.0]]))).expect("room for one");
    simulation.step(3).expect("steps");
    let end = block_on(simulation.snapshot()).expect("a state");
    assert!((end.position()[1] - DVec3::new(8.0, 3.0, 0.0)).length() < 1e-3, "{}", end.position()[1]);
    assert_eq!(end.scalar("wall_corrections").expect("counts"), [0.0, 0.0]);
}

/// Where nothing stops at walls that is said; with `social_wall` it is not. Its range is no smaller than a pedestrian, and its `decay` no smaller than
/// an eightieth of one, beyond which exp(R / B) has no number.
#[test]
fn walls_that_nothing_stops_at_are_remarked_on() {
    let room = || rooms(true, vec![exit(&[[1.0, 4.0], [1.0, 6.0]], 0.25)]).expect("rooms");
    let ids = |setup: &Setup| -> Vec<&str> {
        block_on(motes::diagnose::diagnose(setup)).expect("remarks").iter().map(|remark| remark.id).collect()
    };
    let mut setup = resting(room(), &[[3.0, 3.0]]);
    assert!(ids(&setup).contains(&"open-walls"));
    setup.forces.push(force("social_wall", &[]));
    assert!(!ids(&setup).contains(&"open-walls"));
    let of = |key: &'static str, value: f64| {
        let wall = force("social_wall", &[(key, motes::settings::Value::Number(value))]);
        Setup { forces: vec![wall], ..resting(room(), &[[3.0, 3.0]]) }.check()
    };
    for (key, least) in [("range", 0.3), ("decay", 0.3 / 80.0)] {
        assert!(of(key, 1.001 * least).is_ok(), "{key}");
        let why = of(key, 0.999 * least).expect_err("too small").to_string();
        assert!(why.contains("radius"), "{why}");
    }
}
