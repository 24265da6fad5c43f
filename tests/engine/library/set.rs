//! Settings change between steps as if a setup had had them, nothing is compiled, and what makes no sense changes nothing.

use glam::{DVec3, Vec4};
use motes::forces::{Change, Component, Custom, Over};
use motes::kernel::{Array, Backend, Column, Field, Kind, POSITION, VELOCITY};
use motes::links::Links;
use motes::motion::{Held, Hold, Keyframe, Motion};
use motes::settings::Value;
use motes::{Cpu, Error, Gpu, Setup, Simulation};

use super::{on_gpu, setup};
use crate::support::states::force;
use crate::support::{cloud, device};

/// A force with some settings, what changes of it, and to what.
struct Case {
    name: &'static str,
    settings: Vec<(&'static str, Value)>,
    key: &'static str,
    to: Value,
}

fn cases() -> Vec<Case> {
    let case = |name, settings: &[(&'static str, Value)], key, to| Case { name, settings: settings.to_vec(), key, to };
    vec![
        case("gravity", &[("softening", 0.17.into())], "softening", 0.43.into()),
        case("gravity", &[("over", "tree".into()), ("softening", 0.17.into())], "g", 0.3.into()),
        case("wind", &[], "velocity", DVec3::new(0.3, -0.7, 0.2).into()),
        case("obstacle", &[("look_ahead", 0.9.into())], "position", DVec3::new(0.4, 0.1, -0.2).into()),
        case("solid", &[("radius", 0.3.into())], "position", DVec3::new(0.2, -0.3, 0.1).into()),
        case("boids", &[("range", 0.7.into())], "max_speed", 0.6.into()),
        case("uniform", &[], "acceleration", DVec3::new(0.1, 0.2, -0.3).into()),
    ]
}

/// Particles without links.
fn free(count: usize) -> motes::State {
    let mut state = cloud(count, 5);
    state.links = Links::default();
    state
}

/// Bits of positions and velocities.
async fn bits<B: Backend>(simulation: &mut Simulation<B>) -> Vec<[u32; 8]> {
    let x: Vec<Vec4> = simulation.read(POSITION).await.expect("positions");
    let v: Vec<Vec4> = simulation.read(VELOCITY).await.expect("velocities");
    let four = |v: &Vec4| v.to_array().map(f32::to_bits);
    let both = |(x, v): (&Vec4, &Vec4)| -> [u32; 8] { std::array::from_fn(|n| [four(x), four(v)].concat()[n]) };
    x.iter().zip(&v).map(both).collect()
}

/// Steps, sets, steps: and the same with a second simulation of the changed setup in place of the change.
async fn changed<B: Backend>(make: impl Fn(&Setup) -> Simulation<B>, case: &Case) {
    let (name, key, to) = (case.name, case.key, &case.to);
    let before = setup(free(200), vec![force(name, &case.settings)]);
    let mut one = make(&before);
    one.step(3).expect("steps");
    let state = one.snapshot().await.expect("a state");
    one.set(name, key, to.clone()).unwrap_or_else(|why| panic!("{name} {key}: {why}"));
    one.step(4).expect("steps");
    let with = case.settings.iter().filter(|(known, _)| *known != key).cloned().chain([(key, to.clone())]);
    let settings: Vec<_> = with.collect();
    let mut other = make(&Setup { forces: vec![force(name, &settings)], ..before.with_state(state.clone()) });
    other.step(4).expect("steps");
    let (one, other) = (bits(&mut one).await, bits(&mut other).await);
    assert_eq!(one, other, "{name} {key}");
    let mut same = make(&before.with_state(state));
    same.step(4).expect("steps");
    assert_ne!(one, bits(&mut same).await, "{name} {key} changes nothing");
}

#[test]
fn a_setting_that_changes_is_that_of_a_new_setup_to_the_bit() {
    let shared = device();
    for case in cases() {
        pollster::block_on(changed(|setup| on_gpu(&shared, setup), &case));
        let on_cpu = |setup: &Setup| {
            Simulation::on(Cpu::new(setup.check().expect("sense")).expect("some"), setup).expect("a simulation")
        };
        pollster::block_on(changed(on_cpu, &case));
    }
}

#[test]
fn nothing_is_compiled_and_states_go_on_under_what_was_set() {
    let shared = device();
    let forces = vec![force("gravity", &[("softening", 0.2.into())]), force("solid", &[]), force("solid", &[])];
    let mut simulation = on_gpu(&shared, &setup(free(200), forces));
    pollster::block_on(async {
        simulation.step(2).expect("steps");
        let compiled = simulation.backend().pipelines();
        for n in 0..5 {
            simulation.set("solid 2", "position", DVec3::X * (0.1 + f64::from(n) * 0.1)).expect("it moves");
            simulation.set("gravity", "softening", 0.2 + 0.01 * f64::from(n)).expect("it is softer");
            simulation.step(2).expect("steps");
        }
        assert_eq!(simulation.backend().pipelines(), compiled);
        let state = simulation.snapshot().await.expect("a state");
        let saved = simulation.setup().with_state(state);
        let mut restored = on_gpu(&shared, &saved);
        assert!(restored.goes_on());
        simulation.step(3).expect("steps");
        restored.step(3).expect("steps");
        assert_eq!(bits(&mut simulation).await, bits(&mut restored).await);
    });
}

#[test]
fn what_makes_no_sense_is_refused_and_changes_nothing() {
    let shared = device();
    let forces = || {
        vec![
            force("gravity", &[("softening", 0.2.into())]),
            force("solid", &[]),
            force("contact", &[("range", 0.5.into())]),
        ]
    };
    let mut state = free(60);
    for (name, value) in [("radius", 0.2), ("inertia", 0.01)] {
        let column = forces().iter().flat_map(|force| force.columns()).find(|column| column.name == name);
        let column = column.expect("a column of contacts");
        let values = match column.kind {
            Kind::Vector => Array::Vec3(vec![DVec3::splat(value); 60]),
            _ => Array::Float(vec![value; 60]),
        };
        state.declare(&column).expect("new");
        state.set(name, values).expect("sixty");
    }
    let before = setup(state, forces());
    let (mut one, mut other) = (on_gpu(&shared, &before), on_gpu(&shared, &before));
    let refusals: [(&str, &str, Change, &[&str]); 10] = [
        ("gravty", "softening", 0.1.into(), &["`gravty`", "did you mean `gravity`", "solid"]),
        ("solid 2", "radius", 0.1.into(), &["`solid 2`", "solid"]),
        ("gravity", "softning", 0.1.into(), &["`softning`", "did you mean `softening`"]),
        ("gravity", "softening", (-0.1).into(), &["softening", "-0.1", "zero or above"]),
        ("gravity", "softening", f64::NAN.into(), &["softening", "NaN"]),
        ("gravity", "softening", true.into(), &["softening", "another kind"]),
        ("gravity", "over", "tre".into(), &["over", "did you mean \"tree\""]),
        ("gravity", "over", "tree".into(), &["`over` of `gravity`", "kernels", "snapshot()"]),
        ("solid", "restitution", 1.5.into(), &["restitution 1.5", "the maximum is 1"]),
        ("contact", "range", 0.3.into(), &["radius 0.2", "0.15"]),
    ];
    pollster::block_on(async {
        for (force, key, to, words) in refusals {
            let said = one.set(force, key, to).expect_err(key);
            assert!(matches!(said, Error::Scene(_) | Error::Setting { .. }), "{said:?}");
            words.iter().for_each(|word| assert!(said.to_string().contains(word), "`{said}` does not say `{word}`"));
            one.step(1).expect("a step");
            other.step(1).expect("a step");
        }
        let table = one.set("gravity", "softening", &[1.0_f32, 2.0][..]).expect_err("no table").to_string();
        assert!(table.contains("no table"), "{table}");
        assert_eq!(bits(&mut one).await, bits(&mut other).await);
    });
}

/// A density that is summed in each evaluation, and one that is a state with a rate of its own.
#[test]
fn what_changes_the_columns_is_refused() {
    let shared = device();
    let forces = |by: &'static str| {
        vec![force("fluid", &[("density_by", by.into()), ("spacing", 0.1.into()), ("sound_speed", 10.0.into())])]
    };
    for (from, to) in [("summation", "continuity"), ("continuity", "summation")] {
        let mut simulation = on_gpu(&shared, &setup(free(60), forces(from)));
        let said = simulation.set("fluid", "density_by", to).expect_err(to).to_string();
        assert!(said.contains("which quantities particles have") && said.contains("snapshot()"), "{said}");
    }
}

/// How an energy ends is compiled into its kernels; its depth is not.
#[test]
fn what_is_compiled_is_refused() {
    let shared = device();
    let atoms = vec![force("lennard_jones", &[("range", 2.5.into()), ("sigma", 0.1.into())])];
    let mut simulation = on_gpu(&shared, &setup(free(60), atoms));
    for to in ["xplor", "force_shift"] {
        let said = simulation.set("lennard_jones", "truncation", to).expect_err(to).to_string();
        assert!(said.contains("truncation") || said.contains("snapshot()"), "{said}");
    }
    simulation.set("lennard_jones", "epsilon", 2.0).expect("a number of its table");
}

#[test]
fn a_motion_changes() {
    let shared = device();
    let to = |x: f64| Motion {
        name: "lift".to_owned(),
        keys: vec![Keyframe::default(), Keyframe { time: 1.0, shift: DVec3::new(x, 0.0, 0.0), ..Keyframe::default() }],
        ..Motion::default()
    };
    let mut state = free(50);
    state.motions.push(to(1.0));
    state.held.push(Held { id: 7, by: Hold::Motion(0) });
    let home = state.position()[7].x;
    let solid = force("solid", &[("motion", Value::Text("lift".into())), ("radius", 0.2.into())]);
    let mut simulation = on_gpu(&shared, &setup(state, vec![solid]));
    pollster::block_on(async {
        simulation.step(50).expect("steps");
        let x = |all: &[Vec4]| f64::from(all[7].x) - home;
        let read = simulation.read(POSITION).await.expect("positions");
        assert!((x(&read) - 0.5).abs() < 1e-6, "{}", x(&read));
        // More keys than before, and another way.
        let mut new = to(-2.0);
        new.keys.push(Keyframe { time: 2.0, ..Keyframe::default() });
        simulation.set_motion(new).expect("another motion");
        simulation.step(50).expect("steps");
        let read = simulation.read(POSITION).await.expect("positions");
        assert!((x(&read) + 2.0).abs() < 1e-6, "{}", x(&read));
        let state = simulation.snapshot().await.expect("a state");
        assert_eq!(state.motions[0].keys.len(), 3);
        let said = simulation.set_motion(Motion { name: "lft".to_owned(), ..to(1.0) }).expect_err("none").to_string();
        assert!(said.contains("\"lft\"") && said.contains("did you mean `lift`"), "{said}");
        let said = simulation.set_motion(Motion { keys: Vec::new(), ..to(1.0) }).expect_err("no keys").to_string();
        assert!(said.contains("no keyframes"), "{said}");
    });
}

/// A law with a parameter, a table, and a buffer of its own for each particle.
const LAW: &str = "struct Params { strength: f32 }
@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<storage, read> heights: array<f32>;
@group(3) @binding(2) var<storage, read> wanted: array<vec4f>;
fn force(me: Particle) -> vec4f {
    return vec4f(params.strength * heights[me.index % 3u] * wanted[me.index].xyz, 0.0);
}
";

fn law() -> Box<dyn Component> {
    let heights = [1.0_f32, 2.0, 4.0].map(f32::to_bits).to_vec();
    Box::new(Custom {
        params: vec![("strength".to_owned(), Value::Number(1.0))],
        tables: vec![("heights".into(), heights.into())],
        ..Custom::new("terrain", "terrain.wgsl", LAW, Over::Each)
    })
}

#[test]
fn parameters_tables_and_buffers_of_a_users_law_change() {
    const WANTED: Field<Vec4> = Field::new("wanted");
    let shared = device();
    let mut state = free(5);
    state.velocity_mut().fill(DVec3::ZERO);
    state.declare(&Column::new("wanted", Kind::Vector, "", "where it is to go")).expect("a new column");
    let mut simulation: Simulation<Gpu> = on_gpu(&shared, &setup(state, vec![law()]));
    pollster::block_on(async {
        simulation.write(WANTED, &[Vec4::X; 5]).expect("as many as particles");
        simulation.set("terrain", "strength", 3.0).expect("a parameter");
        simulation.set("terrain", "heights", &[10.0_f32, 20.0, 40.0][..]).expect("a table");
        simulation.step(1).expect("a step");
        let v = simulation.read(VELOCITY).await.expect("velocities");
        let speeds: Vec<f32> = v.iter().map(|v| v.x).collect();
        // a dt of 0.01.
        for (speed, height) in speeds.iter().zip([10.0, 20.0, 40.0, 10.0, 20.0]) {
            assert!((speed - 0.01 * 3.0 * height).abs() < 1e-6 * height, "{speeds:?}");
        }
        let heights: Vec<f32> = simulation.read(Field::new("heights")).await.expect("the table");
        assert_eq!(heights, [10.0, 20.0, 40.0]);
        let said = |result: Result<(), Error>| result.expect_err("refused").to_string();
        let refused = [
            (said(simulation.set("terrain", "strenght", 1.0)), "did you mean `strength`"),
            (said(simulation.set("terrain", "strength", DVec3::X)), "three numbers"),
            (said(simulation.set("terrain", "strength", f64::INFINITY)), "inf"),
            (said(simulation.set("terrain", "heights", &[1.0_f32, 2.0][..])), "3 words of 4 bytes, and these are 2"),
            (said(simulation.set("terrain", "hights", &[1.0_f32][..])), "did you mean `heights`"),
            (said(simulation.write(WANTED, &[Vec4::X; 6])), "5 elements, and these go to 6"),
            (said(simulation.write(Field::new("wnated"), &[Vec4::X; 5])), "did you mean `wanted`"),
            (said(simulation.write(Field::<u32>::new("wanted"), &[1; 5])), "vec4f"),
        ];
        refused.iter().for_each(|(said, word)| assert!(said.contains(word), "`{said}` does not say `{word}`"));
    });
}
