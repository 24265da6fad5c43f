//! Scenes: particles and looks that bring about what the shaders of a picture tell apart.

use glam::{DVec2, DVec3, DVec4, Vec4};
use motes::State;
use motes::kernel::{Array, Field, Host};
use motes::render::{Camera, Color, Exposure, KEYS, Picture, Scenery, Trail};
use motes::settings::{Settings, Value};

use crate::support::{self, Random};

/// Few enough for trails, and fewer than a workgroup, so that some lanes have nothing to do.
pub const FEW: usize = 60;
/// More than two workgroups.
pub const MANY: usize = 131;
/// Moments of every trail.
const MOMENTS: usize = 3;

/// A picture and its particles.
pub struct Scene {
    pub name: &'static str,
    pub picture: Picture,
    pub exposure: Exposure,
    particles: State,
}

/// What is asked of a scene; the rest is the same for all.
pub struct Wish {
    pub name: &'static str,
    pub size: (u32, u32),
    pub style: &'static str,
    pub projection: &'static str,
    pub background: &'static str,
    pub extent: f64,
    pub count: usize,
    pub trails: bool,
    pub color: &'static str,
}

pub const PLAIN: Wish = Wish {
    name: "",
    // Both are one more than a multiple of four, and their product is none of 64.
    size: (45, 33),
    style: "glow",
    projection: "perspective",
    background: "night",
    extent: 1.2,
    count: FEW,
    trails: false,
    color: "speed",
};

pub fn scene(wish: &Wish, change: impl FnOnce(&mut Picture, &mut State)) -> Scene {
    with(wish, &Scenery::default(), change)
}

/// The same with what stands in it.
pub fn with(wish: &Wish, scenery: &Scenery, change: impl FnOnce(&mut Picture, &mut State)) -> Scene {
    let word = |text: &'static str| Value::Text(text.into());
    let mut particles = support::cloud(wish.count, 11);
    // Half as far again as the picture reaches, so that many cross its edges.
    particles.position_mut().iter_mut().for_each(|x| *x *= 1.5 * wish.extent / PLAIN.extent);
    let sizes = [("width", wish.size.0), ("height", wish.size.1)];
    let words = [
        ("style", wish.style),
        ("projection", wish.projection),
        ("background", wish.background),
        ("color", if wish.trails { "group" } else { wish.color }),
    ];
    let settings = sizes.iter().fold(Settings::defaults(KEYS), |s, (key, n)| s.with(key, Value::Number((*n).into())));
    let settings = words.iter().fold(settings, |s, (key, text)| s.with(key, word(text)));
    let settings = settings
        .with("auto_frame", Value::Flag(false))
        .with("extent", Value::Number(wish.extent))
        .with("center", Value::Vector(wish.extent * DVec3::new(0.11, -0.07, 0.05)))
        .with("eye", Value::Vector(DVec3::new(0.3, -0.9, 0.55)));
    let mut random = Random::new(5);
    let mut trail = Trail::new(FEW);
    if wish.trails {
        for _ in 0..MOMENTS {
            trail.push(
                &particles.position().iter().map(|x| *x + 0.3 * wish.extent * random.vector()).collect::<Vec<_>>(),
            );
        }
    }
    let mut picture = Picture::with(&settings, &particles, &[], trail, scenery).expect("a picture");
    picture.frame.unit = 256.0;
    picture.frame.glow = 3.7;
    if wish.trails {
        let bright = |k: u32| k.wrapping_mul(0x9E37_79B9) | 0xff80_8080;
        picture.color = Color::Given((1..=60).map(|k| if k % 5 == 0 { u32::MAX } else { bright(k) }).collect());
    }
    change(&mut picture, &mut particles);
    Scene { name: wish.name, picture, exposure: Exposure { knee: 60.0, white: 900.0 }, particles }
}

/// A place so many pixels right and up of the middle of the picture, and so far towards the eye.
pub fn at(camera: &Camera, pixels: DVec2, height: u32, back: f64) -> DVec3 {
    let length = 2.0 * camera.extent / f64::from(height);
    camera.center + length * (pixels.x * camera.right + pixels.y * camera.up) + back * camera.back
}

