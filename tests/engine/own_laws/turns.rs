//! Loops in laws: either every turn is taken, or the run ends with an error that names the law.

use std::sync::MutexGuard;

use glam::DVec3;
use motes::forces::{Component, Custom, Law, Over, Problem, Stage};
use motes::kernel::{ACCELERATION, Plan, Shader, Source};
use motes::links::{Joint, Link, Links};
use motes::selftest::{Outcome, Questions, examine};
use motes::settings::Value;
use motes::tree::Opening;
use motes::{Bounds, Error, Gpu, Setup, Simulation, Solver, State};

use crate::support::equivalents::{Equivalent, Ledger, same};
use crate::support::mutants::mutants;
use crate::support::states::integrator;
use crate::support::{self, Shared};

/// A law of which `n` turns add 1 each, for each interaction.
fn meetings(arguments: &str) -> String {
    format!(
        "struct Params {{ n: u32 }}
@group(3) @binding(0) var<uniform> params: Params;
fn gather({arguments}, sum: ptr<function, Sum>) {{
    for (var i = 0u; i < params.n; i++) {{ (*sum).acceleration += vec3f(1.0, 0.0, 0.0); }}
}}
fn finish(me: Particle, sum: Sum) -> vec4f {{ return vec4f(sum.acceleration.x, 0.0, 0.0, 0.0); }}"
    )
}
const PAIR: &str = "me: Particle, you: Particle, r: vec3f";
const LINK: &str = "me: Particle, you: Particle, r: vec3f, link: Link";
const CORNER: &str = "me: Particle, corner: Corner";

/// A law of each alone, of which `n` turns add 1 each; no compiler knows what comes of them.
const EACH: &str = "struct Params { n: u32 }
@group(3) @binding(0) var<uniform> params: Params;
fn force(me: Particle) -> vec4f {
    var x = 0u;
    for (var i = 0u; i < params.n; i++) { x += 1u + (i & me.index) * 0u; }
    return vec4f(f32(x), 0.0, 0.0, 0.0);
}";

/// A law with other text in place of that which looks at its turns.
#[derive(Clone)]
struct Changed {
    law: Custom,
    turns: String,
}

impl Component for Changed {
    fn laws(&self) -> Vec<Law> {
        self.law.laws()
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        if !matches!(stage, Stage::Evaluate { .. }) {
            return Ok(());
        }
        let file = "shaders/own/turns.wgsl";
        let mut kernel = self.laws().swap_remove(0).kernel(problem)?;
        for pass in &mut kernel.passes {
            let changed = |source: &Source| {
                if source.file == file { Source::theirs(file.to_owned(), self.turns.clone()) } else { source.clone() }
            };
            let sources: Vec<_> = pass.shader.sources().iter().map(changed).collect();
            pass.shader = Shader::join(&sources)?;
        }
        plan.add(kernel);
        Ok(())
    }
}

fn custom(over: Over, wgsl: &str, n: Option<u32>) -> Custom {
    let params = n.map(|n| ("n".to_owned(), Value::Number(f64::from(n)))).into_iter().collect();
    Custom { params, ..Custom::new("l", "l.wgsl", wgsl, over) }
}

fn setup(particles: State, force: Box<dyn Component>) -> Setup {
    Setup {
        state: particles,
        forces: vec![force],
        integrator: integrator("symplectic_euler"),
        // All stay where they are.
        dt: 1e-9,
        bounds: Bounds::default(),
        solver: Solver::default(),
    }
}

/// Accelerations along x after a step of a law.
fn accelerations(shared: &Shared, particles: State, force: Box<dyn Component>) -> Result<Vec<f32>, Error> {
    let setup = setup(particles, force);
    let mut simulation = Simulation::<Gpu>::new(&shared.found.device, &shared.found.queue, &setup)?;
    simulation.step(1)?;
    pollster::block_on(simulation.check())?;
    Ok(pollster::block_on(simulation.read(ACCELERATION))?.iter().map(|a| a.x).collect())
}

fn law(shared: &Shared, over: Over, count: usize, wgsl: &str, n: Option<u32>) -> Result<Vec<f32>, Error> {
    accelerations(shared, support::cloud(count, 3), Box::new(custom(over, wgsl, n)))
}

/// Whether this driver ends long loops silently.
fn cuts(shared: &MutexGuard<'static, Shared>) -> bool {
    let mut gpu = Gpu::new(&shared.found.device, &shared.found.queue, 1).expect("a GPU");
    let findings = pollster::block_on(examine(&mut gpu, &Questions::default())).expect("findings");
    findings.iter().any(|finding| finding.name == "loops" && finding.outcome != Outcome::Pass)
}

