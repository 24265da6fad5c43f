//! Strokes of light, colours by heading, and a bright sky.

use glam::DVec3;
use motes::render::{Color, Picture, Trail};
use motes::settings::Value;
use motes::*;

use super::*;

/// Particles on a line, 0.5 apart, each with its own velocity; seen from above, 100 pixels per length.
fn line(velocities: &[DVec3]) -> (State, Settings) {
    let mut particles = State::default();
    for (i, v) in (0_u32..).zip(velocities) {
        particles.push(DVec3::new(0.5 * f64::from(i) - 0.75, 0.0, 0.0), *v, 1.0, 0.0);
    }
    let above = settings(300, 200).with("eye", Value::Vector(DVec3::Z)).with("projection", word("orthographic"));
    let above =
        above.with("auto_frame", Value::Flag(false)).with("style", word("glow")).with("background", word("black"));
    (particles, above)
}

/// Brightness of the pixel so far right and up of the middle, in lengths.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place in the picture")]
fn bright(image: &Image, x: f64, y: f64) -> u8 {
    let at = [150.0 + 100.0 * x, 100.0 - 100.0 * y].map(|x| x as usize);
    image.rgba[4 * (at[1] * 300 + at[0])..][..3].iter().copied().max().unwrap_or(0)
}

#[test]
fn a_slab_leaves_out_what_is_before_and_behind_it() {
    let (mut particles, settings) = line(&[DVec3::ZERO; 4]);
    for x in particles.position_mut() {
        // From −0.75 behind the centre to 0.75 before it; of a slab of 1 the two in the middle are part.
        x.z = x.x;
    }
    for (slab, seen) in [(0.0, [true; 4]), (1.0, [false, true, true, false])] {
        let settings = settings.clone().with("slab", Value::Number(slab)).with("color", word("group"));
        let mut picture = Picture::new(&settings, &particles, &[], Trail::default()).unwrap();
        (picture.frame.bloom, picture.frame.glow) = (0.0, 4.0);
        let image = &on_gpu(&particles, &[&picture])[0];
        assert_close(image, &on_cpu(&particles, &picture), "a slab");
        assert_eq!([-0.75, -0.25, 0.25, 0.75].map(|x| bright(image, x + 0.005, 0.0) > 0), seen);
        assert_eq!(image.outside, if slab > 0.0 { 2 } else { 0 });
    }
}

#[test]
fn a_stroke_reaches_from_where_the_particle_was_and_a_particle_at_rest_is_a_light() {
    let (particles, settings) = line(&[DVec3::Y, DVec3::new(0.0, -2.0, 0.0), DVec3::ZERO, 0.5 * DVec3::X]);
    let settings = settings.with("color", word("heading")).with("tail", Value::Number(0.4));
    let mut picture = Picture::new(&settings, &particles, &[], Trail::default()).unwrap();
    (picture.frame.bloom, picture.frame.glow) = (0.0, 4.0);
    let image = &on_gpu(&particles, &[&picture])[0];
    assert_close(image, &on_cpu(&particles, &picture), "strokes");
    // From y = −0.4 to 0, brighter towards the present, and nothing beyond its ends.
    let first = [-0.45, -0.35, -0.2, 0.0, 0.1].map(|y| bright(image, -0.745, y));
    assert!(first[0] == 0 && first[1] > 0 && first[1] < first[2] && first[2] < first[3] && first[4] == 0, "{first:?}");
    // The faster one from y = 0.8 on; it came from above.
    let second = [-0.1, 0.0, 0.4, 0.7, 0.85].map(|y| bright(image, -0.245, y));
    assert!(second[0] == 0 && second[1] > second[2] && second[2] > second[3] && second[3] > 0 && second[4] == 0);
    let third = [-0.06, 0.0, 0.06].map(|y| bright(image, 0.255, y));
    assert!(third[0] == 0 && third[1] > 100 && third[2] == 0, "{third:?}");
    // Where nothing moves, strokes are the lights of a picture without.
    let (still, settings) = line(&[DVec3::ZERO; 4]);
    let with = Picture::new(&settings.clone().with("tail", Value::Number(3.0)), &still, &[], Trail::default()).unwrap();
    let mut without = Picture::new(&settings.with("tail", Value::Number(0.0)), &still, &[], Trail::default()).unwrap();
    without.frame.glow = with.frame.glow;
    let images = on_gpu(&still, &[&with, &without]);
    assert!(images[0] == images[1] && lit(&images[0]) > 0);
}

