//! Pictures: snapshots, invariants, mutation of shaders, awkward sizes and places; and the plain renderer beside the device.

mod draw;
mod fluids;
#[cfg(feature = "scene")]
mod frames;
mod invariants;
mod limits;
mod looks;
mod mutation;
mod outlines;
mod places;
mod scenes;
mod snapshots;
#[path = "../support/mod.rs"]
mod support;
mod tied;

use glam::DVec3;
use motes::render::{Image, KEYS, Picture, Trail};
use motes::settings::{Settings, Value};
use motes::*;

fn settings(width: u32, height: u32) -> Settings {
    let sized = Settings::defaults(KEYS).with("width", Value::Number(width.into()));
    sized.with("height", Value::Number(height.into()))
}

fn word(text: &'static str) -> Value {
    Value::Text(text.into())
}

fn setup(particles: State) -> Setup {
    let integrator = integrators::entry("leapfrog").unwrap().by_default();
    let mut untied = particles;
    untied.links = links::Links::default();
    Setup {
        // A picture may show what is broken, and a simulation would refuse to tie.
        state: untied,
        forces: Vec::new(),
        integrator,
        dt: 0.013,
        bounds: motes::Bounds::default(),
        solver: motes::Solver::default(),
    }
}

fn on_gpu(particles: &State, pictures: &[&Picture]) -> Vec<Image> {
    let device = support::device();
    let mut simulation = Simulation::new(&device.found.device, &device.found.queue, &setup(particles.clone())).unwrap();
    pictures.iter().map(|picture| pollster::block_on(simulation.draw(picture)).unwrap()).collect()
}

fn on_cpu(particles: &State, picture: &Picture) -> Image {
    let cpu = Cpu::new(u32::try_from(particles.len()).unwrap()).unwrap();
    pollster::block_on(Simulation::on(cpu, &setup(particles.clone())).unwrap().draw(picture)).unwrap()
}

/// Some turns of a spiral for each particle.
fn trail(particles: &State) -> Trail {
    let mut trail = Trail::new(particles.len());
    for turn in 0..40 {
        let angle = 0.31 * f64::from(turn);
        let offset = 0.9 * (1.0 - f64::from(turn) / 40.0) * DVec3::new(angle.cos(), angle.sin(), 0.3);
        trail.push(&particles.position().iter().map(|x| *x + offset).collect::<Vec<_>>());
    }
    trail
}

/// The colour of a pixel that nothing but sky has anything to do with is below this.
const SKY: u8 = 24;

fn lit(image: &Image) -> usize {
    image.rgba.chunks_exact(4).filter(|p| p[..3].iter().any(|c| *c > SKY)).count()
}

/// The plain renderer's picture is the device's, to within what drivers differ by.
fn assert_close(gpu: &Image, cpu: &Image, what: &str) {
    let off = draw::Difference::between(&draw::rgb(gpu), &draw::rgb(cpu));
    println!("{what}: {off:?}, {} lit", lit(gpu));
    assert!(off.is_within(1.0), "{what}: {off:?}");
    assert_eq!((gpu.outside, gpu.broken), (cpu.outside, cpu.broken), "{what}");
    assert!(lit(gpu) > 0, "{what}: nothing is lit");
}

