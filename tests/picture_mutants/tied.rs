//! Cloth, threads and solids: what the shaders of a picture's scenery tell apart.

use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};
use motes::State;
use motes::links::{Link, Links, Rod};
use motes::render::{Camera, Color, Exposure, Picture, Scenery, Shape, Solid};

use crate::scenes::{MANY, PLAIN, Scene, Wish, at, with};

/// Particles of a sheet are the first.
const SIDE: u32 = 5;

fn spring(ends: [u32; 2], stiffness: f64, damping: f64) -> Link {
    Link { ends, rest: 0.1, stiffness, damping, rope: false }
}

/// A sheet with springs along its sides, some of them broken; threads; and triangles that are hardly any.
fn links(count: u32) -> Links {
    let mut links = Links::default();
    let id = |x: u32, y: u32| y * SIDE + x;
    for (x, y) in (0..SIDE - 1).flat_map(|x| (0..SIDE - 1).map(move |y| (x, y))) {
        links.triangles.push([id(x, y), id(x + 1, y), id(x, y + 1)]);
        links.triangles.push([id(x + 1, y), id(x + 1, y + 1), id(x, y + 1)]);
        // Without stiffness, without damping, without both.
        let [stiffness, damping] = [[0.0, 2.0], [3.0, 0.0], [1.5, 0.5], [1.0, 0.0]][(x + y) as usize % 4];
        links.springs.push(spring([id(x, y), id(x + 1, y)], stiffness, damping));
        links.springs.push(spring([id(x, y), id(x, y + 1)], damping, stiffness));
    }
    links.springs[6] = spring(links.springs[6].ends, 0.0, 0.0);
    links.springs[25] = spring(links.springs[25].ends, 0.0, 0.0);
    links.triangles.extend([[25, 26, 27], [28, 29, 30], [31, 32, 33], [34, 35, 36]]);
    for first in [38, 44, 50] {
        links.springs.extend((first..first + 5).map(|k| spring([k, k + 1], 1.0, 0.0)));
    }
    links.springs.last_mut().expect("a thread").stiffness = 0.0;
    // Further threads all over the picture, torn in places.
    links.springs.extend((60..count - 1).map(|k| spring([k, k + 1], f64::from(k % 3), 0.0)));
    links.rods = vec![
        Rod { ends: [56, 57], length: 0.4 },
        Rod { ends: [59, 58], length: 0.4 },
        Rod { ends: [0, 43], length: 1.0 },
    ];
    links
}

/// Where all of that is, in pixels of a picture of 45 × 33.
fn place(picture: &Picture, particles: &mut State) {
    let camera = picture.frame.camera;
    let height = picture.frame.height;
    let unit = camera.extent;
    let put = |x: f64, y: f64, back: f64| at(&camera, DVec2::new(x, y), height, back * unit);
    for k in 0..SIDE * SIDE {
        let (x, y) = (f64::from(k % SIDE), f64::from(k / SIDE));
        // Folded, so that its back is seen too, and it throws shadows on itself.
        let fold = (1.7 * x).sin();
        particles.position_mut()[k as usize] =
            put(5.3 * x - 13.0 + 2.0 * fold, 4.1 * y - 9.0 + fold, 0.35 * fold - 0.1 * y);
    }
    let more = [
        // Partly behind the eye; of no width; partly out of the picture; not a number.
        put(2.0, 3.0, 0.1),
        put(9.0, 3.0, 9.0),
        put(4.0, 9.0, 0.2),
        put(-15.0, 8.0, 0.5),
        put(-12.0, 10.0, 0.5),
        put(-12.0, 10.0, 0.5),
        put(13.0, -12.0, 0.1),
        put(40.0, -9.0, -0.5),
        put(17.0, -40.0, 0.2),
        put(1.0, 1.0, 0.0),
        put(5.0, 1.0, 0.0),
        DVec3::NAN,
    ];
    particles.position_mut()[25..37].copy_from_slice(&more);
    for (thread, first) in [38, 44, 50].into_iter().enumerate() {
        let sway = thread as f64;
        for k in 0..6 {
            let t = f64::from(u32::try_from(k).expect("few"));
            let curl = (1.3 * t + sway).sin();
            particles.position_mut()[first + k] =
                put(6.0 + 4.0 * sway + 2.5 * curl, 13.0 - 4.7 * t, 0.5 + 0.2 * curl - 0.1 * sway);
        }
    }
    // Straight across, and straight up from below the picture.
    particles.position_mut()[56] = put(-18.0, -13.5, 0.3);
    particles.position_mut()[57] = particles.position()[56] + 0.5 * unit * camera.right;
    particles.position_mut()[58] = put(-19.5, -20.0, 0.3);
    particles.position_mut()[59] = particles.position()[58] + 1.2 * unit * camera.up;
    particles.size_mut().fill(0.0);
}