#[test]
fn headings_are_hues_and_the_same_bytes_every_time() {
    let (particles, settings) = line(&[DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_Y]);
    let picture = Picture::new(&settings.with("color", word("heading")), &particles, &[], Trail::default()).unwrap();
    assert_eq!(picture.color, Color::Heading);
    let images = on_gpu(&particles, &[&picture, &picture]);
    assert!(images[0] == images[1]);
    let middle = |i: usize| &images[0].rgba[4 * (100 * 300 + 75 + 50 * i)..][..3];
    // East is rose, north is gold, west is green, south is blue.
    let [east, north, west, south] = [0, 1, 2, 3].map(middle);
    assert!(east[0] > east[2] && east[2] > east[1], "{east:?}");
    assert!(north[0] > north[2] && north[1] > north[2], "{north:?}");
    assert!(west[1] > west[0] && west[2] > west[0], "{west:?}");
    assert!(south[2] > south[1] && south[2] > south[0], "{south:?}");
}

#[test]
fn birds_are_dark_before_a_bright_sky() {
    let (particles, settings) = line(&[DVec3::ZERO; 4]);
    let picture = Picture::new(&settings.with("background", word("dusk")), &particles, &[], Trail::default()).unwrap();
    let image = &on_gpu(&particles, &[&picture])[0];
    let (bird, sky) = (bright(image, 0.255, 0.0), bright(image, 0.0, 0.0));
    assert!(bird < 90 && sky > 150, "{bird} before {sky}");
    assert!(bright(image, 0.0, -0.9) > bright(image, 0.0, 0.9), "brighter where the sun has set");
}

/// Keys that a style does not use are said, and no others.
#[test]
fn keys_without_effect_are_remarked() {
    let remark = |style: &'static str, key: &'static str, value: Value| {
        let word = Value::Text(style.into());
        motes::render::styles::remark(&Settings::defaults(motes::render::KEYS).with("style", word).with(key, value))
    };
    let day = || Value::Text("day".into());
    assert!(remark("density", "background", day()).is_some_and(|text| text.contains("`background`")));
    assert!(remark("glow", "foam", Value::Number(1.0)).is_some_and(|text| text.contains("`foam`")));
    assert_eq!(remark("glow", "background", day()), None);
    assert_eq!(remark("fluid", "foam", Value::Number(1.0)), None);
}

/// A film has one frame: a heavy particle that is spawned later does not overflow the canvas, and one of many light ones is not lost.
#[test]
fn density_holds_all_mass_that_will_be() {
    use motes::life::{Birth, Life};
    let mut particles = State::default();
    (0..40).for_each(|_| particles.push(glam::DVec3::ZERO, glam::DVec3::ZERO, 1e-3, 0.0));
    particles.push(glam::DVec3::ZERO, glam::DVec3::ZERO, 0.0, 0.0);
    particles.set_life(40, Life::Pending);
    let birth = Birth { id: 40, time: 1.0, velocity: glam::DVec3::ZERO, mass: 1e3, guided: 0.0, emitter: 0 };
    particles.births = vec![birth];
    let settings = Settings::defaults(motes::render::KEYS).with("style", Value::Text("density".into()));
    let picture = Picture::new(&settings, &particles, &[], Trail::default()).expect("a picture");
    let frame = &picture.frame;
    // What all of them add on one pixel, each rounded up.
    let all = 0.5 * frame.unit * (40.0 * 1e-3 + 1e3) / frame.mean + 41.0;
    assert!(all < f64::from(u32::MAX), "{all:e}");
    // One of many light ones beside a heavy one is seen.
    let mut particles = State::default();
    (0..20_000).for_each(|_| particles.push(glam::DVec3::ZERO, glam::DVec3::ZERO, 1.0, 0.0));
    particles.push(glam::DVec3::ZERO, glam::DVec3::ZERO, 1e6, 0.0);
    let frame = Picture::new(&settings, &particles, &[], Trail::default()).expect("a picture").frame;
    assert!(0.5 * frame.unit / frame.mean > 100.0, "{}", frame.mean);
}
