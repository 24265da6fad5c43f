//! A solid that lets no particle in.

use std::borrow::Cow;
use std::sync::Arc;

use glam::DVec3;

use super::{Component, EACH, Kind as Only, Problem, Projection, Properties, Resolved, SPECIES, Stage, species};
use crate::error::Error;
use crate::kernel::{Host, Kernel, POSITION, Plan, Scalar, Shader, Source, VELOCITY, World, time};
use crate::motion::{Motion, Pose};
use crate::settings::{Key, Kind, Settings, Value};
use crate::solids::{self, Solid as Shape, Standing};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("shape", Kind::Choice(solids::SHAPES), Value::Text(Cow::Borrowed("sphere")), "its shape"),
    Key::new("position", Kind::Vector, Value::Vector(DVec3::ZERO), "its centre, or a point on the plane [length]"),
    Key::new("radius", Kind::Positive, Value::Number(0.5), "sphere and capsule: the radius [length]"),
    Key::new("size", Kind::Vector, Value::Vector(DVec3::ONE), "box: its sides [length]"),
    Key::new("normal", Kind::Direction, Value::Vector(DVec3::Z), "plane: the direction to the free side"),
    Key::new("axis", Kind::Vector, Value::Vector(DVec3::X), "capsule: from the centre of one end to the other's [length]"),
    Key::new("thickness", Kind::NotNegative, Value::Number(0.0), "the minimum distance of particle centres from the surface [length]"),
    Key::new("restitution", Kind::NotNegative, Value::Number(0.0), "the coefficient of restitution, 0 to 1"),
    Key::new("friction", Kind::NotNegative, Value::Number(0.3), "Coulomb's coefficient of friction"),
    Key::new("inside", Kind::Flag, Value::Flag(false), "whether it is a container that keeps particles inside"),
    Key::new("motion", Kind::Motion, Value::Text(Cow::Borrowed("")), "the motion that moves it, if any"),
    SPECIES,
    EACH,
];

/// `solid`: a sphere, a box, a plane or a capsule, still or moving, that lets no particle in, or out. After every drift a particle too
/// near to its surface is put there; normal velocity bounces (Newton 1687), friction takes tangential velocity (Coulomb
/// 1785), both in the frame of the surface. Fixed particles are left alone. It accelerates no particle by itself.
#[derive(Clone)]
pub struct Solid(Settings);

/// The parts of a kernel.
struct Wall {
    shape: Shape,
    /// 1, or −1 for a container.
    side: f64,
    margin: f64,
    position: DVec3,
    restitution: f64,
    friction: f64,
    species: Only,
    motion: Option<(u32, Motion)>,
}

impl Solid {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }

    fn wall(&self, problem: &Problem) -> Result<Wall, Error> {
        let refuse = |text: String| Err(Error::Scene(format!("a solid {text}")));
        let number = |name| self.0.number(name);
        let (radius, size, thickness) = (number("radius"), self.0.vector("size"), number("thickness"));
        let inside = self.0.flag("inside");
        // A container is made smaller: then a particle beyond a corner is put into it.
        let less = if inside { thickness } else { 0.0 };
        let normal = self.0.vector("normal").normalize_or_zero();
        let shape = match self.0.text("shape") {
            "box" => Shape::Box(size - 2.0 * less),
            "plane" => Shape::Plane(if inside { -normal } else { normal }),
            "capsule" => Shape::Capsule(self.0.vector("axis"), radius - less),
            _ => Shape::Sphere(radius - less),
        };
        let narrowest = match shape {
            Shape::Box(size) => size.min_element(),
            Shape::Sphere(radius) | Shape::Capsule(_, radius) => radius,
            Shape::Plane(_) | Shape::Cone { .. } => 0.0,
        };
        if narrowest < 0.0 {
            return refuse(format!(
                "of radius {radius} or sides {size} has no interior (a container is reduced by its thickness, {thickness}): \
                 make it larger"
            ));
        }
        if number("restitution") > 1.0 {
            return refuse(format!("has restitution {}: the maximum is 1", number("restitution")));
        }
        let name = self.0.text("motion");
        let known = problem.motions.iter().zip(0..).find(|(motion, _)| motion.name == name);
        let motion = match known {
            Some((motion, number)) if !name.is_empty() => Some((number, motion.clone())),
            None if !name.is_empty() => return refuse(format!("has the motion \"{name}\", and there is no motion of this name")),
            _ => None,
        };
        let contained = inside && !matches!(shape, Shape::Plane(_));
        Ok(Wall {
            shape,
            side: if contained { -1.0 } else { 1.0 },
            margin: if contained { 0.0 } else { thickness },
            position: self.0.vector("position"),
            restitution: number("restitution"),
            friction: number("friction"),
            species: species(&self.0, "species").0,
            motion,
        })
    }
}

