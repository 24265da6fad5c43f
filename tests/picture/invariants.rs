//! What holds in every picture: the same bytes, whatever the order of particles; all light that is given; no particle lost.

use glam::DVec3;
use motes::State;
use motes::kernel::{Array, Backend};
use motes::render::{Color, Picture, Trail};
use motes::settings::Value;

use super::draw::{device, gpu, plain};
use super::{scenes, settings, support, word};

#[test]
fn every_style_gives_the_same_bytes_twice() {
    let shared = support::device();
    for scene in scenes::all() {
        let [first, second] = [0, 1].map(|_| device(&shared, &scene.state, &scene.picture));
        assert!(first == second, "{}", scene.name);
    }
}

/// The order of particles, by their ids, is no part of a picture: lights are added in integers, and the nearest is in front.
#[test]
fn no_picture_depends_on_the_order_of_particles() {
    let shared = support::device();
    for style in ["glow", "balls", "density", "fluid"] {
        for tail in [0.0, 0.4] {
            let mut state = support::cloud(300, 17);
            state.size_mut().iter_mut().step_by(3).for_each(|radius| *radius = 0.1);
            let mut turned = State::default();
            for id in (0..state.len()).rev() {
                let (x, v) = (state.position()[id], state.velocity()[id]);
                turned.push(x, v, state.mass()[id], state.size()[id]);
            }
            let settings = settings(96, 64).with("style", word(style)).with("tail", Value::Number(tail));
            let picture =
                Picture::new(&settings.with("color", word("heading")), &state, &[], Trail::default()).unwrap();
            assert!(device(&shared, &state, &picture) == device(&shared, &turned, &picture), "{style} {tail}");
            let images = [&state, &turned].map(|state| plain(state, &picture));
            // Sums of f64 depend on the order by their last bits, which the dither may show.
            let off = images[0].rgba.iter().zip(&images[1].rgba).filter(|(a, b)| a != b).count();
            assert!(off <= 3, "{style} {tail}: {off} on the host");
        }
    }
}

/// All numbers of the canvas together.
fn canvas(state: &State, picture: &Picture) -> f64 {
    let mut gpu = gpu(&support::device(), state, picture);
    let plan = picture.plan().unwrap();
    let program = gpu.compile(&plan).unwrap();
    if let (Color::Given(colors), true) = (&picture.color, plan.fields(picture.frame.count).contains_key("color")) {
        gpu.write("color", &Array::Uint(colors.clone())).unwrap();
    }
    gpu.run(&program, 1).unwrap();
    let len = 3 * (picture.frame.width * picture.frame.height) as usize;
    let Array::Uint(words) = pollster::block_on(gpu.read("canvas", &Array::Uint(Vec::new()), len)).unwrap() else {
        panic!("a canvas is of whole numbers")
    };
    words.into_iter().map(f64::from).sum()
}

/// What the canvas holds is what particles give, wherever they are: the integral of a light's profile, for each.
#[test]
fn all_light_is_on_the_canvas() {
    let mut state = support::cloud(2000, 23);
    state.size_mut().fill(0.0);
    let plain = settings(96, 64).with("auto_frame", Value::Flag(false)).with("extent", Value::Number(2.0));
    let plain = plain.with("eye", Value::Vector(DVec3::NEG_Y)).with("projection", word("orthographic"));
    for (style, colors) in [("density", 1.0), ("glow", 3.0)] {
        for aside in [0.0, 0.013, 0.21] {
            let center = Value::Vector(DVec3::new(aside, 0.0, -aside));
            let settings = plain.clone().with("style", word(style)).with("center", center).with("color", word("group"));
            let mut picture = Picture::new(&settings, &state, &[], Trail::default()).unwrap();
            picture.color = Color::Given(vec![u32::MAX; state.len()]);
            picture.frame.glow = 4.0;
            let area = std::f64::consts::PI * picture.frame.glow.powi(2);
            // ∫ q² = π R² / 3, and ∫ q² (¼ + ¾ q⁴) = π R² (¼ / 3 + ¾ / 7), with q = 1 − r² / R².
            let (unit, share) = if style == "density" {
                let mass = state.mass().iter().sum::<f64>() / picture.frame.mean;
                (0.5 * picture.frame.unit * mass, 1.0 / 3.0)
            } else {
                (picture.frame.unit * state.len() as f64, 0.25 / 3.0 + 0.75 / 7.0)
            };
            let (all, want) = (canvas(&state, &picture), colors * unit * share * area);
            // A sum over 50 pixels for each of 2000 places is the integral to better than a part in a thousand.
            assert!((all / want - 1.0).abs() < 2e-3, "{style} {aside}: {all:e}, not {want:e}");
        }
    }
}

/// What is not in the picture is counted: particles that are drawn, and those that are not, are all.
#[test]
fn no_particle_is_lost_without_a_word() {
    let mut state = support::cloud(500, 31);
    state.size_mut().fill(0.0);
    state.position_mut()[7].y = f64::NAN;
    let base = settings(96, 64).with("auto_frame", Value::Flag(false)).with("projection", word("orthographic"));
    let base = base.with("eye", Value::Vector(DVec3::NEG_Y)).with("style", word("glow"));
    for extent in [0.2, 0.5, 0.9, 5.0] {
        let settings = base.clone().with("extent", Value::Number(extent));
        let picture = Picture::new(&settings, &state, &[], Trail::default()).unwrap();
        let (scale, glow) = (32.0 / extent, picture.frame.glow);
        // A light beyond an edge is seen when it reaches a pixel.
        let is_seen = |x: &DVec3| {
            let reach = |along: f64, half: f64| (scale * along).abs() < half + glow;
            x.is_finite() && reach(x.x, 48.0) && reach(x.z, 32.0)
        };
        let drawn = state.position().iter().filter(|x| is_seen(x)).count();
        for image in [device(&support::device(), &state, &picture), plain(&state, &picture)] {
            assert_eq!((image.broken, drawn + image.outside as usize + 1), (1, 500), "{extent}");
        }
    }
}

/// Tails of particles that wait or are gone are no part of a picture.
#[test]
fn inactive_particles_leave_no_trace() {
    let shared = support::device();
    for style in ["glow", "balls", "density", "fluid"] {
        let mut state = support::cloud(90, 37);
        let settings = settings(96, 64).with("auto_frame", Value::Flag(false)).with("tail", Value::Number(0.5));
        let settings = settings.with("style", word(style)).with("color", word("heading"));
        state.set_life(3, motes::life::Life::Pending);
        state.set_life(80, motes::life::Life::Removed);
        let picture = Picture::new(&settings, &state, &[], Trail::default()).unwrap();
        let mut elsewhere = state.clone();
        for id in [3, 80] {
            elsewhere.position_mut()[id] *= 0.3;
            elsewhere.velocity_mut()[id] *= -1.0;
        }
        assert!(device(&shared, &state, &picture) == device(&shared, &elsewhere, &picture), "{style}");
        assert!(plain(&state, &picture) == plain(&elsewhere, &picture), "{style} on the host");
        // Of a fluid those inside do not show.
        elsewhere.position_mut()[4..12].iter_mut().for_each(|x| *x *= 0.3);
        assert!(device(&shared, &state, &picture) != device(&shared, &elsewhere, &picture), "{style}: no difference");
    }
}
