//! Outlines of fluids: round about a ball, straight at walls and at the sides of a box.

use glam::DVec3;
use motes::kernel::{Bounds, Side};
use motes::motion::{Held, Hold};
use motes::render::{Picture, Scenery, Trail};
use motes::settings::Value;
use motes::*;

use super::support::Random;
use super::*;

/// Particles on a lattice of a box from 0 on, each moved by up to `jitter` spacings, of those for which `of` holds.
fn block(numbers: [u32; 3], spacing: f64, jitter: f64, of: impl Fn(DVec3) -> bool) -> State {
    let (mut state, mut random) = (State::default(), Random::new(11));
    for (z, y) in (0..numbers[2]).flat_map(|z| (0..numbers[1]).map(move |y| (z, y))) {
        for x in 0..numbers[0] {
            let place = spacing * (DVec3::new(x.into(), y.into(), z.into()) + 0.5);
            let way = random.vector();
            let way = if numbers[2] > 1 { way } else { way.with_z(0.0) };
            if of(place) {
                let z = if numbers[2] > 1 { place.z } else { 0.0 };
                state.push(place.with_z(z) + jitter * spacing * way, DVec3::ZERO, 1.0, 0.0);
            }
        }
    }
    state
}

/// Straight from above about a place, 100 pixels per length, on black.
fn above(width: u32, height: u32, center: DVec3) -> Settings {
    let flat = settings(width, height).with("eye", Value::Vector(DVec3::Z)).with("projection", word("orthographic"));
    let framed = flat.with("auto_frame", Value::Flag(false)).with("extent", Value::Number(f64::from(height) / 200.0));
    framed.with("style", word("fluid")).with("background", word("black")).with("center", Value::Vector(center))
}

fn drawn(particles: &State, settings: &Settings, scenery: &Scenery) -> Image {
    let picture = Picture::with(settings, particles, &[], Trail::default(), scenery).unwrap();
    let image = on_gpu(particles, &[&picture]).remove(0);
    assert_close(&image, &on_cpu(particles, &picture), "an outline");
    image
}

/// How bright a pixel is.
fn bright(image: &Image, x: usize, y: usize) -> u8 {
    image.rgba[4 * (y * image.width as usize + x)..][..3].iter().copied().max().unwrap_or(0)
}

#[test]
fn a_ball_of_fluid_has_a_round_outline() {
    let (radius, center) = (1.0, DVec3::splat(1.1));
    let particles = block([44, 44, 44], 0.05, 0.2, |x| x.distance(center) < radius);
    let image = drawn(&particles, &above(300, 300, center), &Scenery::of(&particles));
    let edge = |angle: f64| {
        let at = |r: f64| [angle.cos(), angle.sin()].map(|part| 150.0 + r * part);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a pixel of the picture")]
        let lit = |r: &f64| bright(&image, at(*r)[0] as usize, at(*r)[1] as usize) > 30;
        (0..600).map(|k| 140.0 - 0.1 * f64::from(k)).find(lit).unwrap_or(0.0)
    };
    let edges: Vec<f64> = (0..180).map(|k| edge(f64::from(k) * std::f64::consts::PI / 90.0)).collect();
    let mean = edges.iter().sum::<f64>() / 180.0;
    let off = (edges.iter().map(|r| (r - mean).powi(2)).sum::<f64>() / 180.0).sqrt();
    println!("radius {mean}, off by {off}");
    // A spacing is 5 pixels. The outermost particles lie at random in the last spacing and stick out of it by three quarters: bumps
    // of some pixels, of which a mean over four drops each way leaves a few tenths.
    assert!((mean - 101.0).abs() < 3.0 && off < 0.8, "{mean} {off}");
}

