//! Parts of barostats: the box as columns of the system, and how it changes with the particles in it.

use std::sync::Arc;

use glam::{DVec3, Vec4};

use super::Pressed;
use super::bath::TEMPERATURE;
use crate::error::Error;
use crate::kernel::{
    Bounds, Column, Field, Host, Indirect, Kernel, Kind as Element, Name, POSITION, Pass, Problem, Reference, Shader,
    Shape, Side, Source, VELOCITY, World,
};
use crate::settings::{Key, Kind, Settings, Value};

/// The highest corner of the box.
pub const CORNER: Field<Vec4> = Field::new("box_corner");
/// What is still to be added to it: what single precision rounds from it, and changes that positions do not resolve.
const CORNER_LOW: Field<Vec4> = Field::new("box_corner_low");
/// The change of the logarithm of the volume in the next step.
pub(crate) const STRAIN: Field<f32> = Field::new("box_strain");
/// The relative change of each side in this step.
const CHANGE: Field<Vec4> = Field::new("box_change");
/// The part of a coordinate by which the corner moves at least: see `shaders/barostat/advance.wgsl`.
const RESOLVED: f64 = 1.0 / 131_072.0;
/// The shortest side so far, the largest change, how many particles had forces that did not add up, and the longest side so far.
pub(crate) const WATCH: Field<Vec4> = Field::new("box_watch");
/// Σ m v², the virial, and how many particles have forces that do not add up.
pub(crate) const TOTAL: Field<Vec4> = Field::new("pressure_total");
/// Indirect arguments of the dispatch that moves particles with the box.
const GO: &str = "arguments of the box";

/// The pressure that a barostat keeps.
pub(crate) const PRESSURE: Key = Key::required(
    "pressure",
    Kind::Number,
    "P₀, that of the measure `pressure` [mass / length / time²; mass / time² in the plane]",
);
/// The time in which it relaxes.
pub(crate) const TIME: Key = Key::new(
    "time",
    Kind::Positive,
    Value::Number(1.0),
    "τ, the relaxation time of the pressure, if the compressibility is right [time]",
);
/// An estimate of the compressibility.
pub(crate) const COMPRESSIBILITY: Key = Key::required(
    "compressibility",
    Kind::Positive,
    "κ, an estimate of −(∂V / ∂P) / V: only κ / τ matters [length · time² / mass; time² / mass in the plane]",
);
/// How often the box changes.
pub(crate) const EVERY: Key = Key::new(
    "every",
    Kind::Count,
    Value::Number(10.0),
    "the number of steps from one change of the box to the next: each measures the pressure, which takes as long as the forces",
);

/// A barostat.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Barostat {
    /// Its name.
    pub name: &'static str,
    /// P₀.
    pub pressure: f64,
    /// τ.
    pub time: f64,
    /// κ.
    pub compressibility: f64,
    /// Steps from one change to the next.
    pub every: u32,
    /// k T, with which the volume fluctuates; velocities change with the box then.
    pub temperature: Option<f64>,
}

/// The column of the corner of the box.
pub(crate) fn corner() -> Column {
    let about = "the highest corner of the box, which a barostat moves; the lowest one stays";
    Column::new(CORNER.name, Element::Vector, "length", about).shaped(Shape::System(1))
}

/// The columns of the box.
pub(crate) fn columns() -> Vec<Column> {
    let one = |name, kind, unit, about| Column::new(name, kind, unit, about).shaped(Shape::System(1));
    let low =
        "what is still to be added to the corner of the box: its rounding, and changes that positions do not resolve";
    vec![
        corner(),
        one(CORNER_LOW.name, Element::Vector, "length", low),
        one(
            STRAIN.name,
            Element::Scalar,
            "",
            "the change of the logarithm of the volume that the box makes in the next step",
        ),
    ]
}

