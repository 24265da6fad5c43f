//! Small pictures in every style and of every family of scenes, with what is awkward in each.

use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};
use motes::State;
use motes::kernel::Array;
use motes::life::Life;
use motes::links::{Link, Links, Rod};
use motes::motion::{Held, Hold};
use motes::render::{Camera, Color, KEYS, Picture, Plane, Scaled, Scenery, Shape, Solid, Trail};
use motes::settings::{Settings, Value};

use super::support::{self, Random};

/// A picture and its particles.
pub struct Scene {
    pub name: &'static str,
    pub picture: Picture,
    pub state: State,
}

/// 96 × 64 pixels about the origin, 3 lengths high.
fn settings(words: &[(&'static str, &'static str)], numbers: &[(&'static str, f64)]) -> Settings {
    let eye = Value::Vector(DVec3::new(0.3, -0.9, 0.55));
    let settings = Settings::defaults(KEYS).with("auto_frame", Value::Flag(false)).with("eye", eye);
    let numbers = [("width", 96.0), ("height", 64.0), ("extent", 1.5)].iter().chain(numbers);
    let settings = numbers.fold(settings, |settings, (key, n)| settings.with(key, Value::Number(*n)));
    words.iter().fold(settings, |settings, (key, text)| settings.with(key, Value::Text((*text).into())))
}

fn scene(name: &'static str, settings: &Settings, state: State, trail: Trail, scenery: &Scenery) -> Scene {
    let groups: Vec<u32> = [0, 1, 2, 3].into_iter().cycle().take(state.len()).collect();
    let picture = Picture::with(settings, &state, &groups, trail, scenery).expect("a picture");
    Scene { name, picture, state }
}

/// A place so many pixels right and up of the middle of the picture, and so far towards the eye.
fn at(camera: &Camera, right: f64, up: f64, back: f64) -> DVec3 {
    let length = 2.0 * camera.extent / 64.0;
    camera.center + length * (right * camera.right + up * camera.up) + back * camera.back
}

/// Particles of many masses and sizes, up to a largest; some about the eye and behind it, far out, or not a number.
fn cloud(count: usize, largest: f64) -> State {
    let mut state = support::cloud(count, 11);
    let sizes = (0..7).cycle().map(|k| largest * f64::from(k) / 6.0);
    state.size_mut().iter_mut().zip(sizes).for_each(|(radius, size)| *radius = size);
    let masses = [1.0, 0.3, 0.02, 0.07, 2e-5];
    state.mass_mut().iter_mut().zip(masses.iter().cycle()).for_each(|(m, part)| *m *= part);
    state
}

fn awkward(state: &mut State, settings: &Settings) {
    let camera = Camera::fit(state, &Trail::new(0), settings);
    let d = if camera.distance > 0.0 { camera.distance } else { 0.1 };
    let places = [2.0 * d, d, 0.98 * d, 0.951 * d, 0.949 * d, -3.0 * d].map(|back| at(&camera, 0.4, -0.3, back));
    state.position_mut()[10..16].copy_from_slice(&places);
    state.position_mut()[18].x = f64::from(f32::from_bits(0x7fc0_0001));
    state.position_mut()[19].z = f64::NEG_INFINITY;
    state.velocity_mut()[20].y = f64::INFINITY;
    state.mass_mut()[21] = f64::NAN;
    state.position_mut()[24] = DVec3::new(1e30, -1e30, 1e30);
}

/// Some turns of a spiral for each particle; one of them comes from far out of the picture, one was nowhere, one is at rest.
fn spirals(state: &State) -> Trail {
    let mut trail = Trail::new(state.len());
    let first = state.position().to_vec();
    for turn in 0..24 {
        let angle = 0.31 * f64::from(turn);
        let offset = 0.5 * (1.0 - f64::from(turn) / 24.0) * DVec3::new(angle.cos(), angle.sin(), 0.3);
        let mut moment: Vec<DVec3> = first.iter().map(|x| *x + offset).collect();
        moment[0] = first[0];
        if turn == 0 {
            moment[1] = DVec3::new(3e4, 2e4, -1e4);
            moment[2].y = f64::NAN;
        }
        trail.push(&moment);
    }
    trail
}

fn balls() -> Scene {
    let settings = settings(&[("style", "auto")], &[]);
    let mut state = cloud(30, 0.25);
    awkward(&mut state, &settings);
    let trail = spirals(&state);
    scene("balls_and_trails", &settings, state, trail, &Scenery::default())
}

/// Balls so large that several layers of a dispatch draw them, and broad trails.
fn large_balls() -> Scene {
    let words = [("style", "balls"), ("projection", "orthographic"), ("background", "day"), ("color", "group")];
    let settings = settings(&words, &[("size", 1.25)]);
    let mut state = cloud(12, 0.72);
    state.position_mut()[3] = DVec3::new(-2.0, 0.4, -0.8);
    let trail = spirals(&state);
    let mut made = scene("large_balls", &settings, state, trail, &Scenery::default());
    made.picture.frame.largest = 600.0;
    made.picture.frame.line = 1.7;
    made
}

fn cluster() -> Scene {
    let settings = settings(&[("style", "glow"), ("projection", "orthographic"), ("color", "speed")], &[]);
    let mut state = cloud(700, 0.0);
    awkward(&mut state, &settings);
    state.position_mut()[100..].iter_mut().for_each(|x| *x *= x.length_squared());
    scene("glow_by_speed", &settings, state, Trail::default(), &Scenery::default())
}

/// Balls and lights together, with bloom; a particle of each is exactly as deep as another.
fn mixed() -> Scene {
    let settings = settings(&[("style", "auto"), ("color", "speed")], &[("exposure", 2.0)]);
    let mut made = scene("balls_among_lights", &settings, cloud(200, 0.12), Trail::default(), &Scenery::default());
    made.picture.frame.solid = 2.2;
    made.picture.frame.glow = 3.1;
    made.picture.frame.reach = 2;
    made
}

/// Particles of all speeds, with tails; one is at rest, one comes from behind the eye, some are straight across or up.
fn tails(name: &'static str, background: &'static str, color: &'static str) -> Scene {
    let numbers = [("tail", 0.5), ("slab", if background == "dusk" { 2.2 } else { 0.0 })];
    let settings = settings(&[("style", "glow"), ("background", background), ("color", color)], &numbers);
    let mut state = cloud(120, 0.0);
    awkward(&mut state, &settings);
    let camera = Camera::fit(&state, &Trail::new(0), &settings);
    let ways =
        [DVec3::ZERO, camera.right, -1.4 * camera.up, -40.0 * camera.back, 3e-31 * DVec3::X, 1e30 * DVec3::X, DVec3::Z];
    state.velocity_mut()[40..47].copy_from_slice(&ways);
    // These wait, or are gone.
    (50..60).for_each(|id| state.set_life(id, if id % 2 == 0 { Life::Pending } else { Life::Removed }));
    let mut made = scene(name, &settings, state, Trail::default(), &Scenery::default());
    made.picture.frame.glow = 3.6;
    made
}

fn density(name: &'static str, massless: bool) -> Scene {
    let settings = settings(&[("style", "density")], &[("slab", 1.4)]);
    let mut state = cloud(900, 0.0);
    awkward(&mut state, &settings);
    state.mass_mut()[21] = 0.01;
    if massless {
        state.mass_mut().fill(0.0);
    }
    let ball = Solid { shape: Shape::Ball { radius: 0.4 }, place: DVec3::new(0.9, 0.0, 0.2), turn: DQuat::IDENTITY };
    let scenery = if massless { Scenery::default() } else { Scenery { solids: vec![ball], ..Scenery::default() } };
    scene(name, &settings, state, Trail::default(), &scenery)
}

fn spring(a: u32, b: u32) -> Link {
    Link { ends: [a, b], rest: 0.1, stiffness: 1.0, damping: 0.5, rope: false }
}

/// A wavy sheet of 12 × 12 particles, one of its springs broken, with two threads and a lone particle.
fn sheet() -> State {
    const SIDE: u32 = 12;
    let mut state = State::default();
    let mut links = Links::default();
    let place = |k: u32| 2.2 * f64::from(k) / f64::from(SIDE - 1) - 1.1;
    let id = |x: u32, y: u32| y * SIDE + x;
    for (y, x) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (y, x))) {
        let height = 0.5 - 0.4 * (place(x).powi(2) + place(y).powi(2)) + 0.1 * (4.0 * place(x)).sin();
        state.push(DVec3::new(place(x), place(y), height), DVec3::ZERO, 1.0, 0.0);
        if x + 1 < SIDE {
            links.springs.push(spring(id(x, y), id(x + 1, y)));
        }
        if x + 1 < SIDE && y + 1 < SIDE {
            links.triangles.push([id(x, y), id(x + 1, y), id(x + 1, y + 1)]);
            links.triangles.push([id(x, y), id(x + 1, y + 1), id(x, y + 1)]);
        }
    }
    for strand in 0..2_u32 {
        let first = u32::try_from(state.len()).expect("few");
        for k in 0..6_u32 {
            let t = 0.3 * f64::from(k);
            state.push(
                DVec3::new(1.2 - 2.6 * f64::from(strand), 0.4 - t, 0.2 + 0.3 * (3.0 * t).sin()),
                DVec3::ZERO,
                1.0,
                0.0,
            );
            if k > 0 {
                links.rods.push(Rod { ends: [first + k - 1, first + k], length: 0.3 });
            }
        }
    }
    state.push(DVec3::new(-0.2, -1.4, 1.0), DVec3::ZERO, 1.0, 0.08);
    let broken = links.springs.iter_mut().find(|spring| spring.ends == [id(5, 3), id(6, 3)]).expect("a spring");
    (broken.stiffness, broken.damping) = (0.0, 0.0);
    state.links = links;
    state
}

