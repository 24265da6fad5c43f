//! Errors: in which place they are mended, and with their numbers. Nothing panics, nothing waits forever.

use std::time::{Duration, Instant};

use crate::support::Shared;
use crate::support::states::{force, integrator, one};
use glam::DVec3;
use motes::forces::{Component, Custom, Over};
use motes::kernel::{Backend, POSITION};
use motes::settings::Value;
use motes::{Cpu, Error, Gpu, Setup, Simulation, State};

fn setup(particles: State, forces: Vec<Box<dyn Component>>, dt: f64) -> Setup {
    Setup {
        state: particles,
        forces,
        integrator: integrator("leapfrog"),
        dt,
        bounds: motes::Bounds::default(),
        solver: motes::Solver::default(),
    }
}

fn on_gpu(shared: &Shared, setup: &Setup) -> Result<Simulation<Gpu>, Error> {
    Simulation::new(&shared.found.device, &shared.found.queue, setup)
}

fn on_cpu(setup: &Setup) -> Result<Simulation<Cpu>, Error> {
    Simulation::on(Cpu::new(u32::try_from(setup.state.len()).expect("few"))?, setup)
}

/// Both backends say the same of a setup that makes no sense.
fn refused(shared: &Shared, setup: &Setup, words: &[&str]) {
    let said = [on_gpu(shared, setup).map(|_| ()), on_cpu(setup).map(|_| ())];
    for result in said {
        let error = result.expect_err("this makes no sense");
        assert!(matches!(error, Error::Scene(_)), "{error:?}");
        assert_eq!(error.exit_code(), 3);
        for word in words {
            assert!(error.to_string().contains(word), "`{error}` does not say `{word}`");
        }
    }
}

#[test]
fn setups_that_make_no_sense() {
    let shared = crate::support::device();
    let good = || crate::support::cloud(5, 1);
    refused(&shared, &setup(State::default(), Vec::new(), 0.1), &["particles"]);
    for dt in [0.0, -0.1, f64::NAN, f64::INFINITY] {
        refused(&shared, &setup(good(), Vec::new(), dt), &["dt", &dt.to_string()]);
    }
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for place in 0..4 {
            let mut particles = good();
            match place {
                0 => particles.position_mut()[3].y = bad,
                1 => particles.velocity_mut()[3].z = bad,
                2 => particles.mass_mut()[3] = bad,
                _ => particles.size_mut()[3] = bad,
            }
            refused(&shared, &setup(particles, Vec::new(), 0.1), &["particle 3"]);
        }
    }
    let mut particles = good();
    particles.mass_mut()[4] = -1e-3;
    refused(&shared, &setup(particles, Vec::new(), 0.1), &["particle 4", "mass"]);
    assert!(matches!(Gpu::new(&shared.found.device, &shared.found.queue, 0), Err(Error::Scene(_))));
    // A test particle is fine where nothing is linked to it.
    let mut particles = good();
    particles.mass_mut()[4] = 0.0;
    refused(&shared, &setup(particles.clone(), Vec::new(), 0.1), &["connects particle 4, which has mass 0"]);
    particles.links = motes::links::Links::default();
    assert!(on_gpu(&shared, &setup(particles, Vec::new(), 0.1)).is_ok());
}

#[test]
fn more_particles_than_a_device_binds() {
    let shared = crate::support::device();
    let few = |limits: &mut motes::wgpu::Limits| limits.max_storage_buffer_binding_size = 4096;
    let (device, queue) = pollster::block_on(crate::support::limited(&shared, few));
    let simulate =
        |count| Simulation::new(&device, &queue, &setup(crate::support::cloud(count, 1), Vec::new(), 0.1)).map(|_| ());
    assert!(simulate(256).is_ok(), "256 of 16 bytes fit");
    match simulate(257) {
        Err(error @ Error::Limit(_)) => {
            let text = error.to_string();
            // Need, limit, and the largest count.
            for number in ["257", "4112 bytes", "4096 bytes", "at most 256"] {
                assert!(text.contains(number), "`{text}` does not say {number}");
            }
        }
        other => panic!("{other:?}"),
    }
}

const SWIRL: &str = "struct Params { strength: f32, center: vec3f }
@group(3) @binding(0) var<uniform> params: Params;

fn force(me: Particle) -> vec4f {
    let d = me.position - params.center;
    return vec4f(params.strength * vec3f(-d.y, d.x, 0.0), 0.0);
}
";

fn custom(over: Over, wgsl: &str, params: &[(&str, Value)]) -> Vec<Box<dyn Component>> {
    let params = params.iter().map(|(name, value)| ((*name).to_owned(), value.clone())).collect();
    vec![Box::new(Custom { params, ..Custom::new("swirl", "my/swirl.wgsl", wgsl, over) })]
}

