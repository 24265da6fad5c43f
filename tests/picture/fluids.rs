//! Fluids: the surface of drops, what it is made of, and light on it.

use glam::DVec3;
use motes::kernel::{Array, Backend, World};
use motes::motion::{Held, Hold};
use motes::render::{Picture, Scenery, Trail};
use motes::settings::Value;
use motes::*;

use super::*;

/// A lattice of particles, `spacing` apart, of those within a box for which `of` holds.
fn lattice(half: DVec3, spacing: f64, of: impl Fn(DVec3) -> bool) -> State {
    let mut particles = State::default();
    let number = |k: usize| (half[k] / spacing).floor();
    let steps = |k: usize| (0..).map(f64::from).map(move |i| i - number(k)).take_while(move |i| *i <= number(k));
    for z in steps(2) {
        for (y, x) in steps(1).flat_map(|y| steps(0).map(move |x| (y, x))) {
            let place = spacing * DVec3::new(x, y, z);
            if of(place) {
                particles.push(place, DVec3::ZERO, 1.0, 0.0);
            }
        }
    }
    particles
}

/// A fluid straight from above, 100 pixels per length.
fn above(width: u32, height: u32) -> Settings {
    let flat = settings(width, height).with("eye", Value::Vector(DVec3::Z)).with("projection", word("orthographic"));
    let framed = flat.with("auto_frame", Value::Flag(false)).with("extent", Value::Number(f64::from(height) / 200.0));
    framed.with("style", word("fluid")).with("background", word("day"))
}

fn picture(particles: &State, settings: &Settings) -> Picture {
    Picture::with(settings, particles, &[], Trail::default(), &Scenery::of(particles)).unwrap()
}

/// A field of a picture as a device leaves it.
fn field(particles: &State, picture: &Picture, name: &str) -> Vec<f64> {
    let count = u32::try_from(particles.len()).unwrap();
    let device = support::device();
    let mut gpu = Gpu::new(&device.found.device, &device.found.queue, count).unwrap();
    let program = gpu.compile(&picture.plan().unwrap()).unwrap();
    gpu.set_world(World { count, dt: 0.1, ..World::default() }).unwrap();
    let array = |v: &[DVec3], w: &[f64]| Array::Vec4(v.iter().zip(w).map(|(x, w)| x.extend(*w)).collect());
    gpu.write("position", &array(particles.position(), particles.mass())).unwrap();
    gpu.write("velocity", &array(particles.velocity(), particles.size())).unwrap();
    gpu.write("color", &Array::Uint(vec![0xff30_90e0; particles.len()])).unwrap();
    gpu.run(&program, 1).unwrap();
    let area = (picture.frame.width * picture.frame.height) as usize;
    let Array::Float(values) = pollster::block_on(gpu.read(name, &Array::Float(Vec::new()), area)).unwrap() else {
        panic!("{name} is of numbers")
    };
    values
}

/// The angle between the surface's normals and those of a ball about the middle, as a root mean square \[radians\].
fn off_a_ball(level: &[f64], side: usize) -> f64 {
    let middle = side / 2;
    let at = |x: usize, y: usize| level[y * side + x];
    // 100 pixels are a length, and the picture's middle is the corner of four of them.
    let radius = -at(middle, middle);
    let (mut sum, mut count) = (0.0, 0.0);
    for (y, x) in (1..side - 1).flat_map(|y| (1..side - 1).map(move |x| (y, x))) {
        let off = |k: usize| (k as f64 + 0.5 - middle as f64) / 100.0;
        let across = off(x).hypot(off(y));
        // Where it is steep, pixels are far apart on it.
        if across < 0.8 * radius {
            let slope = |a: f64, b: f64| 50.0 * (b - a);
            let right = DVec3::new(1.0, 0.0, -slope(at(x - 1, y), at(x + 1, y)));
            let down = DVec3::new(0.0, 1.0, -slope(at(x, y - 1), at(x, y + 1)));
            let want = DVec3::new(off(x), off(y), (radius * radius - across * across).sqrt());
            sum += right.cross(down).angle_between(want).powi(2);
            count += 1.0;
        }
    }
    assert!(count > 1000.0);
    f64::sqrt(sum / count)
}

#[test]
fn a_ball_of_fluid_has_the_normals_of_a_ball() {
    let particles = lattice(DVec3::ONE, 0.05, |x| x.length() < 1.0);
    let mut smooth = picture(&particles, &above(240, 240));
    assert!((smooth.frame.water.drop - 0.75 * 0.05).abs() < 1e-9, "drops by the spacing");
    let good = off_a_ball(&field(&particles, &smooth, "level"), 240);
    // Terraces a spacing high lie as far apart as the ball is flat; a mean over two drops each way leaves some of each.
    // Drops as they are have slopes of their own, up to the vertical.
    smooth.frame.water.calm = 0.0;
    let rough = off_a_ball(&field(&particles, &smooth, "level"), 240);
    println!("{good} {rough}");
    assert!(good < 0.15 && rough > 0.3, "{good} {rough}");
}

