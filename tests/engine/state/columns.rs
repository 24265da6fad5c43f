//! Columns that a scene or a caller declares: laws write them, files hold them, restarts keep them.

use std::path::Path;

use glam::{DVec3, DVec4};
use motes::kernel::{Array, Column, Columns, Kind, Shape};
use motes::life::{Birth, Life};
use motes::scene::{Options, Scene, Source};
use motes::{Error, Gpu, Setup, Simulation, State};

use crate::support;

/// A charge that grows with time from where a column that nothing writes has it, and a heat that is derived.
const LAW: &str = "@group(3) @binding(1) var<storage, read_write> charge: array<f32>;
@group(3) @binding(2) var<storage, read_write> heat: array<f32>;
@group(3) @binding(3) var<storage, read> turning: array<vec4f>;
fn force(me: Particle) -> vec4f {
    charge[me.index] = turning[me.index].y + world.time;
    heat[me.index] = 2.0 * me.mass;
    return vec4f(0.0);
}
";

const COLUMNS: &str = "[[column]]\nname = \"charge\"\nunit = \"charge\"\n
[[column]]\nname = \"turning\"\nkind = \"vector\"\ninitial = [0, 0.25, 0]\n
[[column]]\nname = \"family\"\nkind = \"whole\"\ninitial = 7\n
[[column]]\nname = \"heat\"\nrole = \"derived\"\n";

const FORCE: &str =
    "[[force]]\nwgsl = \"law.wgsl\"\nover = \"each\"\ninto = [\"acceleration\", \"charge\", \"heat\"]\n";

fn load(folder: &Path, text: &str) -> Result<Scene, motes::scene::Diagnostics> {
    let source = Source::Text { name: "a.toml".to_owned(), text: text.to_owned(), folder: folder.to_owned() };
    Scene::load(&source, &[], &Options::default())
}

fn setup(scene: Scene) -> Setup {
    Setup {
        integrator: scene.integrator(),
        state: scene.particles,
        forces: scene.forces,
        dt: scene.dt,
        bounds: scene.bounds,
        solver: scene.solver,
    }
}

fn started(scene: Scene) -> Simulation<Gpu> {
    // A device of its own: tests side by side would poll one from two threads, which wgpu does not support where a wait times out.
    let own = support::open();
    Simulation::new(&own.found.device, &own.found.queue, &setup(scene)).expect("a simulation")
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("law.wgsl"), LAW).expect("written");
    folder
}

fn bodies(charge: &str) -> String {
    format!(
        "[simulation]\ndt = 0.25\nsteps = 8\nintegrator = \"symplectic_euler\"\n{COLUMNS}\n[[particles]]\nbodies = [\n  {{ position = [0, 0, 0]{charge} }},\n  \
         {{ position = [1, 0, 0], charge = -2, family = 9 }},\n]\n\n[[particles]]\nshape = \"box\"\ncount = 3\ncharge = 0.5\n\
         turning = [1, 2, 3]\n{FORCE}\n[output]\ncolumns = [\"heat\"]\n"
    )
}

#[test]
fn a_law_writes_what_a_scene_declares_and_files_hold_it() {
    let folder = folder();
    let scene = load(folder.path(), &bodies(", charge = 3")).unwrap_or_else(|faults| panic!("{faults}"));
    // The resolved scene is the same one.
    let again =
        Source::Text { name: "b.toml".to_owned(), text: scene.resolved.clone(), folder: folder.path().to_owned() };
    let again = Scene::load(&again, &[], &Options { allow_outside: true, ..Options::default() });
    let again = again.unwrap_or_else(|faults| panic!("{faults}\n{}", scene.resolved));
    assert_eq!((again.particles, again.output.columns), (scene.particles.clone(), scene.output.columns.clone()));
    assert_eq!(scene.particles.scalar("charge"), Some(&[3.0, -2.0, 0.5, 0.5, 0.5][..]));
    assert_eq!(scene.particles.whole("family"), Some(&[7, 9, 7, 7, 7][..]));
    let columns = setup(load(folder.path(), &bodies(", charge = 3")).expect("a scene")).columns().expect("columns");
    let mut simulation = started(scene);
    simulation.step(2).expect("steps");
    let state = pollster::block_on(simulation.snapshot_of(&["heat"])).expect("a state");
    // The state is that of time 0.5.
    assert_eq!(state.scalar("charge"), Some(&[0.75, 0.75, 2.5, 2.5, 2.5][..]));
    assert_eq!(state.scalar("heat"), Some(&[2.0; 5][..]));
    assert_eq!(state.vector("turning").map(|turning| turning[4]), Some(DVec3::new(1.0, 2.0, 3.0)));
    // Every format gives back what it was given.
    for format in ["csv", "npz"] {
        let path = folder.path().join("state").with_extension(format);
        let file = std::fs::File::create(&path).expect("a file");
        match format {
            "csv" => motes::formats::csv::write_csv(file, &state, motes::formats::Precision::Double).expect("written"),
            _ => motes::formats::npz::write_npz(file, &state, motes::formats::Precision::Double).expect("written"),
        }
        let back = motes::formats::read(&path, &columns).expect("a state");
        for name in ["position", "charge", "turning", "family", "heat", "potential"] {
            assert_eq!(back.get(name), state.get(name), "{name} in {format}");
        }
        // A file of such columns is refused where they are not declared.
        let said = motes::formats::read(&path, &Columns::default()).expect_err("unknown").to_string();
        assert!(said.contains("unknown") && said.contains("`charge`"), "{said}");
        let text = bodies(", charge = 3");
        let tail = &text[text.find("[[force]]").expect("a force")..];
        let head = &text[..text.find("[[particles]]").expect("particles")];
        let rest = load(folder.path(), &format!("{head}[[particles]]\nfile = \"state.{format}\"\n{tail}"));
        let rest = rest.unwrap_or_else(|faults| panic!("{faults}"));
        assert_eq!(rest.particles.get("charge"), state.get("charge"), "{format}");
        assert_eq!(rest.particles.whole("family"), state.whole("family"), "{format}");
    }
}

