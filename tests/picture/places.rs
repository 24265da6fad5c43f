//! Particles where they cannot be drawn, or all at one place.

use glam::{DVec3, Vec4};
use motes::kernel::{Array, Backend};
use motes::render::{Camera, Picture, Trail};
use motes::settings::Value;
use motes::*;

use super::*;

#[test]
fn what_is_behind_the_eye_or_beside_the_picture_is_counted_and_not_drawn() {
    let mut particles = support::cloud(80, 3);
    particles.size_mut().fill(0.0);
    let plain = settings(300, 200).with("auto_frame", Value::Flag(false)).with("extent", Value::Number(2.5));
    let settings = plain.with("eye", Value::Vector(DVec3::NEG_Y)).with("color", word("group"));
    let before = Picture::new(&settings, &particles, &[], Trail::new(80)).unwrap();
    let clean = &on_gpu(&particles, &[&before])[0];
    assert_eq!((clean.outside, clean.broken), (0, 0));
    let distance = before.frame.camera.distance;
    // On the axis behind the eye, at the eye, just before it; far beside; as far away as numbers go.
    let away = [
        DVec3::new(0.0, -2.0 * distance, 0.0),
        DVec3::new(0.0, -distance, 0.0),
        DVec3::new(0.0, -0.99 * distance, 0.0),
        DVec3::new(40.0, 0.0, 0.0),
        DVec3::new(0.0, 0.0, -9.0),
        DVec3::new(3e38, -3e38, 3e38),
    ];
    particles.position_mut()[..6].copy_from_slice(&away);
    let image = &on_gpu(&particles, &[&before])[0];
    assert_eq!((image.outside, image.broken), (6, 0));
    let cpu = on_cpu(&particles, &before);
    assert_close(image, &cpu, "away");
    assert!(lit(image) < lit(clean));
}

/// What `Simulation::write` refuses.
fn broken(values: &[Vec4]) -> Array {
    Array::Vec4(values.iter().map(|v| v.as_dvec4()).collect())
}

#[test]
fn broken_numbers_are_drawn_nowhere_and_counted() {
    let mut particles = support::cloud(70, 9);
    particles.size_mut().fill(0.03);
    let picture = Picture::new(&settings(260, 150), &particles, &[], Trail::new(70)).unwrap();
    let device = support::device();
    let mut gpu = Simulation::new(&device.found.device, &device.found.queue, &setup(particles.clone())).unwrap();
    let mut cpu = Simulation::on(Cpu::new(70).unwrap(), &setup(particles.clone())).unwrap();
    let mut position: Vec<Vec4> =
        particles.position().iter().zip(particles.mass()).map(|(x, m)| x.extend(*m).as_vec4()).collect();
    let mut velocity: Vec<Vec4> =
        particles.velocity().iter().zip(particles.size()).map(|(v, r)| v.extend(*r).as_vec4()).collect();
    position[3].x = f32::NAN;
    position[64].z = f32::NEG_INFINITY;
    position[10].w = f32::NAN;
    velocity[20].w = f32::INFINITY;
    velocity[30].y = f32::NAN;
    gpu.backend().write(POSITION.name, &broken(&position)).unwrap();
    gpu.backend().write(VELOCITY.name, &broken(&velocity)).unwrap();
    cpu.backend().write(POSITION.name, &broken(&position)).unwrap();
    cpu.backend().write(VELOCITY.name, &broken(&velocity)).unwrap();
    let (gpu, cpu) = (pollster::block_on(gpu.draw(&picture)).unwrap(), pollster::block_on(cpu.draw(&picture)).unwrap());
    assert_eq!(gpu.broken, 5);
    assert_close(&gpu, &cpu, "broken");
}

#[test]
fn particles_at_one_place_have_a_picture() {
    for place in [DVec3::ZERO, DVec3::new(1e6, -2e6, 3e6)] {
        for count in [1, 2, 65, 20_000] {
            let mut particles = State::default();
            for _ in 0..count {
                particles.push(place, DVec3::ZERO, 0.0, 0.0);
            }
            let picture = Picture::new(&settings(190, 110), &particles, &[], Trail::new(count)).unwrap();
            let Camera { center, extent, distance, .. } = picture.frame.camera;
            assert!(extent > 0.0 && extent.is_finite() && distance.is_finite(), "{extent} {distance}");
            assert!(center.distance(place) <= 1e-9 * place.length());
            let image = &on_gpu(&particles, &[&picture])[0];
            assert!(lit(image) > 0 && image.outside == 0, "{count} at {place}");
            assert!(image.rgba[(55 * 190 + 95) * 4] > 100, "{count} at {place}: the middle is dark");
            assert_close(image, &on_cpu(&particles, &picture), "one place");
        }
    }
}
