//! An obstacle to be avoided.

use std::borrow::Cow;

use glam::{DVec3, DVec4};

use super::{Component, EACH, Law, SPECIES, params, species};
use crate::kernel::Scalar;
use crate::settings::{Key, Kind, Settings, Value};
use crate::solids::Solid;

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("shape", Kind::Choice(SHAPES), Value::Text(Cow::Borrowed("sphere")), "its shape"),
    Key::new("position", Kind::Vector, Value::Vector(DVec3::ZERO), "its centre, or a point on the plane [length]"),
    Key::new("radius", Kind::Positive, Value::Number(0.5), "sphere: its radius [length]"),
    Key::new("size", Kind::Vector, Value::Vector(DVec3::ONE), "box: its sides [length]"),
    Key::new("normal", Kind::Direction, Value::Vector(DVec3::Z), "plane: the direction to the free side"),
    Key::new("look_ahead", Kind::NotNegative, Value::Number(1.0), "how far ahead particles look [time]"),
    Key::new("clearance", Kind::NotNegative, Value::Number(0.05), "the minimum distance from it: the radius of a bird [length]"),
    Key::new("max_force", Kind::Positive, Value::Number(5.0), "the acceleration of particles that touch it [length / time²]"),
    SPECIES,
    EACH,
];

const SHAPES: &[&str] = &["sphere", "box", "plane"];
/// The number of samples of the path ahead; a path that only grazes an obstacle appears slightly shorter.
const MARCHES: usize = 8;

/// `obstacle`: steers round a sphere, a box or a plane that lies ahead, along the normal of where one would touch it (after
/// Reynolds 1999), the more the nearer that is and the more straight on; a particle that touches it or is inside pushes straight out
/// with all its force.
#[derive(Clone)]
pub struct Obstacle(Settings);

impl Obstacle {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

impl Component for Obstacle {
    fn laws(&self) -> Vec<Law> {
        let number = |name| self.0.number(name);
        let (ahead, clearance, force) = (number("look_ahead"), number("clearance"), number("max_force"));
        let (position, normal) = (self.0.vector("position"), self.0.vector("normal").normalize_or_zero());
        let surface = match self.0.text("shape") {
            "box" => Solid::Box(self.0.vector("size")),
            "plane" => Solid::Plane(normal),
            _ => Solid::Sphere(number("radius")),
        };
        let (kind, kind_value) = species(&self.0, "species");
        let mut values = params(&self.0, &["position", "radius", "size", "look_ahead", "clearance", "max_force"]);
        values.push(("normal".to_owned(), Scalar::Vector(normal)));
        values.push(("species".to_owned(), kind_value));
        values.push(("shape".to_owned(), Scalar::Uint(surface.number())));
        vec![Law::each("obstacle", crate::shader!("interactions/obstacle.wgsl"), values, move |me, world| {
            if !kind.has(me) {
                return DVec4::ZERO;
            }
            let heading = me.velocity.normalize_or_zero();
            let ahead = ahead * me.velocity.length();
            let at = |s: f64| {
                let d = me.position + s * heading - position;
                // A plane has no images.
                let plane = matches!(surface, Solid::Plane(_));
                surface.distance(if plane { d } else { world.bounds.shortest(d) }, world.bounds.dimensions)
            };
            let s = (0..MARCHES).fold(0.0, |s, _| s + (at(s).1 - clearance).max(0.0));
            let out = at(s).0;
            if s > 0.0 && s >= ahead {
                return DVec4::ZERO;
            }
            let urgency = if s > 0.0 { (1.0 - s / ahead) * (-heading.dot(out)).max(0.0) } else { 1.0 };
            (urgency * force * out).extend(0.0)
        })]
    }
}
