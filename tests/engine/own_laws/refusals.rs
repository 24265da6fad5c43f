//! What a law must not do, and what no driver should be asked for: each is an error in words, and none a panic.

use std::time::{Duration, Instant};

use motes::forces::{Component, Custom, Over};
use motes::settings::Value;
use motes::{Bounds, Error, Gpu, Setup, Simulation, Solver};

use crate::support::states::integrator;
use crate::support::{self, Shared};

fn made(
    shared: &Shared,
    over: Over,
    wgsl: &str,
    params: &[(&str, Value)],
    (method, count): (&str, usize),
) -> Result<Simulation<Gpu>, Error> {
    let params = params.iter().map(|(name, value)| ((*name).to_owned(), value.clone())).collect();
    let law = Custom { params, ..Custom::new("l", "l.wgsl", wgsl, over) };
    let forces: Vec<Box<dyn Component>> = vec![Box::new(law)];
    let (particles, integrator) = (support::cloud(count, 5), integrator(method));
    let setup =
        Setup { state: particles, forces, integrator, dt: 1e-3, bounds: Bounds::default(), solver: Solver::default() };
    let mut simulation = Simulation::new(&shared.found.device, &shared.found.queue, &setup)?;
    simulation.step(1)?;
    pollster::block_on(simulation.check())?;
    Ok(simulation)
}

/// How long this thread has worked, where the system says so.
fn busy() -> Option<Duration> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split_whitespace().next()?.parse().ok().map(Duration::from_nanos)
}

fn refused(over: Over, wgsl: &str, words: &[&str]) {
    let shared = support::device();
    let (begin, busy) = (Instant::now(), busy());
    let error = made(&shared, over, wgsl, &[], ("leapfrog", 40)).map(|_| ()).expect_err(wgsl);
    let worked = self::busy().zip(busy).map_or_else(|| begin.elapsed(), |(now, then)| now.saturating_sub(then));
    assert!(matches!(error, Error::Shader { .. }), "{wgsl}: {error:?}");
    assert_eq!(error.exit_code(), 3);
    for word in words.iter().chain(&["l.wgsl"]) {
        assert!(error.to_string().contains(word), "`{error}` does not say `{word}`");
    }
    // A driver would work for minutes on what is refused here for its size; the longest law takes 3 s to read, and ten times as long on
    // a processor that others use. The time that passed is limited more loosely, since other tests run beside this one.
    let law: String = wgsl.chars().take(200).collect();
    assert!(worked < Duration::from_secs(30), "after {worked:?} of work: {law}");
    assert!(begin.elapsed() < Duration::from_mins(2), "after {:?}: {law}", begin.elapsed());
}

fn runs(over: Over, wgsl: &str, params: &[(&str, Value)], count: usize) {
    let shared = support::device();
    if let Err(error) = made(&shared, over, wgsl, params, ("leapfrog", count)) {
        panic!("{wgsl}: {error}");
    }
}

/// A law of each alone with something before it, and something in it.
fn each(before: &str, inside: &str) -> String {
    format!("{before}\nfn force(me: Particle) -> vec4f {{ {inside} }}")
}

const GATHER: &str =
    "fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) { (*sum).acceleration += r; }";
const FINISH: &str = "fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, 0.0); }";

#[test]
fn bindings_in_places_that_are_not_a_laws() {
    for (place, words) in [
        ("@group(9) @binding(0)", "group 9"),
        ("@group(4) @binding(0)", "group 4"),
        ("@group(1) @binding(7)", "group 1"),
        ("@group(3) @binding(1000)", "binding 1000"),
    ] {
        let own = format!("{place} var<storage, read_write> mine: array<vec4f>;");
        refused(
            Over::Each,
            &each(&own, "mine[me.index].x += 1.0; return vec4f();"),
            &["`mine`", words, "group 3", "1:"],
        );
    }
    let block = "struct B { x: f32 } @group(3) @binding(1) var<uniform> block: B;";
    refused(Over::Each, &each(block, "return vec4f(block.x);"), &["`block`", "`params`"]);
    let image = "@group(3) @binding(1) var image: texture_2d<f32>;";
    refused(Over::Each, &each(image, "return textureLoad(image, vec2u(), 0);"), &["`image`"]);
    // Its own memory is its own.
    let own = "@group(3) @binding(7) var<storage, read_write> mine: array<vec4f>;";
    runs(Over::Each, &each(own, "mine[me.index].x += 1.0; return mine[me.index];"), &[], 40);
}