impl Barostat {
    pub fn of(name: &'static str, settings: &Settings, fluctuates: bool) -> Self {
        let number = |key: Key| settings.number(key.name);
        Self {
            name,
            pressure: number(PRESSURE),
            time: number(TIME),
            compressibility: number(COMPRESSIBILITY),
            every: u32::try_from(settings.whole(EVERY.name)).unwrap_or(u32::MAX),
            temperature: fluctuates.then(|| number(TEMPERATURE)),
        }
    }
    /// How it changes the box.
    pub fn pressed(self) -> Pressed {
        Pressed { every: self.every, time: self.time }
    }
    /// The kernel of one invocation that finds the next change from the pressure; `noise` is the width of its random part, by the step and
    /// the volume.
    pub fn decide(
        self,
        files: &[Source],
        more: &[(&'static str, f64)],
        noise: impl Fn(u32) -> f64 + Send + Sync + 'static,
    ) -> Result<Kernel, Error> {
        let ground = [crate::shader!("world.wgsl"), crate::shader!("barostat/pressure.wgsl")];
        let shader = Shader::join(&[&ground[..], files].concat())?;
        let rate = self.compressibility / self.time;
        let reference = move |host: &Host| {
            let world = host.world();
            if !due(&world, self.every) {
                return Ok(());
            }
            let (total, volume) = (host.read(TOTAL)?[0], volume(&world.bounds));
            let span = f64::from(self.every) * world.dt;
            let pressure = (total.x + total.y) / f64::from(world.bounds.dimensions) / volume;
            let width = (2.0 * self.temperature.unwrap_or(0.0) * rate * span / volume).sqrt();
            let strain = rate * span * (pressure - self.pressure) + width * noise(world.step);
            host.write(STRAIN)?[0] = strain;
            let watch = &mut host.write(WATCH)?[0];
            watch.y = watch.y.max(strain.abs());
            watch.z += total.z;
            Ok(())
        };
        let mut constants = vec![("EVERY", f64::from(self.every)), ("PRESSURE", self.pressure), ("RATE", rate)];
        constants.extend_from_slice(more);
        let kernel = Kernel::new(self.name, shader, constants, 1, Arc::new(reference));
        Ok(Kernel { sizes: [TOTAL.name, STRAIN.name, WATCH.name].map(|name| (name.into(), 1)).to_vec(), ..kernel })
    }
    /// The kernels that change the box, and move particles with it.
    pub fn change(self, problem: &Problem) -> Result<[Kernel; 2], Error> {
        Ok([advance(problem, true)?, scale(problem, self.temperature.is_some())?])
    }
}

/// Whether the box is to be changed after this step.
pub(crate) fn due(world: &World, every: u32) -> bool {
    world.step.wrapping_add(1).is_multiple_of(every)
}

/// The volume of a box, or its area in the plane.
pub(crate) fn volume(bounds: &Bounds) -> f64 {
    (0..bounds.dimensions as usize).map(|axis| bounds.period()[axis]).product()
}

/// Changes the box, if `applies`; and gives it to all kernels.
pub(crate) fn advance(problem: &Problem, applies: bool) -> Result<Kernel, Error> {
    let shader = Shader::join(&[
        crate::shader!("world.wgsl"),
        crate::shader!("integrators/two_sum.wgsl"),
        crate::shader!("barostat/advance.wgsl"),
    ])?;
    let reference = move |host: &Host| {
        let mut world = host.world();
        let mut corner = host.write(CORNER)?;
        let periodic = world.bounds.axes(Side::Periodic);
        if applies {
            let (mut strain, mut low) = (host.write(STRAIN)?, host.write(CORNER_LOW)?);
            let side = corner[0].truncate() - world.bounds.low;
            let change = (strain[0] / f64::from(world.bounds.dimensions)).exp_m1();
            let due = (side * change + low[0].truncate()) * periodic;
            let before = corner[0].truncate();
            let size = before.abs().max(world.bounds.low.abs());
            let moves = (due.abs() * periodic).cmpge(RESOLVED * size) & periodic.cmpgt(DVec3::ZERO);
            // In single precision here too, so that a state holds all of it whatever it was made by.
            let next = if moves.any() { (before + due).as_vec3().as_dvec3() } else { before };
            let next = DVec3::select(periodic.cmpgt(DVec3::ZERO), next, before);
            low[0] = (due - (next - before)).extend(0.0);
            let made = DVec3::select(periodic.cmpgt(DVec3::ZERO), (next - before) / side, DVec3::ZERO);
            host.write(CHANGE)?[0] = made.extend(0.0);
            corner[0] = next.extend(0.0);
            strain[0] = 0.0;
            let (watch, side) = (&mut host.write(WATCH)?[0], corner[0].x - world.bounds.low.x);
            watch.x = if watch.x == 0.0 { side } else { watch.x.min(side) };
            watch.w = watch.w.max(side);
        }
        for axis in (0..3).filter(|axis| periodic[*axis] > 0.0) {
            world.bounds.high[axis] = corner[0][axis];
        }
        host.set_world(world);
        Ok(())
    };
    let [groups, rows, _] = scaling(problem, false)?.workgroups(problem.machine.workgroups)?;
    let mut constants = vec![("GROUPS", f64::from(groups)), ("ROWS", f64::from(rows))];
    if !applies {
        constants.push(("APPLY", 0.0));
    }
    let pass = Pass { constants, ..Pass::new(shader, 1) }.on(&[("box_go", GO.into())]);
    let ones = [CORNER, CORNER_LOW, CHANGE, WATCH].map(|field| field.name);
    let sizes =
        ones.into_iter().chain([STRAIN.name]).map(|name| (Name::from(name), 1)).chain([(GO.into(), 3)]).collect();
    Ok(Kernel {
        name: if applies { "box" } else { "box at the start" }.to_owned(),
        passes: vec![pass],
        reference: Some(Arc::new(reference)),
        sizes,
        scratch: vec![GO.into()],
        tables: Vec::new(),
    })
}

fn scaling(problem: &Problem, velocities: bool) -> Result<Pass, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("barostat/scale.wgsl")])?;
    let constants = if velocities { vec![("VELOCITIES", 1.0)] } else { Vec::new() };
    Ok(Pass { constants, ..Pass::new(shader, problem.capacity) })
}