fn solids(camera: &Camera) -> Vec<Solid> {
    let spot = |x: f64, y: f64, back: f64| at(camera, DVec2::new(x, y), 33, back * camera.extent);
    let size = camera.extent;
    let turn = DQuat::from_rotation_x(0.8) * DQuat::from_rotation_y(0.5);
    let up = DQuat::from_rotation_arc(DVec3::Z, (camera.up + 0.15 * camera.back).normalize());
    // Seen from below by the eye, and by the lamp.
    let away = DQuat::from_rotation_arc(DVec3::Z, (0.9 * camera.up - 0.43 * camera.back).normalize());
    vec![
        Solid { shape: Shape::Plane, place: spot(-3.0, -12.0, -0.2), turn: up },
        Solid { shape: Shape::Ball { radius: 0.3 * size }, place: spot(-3.0, 5.0, -0.35), turn: DQuat::IDENTITY },
        Solid { shape: Shape::Capsule { radius: 0.13 * size, half: 0.25 * size }, place: spot(16.0, 8.0, -0.1), turn },
        Solid { shape: Shape::Box { half: size * DVec3::new(0.15, 0.22, 0.31) }, place: spot(-15.0, 0.0, -0.2), turn },
        Solid {
            shape: Shape::Capsule { radius: 0.05 * size, half: 0.8 * size },
            place: spot(14.0, -3.0, -0.1),
            turn: DQuat::from_rotation_arc(DVec3::Z, camera.back),
        },
        // Too near to the eye to be seen.
        Solid {
            shape: Shape::Ball { radius: 0.03 },
            place: camera.center + (camera.distance - 0.15) * camera.back,
            turn: DQuat::IDENTITY,
        },
        Solid { shape: Shape::Plane, place: spot(0.0, 0.0, 0.3), turn: away },
    ]
}

pub fn tied() -> Vec<Scene> {
    let camera = with(&PLAIN, &Scenery::default(), |_, _| ()).picture.frame.camera;
    let links = Arc::new(links(60));
    let colored = |picture: &mut Picture, particles: &mut State| {
        let count = particles.len();
        picture.color =
            Color::Given((1..=131_u32).take(count).map(|k| k.wrapping_mul(0x9E37_79B9) | 0xff40_4040).collect());
        picture.frame.map = 61;
        place(picture, particles);
    };
    let all = Scenery { links: links.clone(), solids: solids(&camera), ..Scenery::default() };
    let cloth = with(&Wish { name: "cloth", ..PLAIN }, &all, |picture, particles| {
        colored(picture, particles);
        picture.frame.thread = 0.8;
    });
    let parallel = Wish { name: "threads", projection: "orthographic", ..PLAIN };
    let threads = with(&parallel, &all, |picture, particles| {
        colored(picture, particles);
        picture.frame.fine = 2;
        picture.frame.thread = 1.7;
    });
    let alone = Scenery { links, ..Scenery::default() };
    let more = Scenery { links: Arc::new(self::links(131)), ..Scenery::default() };
    let bare = with(&Wish { name: "bare", count: MANY, extent: 0.2, ..PLAIN }, &more, |picture, particles| {
        colored(picture, particles);
        picture.frame.thread = 0.4;
        picture.frame.fine = 2;
    });
    let mut high = with(&Wish { name: "high", size: (27, 2500), ..PLAIN }, &alone, |picture, particles| {
        colored(picture, particles);
        picture.frame.fine = 1;
        picture.frame.thread = 7.0;
        let camera = picture.frame.camera;
        let put = |x: f64, y: f64, back: f64| at(&camera, DVec2::new(x, y), 2500, back);
        // A triangle, and a thread, from below to above.
        for (id, x, y) in
            [(31, -12.0, -1200.0), (32, 11.0, -900.0), (33, 5.0, 1230.0), (56, 12.0, -1100.0), (57, -8.0, 1000.0)]
        {
            particles.position_mut()[id] = put(x, y, if id > 50 { 0.3 } else { -0.2 });
        }
    });
    high.exposure = Exposure { knee: 60.0, white: 900.0 };
    vec![bare, threads, cloth, high]
}