#[test]
fn what_motes_writes_is_not_a_laws() {
    let alarm = "@group(3) @binding(5) var<storage, read_write> alarm: array<atomic<u32>>;";
    refused(
        Over::Each,
        &each(alarm, "atomicStore(&alarm[0], 3u); return vec4f();"),
        &["`alarm` is a buffer that only motes writes"],
    );
    for (over, inside) in [
        (Over::Pairs, "acceleration[you.index] = vec4f();"),
        (Over::Pairs, "parts[0] = Sum();"),
        (Over::Near { range: 0.5, of: None }, "atomicStore(&alarm[2], 3u);"),
    ] {
        let gather = GATHER.replace("(*sum).acceleration += r;", inside);
        refused(over, &format!("{gather}\n{FINISH}"), &["is a buffer that only motes writes", "l.wgsl:1:"]);
    }
    refused(
        Over::Each,
        &each("", "acceleration[0] = vec4f(); return vec4f();"),
        &["`acceleration` is a buffer that only motes writes"],
    );
    // What a plan of motes has beside: in every measurement, or under one integrator.
    let own = |name: &str| {
        let own = format!("@group(3) @binding(5) var<storage, read_write> {name}: array<vec4f>;");
        each(&own, &format!("{name}[me.index].x += 1.0; return vec4f();"))
    };
    refused(Over::Each, &own("kept_acceleration"), &["`kept_acceleration` is a buffer that only motes writes"]);
    let shared = support::device();
    let by = |method| made(&shared, Over::Each, &own("start_position"), &[], (method, 40)).map(|_| ());
    assert!(by("leapfrog").is_ok(), "it is the law's own there");
    let said = by("rk4").expect_err("it is the method's").to_string();
    assert!(said.contains("l.wgsl: `start_position` is a buffer that only motes writes"), "{said}");
}

#[test]
fn waiting_for_others() {
    for (inside, what) in [
        ("workgroupBarrier();", "barrier"),
        ("if me.index > 3u { storageBarrier(); }", "barrier"),
        ("for (var i = 0u; i < 3u; i++) { workgroupBarrier(); }", "barrier"),
        ("switch me.index { case 0u: { workgroupBarrier(); } default: { } }", "barrier"),
        ("let x = subgroupAdd(1u);", "subgroup operation"),
    ] {
        refused(Over::Each, &each("", &format!("{inside} return vec4f();")), &[what, "l.wgsl:2:"]);
        let gather = GATHER.replace("(*sum)", &format!("{inside} (*sum)"));
        refused(Over::Pairs, &format!("{gather}\n{FINISH}"), &[what, "l.wgsl:1:"]);
    }
    let shared = "var<workgroup> x: u32;";
    refused(Over::Each, &each(shared, "return vec4f(f32(workgroupUniformLoad(&x)));"), &["barrier"]);
    let entry = "@compute @workgroup_size(1) fn mine() { }";
    refused(Over::Each, &each(entry, "return vec4f();"), &["entry point"]);
}

/// What takes lavapipe more than 12 s and up to 3.9 GB to compile is refused before, with the number.
#[test]
fn what_is_too_large_to_compile() {
    for (size, bytes) in [(262_144, "1048576"), (16_000_000, "64000000"), (268_000_000, "1072000000")] {
        let private = format!("var<private> a: array<f32, {size}>;");
        refused(
            Over::Each,
            &each(&private, "a[me.index] = 1.0; return vec4f(a[0]);"),
            &[bytes, "4096", "storage buffer"],
        );
    }
    for size in [65_536, 4_000_000] {
        let local = format!("var a: array<vec4f, {size}>; a[me.index].x = 1.0; return a[0];");
        refused(Over::Each, &each("", &local), &[&(16 * size).to_string(), "4096"]);
    }
    let constant = "const a = array<f32, 1000000>();";
    refused(Over::Each, &each(constant, "return vec4f(a[me.index]);"), &["4000000", "4096"]);
    let sum = "struct Sum { a: array<vec4f, 100000> }
        fn merge(total: ptr<function, Sum>, part: Sum) { (*total).a[0] += part.a[0]; }";
    let gather = GATHER.replace("(*sum).acceleration += r;", "(*sum).a[0] += vec4f(r, 0.0);");
    let finish = FINISH.replace("vec4f(sum.acceleration, 0.0)", "sum.a[0]");
    refused(Over::Pairs, &format!("{sum}\n{gather}\n{finish}"), &["1600000"]);
    let value = "return array<vec4f, 65536>()[me.index];";
    refused(Over::Each, &each("", value), &["1048576"]);
    let mut calls = "fn f0(x: f32) -> f32 { return x * 1.5; }\n".to_owned();
    for n in 1..28 {
        calls += &format!("fn f{n}(x: f32) -> f32 {{ return f{}(x) + f{}(x + 1.0); }}\n", n - 1, n - 1);
    }
    refused(Over::Each, &each(&calls, "return vec4f(f27(me.mass));"), &["operations long", "100000"]);
    // Ordinary sizes are let through.
    runs(Over::Each, &each("var<private> a: array<f32, 64>;", "a[me.index % 64u] = 1.0; return vec4f(a[0]);"), &[], 40);
}