impl Component for Solid {
    fn properties(&self) -> Properties {
        let (radius, position) = (self.0.number("radius"), self.0.vector("position"));
        let solid = match self.0.text("shape") {
            "plane" => Shape::Plane(self.0.vector("normal").normalize_or(DVec3::Z)),
            "box" => Shape::Box(self.0.vector("size")),
            "capsule" => Shape::Capsule(self.0.vector("axis"), radius),
            _ => Shape::Sphere(radius),
        };
        let inside = self.0.flag("inside") && !matches!(solid, Shape::Plane(_));
        let pictured = Some(Standing { solid, position, motion: self.0.text("motion").to_owned(), inside });
        Properties { pictured, constrains: true, ..Properties::default() }
    }
    fn resolved(&self, problem: &Problem) -> Result<Resolved, Error> {
        let wall = self.wall(problem)?;
        let (frame, bounds) = (wall.frame(0.0), problem.bounds);
        let projection: Projection = Box::new(move |kind, x| {
            let world = World { time: 0.0, dt: 0.0, step: 0, count: 1, free: 0, bounds };
            if wall.species.is(kind) { x + wall.meet(&frame, x, DVec3::ZERO, 0.0, &world).0 } else { x }
        });
        Ok(Resolved { initial_projection: Some(projection), ..Resolved::default() })
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        let (Stage::AfterDrift { factor } | Stage::AfterAdvance { factor }) = stage else { return Ok(()) };
        plan.add(kernel(self.wall(problem)?, problem, factor)?);
        Ok(())
    }
}

fn files(wall: &Wall, particles: [Source; 2], clock: Source) -> Vec<Source> {
    let mut files = vec![
        crate::shader!("world.wgsl"),
        crate::shader!("nearest_image.wgsl"),
        crate::shader!("law/species.wgsl"),
        crate::shader!("motion/turned.wgsl"),
        crate::shader!("solids/distance.wgsl"),
        crate::shader!("constraints/solid.wgsl"),
    ];
    files.extend(particles);
    match wall.motion {
        Some(_) => files.extend([clock, crate::shader!("motion/pose.wgsl"), crate::shader!("solids/moving.wgsl")]),
        None => files.push(crate::shader!("solids/still.wgsl")),
    }
    files
}

