//! Tables of laws of one's own: each law has its own, whatever their names.

use std::sync::Arc;

use motes::forces::{Component, Custom, Over};
use motes::kernel::ACCELERATION;
use motes::scene::{Options, Scene, Source};
use motes::{Cpu, Setup, Simulation};

use crate::support::device;
use crate::support::scenes::setup;

const SCENE: &str = r#"
[simulation]
dt = 0.01
steps = 1
integrator = "forward_euler"
[[particles]]
bodies = [{ position = [0, 0, 0], mass = 1 }, { position = [1, 0, 0], mass = 1 }]
"#;
const LAW: &str = "
struct Pair { strength: f32 }
@group(3) @binding(1) var<storage, read> pair_table: array<Pair>;
fn energy(me: Particle, you: Particle, distance: f32, inverse: f32) -> Energy {
    let value = pair_table[pair_index(species[me.index], species[you.index])].strength * exp(-distance);
    return Energy(value, -value);
}";

/// A law of each of these files with a strength.
fn scene(laws: &[(&str, f64)]) -> Setup {
    let mut text = SCENE.to_owned();
    for (file, strength) in laws {
        let pairs = format!("[{{ species = [0, 0], strength = {strength:?} }}]");
        text.push_str(&format!("[[force]]\nwgsl = \"{file}\"\nover = \"pairs\"\npairs = {pairs}\n"));
    }
    let files = ["one.wgsl", "two.wgsl"].map(|name| (name.to_owned(), LAW.as_bytes().to_vec())).to_vec();
    let source = Source::Memory { name: "own".to_owned(), text, files };
    setup(Scene::load(&source, &[], &Options::default()).unwrap_or_else(|faults| panic!("{faults}")))
}

/// The acceleration of the first of two particles.
fn pull(laws: &[(&str, f64)]) -> f32 {
    let shared = device();
    let mut simulation =
        Simulation::new(&shared.found.device, &shared.found.queue, &scene(laws)).expect("a simulation");
    simulation.step(1).expect("a step");
    pollster::block_on(simulation.read(ACCELERATION)).expect("accelerations")[0].x
}

#[test]
fn laws_have_tables_of_their_own() {
    let unit = pull(&[("one.wgsl", 1.0)]);
    assert!((f64::from(unit) + (-1.0_f64).exp()).abs() < 1e-6, "{unit}");
    // Of two files, and twice of one.
    for files in [["one.wgsl", "two.wgsl"], ["one.wgsl", "one.wgsl"]] {
        let both = pull(&[(files[0], 1.0), (files[1], 64.0)]);
        assert!((both / unit - 65.0).abs() < 1e-3, "{files:?}: {both} of {unit}");
        let same = pull(&[(files[0], 3.0), (files[1], 3.0)]);
        assert!((same / unit - 6.0).abs() < 1e-3, "{files:?}: {same} of {unit}");
    }
    // The references have no law of one's own, and say so.
    assert!(Simulation::on(Cpu::new(2).expect("a backend"), &scene(&[("one.wgsl", 1.0)])).is_err());
}

