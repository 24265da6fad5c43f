//! Stages of implicit steps: whole ones, in which every kernel takes up what those before it left.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use glam::DVec3;
use motes::forces::{Force, Jacobian, Law};
use motes::kernel::{Backend, Machine, Plan, Source};
use motes::links::{Link, Links};
use motes::motion::{Held, Hold};
use motes::settings::Value;
use motes::{Bounds, Gpu, Particles, Setup, Simulation, Solver};

use crate::stages::{Device, Stage};
use crate::support::machines::alone;
use crate::support::states::{force, integrator, vector, word};
use crate::support::{self};

/// Two workgroups of 256 and a half.
const COUNT: usize = 600;

/// A cloud of which most are tied, some in rings; one is held, one has no mass.
fn tangle(stiffness: f64) -> Particles {
    let mut particles = support::cloud(COUNT, 31);
    particles.links = Links::default();
    let tied = u32::try_from(COUNT).expect("few") - 20;
    let mut random = support::Random::new(5);
    for id in 1..tied {
        for way in [1, 7] {
            if id + way < tied {
                let rest = f64::from((1.3 + 0.7 * random.next()) as f32);
                let stiffness = f64::from((stiffness * (1.2 + 0.3 * random.next())) as f32);
                let link = Link { ends: [id, id + way], rest, stiffness, damping: 0.3 * stiffness, rope: id % 5 == 0 };
                particles.links.springs.push(link);
            }
        }
    }
    for mass in &mut particles.mass {
        *mass = f64::from((*mass * 300.0) as f32);
    }
    particles.mass[COUNT - 3] = 0.0;
    particles.held.push(Held { id: 17, by: Hold::Fixed });
    particles
}

fn forces() -> Vec<Box<dyn Force>> {
    vec![
        force("uniform", &[("acceleration", vector(0.3, -0.2, -1.7))]),
        force("spring", &[]),
        force(
            "drag",
            &[("linear", Value::Number(0.3)), ("quadratic", Value::Number(0.4)), ("wind", vector(0.2, 0.5, -0.3))],
        ),
        force(
            "attractor",
            &[("profile", word("harmonic")), ("strength", Value::Number(0.7)), ("velocity", vector(0.1, 0.2, 0.3))],
        ),
        force(
            "wind",
            &[
                ("velocity", vector(0.6, 0.2, -0.3)),
                ("gust", Value::Number(0.7)),
                ("rate", Value::Number(0.4)),
                ("wavelength", Value::Number(1.7)),
            ],
        ),
        force("vortex", &[("rate", Value::Number(0.6))]),
    ]
}

/// A spring that draws aside, so that its matrix is not positive.
struct Wrong;

impl Force for Wrong {
    fn laws(&self) -> Vec<Law> {
        let law = force("spring", &[]).laws().swap_remove(0);
        let text = law.wgsl.text.replace("return link.stiffness * (across", "return -9.0 * link.stiffness * (across");
        let jacobian = Jacobian::Links(Arc::new(|_, _, r, link, dx, dv| {
            let (length, along) = (r.length(), r.normalize_or_zero());
            if link.rope && length <= link.rest {
                return DVec3::ZERO;
            }
            let across = (1.0 - link.rest / length).max(0.0);
            -9.0 * link.stiffness * (across * dx + (1.0 - across) * along.dot(dx) * along)
                + link.damping * along.dot(dv) * along
        }));
        vec![Law { wgsl: Source::ours("wrong_spring", text.leak()), jacobian: Some(jacobian), ..law }]
    }
}

/// What is wrong in the later begins of Newton's method: the difference of impulses that are up to a hundred times as large.
const LATER: f64 = 10.0;

/// Steps that run out of iterations, that converge, that settle, and that break down; with ties and without.
pub fn all(device: &Device, stages: &mut Vec<Stage>) {
    let solver = |tolerance, iterations, solves| Solver { tolerance, iterations, solves };
    let loose = || forces().into_iter().filter(|force| force.laws()[0].name != "spring").collect();
    let wrong = || -> Vec<Box<dyn Force>> { vec![Box::new(Wrong)] };
    type Forces<'a> = &'a dyn Fn() -> Vec<Box<dyn Force>>;
    let cases: [(&str, &str, Forces<'_>, Solver, f64); 6] = [
        ("runs out", "linear_implicit_midpoint", &forces, solver(1e-5, 2, 1), 3.0),
        ("converges", "linear_backward_euler", &forces, solver(0.3, 6, 1), 3.0),
        ("settles", "backward_euler", &forces, solver(0.4, 5, 4), 1.0),
        ("does not settle", "trapezoid", &forces, solver(1e-4, 3, 2), 3.0),
        ("breaks down", "linear_backward_euler", &wrong, solver(1e-4, 3, 1), 9.0),
        ("stands alone", "implicit_midpoint", &loose, solver(1e-3, 3, 3), 3.0),
    ];
    let machines = [(true, 256), (false, 1 << 18)];
    for (place, (case, name, forces, solver, stiffness)) in cases.into_iter().enumerate() {
        let (software, invocations) = machines[place % 2];
        let machine = Machine { software, subgroup: 0, invocations };
        let mut gpu = Gpu::new(&device.0, &device.1, u32::try_from(COUNT).expect("few")).expect("a GPU");
        gpu.pad(5);
        gpu.pretend(machine);
        let setup = Setup {
            particles: tangle(stiffness),
            forces: forces(),
            integrator: integrator(name),
            dt: 0.31,
            bounds: Bounds::default(),
            solver,
        };
        let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
        simulation.step(2).expect("steps");
        let plan = setup.plans(machine).expect("plans").step;
        amid(case, simulation, &plan, stages);
    }
}

/// A stage for each kernel of a solve, where those before it have led.
fn amid(case: &str, simulation: Simulation<Gpu>, plan: &Plan, stages: &mut Vec<Stage>) {
    let simulation = Rc::new(RefCell::new(simulation));
    let mut begun = 0;
    for kernel in plan.steps() {
        let single = alone(kernel.clone());
        let file = |name: &str| kernel.passes[0].shader.sources().iter().any(|source| source.file.contains(name));
        if file("solve_") || file("each_jacobian") {
            let name = format!("a solve that {case}, {}", kernel.name);
            let stage = Stage::amid(&name, &simulation, single.clone());
            let begin = kernel.name == "begin";
            begun += u32::from(begin);
            // From the third on, what is left is rounding.
            if !(begin && begun > 2) {
                stages.push(stage.slack(if begin && begun == 2 { LATER } else { 1.0 }));
            }
        }
        let mut simulation = simulation.borrow_mut();
        let gpu = simulation.backend();
        let program = gpu.compile(&single).expect("a kernel");
        gpu.run(&program, 1).expect("a kernel runs");
    }
}