fn solids() -> Vec<Solid> {
    let of = |shape, x: f64, y: f64, z: f64, turn: DQuat| Solid { shape, place: DVec3::new(x, y, z), turn };
    let turn = DQuat::from_rotation_x(0.8) * DQuat::from_rotation_y(0.5);
    vec![
        of(Shape::Plane, 0.0, 0.0, -0.7, DQuat::from_rotation_x(0.05)),
        of(Shape::Ball { radius: 0.35 }, 0.1, 0.0, 0.0, DQuat::IDENTITY),
        of(Shape::Box { half: DVec3::new(0.25, 0.2, 0.35) }, 1.3, -0.9, -0.4, turn),
        of(Shape::Capsule { radius: 0.15, half: 0.3 }, -1.1, -1.0, -0.3, turn),
        of(Shape::Capsule { radius: 0.1, half: 0.5 }, -1.6, 0.9, -0.2, DQuat::IDENTITY),
    ]
}

fn tied(name: &'static str, words: &[(&'static str, &'static str)], solids: Vec<Solid>) -> Scene {
    let state = sheet();
    let scenery = Scenery { solids, ..Scenery::of(&state) };
    let mut made = scene(name, &settings(words, &[]), state, Trail::default(), &scenery);
    made.picture.frame.thread = 0.8;
    // As fine as the picture.
    made.picture.frame.map = 97;
    made
}

