//! Where the particles of walls and drops stand.

use std::f64::consts::PI;

use glam::DVec3;
use motes::State;
use motes::settings::Value;
use motes::sph::{Smoothing, gap};

use crate::walls::{made, number, vector, word};

fn nearest(particles: &State) -> f64 {
    let all = particles.position();
    let of = |(n, x): (usize, &DVec3)| all[n + 1..].iter().map(|y| x.distance(*y)).fold(f64::INFINITY, f64::min);
    all.iter().enumerate().map(of).fold(f64::INFINITY, f64::min)
}

fn wall(values: &[(&'static str, Value)]) -> State {
    made("wall", &[&[("spacing", number(0.1))], values].concat()).expect("a wall")
}

#[test]
fn a_tank_is_a_hull_without_doubles() {
    let d = 0.1;
    let off = (gap(Smoothing::Cubic, 2.0, 1, 3) - 0.5) * d;
    let size = [0.5, 0.7, 0.9];
    let tank = |more: &[(&'static str, Value)]| {
        let values =
            [("size", vector(size[0], size[1], size[2])), ("spacing", number(d)), ("center", vector(0.25, 0.35, 0.45))];
        made("tank", &[&values, more].concat()).expect("a tank")
    };
    let closed = tank(&[]);
    // 5 × 7 × 9 cells and one layer around them, with edges and corners.
    assert_eq!(closed.len(), 7 * 9 * 11 - 5 * 7 * 9);
    assert_eq!(closed.held.len(), closed.len());
    assert!(nearest(&closed) > 0.99 * d, "{}", nearest(&closed));
    for axis in 0..3 {
        let [low, high] =
            [f64::min, f64::max].map(|of| closed.position().iter().map(|x| x[axis]).reduce(of).expect("some"));
        assert!((low + off).abs() < 1e-12 && (high - size[axis] - off).abs() < 1e-12, "{axis}: {low} {high}");
    }
    // Its samples face cells of the lattice.
    let floor = closed.position().iter().filter(|x| x.z < 0.0 && x.x > 0.0 && x.x < 0.5 && x.y > 0.0 && x.y < 0.7);
    assert_eq!(floor.clone().count(), 35);
    assert!(floor.clone().all(|x| ((x.x / d - 0.5).round() - (x.x / d - 0.5)).abs() < 1e-9));
    // Sides that are left out, and what is left of them: nothing beyond the room.
    assert_eq!(tank(&[("open", word("+z"))]).len(), 7 * 9 * 10 - 5 * 7 * 9);
    let channel = tank(&[("open", word("-x +x"))]);
    assert_eq!(channel.len(), 5 * (9 * 11 - 7 * 9));
    assert!(channel.position().iter().all(|x| x.x > 0.0 && x.x < 0.5));
    assert_eq!(tank(&[("layers", number(3.0))]).len(), 11 * 13 * 15 - 5 * 7 * 9);
    let wrong = made("tank", &[("size", vector(1.0, 1.0, 1.0)), ("spacing", number(d)), ("open", word("top"))]);
    assert!(wrong.expect_err("no side").to_string().contains("the side top; there are -x, +x"));
    // In the plane.
    let flat =
        made("tank", &[("size", vector(0.5, 0.7, 0.0)), ("spacing", number(d)), ("open", word("+y"))]).expect("a tank");
    assert_eq!(flat.len(), 2 * 7 + 5 + 2);
    assert!(flat.position().iter().all(|x| x.z == 0.0));
    // A slip of the pen is refused before it fills the memory.
    let many = made("tank", &[("size", vector(9.0, 9.0, 9.0)), ("spacing", number(1e-5))]);
    assert!(many.expect_err("many").to_string().contains("the maximum is 100000000"));
}

#[test]
fn planes_stand_behind_their_face() {
    let d = 0.1;
    for (flat, dimensions) in [(false, 3), (true, 2)] {
        let up = if flat { 0.0 } else { 0.5 };
        let (normal, middle) = (DVec3::new(0.6, 0.8, 0.0), DVec3::new(3.0, 2.0, 1.0));
        let values =
            [("normal", Value::Vector(normal)), ("size", vector(0.8, up, 0.0)), ("center", Value::Vector(middle))];
        let plane = wall(&values);
        assert_eq!(plane.len(), if flat { 8 } else { 40 });
        let behind = (gap(Smoothing::Cubic, 2.0, 1, dimensions) - 0.5) * d;
        assert!(plane.position().iter().all(|x| ((*x - middle).dot(normal) + behind).abs() < 1e-12));
        assert!((nearest(&plane) - d).abs() < 1e-12);
        let [low, high] = [f64::min, f64::max].map(|of| plane.position().iter().map(|x| x.z).reduce(of).expect("some"));
        assert!((high - low - if flat { 0.0 } else { 0.4 }).abs() < 1e-12, "{low} {high}");
    }
}

#[test]
fn boxes_and_spheres_are_hollow() {
    let d = 0.1;
    let off = (gap(Smoothing::Cubic, 2.0, 1, 3) - 0.5) * d;
    let sides = [("surface", word("box")), ("size", vector(0.5, 0.6, 0.7))];
    let inside = wall(&[&sides[..], &[("inside", Value::Flag(true))]].concat());
    let tank = made("tank", &[("size", vector(0.5, 0.6, 0.7)), ("spacing", number(d))]).expect("a tank");
    assert_eq!(inside.len(), tank.len());
    assert!(inside.position().iter().all(|x| tank.position().iter().any(|y| y.distance(*x) < 1e-12)));
    let outside = wall(&sides);
    let reach = outside.position().iter().map(|x| x.abs()).reduce(DVec3::max).expect("some");
    assert!(reach.distance(DVec3::new(0.25, 0.3, 0.35) - off) < 1e-12, "{reach}");
    // The hull of 5 × 6 × 7 cells whose outermost layers were moved in a little.
    assert_eq!(outside.len(), 5 * 6 * 7 - 3 * 4 * 5);
    // A sheet is one layer; a rectangle is a line around.
    assert_eq!(wall(&[("surface", word("box")), ("size", vector(0.5, 0.1, 0.5))]).len(), 25);
    assert_eq!(wall(&[("surface", word("box")), ("size", vector(0.5, 0.4, 0.0))]).len(), 2 * (5 + 4) - 4);
    for (within, dimensions) in [(false, 3), (true, 3), (false, 2), (true, 2)] {
        let flat = dimensions == 2;
        let size = vector(1.0, 1.0, if flat { 0.0 } else { 1.0 });
        let ball = wall(&[("surface", word("sphere")), ("size", size), ("inside", Value::Flag(within))]);
        let off = (gap(Smoothing::Cubic, 2.0, 1, dimensions) - 0.5) * d;
        let radius = if within { 0.5 + off } else { 0.5 - off };
        assert!(ball.position().iter().all(|x| (x.length() - radius).abs() < 1e-12));
        let wanted = if flat { 2.0 * PI * radius / d } else { 4.0 * PI * (radius / d).powi(2) };
        #[expect(clippy::cast_precision_loss, reason = "few")]
        let number = ball.len() as f64;
        assert!((number - wanted).abs() <= 0.5, "{number} {wanted}");
        // A spiral is even: the nearest two are 3.09 / √n of the radius apart (Swinbank & Purser 2006), but for some at the poles.
        assert!(nearest(&ball) > 0.75 * d, "{}", nearest(&ball));
    }
    for (surface, size, words) in [
        ("sphere", vector(1.0, 2.0, 1.0), "the same size along all axes"),
        ("plane", vector(0.0, 1.0, 0.0), "a plane has a size above 0 along x"),
        ("box", vector(1.0, 0.0, 1.0), "sides must be above 0"),
        ("mesh", vector(1.0, 1.0, 1.0), "name the file"),
    ] {
        let error =
            made("wall", &[("spacing", number(d)), ("surface", word(surface)), ("size", size)]).expect_err(words);
        assert!(error.to_string().contains(words), "{error}");
    }
}

#[test]
fn drops_are_cut_out_of_blocks() {
    let d = 0.1;
    let values = |z: f64| {
        [
            ("size", vector(1.0, 1.4, z)),
            ("spacing", number(d)),
            ("density", number(500.0)),
            ("velocity", vector(1.0, 2.0, 3.0)),
        ]
    };
    let drop = made("drop", &values(1.2)).expect("a drop");
    let block = made("block", &values(1.2)).expect("a block");
    let half = DVec3::new(0.5, 0.7, 0.6);
    let within: Vec<_> = block.position().iter().filter(|x| (**x / half).length() <= 1.0).copied().collect();
    assert_eq!(drop.position(), within);
    assert!(
        drop.mass().iter().all(|m| (m - 0.5).abs() < 1e-12)
            && drop.velocity().iter().all(|v| *v == DVec3::new(1.0, 2.0, 3.0))
    );
    // Its volume, up to its surface layer: 4/3 π a b c.
    let mass: f64 = drop.mass().iter().sum();
    assert!((mass / (500.0 * 4.0 / 3.0 * PI * half.element_product()) - 1.0).abs() < 0.03, "{mass}");
    let disk = made("drop", &values(0.0)).expect("a disk");
    assert!(disk.position().iter().all(|x| x.z == 0.0) && (disk.mass()[0] - 5.0).abs() < 1e-12);
    assert!((disk.mass().iter().sum::<f64>() / (500.0 * PI * 0.35) - 1.0).abs() < 0.03);
}