/// Particles that cannot be drawn, or hardly: behind the eye and about it, far out, not a number, two at one place.
pub fn awkward(picture: &Picture, particles: &mut State) {
    let camera = &picture.frame.camera;
    let axis = |back: f64| at(camera, DVec2::new(0.4, -0.3), picture.frame.height, back);
    let d = camera.distance.max(0.1);
    let places = [2.0 * d, d, 0.98 * d, 0.951 * d, 0.949 * d, 0.9 * d, -3.0 * d].map(axis);
    particles.position_mut()[10..17].copy_from_slice(&places);
    // Not a number by its last bit too.
    particles.position_mut()[18].x = f64::from(f32::from_bits(0x7fc0_0001));
    particles.position_mut()[19].z = f64::NEG_INFINITY;
    particles.velocity_mut()[20].y = f64::INFINITY;
    particles.mass_mut()[21] = f64::NAN;
    particles.position_mut()[22] = particles.position()[23];
    particles.position_mut()[24] = DVec3::new(1e30, -1e30, 1e30);
}

/// The trails of some particles begin far out of the picture, to the right and above, or nowhere.
fn far_trails(picture: &mut Picture, particles: &State) {
    let (camera, height) = (picture.frame.camera, picture.frame.height);
    let mut moments: Vec<Vec<DVec3>> =
        picture.trail.points().collect::<Vec<_>>().chunks(FEW).map(<[_]>::to_vec).collect();
    // Beyond a million pixels, from which on nothing is seen, but not by half as much again.
    moments[0][0] = at(&camera, DVec2::new(1.2e6, 0.0), height, 0.0);
    moments[0][1] = at(&camera, DVec2::new(0.0, 1.2e6), height, 0.0);
    moments[0][2] = at(&camera, DVec2::new(-70.0, 33.0), height, 0.0);
    // Almost a diagonal, before everything.
    moments[0][6] = at(&camera, DVec2::new(-30.0, -19.0), height, 3.0);
    moments[1][6] = at(&camera, DVec2::new(10.0, 18.0), height, 3.0);
    moments[1][4].y = f64::NAN;
    for moment in &mut moments {
        // One that has not moved.
        moment[5] = particles.position()[5];
    }
    let mut trail = Trail::new(FEW);
    for moment in &moments {
        trail.push(moment);
    }
    picture.trail = trail;
}

/// Sizes from nothing to more than what is drawn.
pub fn sizes(particles: &mut State, largest: f64) {
    for (i, radius) in (0..7).cycle().zip(particles.size_mut()) {
        *radius = largest * f64::from(i) / 6.0;
    }
}

fn masses(particles: &mut State) {
    particles.mass_mut().iter_mut().zip([1.0, 0.3, 0.02, 0.07, 2e-5].iter().cycle()).for_each(|(m, part)| *m *= part);
}

/// Few particles, with trails.
pub fn few() -> Vec<Scene> {
    let parallel = Wish { name: "parallel balls", style: "balls", projection: "orthographic", trails: true, ..PLAIN };
    let parallel = scene(&parallel, |picture, particles| {
        awkward(picture, particles);
        far_trails(picture, particles);
        masses(particles);
        sizes(particles, 0.4);
        // Its radius is 2.75 pixels, and half a pixel more ends a little beyond the edge.
        let beside = DVec2::new(-0.5 * f64::from(picture.frame.width) - 3.35, 4.0);
        particles.position_mut()[3] = at(&picture.frame.camera, beside, picture.frame.height, 0.0);
        picture.frame.marker = 2.6;
        picture.frame.heaviest *= 0.6;
        picture.frame.largest = 6.0;
        picture.frame.solid = 2.2;
        // √2 (1.267 + ½) is hardly below 2½: across a diagonal no pixel is walked in vain.
        picture.frame.line = 1.267;
        picture.frame.reach = 2;
    });
    let balls = Wish { name: "balls", style: "auto", background: "black", trails: true, ..PLAIN };
    let balls = scene(&balls, |picture, particles| {
        awkward(picture, particles);
        far_trails(picture, particles);
        masses(particles);
        sizes(particles, 0.2);
        picture.frame.marker = 1.7;
        picture.frame.solid = 1.6;
        picture.frame.line = 0.8;
    });
    let tiny = Wish { name: "tiny", style: "balls", extent: 0.05, trails: true, ..PLAIN };
    let tiny = scene(&tiny, |picture, particles| {
        awkward(picture, particles);
        particles.mass_mut().fill(0.0);
        particles.size_mut().fill(0.0);
        picture.frame.heaviest = 0.0;
        picture.frame.marker = 0.8;
        picture.frame.solid = 0.5;
    });
    let dusk = Wish { name: "dusk with trails", style: "auto", background: "dusk", trails: true, ..PLAIN };
    let dusk = scene(&dusk, |picture, particles| {
        sizes(particles, 0.2);
        picture.frame.marker = 1.7;
        picture.frame.solid = 1.6;
        picture.frame.line = 0.8;
        picture.frame.ink = 0.7;
    });
    vec![parallel, balls, tiny, dusk]
}

