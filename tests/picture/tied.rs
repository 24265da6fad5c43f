//! Cloth, threads and solids.

use std::sync::Arc;

use glam::{DQuat, DVec3};
use motes::links::{Link, Links, Rod};
use motes::render::{Picture, Scenery, Shape, Solid, Trail};
use motes::settings::Value;
use motes::*;

use super::*;

fn spring(a: u32, b: u32) -> Link {
    Link { ends: [a, b], rest: 0.1, stiffness: 1.0, damping: 0.5, rope: false }
}

/// A wavy sheet of `side`² particles, three lengths wide, about the origin.
fn sheet(side: u32) -> State {
    let mut particles = State::default();
    let at = |k: u32| 3.0 * f64::from(k) / f64::from(side - 1) - 1.5;
    let id = |x: u32, y: u32| y * side + x;
    for (y, x) in (0..side).flat_map(|y| (0..side).map(move |x| (y, x))) {
        let height = 0.6 - 0.3 * (at(x).powi(2) + at(y).powi(2)) + 0.1 * (4.0 * at(x)).sin();
        particles.push(DVec3::new(at(x), at(y), height), DVec3::ZERO, 1.0, 0.0);
        if x + 1 < side {
            particles.links.springs.push(spring(id(x, y), id(x + 1, y)));
        }
        if x + 1 < side && y + 1 < side {
            particles.links.triangles.push([id(x, y), id(x + 1, y), id(x + 1, y + 1)]);
            particles.links.triangles.push([id(x, y), id(x + 1, y + 1), id(x, y + 1)]);
        }
    }
    particles
}

fn solids() -> Vec<Solid> {
    let of =
        |shape, x: f64, y: f64, z: f64| Solid { shape, place: DVec3::new(x, y, z), turn: DQuat::from_rotation_y(0.7) };
    let floor = Solid { turn: DQuat::IDENTITY, ..of(Shape::Plane, 0.0, 0.0, -0.9) };
    let half = DVec3::new(0.3, 0.2, 0.4);
    vec![
        floor,
        of(Shape::Ball { radius: 0.5 }, 0.1, 0.0, 0.0),
        of(Shape::Box { half }, 1.6, -1.2, -0.5),
        of(Shape::Capsule { radius: 0.2, half: 0.4 }, -1.5, -1.3, -0.3),
    ]
}

fn picture(particles: &State, settings: &Settings, solids: Vec<Solid>) -> Picture {
    let scenery = Scenery { solids, ..Scenery::of(particles) };
    Picture::with(settings, particles, &[], Trail::default(), &scenery).unwrap()
}

/// Straight from above, 100 pixels per length, in the dark.
fn above() -> Settings {
    let flat = settings(400, 300).with("eye", Value::Vector(DVec3::Z)).with("projection", word("orthographic"));
    flat.with("auto_frame", Value::Flag(false)).with("extent", Value::Number(1.5)).with("background", word("black"))
}

#[test]
fn what_is_torn_is_not_drawn_and_its_neighbours_are() {
    let mut particles = sheet(4);
    particles.position_mut().iter_mut().for_each(|x| x.z = 0.0);
    let color = |image: &Image, x: u32, y: u32| image.rgba[4 * (y * 400 + x) as usize..][..3].to_vec();
    let draw = |particles: &State| on_gpu(particles, &[&picture(particles, &above(), Vec::new())]).remove(0);
    let whole = draw(&particles);
    // The squares are a length wide, from 50 pixels on; the spring is the lower side of the one in the middle.
    let broken = particles.links.springs.iter_mut().find(|s| s.ends == [5, 6]).unwrap();
    (broken.stiffness, broken.damping) = (0.0, 0.0);
    let torn = draw(&particles);
    let (above_it, below_it, beside) = ((220, 180), (180, 220), (270, 150));
    for (place, still) in [(above_it, false), (below_it, false), (beside, true), ((180, 120), true)] {
        assert!(color(&whole, place.0, place.1)[0] > 60, "{place:?}");
        assert_eq!(color(&torn, place.0, place.1)[0] > 60, still, "{place:?}");
    }
    // A spring that still damps is none that is broken.
    particles.links.springs.iter_mut().find(|s| s.ends == [5, 6]).unwrap().damping = 0.1;
    assert!(draw(&particles) == whole);
}