#[test]
fn a_slab_is_as_thick_as_it_is() {
    let (spacing, layers) = (0.05, 7.0);
    let particles = lattice(DVec3::new(0.8, 0.8, 0.16), spacing, |_| true);
    let thickness = field(&particles, &picture(&particles, &above(200, 200)), "thickness");
    for (x, y) in [(100, 100), (80, 117), (130, 71)] {
        // All of a drop's volume is counted: over a square of one spacing the mean is exact but for pixels at drops' edges.
        let mean = thickness[y * 200 + x] / (spacing * layers);
        assert!((mean - 1.0).abs() < 0.04, "{mean} at {x}, {y}");
    }
    assert!(thickness[5].abs() < 1e-30);
}

#[test]
fn walls_are_not_drawn_and_nothing_wet_is_sky() {
    let mut particles = lattice(DVec3::splat(0.3), 0.06, |_| true);
    let free = on_gpu(&particles, &[&picture(&particles, &above(120, 90))]).remove(0);
    particles.held = (0..).zip(particles.position()).map(|(id, _)| Held { id, by: Hold::Fixed }).collect();
    let held = Picture::with(
        &above(120, 90),
        &particles,
        &[],
        Trail::default(),
        &Scenery { tanks: Vec::new(), bounded: None, ..Scenery::of(&particles) },
    );
    let held = on_gpu(&particles, &[&held.unwrap()]).remove(0);
    let red = |image: &Image, x: usize, y: usize| image.rgba[4 * (y * 120 + x)];
    assert!(red(&free, 60, 45) < 120 && red(&held, 60, 45) > 130);
    // But for the dither, each row of the sky is of one colour.
    let row: Vec<u8> = (0..120).map(|x| red(&held, x, 45)).collect();
    assert!(row.iter().max().unwrap() - row.iter().min().unwrap() <= 1);
    // All particles behind the eye.
    let behind =
        settings(120, 90).with("auto_frame", Value::Flag(false)).with("center", Value::Vector(DVec3::Y * 99.0));
    let behind =
        behind.with("style", word("fluid")).with("eye", Value::Vector(DVec3::NEG_Y)).with("background", word("day"));
    particles.held.clear();
    let away = on_gpu(&particles, &[&picture(&particles, &behind)]).remove(0);
    assert_eq!(away.outside as usize, particles.len());
    assert!(red(&away, 60, 45).abs_diff(red(&held, 60, 45)) <= 1);
}

#[test]
fn one_drop_is_a_disc_and_an_eye_may_be_in_a_fluid() {
    let mut one = State::default();
    one.push(DVec3::new(0.1, -0.2, 0.0), DVec3::ZERO, 1.0, 0.0);
    let made = picture(&one, &above(100, 100).with("drop", Value::Number(0.2)));
    let image = &on_gpu(&one, &[&made])[0];
    // Its radius is 20 pixels, of which softening takes a quarter; half a pixel more is covered in part.
    let mut dry = one.clone();
    dry.position_mut()[0] = DVec3::splat(99.0);
    let sky = &on_gpu(&dry, &[&made])[0];
    let differs = |(a, b): &(&[u8], &[u8])| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 8);
    let area = image.rgba.chunks_exact(4).zip(sky.rgba.chunks_exact(4)).filter(differs).count() as f64;
    let radius = (area / std::f64::consts::PI).sqrt();
    assert!((14.5..20.5).contains(&radius), "{radius}");
    assert!(image.rgba[4 * (70 * 100 + 60)] < 200 && image.outside == 0);
    let particles = lattice(DVec3::splat(0.5), 0.1, |_| true);
    let inside = settings(90, 60).with("style", word("fluid")).with("auto_frame", Value::Flag(false));
    let made = picture(&particles, &inside.with("extent", Value::Number(0.05)));
    let images = on_gpu(&particles, &[&made, &made]);
    assert!(images[0] == images[1] && images[0].broken == 0 && lit(&images[0]) > 0);
}

#[test]
fn foam_is_where_it_is_fast() {
    let mut particles = lattice(DVec3::new(0.6, 0.3, 0.15), 0.05, |x| x.x.abs() > 0.1);
    let (positions, velocities) = particles.phase_mut();
    for (v, x) in velocities.iter_mut().zip(positions) {
        // Below three fifths of the speed there is none.
        *v = DVec3::Z * if x.x > 0.0 { 3.1 } else { 1.7 };
    }
    let color = |foam: f64| {
        let image =
            on_gpu(&particles, &[&picture(&particles, &above(160, 90).with("foam", Value::Number(foam)))]).remove(0);
        [40, 120].map(|x| image.rgba[4 * (45 * 160 + x)])
    };
    let ([slow, fast], [_, never]) = (color(3.0), color(0.0));
    assert!(slow < 120 && fast > 200 && never < 120, "{slow} {fast} {never}");
}