#[test]
fn device_and_plain_renderer_draw_the_same_at_awkward_sizes() {
    let sizes = [(1, 320, 200), (2, 257, 131), (65, 301, 203), (1000, 127, 255), (4097, 640, 360)];
    for (count, width, height) in sizes {
        for (style, projection, color) in
            [("auto", "perspective", "auto"), ("glow", "orthographic", "speed"), ("balls", "perspective", "group")]
        {
            let mut particles = support::cloud(count, 7);
            particles
                .size_mut()
                .iter_mut()
                .enumerate()
                .for_each(|(i, r)| *r = 0.017 * f64::from(u8::try_from(i % 7).unwrap()));
            particles
                .mass_mut()
                .iter_mut()
                .zip([1.0, 0.3, 1e-3, 0.07, 2e-5].iter().cycle())
                .for_each(|(m, part)| *m *= part);
            particles.mass_mut()[count / 2] = 0.0;
            let settings = settings(width, height).with("style", word(style)).with("projection", word(projection));
            let settings = settings.with("color", word(color)).with("eye", Value::Vector(DVec3::new(0.3, -0.9, 0.55)));
            let groups: Vec<u32> = [0, 1, 2].into_iter().cycle().take(count).collect();
            let picture = Picture::new(&settings, &particles, &groups, trail(&particles)).unwrap();
            let gpu = &on_gpu(&particles, &[&picture])[0];
            assert_close(gpu, &on_cpu(&particles, &picture), &format!("{count} {width}×{height} {style} {projection}"));
        }
    }
}

#[test]
fn the_same_state_gives_the_same_bytes_and_another_gives_others() {
    let particles = support::cloud(3000, 5);
    let small = Picture::new(&settings(129, 70), &particles, &[], Trail::new(3000)).unwrap();
    // A larger picture in between: fields are made anew for every size.
    let large = Picture::new(&settings(500, 301), &particles, &[], Trail::new(3000)).unwrap();
    let images = on_gpu(&particles, &[&small, &large, &small, &large]);
    assert!(images[0] == images[2] && images[1] == images[3]);
    assert!(images[1] == on_gpu(&particles, &[&large])[0]);
    let mut moved = particles.clone();
    moved.position_mut()[17].x += 0.5;
    assert!(images[1] != on_gpu(&moved, &[&large])[0]);
}

#[test]
fn a_large_ball_has_the_area_of_its_disc() {
    let mut particles = State::default();
    particles.push(DVec3::new(3.0, 4.0, 5.0), DVec3::ZERO, 1.5, 2.0);
    // Half the height is 8, so that a ball of radius 2 is an eighth of the height across its radius: 75 pixels.
    let settings = settings(900, 600).with("auto_frame", Value::Flag(false)).with("extent", Value::Number(8.0));
    let settings = settings.with("center", Value::Vector(DVec3::new(3.0, 4.0, 5.0))).with("background", word("black"));
    for projection in ["orthographic", "perspective"] {
        let settings = settings.clone().with("projection", word(projection));
        let mut picture = Picture::new(&settings, &particles, &[], Trail::new(1)).unwrap();
        picture.frame.bloom = 0.0;
        let image = &on_gpu(&particles, &[&picture])[0];
        // The dark side of a ball is lit too, by 0.16 of its colour.
        let area = lit(image) as f64;
        assert!((area / (std::f64::consts::PI * 75.0 * 75.0) - 1.0).abs() < 0.03, "{projection}: {area}");
        // Several layers of the dispatch draw it: no row is left out between two.
        assert_close(image, &on_cpu(&particles, &picture), projection);
        // Its middle is in the middle of the picture.
        let rows: Vec<usize> = (0..600).filter(|y| image.rgba[(y * 900 + 450) * 4] > SKY).collect();
        assert_eq!(usize::midpoint(rows[0], rows[rows.len() - 1]), 299, "{projection}");
    }
}

#[test]
fn the_nearer_ball_is_in_front_whatever_its_id() {
    for near in [0, 1] {
        let mut particles = State::default();
        for id in 0..2 {
            let y = if id == near { -3.0 } else { 3.0 };
            particles.push(DVec3::new(0.0, y, 0.0), DVec3::ZERO, 1.5, if id == near { 1.0 } else { 2.0 });
        }
        let settings = settings(200, 200).with("eye", Value::Vector(DVec3::NEG_Y)).with("color", word("group"));
        let picture = Picture::new(&settings, &particles, &[], Trail::new(2)).unwrap();
        let image = &on_gpu(&particles, &[&picture])[0];
        // The first colour is amber, the second blue.
        let middle = &image.rgba[(100 * 200 + 100) * 4..][..3];
        assert_eq!(middle[0] > middle[2], near == 0, "{near}: {middle:?}");
    }
}