/// Compilers go down into a text by recursion: these ended the process with exit 134.
#[test]
fn what_is_too_deep_to_compile() {
    let chain = |n: usize| each("", &format!("let x = me.mass{}; return vec4f(x);", " + me.mass".repeat(n)));
    let swizzles = |n: usize| each("", &format!("return vec4f(me.position{}, 0.0);", ".xyz".repeat(n)));
    let signs = |n: usize| each("", &format!("let b = {}(me.mass > 1.0); return vec4f(f32(b));", "!".repeat(n)));
    let elses = |n: usize| {
        let more = " else if me.mass > 1.0 { x = 2.0; }".repeat(n);
        each("", &format!("var x = 0.0; if me.mass > 0.0 {{ x = 1.0; }}{more} return vec4f(x);"))
    };
    let constants = |n: usize| {
        let one = |k: usize| format!("const c_{k}_ = c_{}_ + 1.0;\n", k + 1);
        let all: String = (0..n).map(one).collect();
        each(&format!("{all}const c_{n}_ = 1.0;"), "return vec4f(c_0_);")
    };
    let functions = |n: usize| {
        let one = |k: usize| format!("fn f_{k}_(x: f32) -> f32 {{ return f_{}_(x) + 1.0; }}\n", k + 1);
        let all: String = (0..n).map(one).collect();
        each(&format!("{all}fn f_{n}_(x: f32) -> f32 {{ return x; }}"), "return vec4f(f_0_(me.mass));")
    };
    for (text, words) in [
        (chain(9000), "tokens deep"),
        (swizzles(150_000), "tokens deep"),
        (signs(100_000), "tokens deep"),
        (elses(20_000), "branches `else`"),
        (constants(20_000), "functions, constants and types"),
        (functions(10_000), "functions, constants and types"),
    ] {
        refused(Over::Each, &text, &[words, "l.wgsl:"]);
    }
    // What is let through compiles, also on the small stack of this thread.
    for text in [chain(220), swizzles(480), signs(480), elses(200), constants(998), functions(300)] {
        runs(Over::Each, &text, &[], 40);
    }
    // Brackets, blocks and types are counted by the front end.
    let deep = |open: &str, close: &str| format!("{}x{}", open.repeat(50_000), close.repeat(50_000));
    for inside in [deep("(", ")"), deep("f32(", ")"), deep("{", "}"), deep("a[", "]")] {
        refused(Over::Each, &each("", &format!("{inside}; return vec4f();")), &[]);
    }
}

#[test]
fn what_no_workgroup_holds() {
    let shared = support::device();
    for size in ["1000000", "4097", "2147483647"] {
        let own = format!("var<workgroup> w: array<f32, {size}>;");
        let text = each(&own, "w[me.index % 4000u] = 1.0; return vec4f(w[0]);");
        let error = made(&shared, Over::Each, &text, &[], ("leapfrog", 40)).map(|_| ()).expect_err("too large");
        let said = error.to_string();
        assert!(matches!(error, Error::Limit(_) | Error::Shader { .. }), "{error:?}");
        let counted = said.contains("l.wgsl") && said.contains("workgroup memory");
        assert!(counted || size.len() == 10 && said.contains("exceeds limit of 2147483647 bytes"), "{said}");
    }
    // `refused` asks for it again.
    drop(shared);
    // Code that is written out, and a switch of many cases.
    let step = |k: u32| format!("x = sin(x + {k}.5 * me.mass);\n");
    let steps: String = (0..12_000).map(step).collect();
    let case = |k: u32| format!("case {k}u: {{ x = sin({k}.5 * me.mass); }}\n");
    let cases: String = (0..15_000).map(case).collect();
    let switch = format!("switch me.index {{ {cases} default: {{ }} }}");
    for inside in [steps, switch] {
        refused(
            Over::Each,
            &each("", &format!("var x = 0.0; {inside} return vec4f(x);")),
            &["operations long", "100000"],
        );
    }
}

