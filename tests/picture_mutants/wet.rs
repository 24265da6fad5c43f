//! Fluids: what the shaders of a surface, of tanks and of light on them tell apart.

use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};
use motes::render::{Color, Picture, Scenery, Shape, Solid};

use crate::scenes::{MANY, PLAIN, Scene, Wish, at, awkward, with};

/// Kernels that no other scene has; what they share with others those ask about.
pub const KERNELS: [&str; 6] = ["project", "foam", "drops", "level", "settle", "water"];

fn tank(half: DVec3, place: DVec3) -> Solid {
    Solid { shape: Shape::Box { half }, place, turn: DQuat::from_rotation_y(0.2) }
}

/// The pool is so much smaller than the puddle: the eye is less than a length away.
const SMALL: f64 = 1.0 / 6.0;

fn colored(picture: &mut Picture, speed: f64) {
    let words = (1..=131_u32).map(|k| k.wrapping_mul(0x9E37_79B9));
    picture.color = Color::Given(words.collect());
    picture.frame.water.foam = speed;
    picture.frame.water.wire = 0.4;
    // So coarse that a place which is known to 1e-5 pixels hardly decides.
    picture.frame.water.grain = 190.0;
    picture.frame.water.layer = 0.0104 * picture.frame.water.drop;
}

pub fn wet() -> Vec<Scene> {
    let place = SMALL * DVec3::new(0.4, 0.2, 0.2);
    let ball = Solid { shape: Shape::Ball { radius: 0.3 * SMALL }, place, turn: DQuat::IDENTITY };
    let large = tank(SMALL * DVec3::new(0.9, 0.6, 0.5), SMALL * DVec3::new(-0.1, 0.0, 0.1));
    let tanks = vec![large, tank(SMALL * DVec3::new(0.0, 0.3, 0.2), DVec3::ZERO)];
    let scenery = Scenery { solids: vec![ball], tanks, held: Arc::new(vec![2, 40]), ..Scenery::default() };
    let pool = Wish { name: "pool", style: "fluid", background: "day", extent: 0.2, count: MANY, ..PLAIN };
    let pool = with(&pool, &scenery, |picture, particles| {
        awkward(picture, particles);
        picture.frame.water.drop = 0.22 * SMALL;
        colored(picture, 1.3);
        picture.frame.water.calm = 1.1;
        picture.frame.water.farthest = 5;
        picture.frame.water.murk = 1.7 / SMALL;
        // Some are so near that they are cut off, and half of them are in one heap.
        picture.frame.largest = 7.0;
        for x in &mut particles.position_mut()[60..] {
            *x = 0.35 * *x + SMALL * DVec3::new(-0.2, 0.1, 0.0);
        }
        // So far away that they are less than a pixel.
        let camera = picture.frame.camera;
        for (k, x) in (0..).zip(&mut particles.position_mut()[110..118]) {
            *x = at(&camera, DVec2::new(70.0 - 20.0 * f64::from(k), 45.0), 33, -3.2 * camera.distance);
        }
    });
    let plane = tank(DVec3::new(1.0, 0.8, 0.0), DVec3::new(0.05, 0.0, 0.0));
    let scenery = Scenery { tanks: vec![plane], ..Scenery::default() };
    let puddle = Wish { name: "puddle", style: "fluid", projection: "orthographic", count: MANY, ..PLAIN };
    let puddle = with(&puddle, &scenery, |picture, particles| {
        awkward(picture, particles);
        picture.frame.water.drop = 0.15;
        colored(picture, 0.7);
        picture.frame.water.stain = 0.6;
        picture.frame.water.wire = 0.8;
        picture.frame.water.calm = 1.9;
        picture.frame.water.murk = 4.3;
        // Two at exactly one place; and both edges of a row, which are neighbours in memory.
        particles.position_mut()[100] = particles.position()[101];
        let camera = picture.frame.camera;
        for (x, place) in
            particles.position_mut()[90..].iter_mut().zip([DVec2::new(4.0, 16.4), DVec2::new(-3.0, -16.0)])
        {
            *x = at(&camera, place, 33, 0.1);
        }
        // Those at the right are a little nearer, and before all others.
        for (k, height) in (0..).zip([9.0, 3.0, -4.0, -10.0]) {
            particles.position_mut()[92 + 2 * k] = at(&camera, DVec2::new(22.4, height), 33, 0.91);
            particles.position_mut()[93 + 2 * k] = at(&camera, DVec2::new(-22.0, height - 0.4), 33, 0.9);
        }
        picture.frame.water.oblate = 1.0;
    });
    vec![pool, puddle]
}
