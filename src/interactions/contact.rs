//! Granular contacts: spheres with friction that depends on their sliding history.

use std::f64::consts::PI;

use glam::DVec3;

use super::{Component, Law, Properties, params};
use crate::component::Largest;
use crate::kernel::{Column, Kind as Element, World};
use crate::rotation;
use crate::settings::{Key, Kind, Settings, Value};
use crate::visit::{Memory, Outcome, Particle};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::required("range", Kind::Positive, "the largest sum of two radii; larger ones are refused [length]"),
    Key::new("stiffness", Kind::Positive, Value::Number(1000.0), "k, the normal force per overlap [mass / time²]"),
    Key::new("restitution", Kind::Fraction, Value::Number(0.8), "the coefficient of restitution: the speed after a head-on impact over that before"),
    Key::new("friction", Kind::NotNegative, Value::Number(0.5), "the friction coefficient μ: spheres slide where the tangential force would exceed μ times the normal force"),
    Key::new("tangential_stiffness", Kind::NotNegative, Value::Number(2.0 / 7.0), "the tangential stiffness, relative to the normal one"),
    Key::new("tangential_damping", Kind::NotNegative, Value::Number(0.5), "the tangential damping, relative to the normal one"),
    Key::new("skin", Kind::NotNegative, Value::Number(0.0), "the skin of the neighbour list beyond the range; 0: a fifth of the range [length]"),
];

/// `contact`: a linear spring and dashpot along the line between two spheres that overlap, and across it a spring that sliding
/// winds up, bounded by Coulomb's friction (Cundall & Strack, Géotechnique 29, 47, 1979; Luding, Granular Matter 10, 235, 2008).
/// Spheres have their `radius`, and turn by the torques, with their `inertia`. The dashpot is that which makes the
/// coefficient of restitution what is asked for, whatever the masses. Springs hold energy that is not measured.
#[derive(Clone)]
pub struct Contact(Settings);

/// The sums over the contacts of a particle.
#[derive(Debug, Default)]
struct Sum {
    force: DVec3,
    torque: DVec3,
}

/// The parameters of contacts.
#[derive(Debug, Clone, Copy)]
struct Material {
    stiffness: f64,
    /// ζ, half the damping by √(k m).
    damping: f64,
    friction: f64,
    tangential_stiffness: f64,
    tangential_damping: f64,
}

impl Contact {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
    fn material(&self) -> Material {
        let [stiffness, friction] = ["stiffness", "friction"].map(|name| self.0.number(name));
        let loss = -self.0.number("restitution").ln();
        Material {
            stiffness,
            damping: loss / PI.hypot(loss),
            friction,
            tangential_stiffness: self.0.number("tangential_stiffness"),
            tangential_damping: self.0.number("tangential_damping"),
        }
    }
}

impl Component for Contact {
    fn columns(&self) -> Vec<Column> {
        let radius = Column::new("radius", Element::Scalar, "length", "of the sphere that others touch").required();
        [rotation::columns(), vec![radius]].concat()
    }
    fn properties(&self) -> Properties {
        Properties {
            fixed_step: Some("contact integrates the sliding distance with a fixed time step"),
            dissipates: vec!["contacts"],
            turns: true,
            largest: vec![Largest { column: "radius", value: 0.5 * self.0.number("range"), why: "its range is the largest sum of two radii" }],
            ..Properties::default()
        }
    }
    fn laws(&self) -> Vec<Law> {
        let material = self.material();
        let mut values = params(&self.0, &["stiffness", "friction", "tangential_stiffness", "tangential_damping"]);
        values.push(("damping".to_owned(), crate::kernel::Scalar::Float(material.damping)));
        let gather = move |me: &Particle, you: &Particle, r: DVec3, world: &World, memory: &mut Memory<'_>, sum: &mut Sum| {
            material.touch(me, you, r, world, memory, sum);
        };
        let finish = |me: &Particle, sum: &Sum, _: &World, outcome: &mut Outcome| {
            if me.mass > 0.0 {
                outcome.accelerate((sum.force / me.mass).extend(0.0));
            }
            outcome.add("torque", sum.torque);
        };
        let skin = Some(self.0.number("skin")).filter(|skin| *skin > 0.0);
        let (over, wgsl) = ((self.0.number("range"), skin, 3), crate::shader!("interactions/contact.wgsl"));
        let law = Law::remembering("contact", over, wgsl, values, &["acceleration", "torque"], gather, finish);
        vec![Law { reciprocal: true, ..law }]
    }
}

impl Material {
    fn touch(&self, me: &Particle, you: &Particle, r: DVec3, world: &World, memory: &mut Memory<'_>, sum: &mut Sum) {
        let radius = |particle: &Particle| particle.scalar("radius").unwrap_or(0.0);
        let spin = |particle: &Particle| particle.vector("angular_velocity").unwrap_or_default().truncate();
        let distance = r.length();
        let overlap = radius(me) + radius(you) - distance;
        // Two particles at the same position have no direction between them.
        if overlap <= 0.0 || distance <= 0.0 {
            return;
        }
        let n = r / distance;
        // From the centres to the middle of the overlap.
        let arms = [radius(me) - 0.5 * overlap, radius(you) - 0.5 * overlap];
        let v = me.velocity - you.velocity + (arms[0] * spin(me) + arms[1] * spin(you)).cross(n);
        let (approach, slide) = (v.dot(n), v - v.dot(n) * n);
        let mass = me.mass * you.mass / (me.mass + you.mass).max(f64::MIN_POSITIVE);
        let damping = 2.0 * self.damping * (self.stiffness * mass).sqrt();
        let normal = self.stiffness * overlap + damping * approach;
        let limit = self.friction * normal.max(0.0);
        let across = self.tangential_damping * damping;
        let spring = self.tangential_stiffness * self.stiffness;
        let wound = DVec3::from([0, 1, 2].map(|word| memory.recall(word)));
        let mut wound = wound - wound.dot(n) * n + world.dt * slide;
        let mut tangential = -spring * wound - across * slide;
        if tangential.length() > limit {
            tangential *= limit / tangential.length();
            if spring > 0.0 {
                wound = -(tangential + across * slide) / spring;
            }
        }
        wound.to_array().into_iter().enumerate().for_each(|(word, value)| memory.remember(word, value));
        sum.force += tangential - normal * n;
        sum.torque += arms[0] * n.cross(tangential);
    }
}