#[test]
fn directives_come_before_all_that_motes_says() {
    let diagnostic = "// about\ndiagnostic(off, derivative_uniformity);\nrequires pointer_composite_access;";
    runs(Over::Each, &each(diagnostic, "return vec4f();"), &[], 40);
    refused(Over::Each, &each(diagnostic, "return vec4f(nothing);"), &["l.wgsl:4:", "nothing", "^^^^^^^"]);
    refused(Over::Each, &each("enable f16;", "return vec4f(f32(1.0h));"), &["enable f16", "optional"]);
    refused(Over::Each, &each("requires nothing_such;", "return vec4f();"), &["l.wgsl:1:", "nothing_such"]);
}

#[test]
fn a_comment_defines_nothing() {
    let text = format!("/* struct Sum {{ }} /* fn acts_on( */ */\n{GATHER}\n{FINISH}");
    for over in [Over::Pairs, Over::Near { range: 0.5, of: None }] {
        runs(over, &text, &[], 40);
    }
    refused(Over::Pairs, &format!("/* {GATHER} */ {FINISH}"), &["fn gather("]);
}

#[test]
fn a_function_of_other_arguments_is_shown_where_it_stands() {
    let force = "fn force(me: Particle) -> vec4f";
    refused(Over::Each, "\nfn force(me: vec3f) -> vec4f { return vec4f(); }", &["l.wgsl:2:4", force]);
    refused(Over::Each, "fn force(me: Particle) -> vec3f { return vec3f(); }", &["l.wgsl:1:4", force]);
    let two = "fn finish(me: Particle, sum: Sum) -> vec4f";
    refused(Over::Pairs, &format!("{GATHER}\n{}", FINISH.replace(", sum: Sum", "")), &["l.wgsl:2:4", two]);
    let acts = "fn acts_on(me: u32) -> bool { return true; }";
    refused(Over::Pairs, &format!("{GATHER}\n{FINISH}\n{acts}"), &["l.wgsl:3:4", "fn acts_on(me: Particle) -> bool"]);
    let gather = GATHER.replace("Particle", "P").replace("vec3f", "vec3<f32>");
    runs(Over::Pairs, &format!("alias P = Particle;\n{gather}\n{FINISH}"), &[], 40);
}

/// Few particles are cut into layers, and finished by a shader of its own.
#[test]
fn parameters_that_only_gather_reads() {
    let params = "struct Params { n: f32 }\n@group(3) @binding(0) var<uniform> params: Params;";
    let text = format!("{params}\n{}\n{FINISH}", GATHER.replace("+= r", "+= params.n * r"));
    let [n, other] = [("n", Value::Number(1.0)), ("m", Value::Number(1.0))];
    for count in [2, 40, 300, 600, 3000] {
        runs(Over::Pairs, &text, std::slice::from_ref(&n), count);
    }
    let shared = support::device();
    let unused = format!("{GATHER}\n{FINISH}");
    for (text, given) in [(&unused, n), (&text, other)] {
        let error = made(&shared, Over::Pairs, text, &[given], ("leapfrog", 300)).map(|_| ()).expect_err("no use");
        assert!(matches!(error, Error::Scene(_)), "{error:?}");
    }
}

#[test]
fn whole_numbers_are_called_what_they_are() {
    let shared = support::device();
    let text = |kind: &str| {
        let params = format!("struct Params {{ n: {kind} }} @group(3) @binding(0) var<uniform> params: Params;");
        each(&params, "return vec4f(f32(params.n), 0.0, 0.0, 0.0);")
    };
    let with = |kind: &str, n: f64| made(&shared, Over::Each, &text(kind), &[("n", Value::Number(n))], ("leapfrog", 3));
    for (kind, n, fits) in [
        ("i32", 2.5, false),
        ("i32", 2_147_483_648.0, false),
        ("i32", -2_147_483_649.0, false),
        ("u32", -1.0, false),
        ("i32", -7.0, true),
        ("i32", 2_147_483_647.0, true),
        ("u32", 4_294_967_295.0, true),
    ] {
        match with(kind, n) {
            Ok(mut simulation) => {
                assert!(fits, "{kind} holds no {n}");
                let got = pollster::block_on(simulation.read(motes::ACCELERATION)).expect("accelerations")[0];
                #[expect(clippy::cast_possible_truncation, reason = "as the device rounds it")]
                let want = n as f32;
                assert!((got.x / want - 1.0).abs() < 1e-6, "{kind}, {n}: {got}");
            }
            Err(error) => {
                assert!(!fits && error.to_string().contains(&format!("`{kind}`")), "{kind}, {n}: {error}");
            }
        }
    }
}