fn kernel(wall: Wall, problem: &Problem, factor: f64) -> Result<Kernel, Error> {
    let (holding, mut tables) = problem.holding();
    let shader = Shader::join(&files(&wall, [holding, problem.active()], problem.clock()))?;
    let (radius, size, axis) = wall.shape.parts();
    let values = [
        ("position", Scalar::Vector(wall.position)),
        ("radius", Scalar::Float(radius)),
        ("size", Scalar::Vector(size)),
        ("axis", Scalar::Vector(axis)),
        ("shape", Scalar::Uint(wall.shape.number())),
        ("margin", Scalar::Float(wall.margin)),
        ("side", Scalar::Float(wall.side)),
        ("restitution", Scalar::Float(wall.restitution)),
        ("friction", Scalar::Float(wall.friction)),
        ("species", wall.species.scalar()),
        ("motion", Scalar::Uint(wall.motion.as_ref().map_or(0, |(number, _)| *number))),
    ];
    let params = shader.reflection().binding("params");
    let params = params.map_or(Ok(Vec::new()), |binding| binding.packed.pack("solid", &values))?;
    let mut constants = vec![("FACTOR", factor)];
    let mut sizes = Vec::new();
    if wall.motion.is_some() {
        constants.push(("REACHED", problem.reached));
        constants.extend(problem.clock_constants());
        sizes.extend(problem.clock_sizes());
        let (motions, of_motions) = problem.motion_tables();
        tables.extend(motions);
        sizes.extend(of_motions);
    }
    let all = problem.clone();
    let reference = move |host: &Host| {
        let world = host.world();
        let view = crate::visit::View::of(host)?;
        let bodies = view.particles();
        let (mut position, mut velocity) = (host.write(POSITION)?, host.write(VELOCITY)?);
        let frame = wall.frame(if wall.motion.is_some() { time(host, &all, all.reached)? } else { 0.0 });
        for body in bodies.iter().filter(|body| wall.species.has(body) && body.is_active() && !all.is_held(body.index)) {
            let (way, change) = wall.meet(&frame, body.position, body.velocity, factor * world.dt, &world);
            position[body.index] += way.extend(0.0);
            velocity[body.index] += change.extend(0.0);
        }
        Ok(())
    };
    let mut kernel = Kernel::new("solid", shader, constants, problem.capacity, Arc::new(reference)).alone();
    kernel.passes.iter_mut().for_each(|pass| pass.uniforms.push(("params", params.clone())));
    Ok(Kernel { sizes, tables, ..kernel })
}

/// The position of a solid: its centre, its pose, and the reference point of the pose's rates.
struct Frame {
    centre: DVec3,
    pivot: DVec3,
    pose: Pose,
}

impl Wall {
    fn frame(&self, time: f64) -> Frame {
        let still = Frame { centre: self.position, pivot: self.position, pose: Pose::default() };
        self.motion.as_ref().map_or(still, |(_, motion)| {
            let pose = motion.pose(time);
            Frame { centre: motion.place(self.position, time), pivot: motion.about + pose.shift, pose }
        })
    }
    /// The direction out, the depth below the margin, and the position relative to the centre.
    fn touch(&self, frame: &Frame, x: DVec3, world: &World) -> (DVec3, f64, DVec3) {
        let r = x - frame.centre;
        let r = if matches!(self.shape, Shape::Plane(_)) { r } else { world.bounds.shortest(r) };
        let (n, distance) = self.shape.distance(frame.pose.turn.inverse() * r, world.bounds.dimensions);
        (self.side * (frame.pose.turn * n), self.margin - self.side * distance, r)
    }
    /// The position and the velocity after a drift of length `dt`.
    fn meet(&self, frame: &Frame, x: DVec3, v: DVec3, dt: f64, world: &World) -> (DVec3, DVec3) {
        let (n, depth, r) = self.touch(frame, x, world);
        if !(depth > 0.0 && x.is_finite()) {
            return (DVec3::ZERO, DVec3::ZERO);
        }
        let v = v - frame.pose.velocity - frame.pose.spin.cross(frame.centre + r - frame.pivot);
        let inward = -v.dot(n);
        let (mut way, mut change) = (depth * n, DVec3::ZERO);
        if inward > 0.0 {
            let along = v + inward * n;
            let grip = self.friction * (1.0 + self.restitution) * inward;
            let bounce = self.restitution * inward * n - along.clamp_length_max(grip);
            change = bounce + inward * n;
            way += (depth / inward).min(dt.max(0.0)) * bounce;
        }
        let (n, depth, _) = self.touch(frame, x + way, world);
        (way + depth.max(0.0) * n, change)
    }
}