/// The same energy A / r⁶ by the distance and by its square: U′ = −6 A / r⁷, at r = 1 and elsewhere, with its virial.
#[test]
fn energies_of_even_powers_need_no_root() {
    const BY_SQUARE: &str = "
fn even_energy(me: Particle, you: Particle, square: f32, inverse: f32) -> Energy {
    let value = 2.0 * inverse * inverse * inverse;
    return Energy(value, -6.0 * value * inverse);
}";
    const BY_DISTANCE: &str = "
fn energy(me: Particle, you: Particle, distance: f32, inverse: f32) -> Energy {
    let cube = inverse * inverse * inverse;
    return Energy(2.0 * cube * cube, -12.0 * cube * cube * inverse);
}";
    for distance in [0.7, 1.0, 1.6] {
        let values = [BY_SQUARE, BY_DISTANCE].map(|text| {
            let mut setup = scene(&[]);
            setup.state.position_mut()[1].x = distance;
            setup.forces = vec![Box::new(Custom::new("own", "own.wgsl", text, Over::Within { range: 2.0 }))];
            let shared = device();
            let mut simulation =
                Simulation::new(&shared.found.device, &shared.found.queue, &setup).expect("a simulation");
            simulation.step(0).expect("a start");
            let pull = pollster::block_on(simulation.read(ACCELERATION)).expect("accelerations");
            let virial = pollster::block_on(simulation.virial()).expect("a virial");
            [f64::from(pull[0].x), f64::from(pull[0].w), virial[0]]
        });
        let slope = 12.0 * distance.powi(-7);
        for [pull, energy, virial] in values {
            assert!((pull / -slope - 1.0).abs() < 1e-6, "{distance}: {pull}");
            assert!((energy / distance.powi(-6) - 1.0).abs() < 1e-6, "{distance}: {energy}");
            assert!((virial / (slope * distance) - 1.0).abs() < 1e-6, "{distance}: {virial}");
        }
    }
}

/// A law that pulls along x by the number in its table.
const DATA: &str = "
@group(3) @binding(1) var<storage, read> data: array<f32>;
fn force(me: Particle) -> vec4f { return vec4f(data[0], 0.0, 0.0, 0.0); }";

#[test]
fn data_is_of_one_force() {
    let force = |file: &str, value: f32| -> Box<dyn Component> {
        let tables = vec![("data".into(), Arc::new(vec![value.to_bits()]))];
        let name = file.trim_end_matches(".wgsl");
        Box::new(Custom { tables, ..Custom::new(name, file, DATA, Over::Each) })
    };
    let pull = |forces: Vec<Box<dyn Component>>| {
        let shared = device();
        let setup = Setup { forces, ..scene(&[]) };
        let mut simulation = Simulation::new(&shared.found.device, &shared.found.queue, &setup)?;
        simulation.step(1)?;
        Ok::<f32, motes::Error>(pollster::block_on(simulation.read(ACCELERATION))?[0].x)
    };
    assert_eq!(pull(vec![force("one.wgsl", 2.0), force("one.wgsl", 64.0)]).expect("two of a file"), 66.0);
    assert_eq!(pull(vec![force("one.wgsl", 2.0), force("two.wgsl", 2.0)]).expect("the same data"), 4.0);
    let refused = pull(vec![force("one.wgsl", 2.0), force("two.wgsl", 64.0)]).expect_err("one name").to_string();
    assert!(refused.contains("`one` and `two` fill the field `data` with different contents"), "{refused}");
}

/// The virial of two forces of one file with data of their own is the sum of theirs.
#[test]
fn the_virial_has_the_data_of_its_force() {
    const PAIR: &str = "
@group(3) @binding(1) var<storage, read> data: array<f32>;
fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) { (*sum).acceleration += data[0] * r; }
fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, sum.potential); }";
    let virial = |values: &[f32]| {
        let force = |value: &f32| -> Box<dyn Component> {
            let tables = vec![("data".into(), Arc::new(vec![value.to_bits()]))];
            Box::new(Custom { tables, ..Custom::new("pull", "pull.wgsl", PAIR, Over::Near { range: 2.0, of: None }) })
        };
        let (shared, setup) = (device(), Setup { forces: values.iter().map(force).collect(), ..scene(&[]) });
        let mut simulation = Simulation::new(&shared.found.device, &shared.found.queue, &setup).expect("a simulation");
        simulation.step(1).expect("a step");
        pollster::block_on(simulation.virial()).expect("a virial")[0]
    };
    let (one, two) = (virial(&[65.0]), virial(&[1.0, 64.0]));
    assert!(one.abs() > 1.0 && (two / one - 1.0).abs() < 1e-5, "{one} {two}");
}
