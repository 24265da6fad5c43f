//! Fluids that are none in particular.

use glam::DVec3;
use motes::forces::Component;
use motes::motion::{Held, Hold};
use motes::settings::Value;
use motes::{Bounds, Side, State};

use super::Random;
use super::states::force;

use Value::{Flag, Number};

/// How far apart particles are in a cloud.
pub const SPACING: f64 = 0.1;
/// What a cloud is of.
pub const DENSITY: f64 = 1.3;

/// A fluid that is none in particular, with all that a fluid may have.
pub fn fluid(more: &[(&'static str, Value)]) -> Box<dyn Component> {
    let all = [
        ("density", Number(DENSITY)),
        ("spacing", Number(SPACING)),
        ("sound_speed", Number(2.7)),
        ("alpha", Number(0.3)),
        ("viscosity", Number(0.07)),
        ("wall_friction", Number(0.6)),
        ("negative_pressure", Flag(true)),
    ];
    force("fluid", &[&all[..], more].concat())
}

/// Particles about a lattice, on their way; in a plane where `flat` says so. Every fifth is held, where `walls` says so.
pub fn cloud(count: usize, flat: bool, walls: bool) -> State {
    let mut random = Random::new(29);
    let side = side(count, flat);
    let mut particles = State::default();
    let round = |v: DVec3| v.as_vec3().as_dvec3();
    for i in 0..count {
        let place = DVec3::new((i % side) as f64, (i / side % side) as f64, (i / side / side) as f64);
        let (mut x, mut v) = (SPACING * (place + 0.5 + 0.4 * random.vector()), 0.6 * random.vector());
        let mut mass = DENSITY * SPACING * SPACING * (1.0 + 0.2 * random.next());
        if flat {
            (x.z, v.z) = (0.0, 0.0);
        } else {
            mass *= SPACING;
        }
        particles.push(round(x), round(v), f64::from(mass as f32), 0.01);
    }
    if walls {
        particles.held = (0..count as u32).filter(|id| id % 5 == 2).map(|id| Held { id, by: Hold::Fixed }).collect();
    }
    particles
}

/// Particles along each side of a cloud.
pub fn side(count: usize, flat: bool) -> usize {
    let power = if flat { 2 } else { 3 };
    (1..=count).find(|side| side.pow(power) >= count).unwrap_or(1)
}

/// A box that such a cloud fills, with such sides.
pub fn bounds(count: usize, flat: bool, side: Side) -> Bounds {
    let size = DVec3::splat(SPACING * self::side(count, flat) as f64);
    let mut bounds = Bounds::new(DVec3::ZERO, if flat { size.with_z(0.0) } else { size }, side);
    if side == Side::Open {
        bounds = Bounds { dimensions: bounds.dimensions, ..Bounds::default() };
    }
    bounds
}
