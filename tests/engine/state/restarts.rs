//! A run that continues from a state of another one has the bits of a run that was never stopped: in memory and from files, of every
//! scene and by every integrator, on the device and by the references.

use std::path::Path;

use glam::{DVec3, Vec4};
use motes::formats::{Precision, csv, npz};
use motes::integrators::{INTEGRATORS, Precise};
use motes::kernel::{Backend, Columns, base};
use motes::motion::{Held, Hold};
use motes::scene::SCENES;
use motes::settings::Value;
use motes::{Cpu, Error, Gpu, POSITION, Setup, Simulation, State};
use pollster::block_on;

use crate::support::scenes::{setup, with};
use crate::support::states::{force, integrator, vector};
use crate::support::{self, Shared};

/// Enough for births, drains and breaking springs in small scenes, and no multiple of 16: an alarm is in the middle of its window.
const FIRST: u32 = 23;
const REST: u32 = 18;

/// All of a state, with as many digits as read back to the same bits.
fn bits(state: &State) -> String {
    format!("{state:?}")
}

/// Where two long texts differ first.
fn difference(got: &str, want: &str) -> String {
    let (got, want) = (got.as_bytes(), want.as_bytes());
    let same = got.iter().zip(want).take_while(|(a, b)| a == b).count();
    let quote = |end: usize| got[..end].iter().rposition(|byte| *byte == b'"').unwrap_or(0);
    let name = String::from_utf8_lossy(&got[quote(quote(same))..(quote(same) + 1).min(got.len())]).into_owned();
    let near =
        |text: &[u8]| String::from_utf8_lossy(&text[same.saturating_sub(60)..(same + 60).min(text.len())]).into_owned();
    format!(", near {name}:\n  got  {}\n  want {}", near(got), near(want))
}

fn on_device(shared: &Shared) -> impl Fn(&Setup) -> Result<Simulation<Gpu>, Error> {
    |setup| Simulation::new(&shared.found.device, &shared.found.queue, setup)
}

fn on_host(setup: &Setup) -> Result<Simulation<Cpu>, Error> {
    Simulation::on(Cpu::new(setup.check()?)?, setup)
}

/// The columns that a reader must know for a state.
fn columns(state: &State) -> Columns {
    let own = state.declared().filter(|column| base().iter().all(|base| base.name != column.name));
    Columns::with(own.cloned()).expect("columns")
}

/// A state as a scene's own continues from a file that holds it.
fn filed(scene: State, state: &State, precision: Precision) -> State {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("state.npz");
    npz::write_npz(std::fs::File::create(&path).expect("a file"), state, precision).expect("written");
    let mut own = scene;
    // What components declare and no file holds, a simulation knows anyway.
    state.declared().for_each(|column| own.declare(column).expect("the same columns"));
    own.go_on_from(&npz::read(&motes::formats::Input::disk(&path), &columns(state)).expect("read"))
        .expect("the same particles");
    own
}

/// Runs in one go, and in two from the file of a state.
pub(super) fn compare<B: Backend>(
    make: &dyn Fn() -> Setup,
    on: &dyn Fn(&Setup) -> Result<Simulation<B>, Error>,
    precision: Precision,
) -> Result<(), String> {
    let fail = |error: Error| error.to_string();
    // Two words of single precision need a file of double precision.
    let two_words = make().integrator.precision() != motes::kernel::Precision::Single;
    let precision = if two_words { Precision::Double } else { precision };
    let mut whole = on(&make()).map_err(fail)?;
    whole.step(FIRST).map_err(fail)?;
    let middle = block_on(whole.snapshot()).map_err(fail)?;
    whole.step(REST).map_err(fail)?;
    let want = bits(&block_on(whole.snapshot()).map_err(fail)?);
    if want == bits(&middle) {
        return Err("nothing happens".to_owned());
    }
    let state = filed(make().state, &middle, precision);
    if bits(&state) != bits(&middle) {
        return Err(format!("a file holds another state{}", difference(&bits(&state), &bits(&middle))));
    }
    let mut second = on(&Setup { state, ..make() }).map_err(fail)?;
    if !second.goes_on() || second.steps() != u64::from(FIRST) {
        return Err(format!("it does not go on; it is at step {}", second.steps()));
    }
    let measured = bits(&block_on(second.snapshot()).map_err(fail)?);
    if measured != bits(&middle) {
        return Err(format!("another state before the first step{}", difference(&measured, &bits(&middle))));
    }
    second.step(REST).map_err(fail)?;
    let got = bits(&block_on(second.snapshot()).map_err(fail)?);
    if got == want { Ok(()) } else { Err(format!("other bits{}", difference(&got, &want))) }
}

