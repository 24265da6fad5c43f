//! Measures that a scene names: their tables, and the same rows where a run was stopped or killed.

use motes::formats::Precision;
use motes::{Cpu, Setup, Simulation};

use super::resumed::{Way, compare};
use super::{Place, all};

/// Sixty particles in a periodic box, with measures of each kind.
const SCENE: &str =
    "[simulation]\ndt = 0.01\nsteps = 24\n[box]\nboundary = \"periodic\"\nlow = [-1, -1, -1]\nsize = [2, 2, 2]\n
[[particles]]\nshape = \"box\"\ncount = 60\nseed = 5\nsize = [2, 2, 2]\n
[[force]]\nkind = \"gravity\"\nsoftening = 0.1\n
[[measure]]\nkind = \"thermo\"\nevery = 3\n
[[measure]]\nkind = \"heat_capacity\"\nevery = 3\n
[[measure]]\nkind = \"pressure\"\nevery = 6\n
[[measure]]\nkind = \"rdf\"\nrange = 0.8\nbins = 4\n
[[measure]]\nkind = \"rdf\"\nrange = 0.5\nbins = 2\nevery = \"0.05 time\"\n
[[measure]]\nkind = \"structure_factor\"\nlargest = 7\nbins = 3\nvectors = 4\nevery = 4\nafter = 0.1\n
[[measure]]\nkind = \"haloes\"\nlinking_length = 0.8\nmembers = 2\nevery = 4\n
[[column]]\nname = \"unwrapped\"\nkind = \"vector\"\nrate = \"velocity\"\ninitial = [0, 0, 0]\n
[[measure]]\nkind = \"diffusion\"\nevery = 4\n
[[measure]]\nkind = \"probe\"\nstart = [0, 0, 0]\nrange = 0.5\n
[output]\nevery = 8\nformats = [\"npz\"]\n[checkpoint]\nevery = \"5 steps\"\n";

#[test]
fn tables_have_their_rows_and_go_on_where_a_run_was_stopped() {
    let place = Place::with(&[("box.toml", SCENE)]);
    let (code, words) = place.run("box.toml", "out", &[]);
    assert_eq!(code, 0, "{words}");
    assert!(
        words.contains("energy.csv, thermo.csv, heat_capacity.csv, pressure.csv, rdf.csv, rdf_2.csv, structure_factor.csv, haloes.csv, diffusion.csv, probe.csv"),
        "{words}"
    );
    assert!(words.contains("temperature "), "{words}");
    let files = all(&place.at("out"));
    let steps = |name: &str| -> Vec<u64> {
        let text = String::from_utf8(files[name].clone()).expect("a text");
        text.lines().skip(1).map(|row| row.split(',').next().expect("a step").parse().expect("a number")).collect()
    };
    assert_eq!(steps("thermo.csv"), [0, 3, 6, 9, 12, 15, 18, 21, 24]);
    assert_eq!(steps("probe.csv"), [0, 8, 16, 24]);
    assert_eq!(steps("pressure.csv"), [0, 6, 12, 18, 24]);
    assert_eq!(steps("rdf.csv"), [0, 8, 16, 24].map(|step| [step; 4]).concat());
    // Energies are looked at between outputs, whether something else is measured there or not: at 20 steps, here.
    assert!(words.contains("in 5 measurements"), "{words}");
    assert_eq!(steps("rdf_2.csv"), [0, 5, 10, 15, 20].map(|step| [step; 2]).concat());
    assert!(files["thermo.csv"].starts_with(b"step,time,count,temperature,kinetic,potential,total\n0,0.0,60,"));
    // A second run over the first knows its tables as results.
    let (code, words) = place.run("box.toml", "out", &["-q"]);
    assert!(code != 0 && words.contains("--overwrite"), "{words}");
    // Files of such names that no run has written are no results.
    for name in ["rdf_3.csv", "rdf_02.csv", "thermo_2024.csv"] {
        std::fs::write(place.at("out").join(name), "mine\n").expect("written");
    }
    assert_eq!(place.run("box.toml", "out", &["-q", "--overwrite"]).0, 0);
    for name in ["rdf_3.csv", "rdf_02.csv", "thermo_2024.csv"] {
        assert_eq!(std::fs::read_to_string(place.at("out").join(name)).expect("it is there"), "mine\n");
    }

    let on = |setup: &Setup| Simulation::on(Cpu::new(setup.check()?)?, setup);
    let ways = [Way::Killed(8), Way::Stopped(12), Way::Stopped(17), Way::Killed(24)];
    compare(&place.path("box.toml"), &[], (&on, Precision::Double), &ways).unwrap_or_else(|why| panic!("{why}"));
}

#[test]
fn a_measure_that_a_run_cannot_take_is_refused_before_it_begins() {
    for (from, to, why) in [
        ("range = 0.8", "range = 1.8", "more than half a period of the box"),
        ("boundary = \"periodic\"", "boundary = \"open\"", "not periodic along all axes"),
        ("largest = 7", "largest = 3", "set it to 3.14159"),
        (
            "kind = \"gravity\"\nsoftening = 0.1",
            "kind = \"berendsen\"\ntemperature = 1",
            "choose csvr, nose_hoover, langevin or andersen",
        ),
        ("kind = \"probe\"", "kind = \"fluid\"", "unknown key `start`"),
        ("kind = \"thermo\"", "kind = \"termo\"", "did you mean \"thermo\"?"),
        ("kind = \"thermo\"", "kind = \"energy\"", "remove `every`"),
    ] {
        let place = Place::with(&[("box.toml", &SCENE.replace(from, to))]);
        for command in ["run", "check"] {
            let (code, words) = super::said(&mut super::motes(&[command, &place.path("box.toml"), "--backend", "cpu"]));
            assert!(code != 0 && words.contains(why), "{command}: {words}");
        }
        assert!(!place.at("out").exists());
    }
}
