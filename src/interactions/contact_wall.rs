//! Walls that grains touch, still or moving, with friction and history.

use std::borrow::Cow;

use glam::DVec3;

use super::{Component, EACH, Properties, SPECIES, Stage, numbered};
use crate::error::Error;
use crate::grains::{self, ContactForce, Material, Surface, own};
use crate::kernel::{Bounds, Column, Kind as Element, Plan, Problem, Shape as Slots};
use crate::motion::Motion;
use crate::settings::{Key, Kind, Settings, Value};
use crate::solids::{Solid, Standing};
use crate::state::State;

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("shape", Kind::Choice(SHAPES), Value::Text(Cow::Borrowed("plane")), "its shape"),
    Key::new("position", Kind::Vector, Value::Vector(DVec3::ZERO), "its centre, or a point on the plane [length]"),
    Key::new("normal", Kind::Direction, Value::Vector(DVec3::Z), "plane: the direction to the grains"),
    Key::new("size", Kind::Vector, Value::Vector(DVec3::ONE), "box: its sides [length]"),
    Key::new("radius", Kind::Positive, Value::Number(0.5), "sphere and capsule: the radius; cone: that of its first end [length]"),
    Key::new("end_radius", Kind::NotNegative, Value::Number(0.5), "cone: the radius of its other end [length]"),
    Key::new("axis", Kind::Vector, Value::Vector(DVec3::X), "capsule and cone: from the centre of one end to the other's [length]"),
    Key::new("inside", Kind::Flag, Value::Flag(false), "whether it is a container with grains inside; a box then has a contact with a side along each axis"),
    Key::new("motion", Kind::Motion, Value::Text(Cow::Borrowed("")), "the motion that moves it, if any"),
    grains::MODEL,
    grains::STIFFNESS,
    grains::YOUNG,
    grains::POISSON,
    grains::RESTITUTION,
    grains::FRICTION,
    grains::TANGENTIAL_STIFFNESS,
    grains::TANGENTIAL_DAMPING,
    grains::ROLLING,
    grains::ROLLING_MODEL,
    grains::ROLLING_DAMPING,
    grains::TORSION,
    grains::SURFACE_TENSION,
    grains::CONTACT_ANGLE,
    grains::BRIDGE_VOLUME,
    SPECIES,
    EACH,
];

const SHAPES: &[&str] = &["plane", "box", "sphere", "capsule", "cone"];

/// `contact_wall`: a plane, a box, a sphere, a capsule or the surface of a cone that grains touch as they touch each other, with friction,
/// resistance to rolling and history. The surface of a cone has no thickness: grains may be on both sides of it; with two equal radii it is
/// a tube, and with a short axis a plate with a hole. The wall is as a sphere without curvature and of infinite mass; it is not
/// moved by grains. Fixed grains are walls too, by `contact`.
#[derive(Clone)]
pub struct ContactWall(Settings);

impl ContactWall {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
    fn shape(&self) -> Solid {
        let (radius, axis) = (self.0.number("radius"), self.0.vector("axis"));
        match self.0.text("shape") {
            "box" => Solid::Box(self.0.vector("size")),
            "sphere" => Solid::Sphere(radius),
            "capsule" => Solid::Capsule(axis, radius),
            "cone" => Solid::Cone { axis, radius, end: self.0.number("end_radius") },
            _ => Solid::Plane(self.0.vector("normal").normalize_or(DVec3::Z)),
        }
    }
    /// Whether grains are inside of it. A plane and the surface of a cone have no inside.
    fn holds(&self) -> bool {
        self.0.flag("inside") && !matches!(self.shape(), Solid::Plane(_) | Solid::Cone { .. })
    }
    fn contacts(&self) -> u32 {
        if self.holds() && matches!(self.shape(), Solid::Box(_)) { 3 } else { 1 }
    }
    /// Words of history of each particle: of each contact twice those of its material.
    fn words(&self) -> u32 {
        2 * self.contacts() * Material::of(&self.0).words()
    }
    fn surface(&self, motions: &[Motion], dimensions: u32) -> Result<Surface, Error> {
        let name = self.0.text("motion");
        let known = motions.iter().zip(0..).find(|(motion, _)| motion.name == name);
        if known.is_none() && !name.is_empty() {
            let why = format!("a wall has the motion \"{name}\", and there is no motion of this name");
            return Err(Error::Setting { key: "motion", why });
        }
        Ok(Surface {
            shape: self.shape(),
            side: if self.holds() { -1.0 } else { 1.0 },
            // In the plane a box has no faces above and below.
            contacts: self.contacts().min(dimensions),
            words: self.words(),
            position: self.0.vector("position"),
            species: self.0.species("species"),
            material: Material::of(&self.0),
            motion: known.filter(|_| !name.is_empty()).map(|(motion, number)| (number, motion.clone())),
        })
    }
}

impl Component for ContactWall {
    fn columns(&self) -> Vec<Column> {
        grains::columns()
    }
    fn own_columns(&self, earlier: usize) -> Vec<Column> {
        let about = "the history of contacts with a wall, word by word, twice";
        vec![Column::new(own("history", earlier), Element::Scalar, "", about).shaped(Slots::Slots(self.words()))]
    }
    fn check(&self, bounds: &Bounds) -> Result<(), Error> {
        let values = grains::NAMES.map(|name| self.0.number(name));
        grains::check(&self.0, &values)?;
        let (shape, axis) = (self.shape(), self.0.vector("axis"));
        let wrong = |key: &'static str, why: &str| Err(Error::Setting { key, why: why.to_owned() });
        match shape {
            Solid::Box(size) if size.min_element() < 0.0 => return wrong("size", "a side of the box is below 0"),
            Solid::Plane(normal) if bounds.dimensions == 2 && normal.z != 0.0 => {
                return wrong("normal", "the normal leads out of the plane of the scene: its third number must be 0");
            }
            Solid::Plane(_) | Solid::Cone { .. } if self.0.flag("inside") => {
                return wrong("inside", "a plane and the surface of a cone have no inside: turn the normal, or leave it out");
            }
            _ => {}
        }
        if matches!(shape, Solid::Cone { .. }) && axis.length() <= 0.0 {
            return wrong("axis", "the axis of a cone is 0: a plate with a hole has a short axis along its normal");
        }
        Ok(())
    }
    fn contacts(&self, state: &State, bounds: &Bounds, earlier: usize) -> Result<Vec<ContactForce>, Error> {
        Ok(self.surface(&state.motions, bounds.dimensions)?.pushes(state, bounds, earlier))
    }
    fn properties(&self) -> Properties {
        let (position, motion) = (self.0.vector("position"), self.0.text("motion").to_owned());
        let inside = self.holds() || matches!(self.shape(), Solid::Cone { .. });
        Properties {
            fixed_step: Some("walls integrate the sliding distance of grains with a fixed time step"),
            dissipates: vec!["walls"],
            constrains: true,
            turns: vec!["walls"],
            history: true,
            touches: vec![Material::of(&self.0)],
            pictured: Some(Standing { solid: self.shape(), position, motion, inside }),
            ..Properties::default()
        }
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        let Stage::Evaluate { earlier } = stage else { return Ok(()) };
        let wall = self.surface(&problem.motions, problem.bounds.dimensions)?;
        if let Some(frame) = wall.frame(earlier, problem)? {
            plan.add(frame);
        }
        let wgsl = crate::shader!("interactions/contact_wall.wgsl");
        plan.add(wall.kernel(wgsl, &numbered("contact_wall", earlier), earlier, problem)?);
        Ok(())
    }
}
