//! The minimum of the potential energy.

use std::sync::Arc;

use glam::{DVec3, DVec4, Vec4};

use super::{Component, Problem, Properties, Stage};
use crate::component::each;
use crate::error::Error;
use crate::kernel::{
    ACCELERATION, Column, Field, Host, Kernel, Kind as Element, Name, POSITION, Pass, Plan, Shader, Shape, VELOCITY,
};
use crate::primitives::{Items, Operation, reduce};
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::required("tolerance", Kind::Positive, "the largest force on a particle at which all rest [force]"),
    Key::required("largest_move", Kind::Positive, "the longest way of a particle in a step, such as a tenth of a diameter [length]"),
    Key::new("longest", Kind::Positive, Value::Number(10.0), "the longest step, in units of dt"),
];

/// Velocities in units of the length of a step, by which positions drift over dt.
const U: Field<Vec4> = Field::new("minimize_velocity");
/// m u², m u · a, m a² and F² of each particle that is free.
const PARTS: Field<Vec4> = Field::new("minimize_parts");
/// The sum of these, and the largest.
const TOTAL: Field<Vec4> = Field::new("minimize_total");
const LARGEST: Field<Vec4> = Field::new("minimize_largest");
/// The length of a step, in units of dt.
const LENGTH: Field<f32> = Field::new("minimize_length");
/// α
const MIXING: Field<f32> = Field::new("minimize_mixing");
/// Steps downhill since the last uphill.
const DOWNHILL: Field<u32> = Field::new("minimize_downhill");
/// The largest force.
const FORCE: Field<f32> = Field::new("minimize_force");
/// The parts of u and a in the next u.
const CHANGE: Field<Vec4> = Field::new("minimize_change");

/// α at the start, and after a step uphill.
const ALPHA: f64 = 0.1;
/// The shortest step, in units of dt.
const SHORTEST: f64 = 0.02;
/// Steps downhill before a step grows.
const PATIENCE: u32 = 5;
/// Beyond it sums are not finite in single precision.
const FINITE: f64 = 1e37;

/// `minimize`: particles move downhill in steps of adapted lengths, with velocities that are turned towards the forces, and set to zero
/// where they lead uphill (FIRE: Bitzek, Koskinen, Gähler, Moseler & Gumbsch, Phys. Rev. Lett. 97, 170201, 2006; by semi-implicit steps:
/// Guénolé et al., Comput. Mater. Sci. 175, 109584, 2020). When no force is larger than the tolerance all particles rest, and stay at rest.
/// The column `minimize_force` is the largest force. Forces are to be those of an energy: friction, drag and history act on velocities that
/// are none of a motion, and grains go on turning. It needs `leapfrog` or `beeman`. Velocities at the start are not used, and kicks of the integrator have no effect; the time
/// of such a run is a number of steps.
#[derive(Clone)]
pub struct Minimize {
    tolerance: f64,
    longest_way: f64,
    longest: f64,
}

impl Minimize {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        let [tolerance, longest_way, longest] = ["tolerance", "largest_move", "longest"].map(|name| settings.number(name));
        Self { tolerance, longest_way, longest }
    }
    /// The length of the next step, and the parts of u and a.
    fn decide(&self) -> Result<Kernel, Error> {
        let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("updaters/minimize.wgsl")])?;
        let (tolerance, longest) = (self.tolerance, self.longest);
        let reference = move |host: &Host| {
            let (total, force) = (host.read(TOTAL)?[0], host.read(LARGEST)?[0].w.sqrt());
            let (mut length, mut mixing) = (host.write(LENGTH)?, host.write(MIXING)?);
            let (mut downhill, mut change) = (host.write(DOWNHILL)?, host.write(CHANGE)?);
            host.write(FORCE)?[0] = force;
            change[0] = DVec4::ZERO;
            if force <= tolerance {
                return Ok(());
            }
            let before = length[0];
            if total.y > 0.0 && total.z < FINITE {
                if downhill[0] >= PATIENCE {
                    length[0] = (1.1 * before).min(longest);
                    mixing[0] *= 0.99;
                }
                downhill[0] += 1;
                let (keep, alpha) = (length[0] / before, mixing[0]);
                let push = length[0].powi(2) * host.world().dt;
                let square = keep * keep * total.x + 2.0 * keep * push * total.y + push * push * total.z;
                change[0].x = (1.0 - alpha) * keep;
                change[0].y = (1.0 - alpha) * push + alpha * (square / total.z).sqrt();
            } else {
                length[0] = (0.5 * before).max(SHORTEST);
                (mixing[0], downhill[0]) = (ALPHA, 0);
                change[0].y = length[0].powi(2) * host.world().dt;
            }
            Ok(())
        };
        let constants = vec![("TOLERANCE", self.tolerance), ("LONGEST", self.longest)];
        let kernel = Kernel::new("minimize", shader, constants, 1, Arc::new(reference));
        let fields = [TOTAL.name, LARGEST.name, LENGTH.name, MIXING.name, DOWNHILL.name, FORCE.name, CHANGE.name];
        Ok(Kernel { sizes: fields.map(|name| (Name::from(name), 1)).to_vec(), ..kernel })
    }
    fn apply(&self, problem: &Problem) -> Result<Kernel, Error> {
        let (of, most) = (problem.clone(), self.longest_way);
        let reference = move |host: &Host| {
            let (change, dt) = (host.read(CHANGE)?[0], host.world().dt);
            let (position, acceleration) = (host.read(POSITION)?, host.read(ACCELERATION)?);
            for (id, u) in host.write(U)?.iter_mut().enumerate() {
                if position[id].w > 0.0 && !of.is_held(id) {
                    let next: DVec3 = change.x * u.truncate() + change.y * acceleration[id].truncate();
                    *u = next.clamp_length_max(most / dt).extend(0.0);
                }
            }
            Ok(())
        };
        let kernel = each("minimize apply", crate::shader!("minimize/apply.wgsl"), problem, Arc::new(reference))?;
        let constants = vec![("MOVE", self.longest_way)];
        let passes = kernel.passes.into_iter().map(|pass| Pass { constants: constants.clone(), ..pass }).collect();
        Ok(Kernel { passes, sizes: vec![(CHANGE.name.into(), 1)], ..kernel })
    }
}