/// Many particles, mostly lights.
pub fn many() -> Vec<Scene> {
    let many = Wish { count: MANY, ..PLAIN };
    let lights = scene(&Wish { name: "lights", ..many }, |picture, particles| {
        awkward(picture, particles);
        picture.frame.reach = 3;
    });
    let mut dazzling = scene(&Wish { name: "dazzling", ..many }, |picture, _| {
        picture.frame.unit = 4096.0;
        picture.frame.glow = 6.0;
        picture.frame.reach = 1;
    });
    dazzling.exposure = Exposure { knee: 20.0, white: 60.0 };
    let faint = scene(&Wish { name: "faint", ..many }, |picture, _| picture.frame.unit = 8.0);
    let dense = scene(&Wish { name: "dense", style: "balls", ..many }, |picture, particles| {
        masses(particles);
        sizes(particles, 0.1);
        picture.frame.marker = 1.4;
        picture.frame.solid = 1.0;
        picture.frame.slab = 0.9;
    });
    let mut column =
        scene(&Wish { name: "mass along the line of sight", style: "density", ..many }, |picture, particles| {
            masses(particles);
            picture.frame.unit = 60.0;
            picture.frame.glow = 5.0;
        });
    column.exposure = Exposure { knee: 9.0, white: 150.0 };
    let massless =
        scene(&Wish { name: "nothing along the line of sight", style: "density", ..many }, |picture, particles| {
            (0..particles.len()).for_each(|id| particles.mass_mut()[id] = 0.0);
            picture.frame.mean = 0.0;
        });
    vec![lights, dazzling, faint, dense, column, massless]
}

/// A picture so high that its largest ball and its lines are drawn by several layers of a dispatch, and of more than 2¹⁶
/// pixels, whose noise differs from that of others by the upper half of their number.
pub fn tall() -> Scene {
    let wish = Wish { name: "tall", size: (27, 2500), style: "balls", trails: true, ..PLAIN };
    scene(&wish, |picture, particles| {
        sizes(particles, 0.5);
        picture.frame.largest = 600.0;
        picture.frame.marker = 0.3;
        // Strokes from below to above, longer than one layer walks.
        picture.frame.tail = 1.3;
        picture.frame.glow = 9.0;
        let camera = picture.frame.camera;
        for (i, height) in [(31, 1200.0), (32, 1100.0), (33, 900.0)] {
            particles.position_mut()[i] = at(&camera, DVec2::new(0.02 * height - 21.0, height), 2500, 1.0);
            particles.velocity_mut()[i] = 1.6 * camera.up;
        }
    })
}

impl Scene {
    /// What the host writes before a picture is drawn.
    pub fn fields(&self) -> Vec<(&'static str, Array)> {
        let of = &self.particles;
        let join = |v: &[DVec3], w: &[f64]| Array::Vec4(v.iter().zip(w).map(|(v, w)| v.extend(*w)).collect());
        let mut fields =
            vec![("position", join(of.position(), of.mass())), ("velocity", join(of.velocity(), of.size()))];
        if let Color::Given(colors) = &self.picture.color {
            fields.push(("color", Array::Uint(colors.clone())));
        }
        if self.picture.frame.points > 0 {
            fields.push(("trail", Array::Vec4(self.picture.trail.points().map(|x| x.extend(0.0)).collect())));
        }
        fields
    }
    /// Puts a light where the nearest ball is, exactly as deep, so that it is not to be seen. Its id is lower.
    pub fn touch_up(&self, host: &Host) {
        let mut projected = host.write(Field::<Vec4>::new("projected")).expect("a field");
        let (width, height) = (f64::from(self.picture.frame.width), f64::from(self.picture.frame.height));
        let inside = |p: &DVec4| (0.0..width).contains(&p.x) && (0.0..height).contains(&p.y);
        let balls = projected.iter().enumerate().filter(|(_, p)| p.w > 0.0 && inside(p));
        let Some((ball, p)) = balls.min_by(|(_, p), (_, q)| p.z.total_cmp(&q.z)) else { return };
        let p = DVec4::new(p.x.floor() + 0.5, p.y.floor() + 0.5, p.z, 0.0);
        if let Some(light) = projected[..ball].iter_mut().find(|p| p.w == 0.0) {
            *light = p;
        }
    }
}
