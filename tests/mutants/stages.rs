//! Stages: states of a device in which a kernel shows what it does.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;
use std::time::Duration;

use motes::forces::{Component, Law};
use motes::integrators::INTEGRATORS;
use motes::kernel::{
    ALARM, Backend, Element, Field, Kernel, Machine, Next, POSITION, Plan, SPECIES, Shader, Source, VELOCITY, Walk,
    World,
};
use motes::lockstep::{Known, Verdict, compare_again};
use motes::settings::Value;
use motes::{Gpu, Setup, Simulation, wgpu};

use crate::bounded::bounded;
use crate::support::joint;
use crate::support::machines::{alone, cut, kernel, machines};
use crate::support::states::{force, integrator};
use crate::support::{self, Shared};
use crate::{alarms, columns, laws, primitives};

/// Large, and not a round number: what is wrong in a step shows.
const DT: f64 = 0.37;
/// Eight workgroups of 64, the last not full: on a device of four in a row two rows, and none too many.
pub const FEW: usize = 500;
/// Twelve workgroups in three rows; sources in six blocks, of which some lie apart from the targets of each workgroup,
/// and the last is not full.
const MANY: usize = 740;

/// How long a shader as it is may take with its compilation by the driver, on a machine that is busy.
pub const PATIENCE: Duration = Duration::from_mins(1);
/// How long a mutant may take, which may loop without an end.
pub const SHORT: Duration = Duration::from_secs(5);