fn names_the_law(error: &Error) {
    let text = error.to_string();
    assert!(matches!(error, Error::CutShort { .. } | Error::Endless { .. }), "{text}");
    assert!(text.contains("`l` (l.wgsl)"), "{text}");
    assert_eq!(error.exit_code(), 6);
}

/// Every turn is taken, or, where the driver cuts loops, that is said.
fn right_or_loud(what: &str, said: Result<Vec<f32>, Error>, want: impl Fn(f32) -> bool, cuts: bool) -> bool {
    match said {
        Ok(got) => {
            let wrong = got.iter().position(|x| !want(*x));
            assert!(wrong.is_none(), "{what}: particle {wrong:?} has {}", got[wrong.unwrap_or(0)]);
            true
        }
        Err(error @ Error::CutShort { .. }) if cuts => {
            names_the_law(&error);
            false
        }
        Err(error) => panic!("{what}: {error}"),
    }
}

#[test]
fn pairs_with_some_ten_turns_are_right_on_every_driver() {
    let shared = support::device();
    // As many sources, turns and targets as used to be cut on Mesa 22.
    for (count, n) in [(900_u32, 64), (1200, 40), (1200, 100)] {
        for over in [Over::Pairs, Over::Within { range: 100.0 }] {
            let said = law(&shared, over, count as usize, &meetings(PAIR), Some(n)).expect("it is cut into slices");
            #[expect(clippy::cast_precision_loss, reason = "a whole number below 2²⁴")]
            let want = ((count - 1) * n) as f32;
            assert!(said.iter().all(|x| *x == want), "{count}, {n}: {:?} is not {want}", &said[..3]);
        }
    }
}

#[test]
fn a_sum_that_a_driver_cuts_is_never_silent() {
    let shared = support::device();
    let cuts = cuts(&shared);
    let near = Over::Near { range: 100.0, of: None };
    let tree = Over::Tree { opening: Opening::Geometric { theta: 0.01 }, core: 0.0, auto: false };
    // Far above 65 535 iterations for one invocation; all of 1200 are evaluated, or seven.
    for (over, met, n) in [
        (Over::Pairs, 1199.0, 600),
        (near, 1199.0, 400),
        (Over::Nearest { count: 7 }, 7.0, 20_000),
        (tree, 1199.0, 400),
    ] {
        let said = law(&shared, over, 1200, &meetings(PAIR), Some(n));
        let turns = f64::from(n) * met;
        let right = |x: f32| f64::from(x) == turns;
        let whole = right_or_loud(&format!("{over:?}"), said, right, cuts);
        assert_eq!(whole, !cuts, "{over:?}");
    }
    let said = law(&shared, Over::Each, 3, EACH, Some(100_000));
    assert_eq!(right_or_loud("each", said, |x| x == 100_000.0, cuts), !cuts);
    // As many as Mesa 22 gives are taken.
    let said = law(&shared, Over::Each, 3, EACH, Some(60_000)).expect("few");
    assert!(said.iter().all(|x| *x == 60_000.0), "{said:?}");
}

/// A walk of a tree stops early enough for the loops of its law, and continues.
#[test]
fn a_walk_goes_on_that_leaves_turns_to_its_law() {
    let shared = support::device();
    let tree = Over::Tree { opening: Opening::Geometric { theta: 0.01 }, core: 0.0, auto: false };
    for n in [64_u16, 100] {
        let said = law(&shared, tree, 1200, &meetings(PAIR), Some(n.into())).expect("it goes on");
        assert!(said.iter().all(|x| *x == 1199.0 * f32::from(n)), "{n}: {:?}", &said[..3]);
    }
}

#[test]
fn what_is_tied_is_never_silent_either() {
    let shared = support::device();
    let cuts = cuts(&shared);
    let mut particles = State::default();
    for x in [0.0, 1.0, 2.0] {
        particles.push(DVec3::new(x, 0.1 * x * x, 0.0), DVec3::ZERO, 1.0, 0.1);
    }
    let spring = |i| Link { ends: [i, i + 1], rest: 1.0, stiffness: 1.0, damping: 0.0, rope: false };
    let springs = vec![spring(0), spring(1)];
    let joints = vec![Joint { ids: [0, 1, 2], stiffness: 1.0, rest: 0.0 }];
    particles.links = Links { springs, joints, triangles: vec![[0, 1, 2]], ..Links::default() };
    for (over, arguments) in [(Over::Links, LINK), (Over::Joints, CORNER), (Over::Triangles, CORNER)] {
        for (n, long) in [(20_000, false), (100_000, true)] {
            let force = Box::new(custom(over, &meetings(arguments), Some(n)));
            let said = accelerations(&shared, particles.clone(), force);
            let turns = f32::from(u16::try_from(n / 10).expect("few")) * 10.0;
            let right = |x: f32| x == turns || over == Over::Links && x == 2.0 * turns;
            assert_eq!(right_or_loud(&format!("{over:?}, {n}"), said, right, cuts), !(cuts && long), "{over:?}, {n}");
        }
    }
}