/// Sets velocities, after a kick.
fn follow(problem: &Problem) -> Result<Kernel, Error> {
    let of = problem.clone();
    let reference = move |host: &Host| {
        let (position, u) = (host.read(POSITION)?, host.read(U)?);
        for (id, v) in host.write(VELOCITY)?.iter_mut().enumerate() {
            if position[id].w > 0.0 && !of.is_held(id) {
                *v = u[id].truncate().extend(v.w);
            }
        }
        Ok(())
    };
    each("minimize follow", crate::shader!("minimize/follow.wgsl"), problem, Arc::new(reference))
}

/// The sums and the largest force.
fn measured(problem: &Problem) -> Result<Vec<Kernel>, Error> {
    let of = problem.clone();
    let reference = move |host: &Host| {
        let (position, velocity, acceleration) = (host.read(POSITION)?, host.read(U)?, host.read(ACCELERATION)?);
        for (id, parts) in host.write(PARTS)?.iter_mut().enumerate() {
            let (mass, a, u) = (position[id].w, acceleration[id].truncate(), velocity[id].truncate());
            let free = mass > 0.0 && !of.is_held(id);
            let all = DVec4::new(u.length_squared(), u.dot(a), a.length_squared(), mass * a.length_squared());
            *parts = if free { mass * all } else { DVec4::ZERO };
        }
        Ok(())
    };
    let (parts, total, largest): (Name, Name, Name) = (PARTS.name.into(), TOTAL.name.into(), LARGEST.name.into());
    let each = each("minimize measure", crate::shader!("minimize/measure.wgsl"), problem, Arc::new(reference))?;
    let sum = reduce(Operation::Sum, Items::Vec4, &parts, &total, problem.capacity, &problem.machine)?;
    let most = reduce(Operation::Max, Items::Vec4, &parts, &largest, problem.capacity, &problem.machine)?;
    let named = |name: &str, kernel: Kernel| Kernel { name: name.to_owned(), ..kernel };
    Ok(vec![each, named("minimize total", sum), named("minimize largest", most)])
}

impl Component for Minimize {
    fn columns(&self) -> Vec<Column> {
        let of_all = |name, kind, unit, about, first: f64| {
            Column::new(name, kind, unit, about).shaped(Shape::System(1)).starting([first; 4])
        };
        let about = "velocities of the minimization, in units of the length of a step";
        vec![
            Column::new(U.name, Element::Vector, "length / time", about),
            of_all(LENGTH.name, Element::Scalar, "", "the length of a step of the minimization, in units of dt", 1.0),
            of_all(MIXING.name, Element::Scalar, "", "α, the part by which velocities are turned towards forces", ALPHA),
            of_all(DOWNHILL.name, Element::Whole, "", "steps downhill since the last one uphill", 0.0),
            of_all(FORCE.name, Element::Scalar, "force", "the largest force on a particle at the start of the last step; 3.4e38 before the first", f64::from(f32::MAX)),
        ]
    }
    fn properties(&self) -> Properties {
        Properties {
            fixed_step: Some("minimize has lengths of steps of its own"),
            constrains: true,
            thermostat: true,
            needs_forces: true,
            ..Properties::default()
        }
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        match stage {
            Stage::StartOfStep => {}
            Stage::AfterKick => {
                plan.add(follow(problem)?);
                return Ok(());
            }
            _ => return Ok(()),
        }
        let refuse = |why: &str| Err(Error::Scene(format!("minimize moves {why}")));
        if problem.has_inactive {
            return refuse("the same particles all the time: leave out emitters, drains and mergers");
        }
        if !problem.network.rods.is_empty() {
            return refuse("particles along their forces, and rods have others: leave out the rods, or choose springs");
        }
        measured(problem)?.into_iter().for_each(|kernel| plan.add(kernel));
        plan.add(self.decide()?);
        plan.add(self.apply(problem)?);
        Ok(())
    }
}