#[test]
fn a_trail_is_where_the_particle_was() {
    let mut particles = State::default();
    particles.push(DVec3::new(0.8, 0.0, 0.0), DVec3::ZERO, 1.0, 0.01);
    let mut trail = Trail::new(1);
    trail.push(&[DVec3::new(-0.8, 0.0, 0.0)]);
    let plain = settings(200, 100).with("auto_frame", Value::Flag(false)).with("projection", word("orthographic"));
    let settings = plain.with("eye", Value::Vector(DVec3::NEG_Y)).with("background", word("black"));
    let mut picture = Picture::new(&settings, &particles, &[], trail).unwrap();
    picture.frame.bloom = 0.0;
    let image = &on_gpu(&particles, &[&picture])[0];
    // From x = 100 − 0.8 · 50 to 100 + 0.8 · 50, on the line between the two middle rows.
    let red = |x: usize, y: usize| image.rgba[(y * 200 + x) * 4];
    assert!((62..135).all(|x| red(x, 49) > SKY && red(x, 50) > SKY));
    assert!((0..57).all(|x| (0..100).all(|y| red(x, y) < SKY)), "nothing before the first point");
    assert!((62..130).all(|x| red(x, 46) < SKY && red(x, 53) < SKY), "a thin line");
    assert_close(image, &on_cpu(&particles, &picture), "trail");
    // Broad lines in every direction, longer than what one layer of the dispatch walks.
    let mut particles = support::cloud(40, 13);
    particles.size_mut().fill(0.0);
    let settings = settings.with("width", Value::Number(1500.0)).with("height", Value::Number(1200.0));
    let mut trail = Trail::new(40);
    trail.push(&particles.position().iter().map(|x| DVec3::new(x.y, x.z, x.x)).collect::<Vec<_>>());
    let mut picture = Picture::new(&settings, &particles, &[], trail).unwrap();
    picture.frame.line = 3.3;
    assert_close(&on_gpu(&particles, &[&picture])[0], &on_cpu(&particles, &picture), "broad trails");
}

#[test]
fn pictures_that_make_no_sense_are_refused() {
    let particles = support::cloud(4, 1);
    let refused = |settings: &Settings, particles: &State| {
        let made = Picture::new(settings, particles, &[], Trail::default());
        matches!(made, Err(Error::Scene(message)) if !message.is_empty())
    };
    assert!(refused(&settings(9000, 100), &particles));
    assert!(refused(&settings(8000, 8000), &particles));
    assert!(refused(&settings(320, 200), &State::default()));
    assert!(!refused(&settings(1, 1), &particles));
    // Made for four, drawn of five.
    let picture = Picture::new(&settings(32, 20), &particles, &[], Trail::default()).unwrap();
    let mut five = Simulation::on(Cpu::new(5).unwrap(), &setup(support::cloud(5, 1))).unwrap();
    assert!(matches!(pollster::block_on(five.draw(&picture)), Err(Error::Scene(_))));
}

#[cfg(feature = "scene")]
#[test]
fn a_png_reads_back_to_the_same_pixels() {
    let particles = support::cloud(100, 2);
    let picture = Picture::new(&settings(123, 45), &particles, &[], Trail::new(100)).unwrap();
    let image = on_cpu(&particles, &picture);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cloud.png");
    image.save(&path).unwrap();
    let mut reader =
        png::Decoder::new(std::io::BufReader::new(std::fs::File::open(&path).unwrap())).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    assert_eq!((info.width, info.height), (123, 45));
    let rgb: Vec<u8> = image.rgba.chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
    assert!(bytes[..info.buffer_size()] == rgb);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "nothing else is left");
    assert!(matches!(image.save(&folder.path().join("no/such/folder.png")), Err(Error::Output { .. })));
}