fn pool(name: &'static str, words: &[(&'static str, &'static str)], numbers: &[(&'static str, f64)]) -> Scene {
    let mut random = Random::new(3);
    let mut state = State::default();
    for k in 0..12 * 9 * 7_u32 {
        let cell = DVec3::new(f64::from(k % 12) - 5.5, f64::from(k / 12 % 9) - 4.0, f64::from(k / 108) - 3.0);
        let x = 0.15 * (cell + 0.3 * random.vector());
        if x.x + 2.0 * x.z < 0.7 {
            state.push(x, 2.5 * random.vector(), 1.0, 0.0);
        }
    }
    // Drops in the air; walls, which are not drawn.
    state.push(DVec3::new(0.75, -0.2, 0.9), DVec3::ZERO, 1.0, 0.0);
    state.push(DVec3::new(-0.9, 0.1, 1.0), DVec3::X, 1.0, 0.0);
    state.held = (0..20).map(|id| Held { id, by: Hold::Fixed }).collect();
    let ball = Solid { shape: Shape::Ball { radius: 0.3 }, place: DVec3::new(0.8, 0.2, 0.1), turn: DQuat::IDENTITY };
    let turn = DQuat::from_rotation_z(0.05);
    let tank = Solid { shape: Shape::Box { half: DVec3::new(1.25, 0.8, 0.75) }, place: 0.1 * DVec3::Z, turn };
    let scenery = Scenery { solids: vec![ball], tanks: vec![tank], ..Scenery::of(&state) };
    let words: Vec<_> = [("style", "fluid")].iter().chain(words).copied().collect();
    scene(name, &settings(&words, numbers), state, Trail::default(), &scenery)
}

/// A fluid in a plane, from above: a heap, a thin film, lone drops and walls.
fn puddle() -> Scene {
    let mut random = Random::new(5);
    let mut state = State::default();
    for k in 0..300_u32 {
        let x = 1.9 * random.vector().truncate();
        let place = if k % 3 == 0 { x } else { 0.4 * x - DVec2::new(0.5, 0.2) };
        state.push(place.extend(0.0), random.vector().truncate().extend(0.0), 1.0, 0.0);
    }
    let plane =
        Solid { shape: Shape::Box { half: DVec3::new(1.6, 1.2, 0.0) }, place: DVec3::ZERO, turn: DQuat::IDENTITY };
    // Walls, and a box that cuts off drops and goes on at its other side.
    let held = Arc::new((0..40).collect());
    let (low, high) = (DVec2::new(-1.3, -1.13), DVec2::new(1.42, 1.04));
    let plane_of = Plane { low, high, periodic: [true; 2] };
    let scenery = Scenery { tanks: vec![plane], held, plane: plane_of, ..Scenery::default() };
    let words = [("style", "fluid"), ("projection", "orthographic"), ("background", "day")];
    let settings = settings(&words, &[("drop", 0.12), ("clarity", 0.3)]).with("eye", Value::Vector(DVec3::Z));
    scene("fluid_from_above", &settings, state, Trail::default(), &scenery)
}

