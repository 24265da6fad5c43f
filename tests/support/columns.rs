//! Components with columns of their own: every way in which integrators advance one, with solutions that are known.

use glam::{DVec3, DVec4};
use motes::forces::{Component, Law};
use motes::kernel::{Array, Backend, Column, Kind, Role, Shape, Source};
use motes::{Simulation, State, rotation};

use super::Random;

/// How fast the charge leaks away.
pub const LEAK: f64 = 0.8;
/// How strongly a field turns a dipole.
pub const FIELD: f64 = 1.7;

/// `charge` leaks away by a sum; `angle` swings about 0 by a state, which a sum turns back; `dose` adds up x, in the last
/// component of the same buffers; `tracer` is carried along with sin x.
#[derive(Clone)]
pub struct Columned;

const LEAKS: &str = "@group(3) @binding(0) var<storage, read> charge: array<f32>;
@group(3) @binding(1) var<storage, read_write> leak: array<f32>;
fn update(me: Particle) { leak[me.index] -= 0.8 * charge[me.index]; }";

const SWINGS: &str = "@group(3) @binding(0) var<storage, read> angle: array<vec4f>;
@group(3) @binding(1) var<storage, read_write> couple: array<vec4f>;
@group(3) @binding(2) var<storage, read_write> spin: array<vec4f>;
fn update(me: Particle) {
    couple[me.index] -= vec4f(angle[me.index].xyz, 0.0);
    spin[me.index].w = me.position.x;
}";

// The cosine to 2e-7 below 2, where a device's own may be wrong by more.
const CARRIES: &str = "@group(3) @binding(0) var<storage, read_write> advection: array<f32>;
fn update(me: Particle) {
    let x = me.position.x * me.position.x;
    let end = 1.0 - x / 56.0 * (1.0 - x / 90.0 * (1.0 - x / 132.0));
    advection[me.index] = velocity_of(me).x * (1.0 - x / 2.0 * (1.0 - x / 12.0 * (1.0 - x / 30.0 * end)));
}";

const FIELD_ON_DIPOLES: &str = "@group(3) @binding(0) var<storage, read> orientation: array<vec4f>;
@group(3) @binding(1) var<storage, read_write> torque: array<vec4f>;
fn update(me: Particle) {
    let q = orientation[me.index];
    let x = vec3f(1.0, 0.0, 0.0);
    let dipole = x + 2.0 * cross(q.xyz, cross(q.xyz, x) + q.w * x);
    torque[me.index] += vec4f(cross(dipole, vec3f(0.0, 0.0, 1.7)), 0.0);
}";

fn source(name: &'static str, text: &'static str) -> Source {
    Source::ours(name, text)
}

impl Component for Columned {
    fn columns(&self) -> Vec<Column> {
        vec![
            Column::new("charge", Kind::Scalar, "charge", "what leaks").with_rate("leak"),
            Column::new("leak", Kind::Scalar, "charge / time", "how fast").summed(),
            Column::new("angle", Kind::Vector, "", "what swings").with_rate("spin"),
            Column::new("dose", Kind::Scalar, "length time", "what adds up").within("angle", 3).with_rate("exposure"),
            Column::new("spin", Kind::Vector, "1 / time", "how fast").with_rate("couple"),
            Column::new("exposure", Kind::Scalar, "length", "how fast").within("spin", 3).derived(),
            Column::new("couple", Kind::Vector, "1 / time²", "what turns it back").summed(),
            Column::new("tracer", Kind::Scalar, "", "what goes along").carried("advection"),
            Column::new("advection", Kind::Scalar, "1 / time", "how fast").derived(),
        ]
    }
    fn laws(&self) -> Vec<Law> {
        let leaks = Law::updating("leaks", source("leaks", LEAKS), Vec::new(), &["leak"], |me, _, outcome| {
            outcome.add("leak", -LEAK * me.scalar("charge").unwrap_or(f64::NAN));
        });
        let swings =
            Law::updating("swings", source("swings", SWINGS), Vec::new(), &["couple", "spin"], |me, _, outcome| {
                let [angle, spin] = ["angle", "spin"].map(|name| me.vector(name).unwrap_or(DVec4::NAN));
                outcome.add("couple", -angle.truncate());
                outcome.set("spin", spin.with_w(me.position.x));
            });
        let carries =
            Law::updating("carries", source("carries", CARRIES), Vec::new(), &["advection"], |me, _, outcome| {
                outcome.set("advection", me.velocity.x * me.position.x.cos());
            });
        vec![leaks, carries, swings]
    }
}