/// What scenes may say beside what they say.
const MORE: &[(&str, &[&str])] = &[
    ("dam_break_2d", &["force.1.spacing=0.1", "simulation.adaptive=true"]),
    (
        "dam_break_2d",
        &["force.1.spacing=0.1", "force.1.solver=dfsph", "force.1.alpha=0", "simulation.integrator=symplectic_euler"],
    ),
    ("plummer", &["particles.0.count=100", "force.0.over=tree", "force.0.alpha=0.01"]),
];

pub(super) fn every_scene<B: Backend>(on: &dyn Fn(&Setup) -> Result<Simulation<B>, Error>, precision: Precision) {
    let scenes = SCENES.iter().map(|scene| (scene.name, crate::support::small::smaller(scene.name)));
    let mut failures = Vec::new();
    for (name, sets) in scenes.chain(MORE.iter().copied()) {
        // A small periodic box has cells enough for its range with eight particles along each side.
        let sets = if name == "periodic_box" { &["particles.0.size=[8, 8, 8]"][..] } else { sets };
        if let Err(why) = compare(&|| setup(with(name, sets)), on, precision) {
            failures.push(format!("{name} {sets:?}: {why}"));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn every_scene_goes_on_with_the_same_bits_on_the_device() {
    let shared = support::device();
    every_scene(&on_device(&shared), Precision::Single);
}

#[test]
fn every_scene_goes_on_with_the_same_bits_by_the_references() {
    every_scene(&on_host, Precision::Double);
}

/// Pairs, air that depends on time and velocity, friction, and random numbers that are counted by steps.
pub(super) fn mixed(integrator: &str) -> Setup {
    Setup {
        state: support::cloud(60, 5),
        forces: vec![
            force("gravity", &[("softening", Value::Number(0.17))]),
            force(
                "wind",
                &[("velocity", vector(0.6, 0.2, -0.3)), ("gust", Value::Number(0.7)), ("rate", Value::Number(0.4))],
            ),
            force("drag", &[("linear", Value::Number(0.3)), ("quadratic", Value::Number(0.2))]),
            force("wander", &[]),
        ],
        integrator: self::integrator(integrator),
        dt: 0.013,
        bounds: motes::Bounds::default(),
        solver: motes::Solver::default(),
    }
}

#[test]
fn every_integrator_goes_on_with_the_same_bits() {
    let shared = support::device();
    let mut failures = Vec::new();
    for entry in INTEGRATORS {
        let device = compare(&|| mixed(entry.name), &on_device(&shared), Precision::Single);
        let host = compare(&|| mixed(entry.name), &on_host, Precision::Double);
        failures.extend([device, host].into_iter().filter_map(Result::err).map(|why| format!("{}: {why}", entry.name)));
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// The same forces, positions and velocities in two words, the last digits of which a sum in f64 lacks.
fn in_two_words(integrator: &str) -> Setup {
    let precision = motes::kernel::Precision::Compensated;
    Setup { integrator: Box::new(Precise { integrator: self::integrator(integrator), precision }), ..mixed(integrator) }
}

#[test]
fn two_words_go_on_with_the_same_bits() {
    let shared = support::device();
    for name in ["forward_euler", "symplectic_euler", "leapfrog", "forest_ruth", "pefrl"] {
        compare(&|| in_two_words(name), &on_device(&shared), Precision::Double)
            .unwrap_or_else(|why| panic!("{name}: {why}"));
        compare(&|| in_two_words(name), &on_host, Precision::Double).unwrap_or_else(|why| panic!("{name}: {why}"));
    }
}

#[test]
fn spawned_and_written_particles_have_low_words_of_their_own() {
    let shared = support::device();
    let setup = in_two_words("leapfrog");
    let mut simulation = on_device(&shared)(&setup).expect("a simulation");
    simulation.step(FIRST).expect("steps");
    // Numbers that single precision does not hold.
    let mut new = support::cloud(7, 3);
    new.links = motes::links::Links::default();
    let ids = block_on(simulation.spawn(&new)).expect("ids");
    let state = block_on(simulation.snapshot()).expect("a state");
    let first = ids[0] as usize;
    let two_words = |got: DVec3, want: DVec3| (got - want).abs().max_element() < 1e-14 * want.length();
    for (n, want) in new.position().iter().enumerate() {
        assert!(two_words(state.position()[first + n], *want), "{} is not {want}", state.position()[first + n]);
    }
    let places: Vec<DVec3> = state.position().iter().map(|x| *x * 1.1).collect();
    block_on(simulation.write_column("position", &motes::kernel::Array::Vec3(places.clone()))).expect("written");
    let state = block_on(simulation.snapshot()).expect("a state");
    assert!(state.position().iter().zip(&places).all(|(got, want)| two_words(*got, *want)));
    // Single precision brings no low words.
    let single: Vec<Vec4> = places.iter().map(|x| x.extend(1.0).as_vec4()).collect();
    simulation.write(POSITION, &single).expect("written");
    let state = block_on(simulation.snapshot()).expect("a state");
    assert!(state.position().iter().zip(&single).all(|(got, want)| *got == want.truncate().as_dvec3()));
}

/// The state of some steps.
fn advanced(setup: &Setup, steps: u32) -> State {
    let mut simulation = on_host(setup).expect("a simulation");
    simulation.step(steps).expect("steps");
    block_on(simulation.snapshot()).expect("a state")
}

/// A change of a state, and its name.
type Edit = (&'static str, fn(&mut State));

#[test]
fn what_a_step_kept_is_not_used_for_another_step_or_state() {
    let state = advanced(&mixed("leapfrog"), FIRST);
    let goes_on = |setup: &Setup| on_host(setup).expect("a simulation").goes_on();
    assert!(goes_on(&Setup { state: state.clone(), ..mixed("leapfrog") }));
    assert!(!goes_on(&Setup { state: state.clone(), ..mixed("rk4") }), "another integrator");
    let mut others = mixed("leapfrog");
    others.forces.truncate(2);
    assert!(!goes_on(&Setup { state: state.clone(), ..others }), "other forces");
    let edits: [Edit; 5] = [
        ("a place", |state| state.position_mut()[3].x += 0.1),
        ("a mass", |state| state.mass_mut()[3] *= 2.0),
        ("a spring", |state| state.links.springs[3].stiffness *= 2.0),
        ("the clock", |state| (state.step, state.time) = (2 * state.step, 2.0 * state.time)),
        ("another particle", |state| state.push(DVec3::ONE, DVec3::ZERO, 1.0, 0.0)),
    ];
    for (what, edit) in edits {
        let mut state = state.clone();
        edit(&mut state);
        assert!(!goes_on(&Setup { state, ..mixed("leapfrog") }), "{what} was changed");
    }
    // What has not continued begins with the accelerations of its own places: to nothing is everything drawn as before.
    let mut moved = state.clone();
    moved.position_mut().iter_mut().for_each(|x| *x *= 100.0);
    moved.velocity_mut().fill(DVec3::ZERO);
    let alone = |state| Setup { state, forces: vec![force("gravity", &[])], ..mixed("leapfrog") };
    let after = advanced(&alone(moved.clone()), 1);
    let anew = advanced(&alone(moved.begin_anew()), 1);
    assert_eq!(after.velocity(), anew.velocity());
    assert_eq!((after.step, anew.step), (u64::from(FIRST) + 1, 1));
}

#[test]
fn time_and_step_must_agree() {
    let mut state = advanced(&mixed("leapfrog"), FIRST);
    let refused = |state: &State, dt: f64| {
        let setup = Setup { state: state.clone(), dt, ..mixed("leapfrog") };
        on_host(&setup).err().map(|error| error.to_string()).unwrap_or_default()
    };
    assert_eq!(refused(&state, 0.013), "");
    assert!(refused(&state, 0.026).contains("step 23"), "{}", refused(&state, 0.026));
    assert_eq!(refused(&state.clone().begin_anew(), 0.026), "");
    state.step = u64::from(u32::MAX) + 1;
    assert!(refused(&state, 0.013).contains("4294967295"));
    (state.step, state.time) = (0, f64::NAN);
    assert!(refused(&state, 0.013).contains("time"));
}

/// One particle on a motion, one on a target, one that is fixed, and free ones.
fn led() -> Setup {
    let mut state = support::cloud(12, 3);
    state.links = motes::links::Links::default();
    let keys = [(0.0, 0.0), (0.2, 0.7), (0.5, -0.4)];
    let keys = keys.map(|(time, x)| motes::motion::Keyframe { time, shift: DVec3::X * x, ..Default::default() });
    state.motions = vec![motes::motion::Motion { keys: keys.to_vec(), ..Default::default() }];
    state.held =
        vec![Held { id: 7, by: Hold::Motion(0) }, Held { id: 2, by: Hold::Fixed }, Held { id: 4, by: Hold::Target }];
    Setup { state, ..mixed("leapfrog") }
}

#[test]
fn held_particles_keep_to_where_they_began() {
    let shared = support::device();
    compare(&led, &on_device(&shared), Precision::Single).expect("the device");
    compare(&led, &on_host, Precision::Double).expect("the references");
    // Under other forces too: where it began is no acceleration.
    let state = advanced(&led(), FIRST);
    let mut others = led();
    others.forces.truncate(1);
    let after = advanced(&Setup { state, ..others }, REST);
    let want = advanced(&led(), FIRST + REST);
    assert_eq!(after.position()[7], want.position()[7]);
}

/// Springs of which some break at once and some later, and a limit that counts how many springs an end had.
fn torn() -> Setup {
    let forces = vec![
        force("spring", &[]),
        force("strain_limit", &[("strain", Value::Number(1.5)), ("sweeps", Value::Number(1.0))]),
        force("tear", &[("strain", Value::Number(2.0))]),
    ];
    Setup { forces, ..mixed("symplectic_euler") }
}

#[test]
fn springs_that_broke_count_as_before() {
    let [first, middle] = [torn().state, advanced(&torn(), FIRST)].map(|state| state.links.springs.len());
    let last = advanced(&torn(), FIRST + REST).links.springs.len();
    assert!(last < middle && middle < first, "{first}, {middle} and {last} springs");
    let shared = support::device();
    compare(&torn, &on_device(&shared), Precision::Single).expect("the device");
    compare(&torn, &on_host, Precision::Double).expect("the references");
}

#[test]
fn a_caller_that_writes_between_is_not_overruled() {
    let run = |stop: bool| {
        let mut simulation = on_host(&mixed("leapfrog")).expect("a simulation");
        simulation.step(FIRST).expect("steps");
        simulation.write(POSITION, &[Vec4::new(0.1, 0.2, 0.3, 1.0)]).expect("written");
        if stop {
            let state = block_on(simulation.snapshot()).expect("a state");
            simulation = on_host(&Setup { state, ..mixed("leapfrog") }).expect("a simulation");
        }
        simulation.step(REST).expect("steps");
        block_on(simulation.snapshot()).expect("a state")
    };
    assert_eq!(bits(&run(true)), bits(&run(false)));
}

#[test]
fn a_table_goes_on_where_forces_depend_on_places_and_time() {
    let make = || Setup {
        forces: vec![force("gravity", &[("softening", Value::Number(0.17))]), force("attractor", &[])],
        ..mixed("leapfrog")
    };
    let mut whole = on_host(&make()).expect("a simulation");
    whole.step(FIRST).expect("steps");
    let middle = block_on(whole.snapshot()).expect("a state");
    whole.step(REST).expect("steps");
    let want = block_on(whole.snapshot()).expect("a state");
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("state.csv");
    csv::write_csv(std::fs::File::create(&path).expect("a file"), &middle, Precision::Double).expect("written");
    let read = |path: &Path| csv::read(&motes::formats::Input::disk(path), &Columns::default()).expect("read");
    let mut state = make().state;
    // A table holds no clock.
    let mut table = read(&path);
    (table.step, table.time) = (middle.step, middle.time);
    state.go_on_from(&table).expect("the same particles");
    let mut second = on_host(&Setup { state, ..make() }).expect("a simulation");
    assert!(!second.goes_on(), "a table does not hold all that a step keeps");
    second.step(REST).expect("steps");
    let got = block_on(second.snapshot()).expect("a state");
    // Accelerations that are evaluated again are those that the last step had: of the same places, at the same time.
    assert_eq!((got.position(), got.velocity(), got.step), (want.position(), want.velocity(), want.step));
}