#[test]
fn one_element_that_no_device_binds() {
    let shared = support::device();
    // WGSL has no type of 4 GiB, which some devices bind.
    let limits = shared.found.device.limits();
    let bindable = limits.max_buffer_size.min(limits.max_storage_buffer_binding_size);
    assert!(bindable < (1 << 32) - 16, "a device that binds {bindable} bytes binds one of whatever there is");
    let own =
        format!("@group(3) @binding(1) var<storage, read_write> mine: array<array<vec4f, {}>>;", bindable / 16 + 1);
    let text = each(&own, "mine[me.index][0].x += 1.0; return vec4f();");
    let error = made(&shared, Over::Each, &text, &[], ("leapfrog", 40)).map(|_| ()).expect_err("too large");
    let said = error.to_string();
    assert!(matches!(error, Error::Limit(_)), "{error:?}");
    assert!(said.contains("`mine`") && said.contains("not even one") && !said.contains("at most 0"), "{said}");
}

/// A driver that takes longer than one is ready to wait is waited for no more; what it compiled is no loss.
#[test]
fn a_driver_that_compiles_for_ever() {
    let shared = support::device();
    let law = Custom::new("l", "l.wgsl", &each("", "return vec4f(sin(me.mass) * 0.7193);"), Over::Each);
    let setup = Setup {
        state: support::cloud(40, 5),
        forces: vec![Box::new(law)],
        integrator: integrator("leapfrog"),
        dt: 1e-3,
        bounds: Bounds::default(),
        solver: Solver::default(),
    };
    let patient = |patience: Duration| {
        let mut gpu = Gpu::new(&shared.found.device, &shared.found.queue, 40).expect("a GPU");
        gpu.limit_submissions(Duration::from_millis(80), patience);
        Simulation::on(gpu, &setup).map(|_| ())
    };
    match patient(Duration::ZERO) {
        Err(error @ Error::Timeout { .. }) => {
            assert!(error.to_string().contains("the driver compiles l.wgsl"), "{error}");
            assert_eq!(error.exit_code(), 7);
        }
        other => panic!("an instant is not enough: {other:?}"),
    }
    patient(Duration::from_mins(1)).expect("it was only slow");
}

/// Where the driver still compiles when the wait is over, the process ends with the reason, and does not wait for the driver.
#[test]
fn a_process_ends_while_a_driver_compiles() {
    const ITSELF: &str = "MOTES_TEST_COMPILES";
    if std::env::var_os(ITSELF).is_none() {
        let name = "own_laws::refusals::a_process_ends_while_a_driver_compiles";
        let begun = Instant::now();
        let mut command = std::process::Command::new(std::env::current_exe().expect("this program"));
        let output = command.args([name, "--exact", "--nocapture"]).env(ITSELF, "1").output().expect("it starts");
        let said = [output.stdout, output.stderr].concat();
        let said = String::from_utf8_lossy(&said);
        // NVIDIA's own handlers of an exit crash while it compiles; the command leaves them out.
        let crashed = output.status.code().is_none() && !support::is_software(&support::device());
        assert!(output.status.code() == Some(7) || crashed, "{:?}: {said}", output.status);
        assert!(said.contains("the driver compiles l.wgsl") && said.contains("compiled faster"), "{said}");
        // lavapipe takes minutes for the law.
        assert!(begun.elapsed() < Duration::from_mins(1), "{:?}", begun.elapsed());
        return;
    }
    let shared = support::device();
    let step = |k: u32| format!("x = sin(x + {k}.5 * me.mass);\n");
    let steps: String = (0..9000).map(step).collect();
    let law = Custom::new("l", "l.wgsl", &each("", &format!("var x = 0.0; {steps} return vec4f(x);")), Over::Each);
    let setup = Setup {
        state: support::cloud(40, 5),
        forces: vec![Box::new(law)],
        integrator: integrator("leapfrog"),
        dt: 1e-3,
        bounds: Bounds::default(),
        solver: Solver::default(),
    };
    let mut gpu = Gpu::new(&shared.found.device, &shared.found.queue, 40).expect("a GPU");
    gpu.limit_submissions(Duration::from_millis(80), Duration::from_millis(1));
    let error = Simulation::on(gpu, &setup).map(|_| ()).expect_err("a millisecond is not enough");
    println!("{error}");
    std::process::exit(error.exit_code().into());
}