/// A state, and a kernel to run in it.
pub struct Stage {
    pub name: String,
    pub plan: Plan,
    simulation: Rc<RefCell<Simulation<Gpu>>>,
    fields: BTreeMap<String, Vec<u8>>,
    clock: World,
    /// What the reference of the first kernel makes of that state.
    known: RefCell<Known>,
    /// What a field must hold in the end, where no reference can be compared: NaN differs from NaN.
    expected: Option<(&'static str, Vec<f32>)>,
    /// How many times what is allowed elsewhere may be wrong.
    slack: f64,
    /// A file that runs here to no effect.
    overlooked: Option<&'static str>,
}

impl Stage {
    /// Keeps the state that a simulation is in.
    pub fn new(name: &str, simulation: Simulation<Gpu>, kernel: Kernel) -> Self {
        Self::of(name, simulation, alone(kernel))
    }
    /// The same for several kernels, of which each takes up what those before it left.
    pub fn of(name: &str, simulation: Simulation<Gpu>, plan: Plan) -> Self {
        Self::amid(name, &Rc::new(RefCell::new(simulation)), plan)
    }
    /// The same in a simulation that other stages stand in as well: each puts back the fields that it has a use for.
    pub fn amid(name: &str, simulation: &Rc<RefCell<Simulation<Gpu>>>, plan: Plan) -> Self {
        let plan = crate::memory::remembering(plan);
        let shared = simulation.clone();
        let mut simulation = simulation.borrow_mut();
        let count = simulation.count();
        let gpu = simulation.backend();
        gpu.limit_submissions(Duration::from_millis(80), PATIENCE);
        gpu.compile(&plan).expect("a good plan");
        gpu.keep_pipelines();
        let clock = pollster::block_on(gpu.world()).expect("a clock");
        let names = plan.fields(count).into_keys().chain([POSITION.name.into(), VELOCITY.name.into()]);
        let read = |name: String| {
            let bytes = pollster::block_on(gpu.bytes(&name, 0, gpu.size(&name))).expect("a field");
            (name, bytes)
        };
        let fields = names.filter(|n| n != "world").map(read).collect();
        Self {
            name: name.to_owned(),
            plan,
            simulation: shared,
            fields,
            clock,
            known: RefCell::default(),
            expected: None,
            slack: 1.0,
            overlooked: None,
        }
    }
    /// The same stage, judged by what a field holds in the end.
    pub fn expected(self, field: &'static str, values: Vec<f32>) -> Self {
        Self { expected: Some((field, values)), ..self }
    }
    /// The same stage, where more may be wrong.
    pub fn slack(self, slack: f64) -> Self {
        Self { slack, ..self }
    }
    /// The same stage, which is shown no mutant of a file.
    pub fn overlooking(self, file: &'static str) -> Self {
        Self { overlooked: Some(file), ..self }
    }
    fn holds(gpu: &mut Gpu, plan: &Plan, field: &str, want: &[f32]) -> Result<bool, motes::Error> {
        let program = gpu.compile(plan)?;
        gpu.run(&program, 1)?;
        let bytes = pollster::block_on(gpu.bytes(field, 0, 4 * want.len() as u64))?;
        let got = bytemuck::pod_collect_to_vec::<u8, f32>(&bytes);
        Ok(got.iter().zip(want).all(|(got, want)| got.to_bits() == want.to_bits() || got.is_nan() && want.is_nan()))
    }
    /// Runs a plan from that state. Whether it agrees with its references.
    pub fn good(&self, plan: &Plan) -> bool {
        self.fault(plan).is_none()
    }
    /// The same; what is wrong, if anything.
    pub fn fault(&self, plan: &Plan) -> Option<String> {
        self.verdict(plan, None).unwrap_or_else(|error| Some(error.to_string()))
    }
    /// The same, for the [`joint::choice`] of a mutant where several are compiled together.
    ///
    /// # Errors
    /// Those of the device, which may have been too slow.
    pub fn verdict(&self, plan: &Plan, choice: Option<u32>) -> Result<Option<String>, motes::Error> {
        let mut simulation = self.simulation.borrow_mut();
        let count = simulation.count();
        let gpu = simulation.backend();
        for (name, bytes) in &self.fields {
            gpu.write_bytes(name, 0, bytes).expect("a field");
        }
        gpu.set_world(self.clock).expect("a clock");
        if let Some(choice) = choice {
            gpu.compile(plan)?;
            gpu.write_bytes(joint::BUFFER, 0, bytemuck::bytes_of(&choice))?;
        }
        if let Some((field, want)) = &self.expected {
            let same = Self::holds(gpu, plan, field, want)?;
            return Ok((!same).then(|| format!("{field} is not what was expected")));
        }
        let good = |v: &Verdict| v.worst <= self.slack && !v.spilled;
        let mut known = self.known.borrow_mut();
        let all = pollster::block_on(compare_again(gpu, plan, count, good, &mut known))?;
        if all.is_empty() {
            return Ok(Some("nothing is written".to_owned()));
        }
        Ok(all.iter().find(|v| !good(v)).map(|verdict| format!("{verdict:?}")))
    }
    /// How long a run may take from here on.
    pub fn allow(&self, patience: Duration) {
        self.simulation.borrow_mut().backend().limit_submissions(Duration::from_millis(80), patience);
    }
    /// Drops the pipelines of mutants.
    pub fn forget(&self) {
        self.simulation.borrow_mut().backend().forget_pipelines();
    }
    /// Drops what the reference said, which takes memory.
    pub fn forget_answers(&self) {
        self.known.take();
    }
    /// The number of particles.
    pub fn count(&self) -> u32 {
        self.simulation.borrow().count()
    }
    /// Whether a file is part of what runs here to any effect.
    pub fn uses(&self, file: &str) -> bool {
        if self.overlooked == Some(file) {
            return false;
        }
        let mut passes = self.plan.kernels.iter().flat_map(|k| &k.passes);
        passes.any(|p| p.shader.sources().iter().any(|s| s.file == file))
    }
    /// The plan with another text in place of a file's; `None` when that does not compile.
    pub fn mutated(&self, file: &str, text: &str) -> Option<Plan> {
        self.with(file, text, |_| Vec::new())
    }
    /// The same with more files for each shader.
    pub fn with(&self, file: &str, text: &str, more: impl Fn(&Shader) -> Vec<Source>) -> Option<Plan> {
        let mut plan = self.plan.clone();
        let text = bounded(text);
        // A stranger's text: memory starts at zero, so that no mutant lives by chance.
        let theirs = |s: &Source| if s.file == file { Source::theirs(file.into(), text.clone()) } else { s.clone() };
        for pass in plan.kernels.iter_mut().flat_map(|k| &mut k.passes) {
            if pass.shader.sources().iter().any(|s| s.file == file) {
                let sources = pass.shader.sources().iter().map(theirs).chain(more(&pass.shader));
                pass.shader = Shader::join(&sources.collect::<Vec<_>>()).ok()?;
            }
        }
        Some(plan)
    }
    /// The shaders that contain a file.
    pub fn shaders<'a>(&'a self, file: &'a str) -> impl Iterator<Item = &'a Shader> {
        let passes = self.plan.kernels.iter().flat_map(|k| &k.passes).map(|pass| pass.shader.as_ref());
        passes.filter(move |shader| shader.sources().iter().any(|s| s.file == file))
    }
}

/// The next kernel of a plan that runs on a device; loops end by their flags there.
pub fn next<'a>(walk: &mut Walk<'a>, simulation: &Rc<RefCell<Simulation<Gpu>>>) -> Option<&'a Kernel> {
    loop {
        match walk.next()? {
            Next::Run(kernel) => return Some(kernel),
            Next::Ask(flag) => {
                if pollster::block_on(simulation.borrow_mut().backend().is_set(flag)).expect("a flag") {
                    walk.leave();
                }
            }
        }
    }
}

pub type Device = (wgpu::Device, wgpu::Queue);