/// Moves particles with the box, and changes their velocities.
fn scale(problem: &Problem, velocities: bool) -> Result<Kernel, Error> {
    let reference: Reference = Arc::new(move |host: &Host| {
        let (change, bounds) = (host.read(CHANGE)?[0].truncate(), host.world().bounds);
        if change == DVec3::ZERO {
            return Ok(());
        }
        let periodic = bounds.axes(Side::Periodic);
        for x in host.write(POSITION)?.iter_mut() {
            let moved = x.truncate() + (x.truncate() - bounds.low) * change;
            for axis in 0..3 {
                let beyond = periodic[axis] > 0.0 && moved.as_vec3()[axis] >= bounds.high.as_vec3()[axis];
                x[axis] = if beyond { bounds.low[axis] } else { moved[axis] };
            }
        }
        if velocities {
            for v in host.write(VELOCITY)?.iter_mut() {
                *v -= (v.truncate() * change / (1.0 + change)).extend(0.0);
            }
        }
        Ok(())
    });
    let indirect = Some(Indirect { field: GO.into(), word: 0, rests: false });
    let pass = Pass { indirect, ..scaling(problem, velocities)? };
    Ok(Kernel {
        name: "box scale".to_owned(),
        passes: vec![pass],
        reference: Some(reference),
        sizes: vec![(CHANGE.name.into(), 1), (GO.into(), 3)],
        scratch: Vec::new(),
        tables: Vec::new(),
    })
}

/// The box of a state that has one, in place of that of a scene.
#[must_use]
pub fn boxed(bounds: &Bounds, corner: DVec3) -> Bounds {
    // All kernels know the lowest corner in single precision.
    let low = bounds.low.as_vec3().as_dvec3();
    let periodic = bounds.axes(Side::Periodic).cmpgt(DVec3::ZERO);
    Bounds {
        low: DVec3::select(periodic, low, bounds.low),
        high: DVec3::select(periodic, corner, bounds.high),
        ..*bounds
    }
}
