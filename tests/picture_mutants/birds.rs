//! Birds: many particles with headings and tails, in the dark and before a bright sky.

use glam::DVec3;
use motes::render::Exposure;

use crate::scenes::{MANY, PLAIN, Scene, Wish, awkward, scene, sizes};

/// Scenes of as many particles as [`crate::scenes::many`].
pub fn birds() -> Vec<Scene> {
    let headings = scene(&Wish { count: MANY, name: "headings", color: "heading", ..PLAIN }, |picture, particles| {
        awkward(picture, particles);
        // At rest, hardly not, neither, and as fast as can be.
        let speeds = [0.0, 4e-31, 1.3e-30, 3e-24, 1e15, 2e36];
        for (v, speed) in particles.velocity_mut()[30..].iter_mut().zip(speeds) {
            *v = speed * v.normalize();
        }
        particles.velocity_mut()[40] = DVec3::Z;
        particles.velocity_mut()[41] = DVec3::NEG_Z;
        // Whatever is divided by anything but the largest number does not fit.
        particles.velocity_mut()[42] = DVec3::new(3e30, -1e-9, 1e-9);
        particles.velocity_mut()[43] = DVec3::new(1e-9, 3e30, -1e-9);
        particles.velocity_mut()[44] = DVec3::new(-1e-9, 1e-9, 3e30);
    });
    let strokes = scene(&Wish { count: MANY, name: "strokes", style: "auto", ..PLAIN }, |picture, particles| {
        awkward(picture, particles);
        sizes(particles, 0.1);
        picture.frame.solid = 2.2;
        picture.frame.tail = 0.9;
        // So broad and bright that its faint rim is to be seen.
        picture.frame.unit = 1024.0;
        picture.frame.glow = 6.0;
        // Straight across, and straight up; at rest; from behind the eye; from where numbers end.
        let back = picture.frame.camera.back;
        let [right, up] = [picture.frame.camera.right, picture.frame.camera.up];
        for (v, way) in
            particles.velocity_mut()[40..].iter_mut().zip([right, up, DVec3::ZERO, -40.0 * back, 1e38 * right])
        {
            *v = way;
        }
        // Diagonals, on which a stroke has the most pixels across; so long that it is hardly narrower in the picture.
        for (i, sign) in (50..90).zip([1.0, -1.0].into_iter().cycle()) {
            particles.position_mut()[i] *= 0.4;
            particles.velocity_mut()[i] = 60.0 * (right + sign * up);
        }
    });
    let mut dusk = scene(&Wish { count: MANY, name: "dusk", background: "dusk", ..PLAIN }, |picture, _| {
        picture.frame.tail = 0.4;
        picture.frame.ink = 0.8;
    });
    dusk.exposure = Exposure { knee: 60.0, white: 300.0 };
    vec![headings, strokes, dusk]
}