/// Particles three steps on their way, under a force that is not the one on stage.
pub fn moving(device: &Device, count: usize, machine: Option<Machine>) -> Simulation<Gpu> {
    let mut gpu = Gpu::new(&device.0, &device.1, u32::try_from(count).expect("few")).expect("a GPU");
    gpu.pad(5);
    if let Some(machine) = machine {
        gpu.pretend(machine);
    }
    let integrator = integrator("symplectic_euler");
    let forces = vec![force("uniform", &[])];
    let setup = Setup {
        state: support::cloud(count, 11),
        forces,
        integrator,
        dt: DT,
        bounds: motes::Bounds::default(),
        solver: motes::Solver::default(),
    };
    let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
    simulation.step(3).expect("three steps");
    simulation
}

/// A stage where every field but position, velocity and alarm holds numbers that differ from element to element.
pub fn stage(name: &str, mut simulation: Simulation<Gpu>, kernel: Kernel) -> Stage {
    let plan = alone(kernel);
    fill(&mut simulation, &plan);
    Stage::of(name, simulation, plan)
}

/// Writes a field of a plan, which need not be one of the simulation's own.
pub fn put<T: Element>(simulation: &mut Simulation<Gpu>, field: Field<T>, values: &[T]) {
    simulation.backend().write_bytes(field.name, 0, bytemuck::cast_slice(values)).expect(field.name);
}

/// Numbers for every field but position, velocity and alarm.
pub fn fill(simulation: &mut Simulation<Gpu>, plan: &Plan) {
    let gpu = simulation.backend();
    gpu.compile(plan).expect("a good plan");
    let mut random = support::Random::new(23);
    let kept = [POSITION.name, VELOCITY.name, SPECIES.name, ALARM.name, "world"];
    for name in plan.fields(1).keys().filter(|n| !kept.contains(&n.as_str()) && plan.table(n).is_none()) {
        let words: Vec<f32> = (0..gpu.size(name) / 4).map(|_| random.narrow()).collect();
        gpu.write_bytes(name, 0, bytemuck::cast_slice(&words)).expect("a field");
    }
    let bytes = usize::try_from(gpu.size(SPECIES.name)).expect("few");
    if bytes > 0 {
        gpu.write_bytes(SPECIES.name, 0, bytemuck::cast_slice(&support::species(bytes / 4))).expect("a field");
    }
}

/// Sets up some stages.
type Group<'a> = &'a dyn Fn(&mut Vec<Stage>);

