//! Stages of implicit steps: whole ones, in which every kernel takes up what those before it left.
#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds")]

use std::cell::RefCell;
use std::rc::Rc;

use motes::forces::Component;
use motes::kernel::{Backend, Kernel, Machine, Plan, Scalar};
use motes::links::{Link, Links};
use motes::motion::{Held, Hold};
use motes::settings::Value;
use motes::{Bounds, Gpu, Setup, Simulation, Solver, State};

use crate::stages::{Device, Stage, next};
use crate::support::machines::alone;
use crate::support::states::{force, integrator, vector, word};
use crate::support::{self};

/// Four workgroups of 256, or sixteen of 64, the last not full: as many as a device of four in each of four rows has.
const COUNT: usize = 1010;

/// A cloud of which most are linked, some in rings; one is held, one has no mass.
#[expect(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds")]
fn tangle(stiffness: f64) -> State {
    let mut particles = support::cloud(COUNT, 31);
    particles.links = Links::default();
    let tied = u32::try_from(COUNT).expect("few") - 20;
    let mut random = support::Random::new(5);
    for id in 1..tied {
        for way in [1, 7] {
            if id + way < tied {
                let rest = f64::from((1.3 + 0.7 * random.next()) as f32);
                // Two of them are going to be at one place, in [`together`].
                let rest = if (id, way) == (8, 1) { 0.0 } else { rest };
                let stiffness = f64::from((stiffness * (1.2 + 0.3 * random.next())) as f32);
                let link = Link { ends: [id, id + way], rest, stiffness, damping: 0.3 * stiffness, rope: id % 5 == 0 };
                particles.links.springs.push(link);
            }
        }
    }
    for mass in particles.mass_mut() {
        *mass = f64::from((*mass * 300.0) as f32);
    }
    particles.mass_mut()[COUNT - 3] = 0.0;
    particles.held.push(Held { id: 17, by: Hold::Fixed });
    particles
}

/// More workgroups than a workgroup has lanes.
const MANY: u32 = 300;

/// A state of a solve: first, gamma, alpha, residual; iterations, total, code, settled, broken.
const DONE: [f32; 9] = [1.5, 2.5, 3.5, 4.5, 1.0, 5.0, 1.0, 0.0, 0.0];

fn forces() -> Vec<Box<dyn Component>> {
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
                ("period", Value::Number(1.3)),
                ("wavelength", Value::Number(1.7)),
            ],
        ),
        // Air at rest, and a particle at rest.
        force("wind", &[("velocity", vector(0.0, 0.0, 0.0)), ("rate", Value::Number(0.3))]),
        force("drag", &[("linear", Value::Number(0.1)), ("quadratic", Value::Number(0.2))]),
        force("vortex", &[("rate", Value::Number(0.6))]),
    ]
}

/// What is wrong in the later begins of Newton's method: the difference of impulses that are up to a hundred times as large.
const LATER: f64 = 10.0;

type Forces<'a> = &'a dyn Fn() -> Vec<Box<dyn Component>>;

