//! The memory of this process over many steps. It is measured in a process of its own, which runs one test.
#![cfg(target_os = "linux")]

mod support;

use motes::forces::{Custom, Over};
use motes::integrators::Leapfrog;
use motes::kernel::Backend;
use motes::settings::Value;
use motes::{Bounds, Cpu, POSITION, Setup, Simulation, Solver};
use support::scenes;

/// Before the first look at memory: pools and caches are as large as they become.
const FIRST: u32 = 300;
/// What may come and go \[MB\]: arenas of threads, pools of command buffers. The largest seen is 2.3. lavapipe of Mesa 22.3.6
/// keeps what it compiles, some 0.2 MB a time: without the unused word of uniform blocks it takes 60 to 1580 in these steps.
const NOISE: f64 = 16.0;

/// Memory of this process that is in use \[MB\].
fn resident() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").expect("Linux has it");
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).expect("a size");
    line.split_whitespace().next().and_then(|size| size.parse::<f64>().ok()).expect("kilobytes") / 1024.0
}

fn growth<B: Backend>(mut simulation: Simulation<B>, steps: u32) -> f64 {
    let mut after = |steps| {
        simulation.step(steps).expect("steps");
        pollster::block_on(simulation.read(POSITION)).expect("positions");
        resident()
    };
    let before = after(FIRST);
    after(steps) - before
}

/// A law with a loop as long as its first parameter says: what lavapipe compiles anew, where that is the word at offset 0.
const LOOP: &str = "struct Params { n: u32, s: f32 }
@group(3) @binding(0) var<uniform> params: Params;
fn mixed(x: vec3f) -> vec3f {
    var y = x;
    y = sin(y) * y.yzx + cos(y.zxy) * y;
    y = sqrt(abs(y)) + exp2(-y * y);
    y = sin(y.zxy) - y * cos(y);
    return sqrt(abs(y) + 1.0);
}
fn force(me: Particle) -> vec4f {
    var a = mixed(mixed(me.position));
    for (var k = 0u; k < params.n; k++) { a = mixed(a + params.s * me.position * f32(k)); }
    return vec4f(a, 0.0);
}
";

fn law() -> Setup {
    let params = vec![("n".to_owned(), Value::Number(4.0)), ("s".to_owned(), Value::Number(2.0))];
    let law = Custom { params, ..Custom::new("loop", "loop.wgsl", LOOP, Over::Each) };
    Setup {
        state: support::cloud(64, 7),
        forces: vec![Box::new(law)],
        integrator: Box::new(Leapfrog),
        dt: 1e-4,
        bounds: Bounds::default(),
        solver: Solver::default(),
    }
}

#[test]
fn memory_does_not_grow_with_steps() {
    let shared = support::device();
    let small = |name: &'static str| (name, scenes::setup(scenes::small(name)));
    let coarse = ["force.1.spacing=0.1", "simulation.dt=0.0005"];
    let families = || {
        vec![
            small("flag"),
            small("fountain_pool"),
            small("fish_school"),
            small("plummer"),
            small("vicsek"),
            small("double_pendulum"),
            small("cloth"),
            small("periodic_box"),
            ("dam_break_2d", scenes::setup(scenes::with("dam_break_2d", &coarse))),
        ]
    };
    // The fluids' references look at all pairs: so many steps of them take as long as those of the device.
    let by_reference = |name: &str| if ["fountain_pool", "dam_break_2d"].contains(&name) { 60 } else { 1000 };
    for (name, setup) in families() {
        let count = u32::try_from(setup.state.len()).expect("few");
        let steps = by_reference(name);
        let grown = growth(Simulation::on(Cpu::new(count).expect("some"), &setup).expect("a simulation"), steps);
        println!("{name}, {count} particles, reference: {grown:.1} MB in {steps} steps");
        assert!(grown < NOISE, "{name}: the reference has taken {grown} MB in {steps} steps");
    }
    for (name, setup) in families().into_iter().chain([("a law with a loop", law())]) {
        let steps = 5000;
        let simulation = Simulation::new(&shared.found.device, &shared.found.queue, &setup).expect("a simulation");
        let start = std::time::Instant::now();
        let grown = growth(simulation, steps);
        println!("{name}, device: {grown:.1} MB in {steps} steps, {:.1} s", start.elapsed().as_secs_f64());
        assert!(grown < NOISE, "{name}: the device has taken {grown} MB in {steps} steps");
    }
}