#[test]
fn a_fluid_ends_straight_at_the_sides_of_its_box() {
    for side in [Side::Reflecting, Side::Periodic] {
        let bounds = Bounds::new(DVec3::ZERO, DVec3::new(2.0, 1.0, 0.0), side);
        let particles = block([20, 10, 1], 0.1, 0.35, |_| true);
        let scenery = Scenery::of(&particles).within(&bounds);
        let image =
            drawn(&particles, &above(240, 140, DVec3::new(1.0, 0.5, 0.0)), &Scenery { tanks: Vec::new(), ..scenery });
        // The box is from 20 to 220 across, and from 20 to 120 down.
        let is_lit = |x: usize, y: usize| bright(&image, x, y) > 60;
        for k in 20..220 {
            assert!(is_lit(k, 21) && is_lit(k, 118) && !is_lit(k, 18) && !is_lit(k, 121), "column {k} of {side:?}");
        }
        for k in 20..120 {
            assert!(is_lit(21, k) && is_lit(218, k) && !is_lit(18, k) && !is_lit(221, k), "row {k} of {side:?}");
        }
    }
}

#[test]
fn a_free_surface_is_a_line_and_the_border_to_a_wall_is_half_the_way() {
    let spacing = 0.2;
    let mut particles = block([14, 4, 1], spacing, 0.0, |_| true);
    let fluid = particles.len();
    for k in 0..14_u32 {
        particles.push(DVec3::new(spacing * (f64::from(k) + 0.5), -0.5 * spacing, 0.0), DVec3::ZERO, 1.0, 0.0);
    }
    let ids = u32::try_from(fluid).unwrap()..u32::try_from(particles.len()).unwrap();
    particles.held = ids.map(|id| Held { id, by: Hold::Fixed }).collect();
    let scenery = Scenery { tanks: Vec::new(), bounded: None, ..Scenery::of(&particles) };
    let settings = above(280, 160, DVec3::new(1.4, 0.4, 0.0)).with("color", word("group"));
    let image = drawn(&particles, &settings, &scenery);
    // Amber is above grey: its blue is far below its red.
    let blue = |x: usize, y: usize| i32::from(image.rgba[4 * (y * 280 + x) + 2]);
    let red = |x: usize, y: usize| i32::from(image.rgba[4 * (y * 280 + x)]);
    for x in 60..220 {
        let top = (0..160).find(|y| bright(&image, x, *y) > 60).unwrap();
        let first = (0..160).find(|y| bright(&image, 60, *y) > 60).unwrap();
        assert!(top.abs_diff(first) <= 1, "the surface is at {top} in column {x} and at {first} in another");
        // The picture's middle is at 0.4, and 0 is 40 pixels below it.
        assert!(red(x, 117) - blue(x, 117) > 60, "fluid above the border in column {x}");
        assert!((red(x, 123) - blue(x, 123)).abs() < 30 && red(x, 123) > 90, "wall below the border in column {x}");
    }
}

/// A drop by itself is seen, between those of a body and nothing.
#[test]
fn a_drop_by_itself_is_seen_and_a_hole_of_a_fluid_is_not() {
    let mut particles = block([8, 8, 1], 0.1, 0.0, |x| x.distance(DVec3::new(0.35, 0.35, 0.05)) > 0.01);
    particles.push(DVec3::new(1.2, 0.4, 0.0), DVec3::ZERO, 1.0, 0.0);
    let image = drawn(&particles, &above(200, 120, DVec3::new(0.6, 0.4, 0.0)), &Scenery::of(&particles));
    assert!(bright(&image, 160, 60) > 60 && bright(&image, 160, 72) < 20, "a drop");
    assert!(bright(&image, 75, 65) > 60, "a hole of one particle");
    let thick = block([6, 6, 6], 0.1, 0.1, |_| true);
    let mut spray = thick.clone();
    spray.push(DVec3::new(1.2, 0.3, 0.3), DVec3::ZERO, 1.0, 0.0);
    let center = DVec3::new(0.6, 0.3, 0.3);
    let images = [&thick, &spray].map(|state| drawn(state, &above(200, 120, center), &Scenery::of(state)));
    assert!(
        bright(&images[0], 160, 60) < 20 && bright(&images[1], 163, 60) > bright(&images[0], 163, 60) + 10,
        "spray"
    );
}