#[test]
fn a_triangle_as_large_as_the_picture_is_drawn_whole() {
    let mut particles = State::default();
    for x in [DVec3::new(-9.0, -9.0, 0.0), DVec3::new(9.0, -9.0, 0.0), DVec3::new(0.0, 14.0, 0.0)] {
        particles.push(x, DVec3::ZERO, 1.0, 0.0);
    }
    particles.links.triangles.push([0, 1, 2]);
    let image = on_gpu(&particles, &[&picture(&particles, &above(), Vec::new())]).remove(0);
    assert_eq!(lit(&image), 400 * 300);
}

/// A funnel is as wide as it is at each height, is seen from within, and hides nothing that is in it.
#[test]
fn a_funnel_is_cut_open() {
    let mut particles = State::default();
    particles.push(DVec3::new(0.0, 0.0, 0.1), DVec3::ZERO, 1.0, 0.15);
    let side =
        above().with("eye", Value::Vector(DVec3::NEG_Y)).with("style", word("balls")).with("color", word("group"));
    let draw = |end: f64| {
        let shape = Shape::Cone { radius: 0.3, end, half: 0.5 };
        let funnel = Solid { shape, place: DVec3::ZERO, turn: DQuat::IDENTITY };
        on_gpu(&particles, &[&picture(&particles, &side, vec![funnel])]).remove(0)
    };
    let (funnel, tube) = (draw(0.9), draw(0.3));
    let at = |image: &Image, x: f64, z: f64| {
        let place = 400.0 * (150.0 - 100.0 * z).round() + 200.0 + 100.0 * x;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a pixel")]
        image.rgba[4 * place as usize..][..3].to_vec()
    };
    let dyed = |c: &[u8]| c.iter().max().unwrap() - c.iter().min().unwrap() > 40;
    let wall = |c: &[u8]| c[0] > 40 && !dyed(c);
    for image in [&funnel, &tube] {
        assert!(dyed(&at(image, 0.0, 0.1)) && wall(&at(image, 0.0, 0.4)) && wall(&at(image, 0.25, -0.45)));
        assert!(at(image, 0.5, -0.45)[0] < 20 && at(image, 0.0, 0.55)[0] < 20);
    }
    assert!(wall(&at(&funnel, 0.8, 0.45)) && at(&tube, 0.8, 0.45)[0] < 20);
}

#[test]
fn the_nearer_is_in_front_and_bobs_stay_balls_beside_their_rods() {
    let mut particles = State::default();
    for (x, radius) in [(-1.0, 0.1), (1.0, 0.1), (0.0, 0.0)] {
        particles.push(DVec3::new(x, 0.0, 0.0), DVec3::ZERO, 1.0, radius);
    }
    particles.links.rods.push(Rod { ends: [0, 1], length: 2.0 });
    let draw = |height: f64| {
        let ball =
            Solid { shape: Shape::Ball { radius: 0.3 }, place: DVec3::new(0.5, 0.0, height), turn: DQuat::IDENTITY };
        on_gpu(&particles, &[&picture(&particles, &above(), vec![ball])]).remove(0)
    };
    let (below, front) = (draw(-1.0), draw(1.0));
    let at = |image: &Image, x: u32, y: u32| image.rgba[4 * (y * 400 + x) as usize..][..3].to_vec();
    // The rod has colours of its ends, the stone has none.
    let grey = |c: &[u8]| c.iter().max().unwrap() - c.iter().min().unwrap() < 20;
    assert!(!grey(&at(&below, 250, 150)) && grey(&at(&front, 250, 150)));
    assert!(grey(&at(&below, 250, 170)) && at(&below, 250, 170)[0] > 40);
    assert_eq!(at(&below, 150, 150), at(&front, 150, 150));
    assert!(at(&below, 100, 145).iter().max().unwrap() > &100, "the bob is a ball");
}

#[test]
fn scenery_that_makes_no_sense_is_refused() {
    let particles = sheet(3);
    let with = |scenery: &Scenery| Picture::with(&above(), &particles, &[], Trail::default(), scenery);
    let stray = Links { triangles: vec![[0, 1, 9]], ..Links::default() };
    let loose = Links { springs: vec![spring(2, 12)], ..Links::default() };
    for links in [stray, loose] {
        let scenery = Scenery { links: Arc::new(links), ..Scenery::default() };
        assert!(matches!(with(&scenery), Err(Error::Scene(text)) if text.contains("ids go from 0")));
    }
    let crowd = Scenery { solids: vec![solids()[1]; 1025], ..Scenery::default() };
    assert!(matches!(with(&crowd), Err(Error::Scene(text)) if text.contains("1025") && text.contains("1024")));
}