/// All stages, those that cost the least first.
pub fn all(shared: &Shared) -> Vec<Stage> {
    let few = |limits: &mut wgpu::Limits| limits.max_compute_workgroups_per_dimension = 4;
    let device = pollster::block_on(support::limited(shared, few));
    let groups: [(&str, Group<'_>); 37] = [
        ("integrators", &|all| integrators(&device, all)),
        ("repeat", &|all| crate::repeat::all(&device, all)),
        ("implicit", &|all| crate::implicit::all(&device, all)),
        ("precision", &|all| crate::precision::all(&device, all)),
        ("radau", &|all| crate::radau::all(&device, all)),
        ("two_words", &|all| crate::two_words::all(shared, &device, all)),
        ("alarms_watches", &|all| alarms::watches(&device, all)),
        ("alarms_runaways", &|all| alarms::runaways(&device, all)),
        ("boundary_boundary", &|all| crate::boundary::boundary(&device, all)),
        ("laws", &|all| laws::all(&device, all)),
        ("laws_firsts", &|all| laws::firsts(&device, all)),
        ("laws_softenings", &|all| laws::softenings(&device, all)),
        ("laws_corners", &|all| laws::corners(&device, all)),
        ("laws_overlong", &|all| laws::overlong(&device, all)),
        ("laws_virials", &|all| laws::virials(&device, all)),
        ("collide", &|all| crate::collide::all(&device, all)),
        ("columns", &|all| columns::all(&device, all)),
        ("matter", &|all| crate::matter::all(shared, &device, all)),
        ("crowds", &|all| crate::crowds::all(&device, all)),
        ("laws_planes", &|all| laws::planes(&device, all)),
        ("held", &|all| crate::held::all(&device, all)),
        ("pairs", &|all| crate::pairs::all(&device, all)),
        ("adaptive", &|all| crate::adaptive::all(&device, all)),
        ("adaptive_stages", &|all| crate::adaptive_stages::all(shared, &device, all)),
        ("blocks", &|all| crate::blocks::all(shared, &device, all)),
        ("births", &|all| crate::births::all(shared, &device, all)),
        ("rods_rods", &|all| crate::rods::rods(&device, all)),
        ("strained", &|all| crate::strained::all(&device, all)),
        ("dfsph", &|all| crate::dfsph::all(shared, &device, all)),
        ("ewald", &|all| crate::ewald::all(shared, &device, all)),
        ("fluids", &|all| crate::fluids::all(shared, &device, all)),
        ("pairs", &|all| pairs(shared, &device, all)),
        ("neighbors", &|all| crate::neighbors::all(shared, &device, all)),
        ("lists", &|all| crate::lists::all(shared, all)),
        ("primitives", &|all| primitives::all(&device, all)),
        ("trees", &|all| crate::trees::all(shared, all)),
        ("walks", &|all| crate::walks::all(shared, all)),
    ];
    // `MUTANTS_ON=precision,adaptive` sets up the stages of such groups alone: to look at a few files, since all take a minute or more.
    let wanted = std::env::var("MUTANTS_ON").unwrap_or_default();
    let mut stages = Vec::new();
    for (name, group) in groups {
        if wanted.is_empty() || wanted.split(',').any(|part| name.contains(part)) {
            group(&mut stages);
        }
    }
    stages
}

/// One stage for each shader of the integrators, with constants that are neither 0 nor 1.
fn integrators(device: &Device, stages: &mut Vec<Stage>) {
    let machine = moving(device, 1, None).backend().machine();
    for entry in INTEGRATORS {
        let setup = Setup {
            state: support::cloud(FEW, 11),
            forces: Vec::new(),
            integrator: entry.by_default(),
            dt: DT,
            bounds: motes::Bounds::default(),
            solver: motes::Solver::default(),
        };
        let plans = setup.plans(machine).expect("plans");
        for kernel in [plans.step, plans.measure.0, plans.measure.1].into_iter().flat_map(|p| p.kernels) {
            let pass = kernel.passes.last().expect("a pass");
            let file = &pass.shader.sources().last().expect("a file").file;
            let telling = pass.constants.iter().all(|(_, value)| ![0.0, 1.0].contains(value));
            // Solves have stages of their own, in states that solves come to.
            let telling = telling && !file.contains("solve_");
            if telling && !stages.iter().any(|s: &Stage| s.uses(file)) {
                if kernel.names("earlier_acceleration") {
                    stages.push(first_step(device, &kernel));
                }
                stages.push(stage(&kernel.name.clone(), moving(device, FEW, None), kernel));
            }
        }
    }
}

/// A kernel of a method that continues with accelerations of a step before, where some particles have none.
fn first_step(device: &Device, kernel: &Kernel) -> Stage {
    let (mut simulation, plan) = (moving(device, FEW, None), alone(kernel.clone()));
    fill(&mut simulation, &plan);
    let gpu = simulation.backend();
    let known = [0.0, 0.5, 0.6, 1.0];
    let earlier: Vec<f32> = (0..FEW).flat_map(|i| [0.3, -0.7, 1.1 + i as f32, known[i % known.len()]]).collect();
    gpu.write_bytes("earlier_acceleration", 0, bytemuck::cast_slice(&earlier)).expect("a field");
    Stage::of(&format!("{}, in a first step", kernel.name), simulation, plan)
}

/// A law that reads everything that a visit passes to it: the other particle, its index too, and where it is.
#[derive(Clone)]
struct Curious;

impl Component for Curious {
    fn laws(&self) -> Vec<Law> {
        let wgsl = "fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
            let v = velocity[you.index].xyz - velocity[me.index].xyz;
            let near = 1.0 / (1.0 + dot(r, r));
            (*sum).acceleration += (you.mass * near) * v;
            (*sum).potential += you.mass * me.mass * near;
        }
        fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, sum.potential); }";
        vec![Law::pairs("curious", Source::ours("curious", wgsl), Vec::new(), |me, you, r| {
            let near = 1.0 / (1.0 + r.length_squared());
            (you.mass * near * (you.velocity - me.velocity)).extend(you.mass * me.mass * near)
        })]
    }
}

/// Each file of `pairs`: in one dispatch, and in two of three layers each.
fn pairs(shared: &Shared, device: &Device, stages: &mut Vec<Stage>) {
    let gravity: Box<dyn Component> =
        force("gravity", &[("softening", Value::Number(0.17)), ("g", Value::Number(1.3))]);
    for (name, machine) in machines(shared).into_iter().filter(|(name, _)| !name.contains("layers")) {
        let whole = kernel(gravity.as_ref(), MANY, &machine);
        let layered = kernel(gravity.as_ref(), MANY, &Machine { invocations: 1 << 18, ..machine });
        let cut = cut(&whole, layered.passes.last().expect("a finish"), MANY, 3, 128);
        let curious = kernel(&Curious, MANY, &machine);
        for (case, kernel) in [("whole", whole), ("cut", cut), ("curious", curious)] {
            stages.push(stage(&format!("{name}, {case}"), moving(device, MANY, Some(machine)), kernel));
        }
    }
}