#[test]
fn what_is_missing_is_named() {
    let folder = folder();
    let said = load(folder.path(), &bodies("")).err().expect("a body has no charge").to_string();
    assert!(said.contains("charge"), "{said}");
    let said = |text: &str| load(folder.path(), text).err().unwrap_or_else(|| panic!("{text}")).to_string();
    let head = "[simulation]\ndt = 0.1\nsteps = 1\n[[particles]]\nbodies = [{ position = [0, 0, 0] }]\n";
    let faults = [
        ("[[column]]\nname = \"charge\"\n", "`charge`"),
        ("[[column]]\nname = \"position\"\n", "`position`"),
        ("[[column]]\nname = \"count\"\ninitial = 1\n", "is a key of [[particles]]"),
        ("[[column]]\nname = \"world\"\ninitial = 1\n", "a buffer of the engine"),
        (
            "[[column]]\nname = \"a\"\ninitial = 1\n[[column]]\nname = \"a\"\nkind = \"vector\"\ninitial = [0, 0, 1]\n",
            "twice",
        ),
        ("[[column]]\nname = \"q\"\nkind = \"quaternion\"\ninitial = [0, 0, 1, 1]\n", "length 1"),
        ("[[column]]\nname = \"n\"\nkind = \"whole\"\ninitial = -1\n", "zero or above"),
        ("[output]\ncolumns = [\"density\"]\n", "density"),
        ("[[column]]\ninitial = 1\n", "lacks `name`"),
    ];
    for (text, word) in faults {
        let said = said(&format!("{head}{text}"));
        assert!(said.contains(word), "{text}: {said}");
    }
    // The keys of the size that is drawn have had another name.
    let old = said(&head.replace("0] }", "0], radius = 1 }"));
    assert!(old.contains("called `size`"), "{old}");
    // A library's setup says the same.
    let mut state = support::cloud(4, 1);
    state.declare(&Column::new("charge", Kind::Scalar, "", "").required()).expect("a new column");
    let Err(Error::Scene(why)) = setup_of(state.clone()).check() else { panic!("no charge is given") };
    assert!(why.contains("`charge`") && why.contains("no initial value"), "{why}");
    state.set("charge", Array::Float(vec![1.0, f64::NAN, 0.0, 0.0])).expect("four");
    let Err(Error::Scene(why)) = setup_of(state).check() else { panic!("a charge is no number") };
    assert!(why.contains("particle 1") && why.contains("`charge`"), "{why}");
}

fn setup_of(state: State) -> Setup {
    Setup {
        state,
        forces: Vec::new(),
        integrator: Box::new(motes::integrators::Leapfrog),
        dt: 0.1,
        bounds: motes::Bounds::default(),
        solver: motes::Solver::default(),
    }
}

#[test]
fn a_column_that_nothing_computes_is_refused() {
    let folder = folder();
    let text = "@group(3) @binding(1) var<storage, read> heat: array<f32>;
fn force(me: Particle) -> vec4f { return vec4f(heat[me.index], 0.0, 0.0, 0.0); }\n";
    std::fs::write(folder.path().join("law.wgsl"), text).expect("written");
    let scene = "[simulation]\ndt = 0.1\nsteps = 1\n[[column]]\nname = \"heat\"\nrole = \"derived\"\n[[particles]]\nbodies = [{ position = [0, 0, 0] }]\n\
                 [[force]]\nwgsl = \"law.wgsl\"\nover = \"each\"\n";
    let scene = load(folder.path(), scene).unwrap_or_else(|faults| panic!("{faults}"));
    let Err(error) = setup(scene).plans(motes::kernel::Machine::HOST) else { panic!("nothing computes heat") };
    assert!(error.to_string().contains("`heat`, which nothing computes"), "{error}");
}

