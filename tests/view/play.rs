//! Playing with a run: pulls, balls and bars.

use egui::{Key, Modifiers, Pos2, Vec2};
use motes::settings::Value;

use super::hand::Hand;
use super::{small, spots};

/// The median distance of particles from the line of sight through the middle of the picture: `spring_chain` and its kin lie in a plane, and a
/// camera along z sees it straight.
fn median_distance(hand: &mut Hand) -> f64 {
    let mut away: Vec<f64> = hand.places().iter().map(|x| x.truncate().length()).collect();
    away.sort_by(f64::total_cmp);
    away[away.len() / 2]
}

/// From above, at the middle of a sphere: what is pulled comes closer to the axis than what is not, and what is pushed is farther.
#[test]
fn a_drag_pulls_particles_or_pushes_them_and_lets_go() {
    let away = |presses: u32| {
        let mut hand = Hand::on("plummer", &["particles.0.count=500", "particles.0.seed=3"]);
        hand.key(Key::Num5, Modifiers::NONE);
        (0..presses).for_each(|_| hand.key(Key::G, Modifiers::NONE));
        hand.until(12);
        let middle = Pos2::new(250.0, 600.0);
        hand.hold(middle, middle + Vec2::new(0.5, 0.0), 60);
        let steps = hand.steps();
        let pulled = median_distance(&mut hand);
        (pulled, steps, hand)
    };
    let (alone, _, mut hand) = away(0);
    assert_eq!(hand.forces(), ["gravity"]);
    let (pulled, steps, mut hand_of_pull) = away(1);
    assert!(pulled < 0.85 * alone, "pulled to {pulled}, by itself {alone}: {}", hand_of_pull.message());
    assert_eq!(hand_of_pull.forces(), ["gravity", "tweezers"]);
    let depth = hand_of_pull.setting("tweezers", "depth");
    assert_eq!(depth, Value::Number(0.0), "it is let go");
    let before = hand_of_pull.steps();
    hand_of_pull.frames(3);
    assert!(before >= steps && hand_of_pull.steps() == before + 3, "the run goes on");
    let (pushed, ..) = away(2);
    assert!(pushed > 1.1 * alone, "pushed to {pushed}, by itself {alone}");
    // With the settings of the scene nothing is left of it.
    let place = hand_of_pull.place("Scene");
    hand_of_pull.click(place);
    hand_of_pull.frames(1);
    assert_eq!(hand_of_pull.forces(), ["gravity"]);
    hand.key(Key::Space, Modifiers::NONE);
    hand.key(Key::G, Modifiers::NONE);
    hand.hold(Pos2::new(250.0, 600.0), Pos2::new(260.0, 600.0), 2);
    assert!(hand.message().contains("Space"), "a run that stands still: {}", hand.message());
    assert_eq!(hand.forces(), ["gravity"], "nothing is compiled for it");
    hand.key(Key::Space, Modifiers::NONE);
    assert_eq!(hand.message(), "");
}

#[test]
fn a_ball_is_placed_where_it_is_drawn_and_keeps_particles_out() {
    let mut hand = Hand::on("plummer", &["particles.0.count=500"]);
    hand.key(Key::Num5, Modifiers::NONE);
    hand.frames(2);
    let before = hand.picture();
    (0..3).for_each(|_| hand.key(Key::G, Modifiers::NONE));
    let (middle, edge) = (Pos2::new(250.0, 600.0), Pos2::new(310.0, 600.0));
    hand.hold(middle, edge, 2);
    assert_eq!(hand.forces(), ["gravity", "solid"], "{}", hand.message());
    let (position, radius) = (hand.setting("solid", "position"), hand.setting("solid", "radius"));
    let (Value::Vector(center), Value::Number(radius)) = (position, radius) else { panic!("a ball") };
    hand.frames(20);
    assert!(hand.picture() != before, "the same picture");
    let nearest = hand.places().iter().map(|x| x.distance(center)).fold(f64::INFINITY, f64::min);
    assert!(nearest > 0.999 * radius, "a particle is inside: {nearest} of {radius}");
    // The tool is used up: a drag turns the camera again. The ball has sliders of its own.
    hand.hold(middle, edge, 2);
    assert_eq!(hand.forces(), ["gravity", "solid"]);
    hand.frames(20);
    let place = hand.place("Remove the last obstacle");
    hand.click(place);
    hand.frames(1);
    assert_eq!(hand.forces(), ["gravity"]);
}

