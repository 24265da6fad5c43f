//! States that say which particles are active, and runs that continue from them.

use motes::formats::{Input, Precision, csv, npz};
use motes::kernel::Columns;
use motes::life::Life;
use motes::scene::{Options, Scene, Source};
use motes::{Cpu, Simulation, State};

use crate::births::{DT, jet, state};

#[test]
fn files_say_which_are_active() {
    let mut particles = jet(0.3);
    particles.set_life(1, Life::Active);
    particles.set_life(2, Life::Removed);
    let folder = tempfile::tempdir().expect("a folder");
    let [table, archive] = ["a.csv", "a.npz"].map(|name| folder.path().join(name));
    csv::write_csv(std::fs::File::create(&table).expect("a file"), &particles, Precision::Double).expect("written");
    let file = std::fs::File::create(&archive).expect("a file");
    npz::write_npz(file, &particles, Precision::Double).expect("written");
    assert_eq!(csv::read(&Input::disk(&table), &Columns::default()).expect("a table").life(), particles.life());
    assert_eq!(npz::read(&Input::disk(&archive), &Columns::default()).expect("an archive").life(), particles.life());
    // In another order, and with words that mean nothing.
    std::fs::write(&table, "id,x,y,z,life\n1,0,0,0,2\n0,0,0,0,0\n").expect("written");
    assert_eq!(
        csv::read(&Input::disk(&table), &Columns::default()).expect("a table").life(),
        [Life::Pending, Life::Removed]
    );
    std::fs::write(&table, "x,y,z,life\n0,0,0,3\n").expect("written");
    let said = csv::read(&Input::disk(&table), &Columns::default()).expect_err("no such life").to_string();
    assert!(said.contains("column life: 3 is none of 0 (pending), 1 (active) and 2 (removed)"), "{said}");
    // Where all are active nothing is said of it.
    particles.remove("life");
    csv::write_csv(std::fs::File::create(&table).expect("a file"), &particles, Precision::Double).expect("written");
    assert!(!std::fs::read_to_string(&table).expect("a text").contains("life"));
}

fn run(text: &str, folder: &std::path::Path, steps: u32) -> State {
    let source = Source::Text { name: "a.toml".to_owned(), text: text.to_owned(), folder: folder.to_owned() };
    let mut scene = Scene::load(&source, &[], &Options::default()).unwrap_or_else(|faults| panic!("{faults}"));
    // What it is resolved to is the same scene.
    let again = Source::Text { name: "b.toml".to_owned(), text: scene.resolved.clone(), folder: folder.to_owned() };
    let again = Scene::load(&again, &[], &Options { allow_outside: true, ..Options::default() });
    let again = again.unwrap_or_else(|faults| panic!("{faults}\n{}", scene.resolved));
    assert_eq!(again.particles, scene.particles);
    let count = u32::try_from(scene.particles.len()).expect("few");
    let setup = scene.setup();
    let mut simulation = Simulation::on(Cpu::new(count).expect("some"), &setup).expect("a run");
    simulation.step(steps).expect("steps");
    state(&mut simulation)
}

const REST: &str = "[[drain]]\nshape = \"plane\"\nposition = [0.5, 0, 0]\nnormal = [-1, 0, 0]\n
[[force]]\nkind = \"uniform\"\nacceleration = [0, 0, -1]\n";

#[test]
fn a_run_goes_on_from_its_state() {
    let folder = tempfile::tempdir().expect("a folder");
    let head = format!("[simulation]\ndt = {DT}\nsteps = 80\n");
    let emitter = |start: f64, first: &str| {
        format!(
            "[[emitter]]\nshape = \"rectangle\"\nsize = [0.3, 0.2, 0]\nspeed = 1.3\nspacing = 0.1\nstart = {start:?}\n\
             count = 84\n{first}\n{REST}"
        )
    };
    let body = "[[particles]]\nbodies = [{ position = [0, 1, 0] }]\n";
    let whole = format!("{head}{body}{}", emitter(0.05, ""));
    let (half, end) = (run(&whole, folder.path(), 35), run(&whole, folder.path(), 60));
    let file = std::fs::File::create(folder.path().join("half.csv")).expect("a file");
    csv::write_csv(file, &half, Precision::Double).expect("written");
    let later = 0.05 - 35.0 * DT;
    let rest = format!("{head}[[particles]]\nfile = \"half.csv\"\n{}", emitter(later, "first = 1"));
    let then = run(&rest, folder.path(), 25);
    assert_eq!(then.life(), end.life());
    let of = end.population();
    assert!(of.pending > 0 && of.removed > 0 && of.active > 5, "{of:?}");
    assert!(half.population().pending > of.pending);
    for id in 0..85 {
        // Rounding alone: in f64 births are decided by their times, which are written otherwise.
        assert!((then.position()[id] - end.position()[id]).length() < 1e-9, "{id}");
        assert!((then.mass()[id] - end.mass()[id]).abs() < 1e-12, "{id}");
    }
}
