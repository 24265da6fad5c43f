//! Errors of the library: setups that make no sense, and calls that a simulation refuses.

use std::fmt::Write as _;

use glam::{DVec3, Vec4};
use motes::forces::Component;
use motes::links::{Link, Links};
use motes::motion::{Held, Hold, Motion};
use motes::settings::{Settings, Value};
use motes::{Array, Bounds, Cpu, Error, Field, POSITION, Setup, Simulation, Solver, State};

use crate::golden;

const GOLDEN: &str = "tests/inputs/messages/library.txt";

fn two() -> State {
    let mut state = State::default();
    state.push(DVec3::ZERO, DVec3::ZERO, 1.0, 0.0);
    state.push(DVec3::X, DVec3::ZERO, 1.0, 0.0);
    state
}

fn gravity() -> Vec<Box<dyn Component>> {
    let entry = motes::forces::entry("gravity").expect("gravity");
    vec![(entry.build)(&Settings::defaults(entry.keys))]
}

/// A setup of two particles, changed.
fn changed(change: impl FnOnce(&mut Setup)) -> Option<Error> {
    let mut setup = Setup::new(two(), gravity(), 0.01);
    change(&mut setup);
    setup.check().err()
}

fn setups() -> Vec<(&'static str, Option<Error>)> {
    vec![
        ("no time step", changed(|setup| setup.dt = 0.0)),
        ("no particles", changed(|setup| setup.state = State::default())),
        ("a position that is not finite", changed(|setup| setup.state.position_mut()[1].x = f64::NAN)),
        ("a mass below zero", changed(|setup| setup.state.mass_mut()[1] = -1.0)),
        ("a solver without iterations", changed(|setup| setup.solver = Solver { iterations: 0, ..Solver::default() })),
        ("a tolerance of zero", changed(|setup| setup.solver = Solver { tolerance: 0.0, ..Solver::default() })),
        ("a box of one dimension", changed(|setup| setup.bounds = Bounds { dimensions: 1, ..Bounds::default() })),
        (
            "a fixed particle that is not there",
            changed(|setup| setup.state.held = vec![Held { id: 9, by: Hold::Fixed }]),
        ),
        ("a fixed particle twice", changed(|setup| setup.state.held = vec![Held { id: 1, by: Hold::Fixed }; 2])),
        ("a motion that is not there", changed(|setup| setup.state.held = vec![Held { id: 1, by: Hold::Motion(3) }])),
        (
            "a motion without keyframes",
            changed(|setup| {
                let motion =
                    Motion { name: "a".to_owned(), about: DVec3::ZERO, keys: Vec::new(), smooth: false, repeat: false };
                setup.state.motions = vec![motion];
            }),
        ),
        (
            "a spring to a particle that is not there",
            changed(|setup| {
                let spring = Link { ends: [0, 9], rest: 1.0, stiffness: 1.0, damping: 0.0, rope: false };
                setup.state.links = Links { springs: vec![spring], ..Links::default() };
            }),
        ),
    ]
}

fn calls() -> Vec<(&'static str, Option<Error>)> {
    let setup = Setup::new(two(), gravity(), 0.01);
    let mut simulation = Simulation::on(Cpu::new(2).expect("two"), &setup).expect("a simulation");
    vec![
        ("a force that is not there", simulation.set("gravty", "g", 2.0).err()),
        ("a setting that is not there", simulation.set("gravity", "h", 2.0).err()),
        ("a setting that is fixed", simulation.set("gravity", "over", Value::Text("tree".into())).err()),
        ("a setting of another kind", simulation.set("gravity", "g", DVec3::X).err()),
        ("a setting out of range", simulation.set("gravity", "softening", -1.0).err()),
        ("a field that is not there", simulation.write(Field::<Vec4>::new("positon"), &[Vec4::ONE]).err()),
        ("a field of another type", simulation.write(Field::<u32>::new("position"), &[1]).err()),
        ("more elements than a field has", simulation.write(POSITION, &[Vec4::ONE; 5]).err()),
        ("elements that are not finite", simulation.write(POSITION, &[Vec4::splat(f32::NAN)]).err()),
        ("the clock", simulation.write(Field::<u32>::new("world"), &[1]).err()),
        ("a column that is not there", pollster::block_on(simulation.read_column("heat")).err()),
        (
            "too few values of a column",
            pollster::block_on(simulation.write_column("mass", &Array::Float(vec![1.0]))).err(),
        ),
        ("a particle that is not there", pollster::block_on(simulation.remove(&[9])).err()),
        ("a particle twice", pollster::block_on(simulation.remove(&[1, 1])).err()),
        ("a stop with a fixed step", simulation.stop_at(1.0).err()),
        ("no particles on the host", Cpu::new(0).err()),
    ]
}

/// Errors of a run, with numbers as they may come.
fn of_runs() -> Vec<(&'static str, Option<Error>)> {
    let law = || "the law `swirl` (swirl.wgsl)".to_owned();
    let all = [
        Error::NotFinite { particle: 7, step: 12 },
        Error::Runaway { particle: 7, step: 512 },
        Error::TooShort {
            step: 12,
            wanted: 1.5e-7,
            least: 1e-6,
            reason: "acceleration",
            particle: "particle 7".to_owned(),
            remedy: motes::kernel::Reason::Acceleration.remedy(),
        },
        Error::TooShort {
            step: 43,
            wanted: 7.4e-8,
            least: 1e-7,
            reason: "error",
            particle: "all particles".to_owned(),
            remedy: motes::kernel::Reason::Error.remedy(),
        },
        Error::TooManyNeighbors { particle: 7 },
        Error::Outgrown { particle: 7, largest: 0.25 },
        Error::CutShort { law: law() },
        Error::Endless { law: law() },
        Error::ListFull { particle: 7, longest: 900, capacity: 512, reach: 1.2 },
        Error::Lost("the driver was reset".to_owned()),
        Error::OutOfMemory("a buffer of 2 GiB".to_owned()),
        Error::Timeout { what: "a batch of steps; choose another adapter, or fewer particles".to_owned(), seconds: 60 },
        Error::Threads("Resource temporarily unavailable".to_owned()),
        Error::Device("Buffer is destroyed".to_owned()),
        Error::NoAdapter(motes::gpu::NO_DRIVER.to_owned()),
        Error::Output { file: "out/energy.csv".into(), message: "no space left on device".to_owned() },
    ];
    all.into_iter().map(|error| ("of a run", Some(error))).collect()
}

#[test]
fn errors_of_the_library() {
    let mut text =
        "# What the library says of setups and calls that make no sense, and of runs that fail.\n\n".to_owned();
    for (title, error) in setups().into_iter().chain(calls()).chain(of_runs()) {
        let error = error.unwrap_or_else(|| panic!("{title}: no error"));
        let _ = writeln!(text, "{title}: {error}");
    }
    golden::matched(GOLDEN, &std::fs::read_to_string(GOLDEN).unwrap_or_default(), &text);
}