/// Rigid bodies, on whose dipoles along their first axes a field along z may act.
#[derive(Clone)]
pub struct Bodies {
    pub field: bool,
}

impl Component for Bodies {
    fn columns(&self) -> Vec<Column> {
        rotation::columns()
    }
    fn laws(&self) -> Vec<Law> {
        let wgsl = source("field on dipoles", FIELD_ON_DIPOLES);
        let field = Law::updating("field on dipoles", wgsl, Vec::new(), &["torque"], |me, _, outcome| {
            let q = me.vector("orientation").unwrap_or(DVec4::NAN);
            // Between stages q is no unit: by the same polynomial as on the device.
            let (axis, x) = (q.truncate(), DVec3::X);
            let dipole = x + 2.0 * axis.cross(axis.cross(x) + q.w * x);
            outcome.add("torque", dipole.cross(DVec3::new(0.0, 0.0, FIELD)));
        });
        if self.field { vec![field] } else { Vec::new() }
    }
}

/// What has several values for each particle, and what is of the whole system; each continues by a state.
#[derive(Clone)]
pub struct Grouped;

impl Component for Grouped {
    fn columns(&self) -> Vec<Column> {
        let scalar = |name, shape| Column::new(name, Kind::Scalar, "", "").shaped(shape);
        vec![
            scalar("grip", Shape::Slots(2)).with_rate("slip"),
            scalar("slip", Shape::Slots(2)),
            scalar("reservoir", Shape::System(2)).with_rate("inflow"),
            scalar("inflow", Shape::System(2)),
        ]
    }
}

/// A column of numbers that f32 holds, other ones for each element; moments and quaternions are what they must be.
pub fn numbers(column: &Column, count: usize, seed: u64) -> Array {
    let mut random = Random::new(seed);
    let len = column.shape.len(count);
    let single = |v: DVec4| v.as_vec4().as_dvec4();
    let mut vector = || random.vector().extend(random.next());
    match column.kind {
        Kind::Scalar if column.name == "radius" => {
            Array::Float((0..len).map(|_| single(DVec4::splat(0.25) + 0.1 * vector()).x).collect())
        }
        Kind::Scalar => Array::Float((0..len).map(|_| single(vector()).x).collect()),
        Kind::Quaternion => Array::Vec4((0..len).map(|_| single(vector().normalize())).collect()),
        Kind::Vector if column.name == "inertia" => {
            Array::Vec4((0..len).map(|_| single(DVec4::splat(1.6) + vector())).collect())
        }
        // Beside it lies the radius of a grain.
        Kind::Vector if column.name == "angular_velocity" => {
            let mut both = || vector() * DVec4::new(1.0, 1.0, 1.0, 0.1) + 0.25 * DVec4::W;
            Array::Vec4((0..len).map(|_| single(both())).collect())
        }
        Kind::Vector => Array::Vec4((0..len).map(|_| single(vector())).collect()),
        Kind::Whole => panic!("no column here counts"),
    }
}

/// Gives a state such numbers for every column that some components declare and that it keeps.
pub fn give(state: &mut State, columns: &[Column], seed: u64) {
    let count = state.len();
    for (column, place) in columns.iter().zip(seed..).filter(|(column, _)| column.role == Role::State) {
        let values = match numbers(column, count, place) {
            Array::Vec4(all) if column.kind == Kind::Vector => {
                Array::Vec3(all.into_iter().map(glam::DVec4::truncate).collect())
            }
            other => other,
        };
        state.declare(column).expect("a column");
        state.set(&column.name, values).expect("values");
    }
}

/// Fills every column that some components declare on a backend.
pub fn fill<B: Backend>(simulation: &mut Simulation<B>, columns: &[Column], seed: u64) {
    let count = simulation.count() as usize;
    for (column, place) in columns.iter().filter(|column| !column.is_packed()).zip(seed..) {
        simulation.backend().write(&column.name, &numbers(column, count, place)).expect("a column");
    }
}