/// A bar lies along its drag, and a click draws none.
#[test]
fn a_bar_is_drawn_from_end_to_end_and_keeps_particles_out() {
    let mut hand = Hand::on("plummer", &["particles.0.count=500"]);
    hand.key(Key::Num5, Modifiers::NONE);
    hand.frames(2);
    (0..4).for_each(|_| hand.key(Key::G, Modifiers::NONE));
    let (begin, end) = (Pos2::new(250.0, 560.0), Pos2::new(250.0, 680.0));
    hand.click(begin);
    hand.frames(1);
    assert!(hand.message().contains("as long as the drag"), "{}", hand.message());
    assert_eq!(hand.forces(), ["gravity"]);
    hand.hold(begin, end, 2);
    assert_eq!(hand.forces(), ["gravity", "solid"], "{}", hand.message());
    let values = ["position", "axis", "radius"].map(|key| hand.setting("solid", key));
    let [Value::Vector(center), Value::Vector(axis), Value::Number(radius)] = values else { panic!("a bar") };
    assert!(axis.x.abs() + axis.z.abs() < 1e-3 * axis.y.abs(), "down the picture: {axis}");
    assert!((axis.length() / radius - 120.0 / (0.03 * 600.0)).abs() < 0.3, "{axis} {radius}");
    hand.frames(20);
    let places = hand.places();
    let distance = |x: &glam::DVec3| {
        let along = ((*x - center).dot(axis) / axis.length_squared()).clamp(-0.5, 0.5);
        x.distance(center + along * axis)
    };
    let nearest = places.iter().map(distance).fold(f64::INFINITY, f64::min);
    assert!(nearest > 0.999 * radius, "a particle is inside: {nearest} of {radius}");
}

/// What is placed, and another background, leave the camera where it is, though the particles have moved since it framed them.
#[test]
fn the_camera_stays_while_one_plays() {
    let mut hand = Hand::on("plummer", &["particles.0.count=3", "particles.0.seed=4"]);
    hand.key(Key::H, Modifiers::NONE);
    hand.frames(3);
    hand.until(150);
    hand.key(Key::Space, Modifiers::NONE);
    hand.frames(3);
    let width = hand.size()[0] as usize;
    let seen = |hand: &mut Hand, count| spots(&hand.picture(), width, (820.0, 60.0), count);
    let before = seen(&mut hand, 3);
    let corner = Pos2::new(60.0, 1100.0);
    (0..3).for_each(|_| hand.key(Key::G, Modifiers::NONE));
    hand.hold(corner, corner + Vec2::new(20.0, 0.0), 1);
    assert_eq!(hand.forces(), ["gravity", "solid"], "{}", hand.message());
    hand.frames(3);
    let after = seen(&mut hand, 5);
    for spot in &before {
        let moved = after.iter().map(|at| (*at - *spot).length()).fold(f32::INFINITY, f32::min);
        assert!(moved < 2.0, "{spot:?} has moved by {moved} pixels: {after:?}");
    }
}

/// Scenes of each kind take a pull and a ball: their kernels compile with them, and steps go on.
#[test]
fn scenes_of_each_kind_can_be_played_with() {
    let names = ["dam_break_2d", "cloth", "pile", "argon", "vicsek", "room"];
    for name in names {
        let scene = motes::scene::SCENES.iter().find(|scene| scene.name == name).expect("a scene");
        let mut hand = Hand::on(scene.name, small::smaller(scene.name));
        hand.key(Key::G, Modifiers::NONE);
        hand.frames(1);
        let middle = Pos2::new(250.0, 600.0);
        hand.hold(middle, middle + Vec2::new(20.0, 0.0), 2);
        assert_eq!(hand.message(), "", "{}", scene.name);
        assert!(hand.forces().iter().any(|name| name.starts_with("tweezers")), "{}", scene.name);
        (0..2).for_each(|_| hand.key(Key::G, Modifiers::NONE));
        hand.hold(middle, middle + Vec2::new(0.0, 40.0), 1);
        assert!(hand.forces().iter().any(|name| name.starts_with("solid")), "{}: {}", scene.name, hand.message());
        hand.frames(2);
    }
}