#[test]
fn states_keep_their_columns_together() {
    let mut a = State::default();
    a.push(DVec3::X, DVec3::ZERO, 1.0, 0.0);
    a.push(DVec3::Y, DVec3::ZERO, 2.0, 0.0);
    a.set("charge", Array::Float(vec![1.0, 2.0])).expect("two");
    let slots = Column::new("bins", Kind::Whole, "", "").shaped(Shape::Slots(3));
    a.declare(&slots).expect("a new column");
    a.set("bins", Array::Uint((0..6).collect())).expect("three for each");
    a.push(DVec3::Z, DVec3::ZERO, 3.0, 0.0);
    assert_eq!(a.scalar("charge"), Some(&[1.0, 2.0, 0.0][..]));
    assert_eq!(a.whole("bins"), Some(&[0, 1, 2, 3, 4, 5, 0, 0, 0][..]));
    let mut b = State::default();
    b.push(DVec3::NEG_X, DVec3::ZERO, 4.0, 0.5);
    b.set("tint", Array::Vec3(vec![DVec3::ONE])).expect("one");
    b.set_life(0, Life::Pending);
    b.births.push(Birth { id: 0, time: 1.0, velocity: DVec3::X, mass: 4.0, guided: 0.0, emitter: 0 });
    a.append(&b).expect("no column is of two kinds");
    assert_eq!((a.len(), a.births[0].id), (4, 3));
    assert_eq!(a.scalar("charge"), Some(&[1.0, 2.0, 0.0, 0.0][..]));
    assert_eq!(a.vector("tint").map(|tint| tint[3]), Some(DVec3::ONE));
    assert_eq!(a.life(), [Life::Active, Life::Active, Life::Active, Life::Pending]);
    let c = a.picked(&[3, 1]);
    assert_eq!((c.scalar("charge"), c.whole("bins")), (Some(&[0.0, 2.0][..]), Some(&[0, 0, 0, 3, 4, 5][..])));
    assert_eq!((c.births[0].id, c.life(), c.mass()), (0, vec![Life::Pending, Life::Active], &[4.0, 2.0][..]));
    // Of another length, of another kind.
    assert!(a.set("charge", Array::Float(vec![0.0; 3])).is_err());
    assert!(a.set("charge", Array::Uint(vec![0; 4])).is_err());
    assert!(a.declare(&Column::new("charge", Kind::Vector, "", "")).is_err());
    assert!(a.remove("position").is_none() && a.remove("charge").is_some() && a.get("charge").is_none());
    // What every particle must be given cannot be filled up.
    let mut d = State::default();
    d.push(DVec3::X, DVec3::ZERO, 1.0, 0.0);
    d.declare(&Column::new("charge", Kind::Scalar, "", "").required()).expect("a new column");
    d.set("charge", Array::Float(vec![1.0])).expect("one");
    let why = d.append(&b).expect_err("the other has no charge").to_string();
    assert!(why.contains("`charge` has no initial value"), "{why}");
}

#[test]
fn columns_are_read_and_written_by_name() {
    let run = |mut simulation: Simulation<Gpu>| {
        let wait = |array: Result<Array, Error>| array.expect("a column");
        let mass = wait(pollster::block_on(simulation.read_column("mass")));
        let Array::Float(mass) = mass else { panic!("{mass:?}") };
        let before = wait(pollster::block_on(simulation.read_column("position")));
        let twice = Array::Float(mass.iter().map(|m| 2.0 * m).collect());
        pollster::block_on(simulation.write_column("mass", &twice)).expect("written");
        assert_eq!(wait(pollster::block_on(simulation.read_column("mass"))), twice);
        assert_eq!(wait(pollster::block_on(simulation.read_column("position"))), before);
        let tint = Array::Vec3(vec![DVec3::new(0.5, 0.25, 1.0); 4]);
        pollster::block_on(simulation.write_column("tint", &tint)).expect("written");
        assert_eq!(wait(pollster::block_on(simulation.read_column("tint"))), tint);
        assert_eq!(pollster::block_on(simulation.snapshot()).expect("a state").get("tint"), Some(&tint));
        for (name, values) in
            [("tint", Array::Float(vec![0.0; 4])), ("mass", Array::Float(vec![0.0; 3])), ("nix", tint)]
        {
            let why = pollster::block_on(simulation.write_column(name, &values)).expect_err("refused").to_string();
            assert!(why.contains(name), "{why}");
        }
        let why = pollster::block_on(simulation.read_column("nix")).expect_err("refused").to_string();
        assert!(why.contains("`nix`") && why.contains("tint"), "{why}");
    };
    let mut state = support::cloud(4, 1);
    state.set("tint", Array::Vec3(vec![DVec3::ZERO; 4])).expect("four");
    state.declare(&Column::new("turn", Kind::Quaternion, "", "")).expect("a new column");
    let shared = support::device();
    let simulation =
        Simulation::new(&shared.found.device, &shared.found.queue, &setup_of(state)).expect("a simulation");
    let mut simulation = simulation;
    let turn = pollster::block_on(simulation.read_column("turn")).expect("a column");
    assert_eq!(turn, Array::Vec4(vec![DVec4::W; 4]));
    run(simulation);
}
