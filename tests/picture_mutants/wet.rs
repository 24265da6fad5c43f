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

fn colored(picture: &mut Picture, speed: f64) {
    let words = (1..=131_u32).map(|k| k.wrapping_mul(0x9E37_79B9));
    picture.color = Color::Given(words.collect());
    picture.frame.water.foam = speed;
    picture.frame.water.wire = 0.4;
    // So coarse that a place which is known to 1e-5 pixels hardly decides.
    picture.frame.water.grain = 190.0;
    picture.frame.water.layer = 0.0013;
}

pub fn wet() -> Vec<Scene> {
    let ball = Solid { shape: Shape::Ball { radius: 0.3 }, place: DVec3::new(0.4, 0.2, 0.2), turn: DQuat::IDENTITY };
    let tanks = vec![tank(DVec3::new(0.9, 0.6, 0.5), DVec3::new(-0.1, 0.0, 0.1)), tank(DVec3::new(0.0, 0.3, 0.2), DVec3::ZERO)];
    let scenery = Scenery { solids: vec![ball], tanks, held: Arc::new(vec![2, 40]), ..Scenery::default() };
    let pool = Wish { name: "pool", style: "fluid", background: "day", count: MANY, ..PLAIN };
    let pool = with(&pool, &scenery, |picture, particles| {
        awkward(picture, particles);
        colored(picture, 1.3);
        picture.frame.water.drop = 0.22;
        picture.frame.water.calm = 1.1;
        picture.frame.water.farthest = 5;
        picture.frame.water.murk = 1.7;
        // Some are so near that they are cut off, and half of them are in one heap.
        picture.frame.largest = 7.0;
        for x in &mut particles.position[60..] {
            *x = 0.35 * *x + DVec3::new(-0.2, 0.1, 0.0);
        }
    });
    let plane = tank(DVec3::new(1.0, 0.8, 0.0), DVec3::new(0.05, 0.0, 0.0));
    let scenery = Scenery { tanks: vec![plane], ..Scenery::default() };
    let puddle = Wish { name: "puddle", style: "fluid", projection: "orthographic", count: MANY, ..PLAIN };
    let puddle = with(&puddle, &scenery, |picture, particles| {
        awkward(picture, particles);
        colored(picture, 0.7);
        picture.frame.water.stain = 0.6;
        picture.frame.water.drop = 0.15;
        picture.frame.water.calm = 1.9;
        picture.frame.water.murk = 4.3;
        // Two at exactly one place, and edges of the picture.
        particles.position[100] = particles.position[101];
        let edge = [DVec2::new(22.4, 3.0), DVec2::new(-22.0, -5.0), DVec2::new(4.0, 16.4), DVec2::new(-3.0, -16.0)];
        for (x, place) in particles.position[90..].iter_mut().zip(edge) {
            *x = at(&picture.frame.camera, place, 33, 0.1);
        }
    });
    vec![pool, puddle]
}
