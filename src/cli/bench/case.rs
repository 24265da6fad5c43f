//! The scenes of `motes bench`: built-in ones with overrides, in several sizes, and independent particles.

use glam::DVec3;
use motes::forces;
use motes::scene::{Options, Scene, Source};
use motes::settings::{Settings, Value};
use motes::{Bounds, Setup, Solver, State, integrators};

use super::super::args::Topic;
use super::super::failure::Failure;

/// The factor of the number of particles from one size to the next.
const GROWTH: u32 = 4;
/// The number of independent particles of the smallest size.
const STREAM: u32 = 1_000_000;

/// One measurement: a scene of a size.
pub struct Case {
    pub topic: &'static str,
    pub scene: &'static str,
    pub changes: Vec<String>,
    /// The approximate number of particles.
    pub count: u32,
}

/// A scene in several sizes: its own number of particles, and the overrides for another number.
struct Sized {
    topic: &'static str,
    scene: &'static str,
    own: u32,
    always: &'static [&'static str],
    set: fn(u32) -> Vec<String>,
}

/// All sizes of a topic up to a number of particles; the smallest size if there is no number.
pub fn cases(topic: Topic, most: Option<u32>) -> Vec<Case> {
    let mut cases = Vec::new();
    for sized in sizes(topic) {
        let mut counts = vec![sized.own];
        while let (Some(last), Some(most)) = (counts.last().copied(), most) {
            if last >= most {
                break;
            }
            counts.push(last.saturating_mul(GROWTH).min(most));
        }
        for count in counts {
            let set = if count == sized.own { Vec::new() } else { (sized.set)(count) };
            let changes = sized.always.iter().map(|change| (*change).to_owned()).chain(set).collect();
            cases.push(Case { topic: sized.topic, scene: sized.scene, changes, count });
        }
    }
    cases
}

fn sizes(topic: Topic) -> Vec<Sized> {
    let sized = |topic, scene, own, always, set| Sized { topic, scene, own, always, set };
    let bodies = |count| vec![format!("particles.0.count={count}")];
    let fluid = |count| {
        // The same box with a smaller spacing: steps are shorter by the same factor.
        let finer = (33_528.0 / f64::from(count)).cbrt();
        vec![format!("force.1.spacing={}", 0.04 * finer), format!("simulation.dt={}", 0.0004 * finer)]
    };
    match topic {
        Topic::Gravity => {
            vec![sized("gravity", "plummer", 16_384, &["particles.0.count=16384", "force.0.over=pairs"], bodies)]
        }
        Topic::Tree => vec![sized("tree", "plummer", 100_000, &["force.0.over=tree"], bodies)],
        Topic::Neighbors => vec![sized("neighbors", "flock", 10_000, &[], |count| {
            // The number of neighbours stays the same.
            let wider = (f64::from(count) / 10_000.0).cbrt();
            let [x, z] = [16.0, 9.0].map(|side| side * wider);
            let size = format!("[{x}, {x}, {z}]");
            let low = format!("box.low=[{}, {}, {}]", -x / 2.0, -x / 2.0, -z / 2.0);
            vec![
                format!("particles.0.count={count}"),
                format!("particles.0.size={size}"),
                format!("box.size={size}"),
                low,
            ]
        })],
        Topic::Springs => vec![sized("springs", "flag", 3876, &[], |count| cloth(count, 1.49))],
        Topic::Fluids => vec![
            sized("fluids", "dam_break", 33_528, &[], fluid),
            sized("incompressible", "dam_break", 33_528, &["force.1.solver=dfsph"], fluid),
        ],
        Topic::Solve => vec![sized(
            "solve",
            "cloth",
            16_384,
            // So stiff that no solve converges in these iterations.
            &["simulation.integrator=linear_backward_euler", "simulation.dt=0.1", "solver.tolerance=1e-6"],
            |count| cloth(count, 1.0),
        )],
        Topic::Stream => {
            ["leapfrog", "symplectic_euler"].map(|name| sized("stream", name, STREAM, &[], |_| Vec::new())).into()
        }
        Topic::All | Topic::Kernels => Vec::new(),
    }
}

/// Columns and rows of a sheet with a number of particles and an aspect ratio.
fn cloth(count: u32, long: f64) -> Vec<String> {
    let rows = (f64::from(count) / long).sqrt().round();
    vec![format!("particles.0.columns={}", (rows * long).round()), format!("particles.0.rows={rows}")]
}

impl Case {
    /// Its setup with additional overrides.
    pub fn setup(&self, more: &[String]) -> Result<Setup, Failure> {
        if self.topic == "stream" {
            return Ok(independent(self.count, self.scene));
        }
        let changes = [&self.changes[..], more].concat();
        Ok(Scene::load(&Source::find(self.scene)?, &changes, &Options::default())?.setup())
    }
}

/// Particles that do not interact, under drag and weight.
fn independent(count: u32, integrator: &str) -> Setup {
    let force = |name, key, value| {
        let entry = forces::entry(name)?;
        Some((entry.build)(&Settings::defaults(entry.keys).with(key, value)))
    };
    let weight = force("uniform", "acceleration", Value::Vector(DVec3::new(0.0, 0.0, -9.81)));
    let drag = force("drag", "linear", Value::Number(0.1));
    let mut state = State::default();
    for i in 0..count {
        let x = f64::from(i) * 1e-6;
        state.push(DVec3::new(x, 1.0 - x, 0.5 * x), DVec3::new(0.3, 0.1 + x, 0.2), 1.0, 0.0);
    }
    Setup {
        state,
        forces: [drag, weight].into_iter().flatten().collect(),
        integrator: integrators::entry(integrator)
            .map_or_else(|| Box::new(integrators::Leapfrog) as _, integrators::Entry::by_default),
        dt: 1e-3,
        bounds: Bounds::default(),
        solver: Solver::default(),
    }
}
