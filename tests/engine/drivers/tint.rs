//! The kernels of scenes, pictures, forces and loops, and what a device is asked, for another compiler than naga. `tests/mutants`
//! writes those of its stages.

use std::collections::HashSet;

use motes::forces::{Custom, Over};
use motes::kernel::{Column, Columns, Flag, Kernel, Kind, Machine, Pass, Shader, repeat};
use motes::render::{Color, Exposure, Picture, Scaled, Scenery, Trail};
use motes::selftest::Questions;
use motes::settings::Value;
use motes::tree::Opening;
use motes::{Bounds, Setup, Solver};

use crate::drivers::kernels::{every, machines};
use crate::support;
use crate::support::scenes::with;
use crate::support::states::integrator;
use crate::support::tint::{shaders, write};

/// A law that loops, over pairs.
const LOOPS: &str = "struct Params { n: u32 }
@group(3) @binding(0) var<uniform> params: Params;
fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    for (var i = 0u; i < params.n; i++) { (*sum).acceleration += r; }
}
fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, 0.0); }";

/// A law that computes which words of a pair's history it names.
const WORDS: &str = "fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    for (var word = 0u; word < 3u; word += 1u) { remember(you, word, recall(you, word) + 1.0); }
    (*sum).acceleration += r;
}
fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, 0.0); }";

/// What no scene has: kernels of loops, what a device is asked, and users' laws that loop.
fn others(machine: Machine) -> Vec<Kernel> {
    let flag = Flag { field: "solver".into(), word: 0, member: "done" };
    let mut all = [repeat::proceed(&flag, 3, 2), repeat::reset(6)].map(|kernel| kernel.expect("a loop")).to_vec();
    let Questions { long_loop, arithmetic, numbers } = Questions::default();
    for source in [long_loop, arithmetic, numbers] {
        let mut question = all[0].clone();
        question.name = source.file.to_string();
        question.passes = vec![Pass::new(Shader::join(&[source]).expect("a shader"), 1)];
        all.push(question);
    }
    let tree = Over::Tree { opening: Opening::Geometric { theta: 0.01 }, core: 0.0, auto: false };
    let list = Over::List { range: 0.1, skin: None, slots: 2 };
    for (over, text) in [(Over::Pairs, LOOPS), (tree, LOOPS), (list, WORDS)] {
        let params = if text == LOOPS { vec![("n".to_owned(), Value::Number(100.0))] } else { Vec::new() };
        let setup = Setup {
            state: support::cloud(1200, 3),
            forces: vec![Box::new(Custom { params, ..Custom::new("l", "l.wgsl", text, over) })],
            integrator: integrator("symplectic_euler"),
            dt: 0.01,
            bounds: Bounds::default(),
            solver: Solver::default(),
        };
        all.extend(setup.plans(machine).expect("plans").step.kernels);
    }
    all
}

/// Pictures as no built-in scene has them.
fn pictures() -> Vec<Kernel> {
    let pictures = [("vicsek", "picture.style=density"), ("kepler", "picture.style=glow")].map(|(name, style)| {
        let scene = with(name, &[style]);
        let (scenery, mut trail) = (Scenery::of(&scene.particles), Trail::new(scene.particles.len()));
        (0..3).for_each(|_| trail.push(scene.particles.position()));
        let picture = Picture::with(&scene.picture, &scene.particles, &[], trail, &scenery).expect("a picture");
        let plans = [picture.plan(), picture.development(Exposure { knee: 0.1, white: 1.3 })];
        plans.map(|plan| plan.expect("a plan").kernels).concat()
    });
    pictures.into_iter().chain([columns()]).flatten().collect()
}

/// Colours by columns, in every way in which they lie on a device.
fn columns() -> Vec<Kernel> {
    let scene = with("kepler", &["picture.style=balls"]);
    let known = Columns::default();
    let own = [Column::new("heat", Kind::Scalar, "", ""), Column::new("shell", Kind::Whole, "", "")];
    let base = ["mass", "velocity"].map(|name| known.get(name).expect("a column").clone());
    let of = |column: Column| {
        let mut picture = Picture::new(&scene.picture, &scene.particles, &[], Trail::new(0)).expect("a picture");
        picture.paint(Color::Value(Box::new(Scaled::of(column, [1.0, 2.0]))));
        picture.plan().expect("a plan").kernels
    };
    own.into_iter().chain(base).flat_map(of).collect()
}

#[test]
fn every_shader_can_be_written_for_another_compiler() {
    let mut all: Vec<(String, Kernel, u32)> =
        pictures().into_iter().map(|kernel| ("a picture".to_owned(), kernel, 0)).collect();
    for (_, machine) in machines() {
        let others = others(machine).into_iter().map(|kernel| ("others".to_owned(), kernel));
        all.extend(every(machine).into_iter().chain(others).map(|(of, kernel)| (of, kernel, machine.subgroup)));
    }
    let shaders = shaders(all.iter().map(|(of, kernel, lanes)| (of.clone(), kernel, *lanes)));
    let texts: HashSet<_> = shaders.iter().filter_map(|shader| shader["code"].as_str()).collect();
    assert!(texts.len() > 200 && shaders.len() > texts.len(), "{} of {} are not all", texts.len(), shaders.len());
    write("engine", &shaders);
}