/// Balls in a tube and a funnel, which widens upwards, and one that narrows: what is cut open shows its far side.
fn funnel() -> Scene {
    let of = |radius, end, half, place| Solid {
        shape: Shape::Cone { radius, end, half },
        place,
        turn: DQuat::from_rotation_x(0.2),
    };
    let solids = vec![
        of(0.3, 0.8, 0.4, DVec3::new(-0.9, 0.1, -0.3)),
        of(0.8, 0.8, 0.3, DVec3::new(-0.9, 0.0, 0.6)),
        of(0.9, 0.2, 0.7, DVec3::new(0.9, -0.2, 0.0)),
    ];
    let mut state = cloud(60, 0.15);
    state.position_mut().iter_mut().for_each(|x| *x *= 1.5);
    let settings = settings(&[("style", "balls"), ("color", "group")], &[]);
    scene("funnel", &settings, state, Trail::default(), &Scenery { solids, ..Scenery::default() })
}

/// A picture so high that several layers of a dispatch draw strokes, trails, triangles and lines.
fn tall() -> Scene {
    let words = [("style", "auto"), ("background", "black"), ("projection", "orthographic")];
    let settings = settings(&words, &[("width", 6.0), ("height", 2400.0), ("extent", 40.0), ("tail", 0.0)]);
    let settings = settings.with("eye", Value::Vector(DVec3::NEG_Y));
    let mut state = State::default();
    for k in 0..9_u32 {
        let z = 9.0 * f64::from(k) - 36.0;
        state.push(DVec3::new(0.03 * z / 36.0, 0.0, z), DVec3::ZERO, 1.0, 0.0);
    }
    state.push(DVec3::new(-0.08, 0.5, -38.0), DVec3::ZERO, 1.0, 0.0);
    state.push(DVec3::new(0.09, 0.5, -30.0), DVec3::ZERO, 1.0, 0.0);
    state.push(DVec3::new(0.02, 0.5, 35.0), DVec3::ZERO, 1.0, 0.0);
    let mut trail = Trail::new(state.len());
    trail.push(&state.position().iter().map(|x| DVec3::new(-x.x, -0.1, -0.9 * x.z)).collect::<Vec<_>>());
    state.links.triangles.push([9, 10, 11]);
    state.links.springs.push(spring(0, 8));
    let scenery = Scenery { links: Arc::new(state.links.clone()), ..Scenery::default() };
    let mut made = scene("tall", &settings, state, trail, &scenery);
    made.picture.frame.bloom = 0.0;
    made.picture.frame.fine = 1;
    (made.picture.frame.thread, made.picture.frame.map) = (1.1, 61);
    made
}

/// All of them.
/// Balls of many values, some of which are not finite.
fn by_column(name: &'static str, column: &str) -> Scene {
    let mut state = cloud(150, 0.25);
    let mut random = Random::new(5);
    let heat: Vec<f64> = (0..150).map(|_| random.next() * 3.0 - 1.0).collect();
    let heat = heat.into_iter().enumerate().map(|(n, x)| if n % 40 == 7 { f64::NAN } else { x }).collect();
    let shells = (0..150).map(|n| n * n % 23).collect();
    state.set("heat", Array::Float(heat)).expect("a column");
    state.set("shell", Array::Uint(shells)).expect("a column");
    let known = state.columns().find(|(one, _)| one.name == column).map(|(one, _)| one.clone()).expect("a column");
    let sizes = Scaled::sizes(state.get(column).expect("values"));
    let mut scene = scene(name, &settings(&[("style", "balls")], &[]), state, Trail::default(), &Scenery::default());
    scene.picture.paint(Color::Value(Box::new(Scaled::of(known, sizes))));
    scene
}

pub fn all() -> Vec<Scene> {
    vec![
        balls(),
        large_balls(),
        cluster(),
        mixed(),
        tails("tails_at_night", "night", "group"),
        tails("headings_at_dusk", "dusk", "heading"),
        tails("ink_by_day", "day", "speed"),
        tails("ink_on_paper", "paper", "group"),
        tails("lights_in_the_sea", "sea", "heading"),
        density("density", false),
        density("number_density", true),
        tied("cloth_and_solids", &[], solids()),
        tied("threads", &[("draw", "lines"), ("projection", "orthographic")], Vec::new()),
        tied("cloth_alone", &[("draw", "surface"), ("background", "day")], Vec::new()),
        pool("fluid", &[("background", "day")], &[("foam", 2.2)]),
        pool("fluid_by_speed", &[("background", "night"), ("color", "speed")], &[("extent", 0.8)]),
        puddle(),
        funnel(),
        tall(),
        by_column("by_mass", "mass"),
        by_column("by_velocity", "velocity"),
        by_column("by_heat", "heat"),
        by_column("by_shell", "shell"),
    ]
}
