//! Kernels that are fused: a step leaves the same bits as its kernels one by one, in every built-in scene.

use std::collections::BTreeMap;

use motes::kernel::{Backend, Next, Plan};
use motes::scene::{Options, SCENES, Scene, Source};
use motes::{Gpu, Setup, Simulation};

use crate::support::scenes::{setup, with};
use crate::support::small::SMALLER;
use crate::support::{device, is_software};

const STEPS: u32 = 3;

/// A step of a plan kernel by kernel, each compiled alone.
fn apart(gpu: &mut Gpu, plan: &Plan) {
    let mut walk = plan.walk();
    while let Some(next) = walk.next() {
        match next {
            Next::Run(kernel) => {
                let program = gpu.compile(&Plan::of([kernel.clone()])).expect("a program");
                gpu.run(&program, 1).expect("a run");
            }
            Next::Ask(flag) => {
                if pollster::block_on(gpu.is_set(flag)).expect("a flag") {
                    walk.leave();
                }
            }
        }
    }
}

/// The contents of all fields of a step that have a meaning after it.
fn contents(gpu: &mut Gpu, plan: &Plan, rows: u32) -> BTreeMap<String, Vec<u32>> {
    let scratch = |name: &String| plan.kernels.iter().any(|kernel| kernel.is_scratch(name));
    let names: Vec<String> = plan.fields(rows).into_keys().filter(|name| !scratch(name)).collect();
    let all = names.into_iter().filter(|name| gpu.size(name) > 0).collect::<Vec<_>>();
    all.into_iter()
        .map(|name| {
            let size = gpu.size(&name);
            let bytes = pollster::block_on(gpu.bytes(&name, 0, size)).expect("a field");
            // A compiler that sees a sum begin with 0 leaves that out, and −0 stays what it is.
            let word = |word: &[u8]| u32::from_le_bytes(word.try_into().expect("four bytes"));
            let words = bytes.chunks_exact(4).map(word);
            (name, words.map(|word| if word == 1 << 31 { 0 } else { word }).collect())
        })
        .collect()
}

/// The fields that differ after some steps.
fn differences(setup: &Setup) -> Vec<String> {
    let shared = device();
    let simulation = || Simulation::new(&shared.found.device, &shared.found.queue, setup).expect("a simulation");
    let mut fused = simulation();
    let (plan, rows) = fused.step_plan();
    let plan = plan.clone();
    fused.step(STEPS).expect("steps");
    let whole = contents(fused.backend(), &plan, rows);
    let mut single = simulation();
    // What comes before the first step.
    single.step(0).expect("a start");
    (0..STEPS).for_each(|_| apart(single.backend(), &plan));
    let parts = contents(single.backend(), &plan, rows);
    assert!(whole.len() > 3 && whole.len() == parts.len());
    whole.into_iter().filter(|(name, bytes)| parts[name] != *bytes).map(|(name, _)| name).collect()
}

#[test]
fn steps_have_the_bits_of_their_kernels_one_by_one() {
    // A compiler of another adapter may round a product of one kernel and a sum of the next as one.
    if !is_software(&device()) {
        return;
    }
    let mut wrong = Vec::new();
    for scene in SCENES {
        let smaller = SMALLER.iter().find(|(name, _)| *name == scene.name).map_or(&[][..], |(_, set)| set);
        let setup = setup(with(scene.name, smaller));
        wrong.extend(differences(&setup).into_iter().map(|field| format!("{}: {field}", scene.name)));
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// A law of one's own over each particle, after a kernel that moves them all.
const SCENE: &str = r#"
[simulation]
dt = 0.01
steps = 3
[[particles]]
shape = "box"
count = 700
size = [1, 1, 1]
speed = 1
[[force]]
wgsl = "own.wgsl"
over = "each"
"#;

fn own(pull: &str) -> Setup {
    let law = format!("fn force(me: Particle) -> vec4f {{\n    return vec4f({pull}, 0.0);\n}}\n");
    let files = vec![("own.wgsl".to_owned(), law.into_bytes())];
    let source = Source::Memory { name: "own".to_owned(), text: SCENE.to_owned(), files };
    setup(Scene::load(&source, &[], &Options::default()).unwrap_or_else(|faults| panic!("{faults}")))
}

#[test]
fn a_law_that_looks_at_another_particle_stays_apart() {
    let (apart, alone) = (own("position[(me.index + 1u) % world.count].xyz - me.position"), own("-me.position"));
    let kernels = |setup: &Setup| setup.plans(motes::kernel::Machine::HOST).expect("plans").step.fused().to_string();
    assert!(kernels(&apart).starts_with("kick+drift KICK=0.5 | own | kick "), "{}", kernels(&apart));
    assert!(kernels(&alone).starts_with("kick+drift KICK=0.5 + own + kick "), "{}", kernels(&alone));
    assert_eq!(differences(&apart), Vec::<String>::new());
    assert_eq!(differences(&alone), Vec::<String>::new());
}

/// A driver's fault is that of one law, which a message names, and large laws are compiled once.
#[test]
fn at_most_one_law_of_a_user_is_fused_and_no_large_one() {
    let text = format!("{SCENE}[[force]]\nwgsl = \"two.wgsl\"\nover = \"each\"\n");
    let plan = |first: String| {
        let law = "fn force(me: Particle) -> vec4f { return vec4f(-me.position, 0.0); }";
        let files = vec![("own.wgsl".to_owned(), first.into_bytes()), ("two.wgsl".to_owned(), law.as_bytes().to_vec())];
        let source = Source::Memory { name: "own".to_owned(), text: text.clone(), files };
        let scene = Scene::load(&source, &[], &Options::default()).unwrap_or_else(|faults| panic!("{faults}"));
        setup(scene).plans(motes::kernel::Machine::HOST).expect("plans").step.fused().to_string()
    };
    let small = "fn force(me: Particle) -> vec4f { return vec4f(me.position, 0.0); }".to_owned();
    assert!(plan(small).starts_with("kick+drift KICK=0.5 + own | two + kick "));
    let numbers: Vec<String> = (0..600).map(|k| format!("{k}.5")).collect();
    let large = format!(
        "fn force(me: Particle) -> vec4f {{ var all = array<f32, 600>({}); return vec4f(all[u32(me.mass)]); }}",
        numbers.join(", ")
    );
    assert!(plan(large).starts_with("kick+drift KICK=0.5 | own | two + kick "));
}