/// Steps that run out of iterations, that converge, that settle, and that break down; with links and without.
pub fn all(device: &Device, stages: &mut Vec<Stage>) {
    let solver = |tolerance, iterations, solves| Solver { tolerance, iterations, solves };
    let loose = || forces().into_iter().filter(|force| force.laws()[0].name != "spring").collect();
    let bonds = || {
        let others = forces().into_iter().filter(|force| force.laws()[0].name != "spring");
        others.chain([force("fene", &[("max_length", Value::Number(5.5))])]).collect()
    };
    let cases: [(&str, &str, Forces<'_>, Solver, f64); 6] = [
        ("runs out", "linear_implicit_midpoint", &forces, solver(1e-5, 2, 1), 3.0),
        ("converges", "linear_backward_euler", &forces, solver(0.3, 3, 1), 3.0),
        ("settles", "backward_euler", &forces, solver(0.4, 3, 3), 1.0),
        ("does not settle", "trapezoid", &forces, solver(1e-4, 2, 2), 3.0),
        ("is of bonds", "backward_euler", &bonds, solver(0.4, 3, 2), 3.0),
        ("stands alone", "implicit_midpoint", &loose, solver(1e-3, 3, 2), 3.0),
    ];
    let machines = [(true, 256), (false, 1 << 18)];
    for (place, (case, name, forces, solver, stiffness)) in cases.into_iter().enumerate() {
        let (software, invocations) = machines[place % 2];
        let machine = Machine { software, subgroup: 0, invocations, ..Machine::HOST };
        let mut gpu = Gpu::new(&device.0, &device.1, u32::try_from(COUNT).expect("few")).expect("a GPU");
        gpu.pad(5);
        gpu.pretend(machine);
        let setup = Setup {
            state: tangle(stiffness),
            forces: forces(),
            integrator: integrator(name),
            dt: 0.31,
            bounds: Bounds::default(),
            solver,
        };
        let plan = setup.plans(machine).expect("plans").step;
        // A field is made once: with room for all.
        let advance = plan.kernels.iter().find(|kernel| kernel.name == "advance").expect("an iteration");
        gpu.compile(&alone(enlarged(advance))).expect("a kernel");
        let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
        simulation.step(2).expect("steps");
        amid(case, simulation, &plan, stages);
    }
}

type Shared = Rc<RefCell<Simulation<Gpu>>>;

/// A stage for each kernel of a solve, where after those before it.
fn amid(case: &str, simulation: Simulation<Gpu>, plan: &Plan, stages: &mut Vec<Stage>) {
    let simulation = Rc::new(RefCell::new(simulation));
    let mut begun = 0;
    let mut walk = plan.walk();
    while let Some(kernel) = next(&mut walk, &simulation) {
        let file = |name: &str| kernel.passes[0].shader.sources().iter().any(|source| source.file.contains(name));
        let name = format!("a solve that {case}, {}", kernel.name);
        let here = || Stage::amid(&name, &simulation, alone(kernel.clone()));
        match kernel.name.as_str() {
            "begin" => {
                // From the third on, what is left is rounding, unless it is left alone.
                let settled = words(&simulation, "solve_state")[7] > 0.0;
                if begun < 2 || settled {
                    stages.push(here().slack(if begun > 0 { LATER } else { 1.0 }));
                }
                if begun == 1 && !settled {
                    stages.push(far(&name, &simulation, kernel).slack(LATER));
                }
                begun += 1;
            }
            "report" => {
                let old = [[3, 0, 77, 2, 8, 9], [3, 1, 77, 900, 8, 9]];
                stages.extend(old.map(|old: [u32; 6]| {
                    amended(&name, &simulation, kernel.clone(), &[("solve_report", old.map(f32::from_bits).to_vec())])
                }));
                let broken = [1.5, 2.5, 3.5, 4.5, 1.0, 5.0, 2.0, 0.0, 1.0];
                stages.push(amended(&name, &simulation, kernel.clone(), &[("solve_state", broken.to_vec())]));
            }
            "advance" => {
                if case == "runs out" && !stages.iter().any(|stage| stage.name.contains("made up")) {
                    made_up(&simulation, kernel, stages);
                }
                stages.push(here());
            }
            "product" if begun == 1 && case == "runs out" => {
                // Where rows are not full, there are workgroups that have nothing to do.
                let mut wider = kernel.clone();
                wider.passes[0].threads.count += 256;
                stages.extend([here(), Stage::amid(&format!("{name}, wider"), &simulation, alone(wider))]);
                let state = kernel.passes[0].field("solve_state");
                stages.push(amended(&format!("{name}, done"), &simulation, kernel.clone(), &[(state, DONE.to_vec())]));
            }
            "rows" if begun == 0 && case == "runs out" => {
                stages.extend([here(), together(&name, &simulation, kernel)]);
            }
            "update" => stages.push(here()),
            _ if begun < 2 && (file("solve_") || file("each_jacobian")) => stages.push(here()),
            _ => {}
        }
        let mut simulation = simulation.borrow_mut();
        let gpu = simulation.backend();
        let program = gpu.compile(&alone(kernel.clone())).expect("a kernel");
        gpu.run(&program, 1).expect("a kernel runs");
    }
}

/// A field as it is.
fn words(simulation: &Shared, name: &str) -> Vec<f32> {
    let mut simulation = simulation.borrow_mut();
    let gpu = simulation.backend();
    let bytes = pollster::block_on(gpu.bytes(name, 0, gpu.size(name))).expect("a field");
    bytemuck::pod_collect_to_vec(&bytes)
}

/// A stage in which some fields begin with other numbers than they do.
fn amended(name: &str, simulation: &Shared, kernel: Kernel, fields: &[(&str, Vec<f32>)]) -> Stage {
    let write = |field: &str, words: &[f32]| {
        let mut simulation = simulation.borrow_mut();
        simulation.backend().write_bytes(field, 0, bytemuck::cast_slice(words)).expect("a field");
    };
    simulation.borrow_mut().backend().compile(&alone(kernel.clone())).expect("a kernel");
    let before: Vec<_> = fields.iter().map(|(field, _)| words(simulation, field)).collect();
    for (field, words) in fields {
        write(field, words);
    }
    let stage = Stage::amid(name, simulation, alone(kernel));
    for ((field, _), words) in fields.iter().zip(before) {
        write(field, &words);
    }
    stage
}

/// Ends of springs at one place.
fn together(name: &str, simulation: &Shared, kernel: &Kernel) -> Stage {
    let mut position = words(simulation, "position");
    for id in [8, 21] {
        position.copy_within(4 * id..4 * id + 3, 4 * id + 4);
    }
    amended(&format!("{name}, together"), simulation, kernel.clone(), &[("position", position)])
}

/// Particles at all distances from the origin: for some of them what is left to do is less than a place can tell.
fn far(name: &str, simulation: &Shared, kernel: &Kernel) -> Stage {
    let mut rows = words(simulation, "rows");
    let mut random = support::Random::new(41);
    for row in rows[..16 * COUNT].chunks_exact_mut(16) {
        row[15] = 10f32.powf(5.0 + 3.0 * random.narrow());
    }
    amended(&format!("{name}, far away"), simulation, kernel.clone(), &[("rows", rows)])
}

/// States that a solve seldom comes to: done while sums say otherwise, without a positive matrix, with what is not a
/// number; and one of more workgroups than a workgroup has lanes.
fn made_up(simulation: &Shared, advance: &Kernel, stages: &mut Vec<Stage>) {
    let state = advance.passes[0].field("solve_state").to_owned();
    let groups = COUNT.div_ceil(256);
    let mut random = support::Random::new(43);
    let mut dots = |groups: usize, sums: [f32; 4]| -> Vec<f32> {
        (0..groups).flat_map(|_| sums.map(|sum| sum * (1.0 + 0.3 * random.narrow()))).collect()
    };
    let done = DONE;
    let mut on_its_way = DONE;
    on_its_way[6] = 0.0;
    let mut fresh = on_its_way;
    fresh[4] = 0.0;
    let sums = [0.3, 0.7, 0.2, 0.1];
    let mut none = dots(groups, sums);
    none[4] = f32::NAN;
    let cases = [
        ("done", done, dots(groups, sums)),
        ("bent aside", on_its_way, dots(groups, [0.3, -0.7, 0.2, 0.1])),
        ("led aside", on_its_way, dots(groups, [-0.3, 0.7, 0.2, 0.1])),
        ("not a number", on_its_way, none),
    ];
    for (case, before, dots) in cases {
        let fields = [(state.as_str(), before.to_vec()), ("dots", dots)];
        stages.push(amended(&format!("a made up solve, {case}"), simulation, advance.clone(), &fields));
    }
    let garbage: Vec<f32> = (0..12 * COUNT).map(|_| random.narrow()).collect();
    let sums = (0..MANY).flat_map(|k| sums.map(|sum| sum * (1.0 + (k % 7) as f32))).collect();
    let fields = [(state.as_str(), fresh.to_vec()), ("dots", sums), ("directions", garbage)];
    stages.push(amended("a made up solve of many workgroups", simulation, enlarged(advance), &fields));
}

/// The same with sums of so many workgroups.
fn enlarged(advance: &Kernel) -> Kernel {
    let mut large = advance.clone();
    let pass = &mut large.passes[0];
    let extent = &pass.shader.reflection().binding("extent").expect("a block").packed;
    let values = [("chunk", 256), ("groups", MANY)].map(|(name, n)| (name, Scalar::Uint(n)));
    let packed = extent.pack("extent", &values).expect("two numbers");
    pass.uniforms.retain(|(name, _)| *name != "extent");
    pass.uniforms.push(("extent", packed));
    for (_, size) in large.sizes.iter_mut().filter(|(name, _)| name == "dots") {
        *size = u64::from(MANY);
    }
    large
}