fn good() -> [(&'static str, Value); 2] {
    [("strength", Value::Number(0.7)), ("center", Value::Vector(DVec3::new(0.1, 0.2, 0.3)))]
}

#[test]
fn a_users_shader_works() {
    let shared = crate::support::device();
    let particles = one(DVec3::new(1.1, 0.2, 0.3), DVec3::ZERO);
    let mut simulation =
        on_gpu(&shared, &setup(particles, custom(Over::Each, SWIRL, &good()), 0.5)).expect("a simulation");
    simulation.step(1).expect("a step");
    let velocity = pollster::block_on(simulation.read(motes::VELOCITY)).expect("velocities")[0];
    // d = (1, 0, 0): pushed 0.7 along y for half a step, then drifted, then pushed again from y = 0.0875 on.
    let want = glam::Vec3::new(-0.25 * 0.7 * 0.0875, 0.25 * 0.7 * 2.0, 0.0);
    assert!((velocity.truncate() - want).length() < 1e-6, "{velocity} is not {want}");
}

/// The name of a user's file has no effect: not even that of a verb, or of the clock.
#[test]
fn a_force_may_be_called_anything() {
    let shared = crate::support::device();
    let wgsl = "fn force(me: Particle) -> vec4f { return vec4f(1.0 + world.time, 0.0, 0.0, 0.0); }";
    for name in ["clear", "drift", "at", "attic", "tick", "watch", "each", "rk_save"] {
        let custom = Custom::new(name, &format!("{name}.wgsl"), wgsl, Over::Each);
        let mut setup = setup(one(DVec3::ZERO, DVec3::ZERO), vec![Box::new(custom)], 0.5);
        setup.integrator = integrator("rk4");
        let mut simulation = on_gpu(&shared, &setup).expect("a simulation");
        simulation.step(2).expect("steps");
        let velocity = pollster::block_on(simulation.read(motes::VELOCITY)).expect("velocities")[0];
        // ∫ 1 + t from 0 to 1, which Simpson's rule has exactly.
        assert!((velocity.x - 1.5).abs() < 1e-6, "{name}: {velocity} under {}", simulation.plan());
    }
}

#[test]
fn faults_of_a_users_shader_name_their_place() {
    let shared = crate::support::device();
    let complaint = |over, wgsl: &str, params: &[(&str, Value)]| {
        on_gpu(&shared, &setup(crate::support::cloud(3, 1), custom(over, wgsl, params), 0.1))
            .map(|_| ())
            .expect_err("refused")
    };
    let in_shader = |over, wgsl: &str, words: &[&str]| {
        let error = complaint(over, wgsl, &good());
        assert!(matches!(error, Error::Shader { .. }), "{error:?}");
        for word in words {
            assert!(error.to_string().contains(word), "`{error}` does not say `{word}`");
        }
    };
    let each = Over::Each;
    // A word forgotten, in line 5 of the user's file; a type, in line 6; a name, in line 5.
    in_shader(each, &SWIRL.replace("let d =", "let d"), &["my/swirl.wgsl:5:", "| ", "^"]);
    in_shader(each, &SWIRL.replace("vec3f(-d.y, d.x, 0.0)", "vec2f(d.x)"), &["my/swirl.wgsl:6:", "^"]);
    in_shader(each, &SWIRL.replace("params.center", "params.centre"), &["my/swirl.wgsl:5:", "^^^", "centre"]);
    in_shader(each, &SWIRL.replace("me.position", "you.position"), &["my/swirl.wgsl:5:", "^^^", "you"]);
    // The type of what the function returns is wrong: found by the validator, not the parser.
    in_shader(each, &SWIRL.replace(", 0.0);\n}", ", 0.0).xyz;\n}"), &["my/swirl.wgsl:"]);
    // In the line of the struct, where a word is put in: the column is that of the file, and so is what is shown.
    let twice = SWIRL.replace("center: vec3f", "center: vec3");
    in_shader(each, &twice, &["my/swirl.wgsl:1:40", "1 | struct Params { strength: f32, center: vec3 }\n", "^^^^"]);
    // No function, or only in a comment.
    in_shader(each, &SWIRL.replace("fn force", "fn push"), &["my/swirl.wgsl", "fn force(me: Particle) -> vec4f"]);
    in_shader(each, &SWIRL.replace("fn force", "// fn force(\nfn push"), &["my/swirl.wgsl", "fn force("]);
    in_shader(Over::Pairs, SWIRL, &["my/swirl.wgsl", "fn gather("]);

    let in_scene = |params: &[(&str, Value)], words: &[&str]| {
        let error = complaint(each, SWIRL, params);
        assert!(matches!(error, Error::Scene(_)), "{error:?}");
        for word in words {
            assert!(error.to_string().contains(word), "`{error}` does not say `{word}`");
        }
    };
    let [strength, center] = good();
    in_scene(std::slice::from_ref(&strength), &["swirl", "`center`"]);
    in_scene(
        &[strength.clone(), center.clone(), ("spin", Value::Number(2.0))],
        &["swirl", "`spin`", "`strength`", "`center`"],
    );
    in_scene(&[("strength", Value::Vector(DVec3::X)), center.clone()], &["swirl", "`strength`", "`f32`"]);
    in_scene(&[strength, ("center", Value::Number(0.1))], &["swirl", "`center`", "vec3"]);
    let error = complaint(each, "fn force(me: Particle) -> vec4f { return vec4f(); }", &good());
    assert!(error.to_string().contains("my/swirl.wgsl"), "{error}");
}

#[test]
fn the_references_cannot_run_a_users_shader() {
    let error = on_cpu(&setup(crate::support::cloud(3, 1), custom(Over::Each, SWIRL, &good()), 0.1))
        .map(|_| ())
        .expect_err("no reference");
    assert!(matches!(error, Error::Scene(_)), "{error:?}");
    for word in ["swirl", "reference", "GPU"] {
        assert!(error.to_string().contains(word), "`{error}` does not say `{word}`");
    }
}

fn not_finite<B: Backend>(simulation: &mut Simulation<B>, steps: u32) -> (u32, u64) {
    simulation.step(steps).expect("steps");
    match pollster::block_on(simulation.check()) {
        Err(Error::NotFinite { particle, step }) => {
            let snapshot = pollster::block_on(simulation.snapshot());
            assert!(matches!(snapshot, Err(Error::NotFinite { .. })), "a snapshot says so too: {snapshot:?}");
            (particle, step)
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn numbers_that_are_none_are_found_where_they_begin() {
    let shared = crate::support::device();
    // At one place, with no softening: 0 / 0 in the first kick, of both; the lower id is reported.
    let mut coincident = crate::support::cloud(100, 1);
    coincident.position_mut()[70] = coincident.position()[41];
    let together = setup(coincident, vec![force("gravity", &[])], 0.1);
    assert_eq!(not_finite(&mut on_gpu(&shared, &together).expect("a simulation"), 9), (41, 0));
    assert_eq!(not_finite(&mut on_cpu(&together).expect("a simulation"), 9), (41, 0));
    // A particle that is sent 1e38 in each step leaves f32 behind in the fourth, and on both backends the run ends there.
    let fast = |speed: f64| {
        let mut particles = crate::support::cloud(100, 1);
        particles.velocity_mut()[87] = DVec3::Y * speed;
        setup(particles, Vec::new(), 1.0)
    };
    assert_eq!(not_finite(&mut on_gpu(&shared, &fast(1e38)).expect("a simulation"), 9), (87, 3));
    assert_eq!(not_finite(&mut on_cpu(&fast(1e38)).expect("a simulation"), 9), (87, 3));
    // What no f32 can hold is refused on both, by the id of the particle.
    let refused = on_cpu(&fast(1e39)).map(|_| ()).expect_err("beyond single precision");
    assert!(refused.to_string().contains("particle 87"), "{refused}");
    // And where all is well nothing is said.
    let mut well = on_gpu(&shared, &fast(1e30)).expect("a simulation");
    well.step(9).expect("steps");
    pollster::block_on(well.check()).expect("all is well");
}

#[test]
fn a_device_that_is_gone_says_so() {
    let shared = crate::support::device();
    for asks in 0..3 {
        let (device, queue) = pollster::block_on(crate::support::limited(&shared, |_| ()));
        let setup =
            setup(crate::support::cloud(65, 1), vec![force("gravity", &[("softening", Value::Number(0.1))])], 0.1);
        let mut simulation = Simulation::new(&device, &queue, &setup).expect("a simulation");
        simulation.step(3).expect("steps");
        device.destroy();
        let begin = Instant::now();
        let said = match asks {
            0 => pollster::block_on(simulation.read(POSITION)).map(|_| ()),
            1 => simulation.step(5).and_then(|()| pollster::block_on(simulation.read(POSITION)).map(|_| ())),
            _ => pollster::block_on(simulation.snapshot()).map(|_| ()),
        };
        let error = said.expect_err("there is no device");
        assert!(matches!(error, Error::Lost(_)), "{asks}: {error:?}");
        assert_eq!(error.exit_code(), 7);
        assert!(begin.elapsed() < Duration::from_secs(10), "it waits for nothing");
    }
}

/// A shader that never ends is not tried here: some drivers cut it off, others take the whole machine with them. To the
/// waiting side it is the same as a batch that takes longer than one is ready to wait.
#[test]
fn a_device_that_takes_too_long_says_so() {
    let shared = crate::support::device();
    let setup =
        setup(crate::support::cloud(8192, 1), vec![force("gravity", &[("softening", Value::Number(0.1))])], 0.1);
    let mut simulation = on_gpu(&shared, &setup).expect("a simulation");
    simulation.backend().limit_submissions(Duration::from_millis(80), Duration::ZERO);
    // So many that they are not done before this thread, which others may keep waiting, asks for the first time.
    let said = simulation.step(8).and_then(|()| pollster::block_on(simulation.read(POSITION)).map(|_| ()));
    match said {
        Err(error @ Error::Timeout { seconds: 0, .. }) => assert_eq!(error.exit_code(), 7),
        other => panic!("an instant is not enough for 8 times 67 million meetings: {other:?}"),
    }
    // It was only slow, and is still there.
    simulation.backend().limit_submissions(Duration::from_millis(80), Duration::from_mins(1));
    assert_eq!(pollster::block_on(simulation.read(POSITION)).expect("positions").len(), 8192);
    pollster::block_on(simulation.check()).expect("all is well");
}