#[test]
fn a_loop_without_an_end_ends_the_run() {
    let shared = support::device();
    for body in
        ["loop { }", "while me.mass >= 0.0 { }", "var x = 1u; for (;;) { x = x * 3u + 1u; if x == 2u { break; } }"]
    {
        let each = format!("fn force(me: Particle) -> vec4f {{ {body} return vec4f(); }}");
        let pairs = format!(
            "fn turn(me: Particle) -> bool {{ {body} return true; }}
            fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {{ (*sum).potential += f32(turn(me)); }}
            fn finish(me: Particle, sum: Sum) -> vec4f {{ return vec4f(sum.potential); }}"
        );
        for (over, text) in [(Over::Each, each), (Over::Pairs, pairs)] {
            let begin = std::time::Instant::now();
            names_the_law(&law(&shared, over, 2000, &text, None).expect_err("it has no end"));
            assert!(begin.elapsed().as_secs() < 60, "{over:?}, {body}: after {:?}", begin.elapsed());
        }
    }
}

const TURNS: &str = include_str!("../../../shaders/own/turns.wgsl");

/// What looks at the turns, with so few that no driver cuts them: each 16 turns it looks round, and 64 are the most.
fn short() -> String {
    let text = TURNS.replace("0xffffu) == 0u", "0xfu) == 0u").replace("16777216u", "64u");
    assert_ne!(text, TURNS);
    text
}

/// What a law of so many iterations comes to, with this text in place of what looks at them: why it ends, if it does, and the
/// accelerations.
fn with(shared: &Shared, turns: &str, n: u32) -> (Option<String>, Vec<f32>) {
    let force = Changed { law: custom(Over::Each, EACH, Some(n)), turns: turns.to_owned() };
    let setup = setup(support::cloud(100, 3), Box::new(force));
    let simulation = Simulation::<Gpu>::new(&shared.found.device, &shared.found.queue, &setup);
    let mut simulation = match simulation {
        Ok(simulation) => simulation,
        Err(error) => return (Some(error.to_string()), Vec::new()),
    };
    simulation.step(1).expect("a step");
    let said = pollster::block_on(simulation.check()).err().map(|error| error.to_string());
    let got = pollster::block_on(simulation.read(ACCELERATION)).expect("accelerations");
    (said, got.iter().map(|a| a.x).collect())
}

#[test]
fn an_invocation_has_so_many_turns_and_no_more() {
    let shared = support::device();
    assert_eq!(with(&shared, &short(), 63), (None, vec![63.0; 100]));
    for n in [64, 65, 1000] {
        let (said, got) = with(&shared, &short(), n);
        let said = said.expect("above");
        assert!(said.starts_with("`l` (l.wgsl): its loops took 16777216 iterations"), "{n}: {said}");
        assert_eq!(got, vec![0.0; 100], "{n}: it goes on");
    }
}

const EQUIVALENT: &[Equivalent] = &[
    same("turns.wgsl", "own_turns & 0xfu", "0xfu", "0x10u", "it looks at other turns, and 64 is one of them"),
    same("turns.wgsl", "let wanted", "2u", "3u", "three turns are more than one, too"),
    same("turns.wgsl", "let wanted", "+", "-", "no mass has a sign"),
    same("turns.wgsl", "while turns", "<", "<=", "three turns are more than one, too"),
];

/// What looks at turns has no reference: every operator and number of it is changed once, and must be missed.
#[test]
fn every_mutant_of_what_looks_at_turns_is_noticed() {
    let shared = support::device();
    let cuts = cuts(&shared);
    let short = short();
    let at = |text: &str| text.find("// A loop of two turns").expect("the second part");
    let (clock, rest) = short.split_at(at(&short));
    let (before, end) = TURNS.split_at(at(TURNS));
    let few = |text: &str| [63, 64, 1000].map(|n| with(&shared, text, n));
    let many = |text: &str| [63, 100_000].map(|n| with(&shared, text, n));
    let right = (few(&short), many(TURNS));
    let mut ledger = Ledger::new(EQUIVALENT, &[]);
    for mutant in mutants(clock) {
        ledger.enter("turns.wgsl", &mutant, few(&format!("{}{rest}", mutant.text)) != right.0);
    }
    // Where no loop is cut short, nothing depends on what would say so.
    for mutant in mutants(end).iter().filter(|_| cuts) {
        ledger.enter("turns.wgsl", mutant, many(&format!("{before}{}", mutant.text)) != right.1);
    }
    assert_eq!((few(&short), many(TURNS)), right, "a mutant has broken the device");
    ledger.close(|equivalent| cuts || equivalent.line.contains("own_turns"), if cuts { 12 } else { 6 });
}
