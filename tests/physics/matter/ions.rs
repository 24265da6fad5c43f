//! `born_mayer`: the energies of rock salt, tables over pairs of species, and lockstep.

use glam::DVec3;
use motes::forces::Component;
use motes::kernel::Array;
use motes::scene::{Options, Scene, Source};
use motes::settings::{Kind, Pair, Settings, Value};
use motes::{Bounds, Error, Side, State};

use super::{agrees, scalars, setup, side, spread};
use crate::support::choices;
use crate::support::states::{accelerations, force, word};

fn row(species: [u32; 2], numbers: [f64; 4]) -> Pair {
    let names = ["repulsion", "decay", "dispersion", "dispersion_8"];
    let values = names.iter().zip(numbers).map(|(name, x)| ((*name).to_owned(), x));
    Pair { species, values: values.collect() }
}

fn ions(rows: Vec<Pair>, more: &[(&'static str, Value)]) -> Box<dyn Component> {
    force("born_mayer", &[&[("pairs", Value::Pairs(rows))], more].concat())
}

/// Rock salt about an ion in the middle: sodium of species 0, chlorine of species 1; the middle one is of this species.
fn salt(reach: i32, distance: f64, middle: u32) -> (State, usize) {
    let mut state = State::default();
    let (mut charges, mut species, mut place) = (Vec::new(), Vec::new(), 0);
    for x in -reach..=reach {
        for y in -reach..=reach {
            for z in -reach..=reach {
                let odd = (x + y + z).rem_euclid(2) as u32;
                if (x, y, z) == (0, 0, 0) {
                    place = state.len();
                }
                state.push(distance * DVec3::new(f64::from(x), f64::from(y), f64::from(z)), DVec3::ZERO, 1.0, 0.0);
                species.push(odd ^ middle);
                charges.push(if odd ^ middle == 0 { 1.0 } else { -1.0 });
            }
        }
    }
    state.species_mut().copy_from_slice(&species);
    state.set("charge", Array::Float(charges)).expect("charges");
    (state, place)
}

/// Madelung's constant of rock salt is 1.747 564 594 633 (Madelung 1918; OEIS A085469). Damped by α = 0.6 and cut off at 6.5 distances
/// of neighbours, what is left out of the sum over waves, of order exp(−3 π² / 4 α²) = 1e-9, and of that over ions, erfc(3.9) / 6.5 =
/// 5e-9 for each of some tens that are not balanced, is 1e-7. With less of a range or without damping it is more.
#[test]
fn rock_salt_has_its_madelung_constant() {
    let nothing = || {
        vec![row([0, 0], [0.0, 1.0, 0.0, 0.0]), row([1, 0], [0.0, 1.0, 0.0, 0.0]), row([1, 1], [0.0, 1.0, 0.0, 0.0])]
    };
    let madelung = |damping: f64, range: f64, coulomb: f64| {
        let (state, middle) = salt(7, 1.0, 0);
        let more =
            [("damping", damping), ("range", range), ("coulomb", coulomb)].map(|(name, x)| (name, Value::Number(x)));
        let a =
            accelerations(&[ions(nothing(), &[&more[..], &[("over", word("within"))]].concat())], &state, 0.0)[middle];
        // The sides of the cube are as far on all sides.
        assert!(a.truncate().length() < 1e-13, "{a}");
        // Each of a pair holds half.
        -2.0 * a.w / coulomb
    };
    let known = 1.747_564_594_633;
    assert!((madelung(0.6, 6.5, 1.0) - known).abs() < 2e-7, "{}", madelung(0.6, 6.5, 1.0));
    assert!((madelung(0.6, 6.5, 14.4) - known).abs() < 2e-7);
    let coarse = madelung(0.6, 4.5, 1.0) - known;
    assert!((1e-6..1e-4).contains(&coarse.abs()), "{coarse:e}");
}

/// The coefficients of Tosi & Fumi (J. Phys. Chem. Solids 25, 45, 1964) in eV and Å.
fn tosi_fumi() -> Vec<Pair> {
    let row = |species, (b, sizes, c, d): (f64, f64, f64, f64)| {
        let ev = 1.602_176_634e-19;
        row(species, [b * 1e-19 / ev * (sizes / 0.317_f64).exp(), 0.317, c * 1e-19 / ev, d * 1e-19 / ev])
    };
    vec![
        row([0, 0], (0.338 * 1.25, 2.34, 1.68, 0.8)),
        row([0, 1], (0.338, 2.755, 11.2, 13.9)),
        row([1, 1], (0.338 * 0.75, 3.17, 116.0, 233.0)),
    ]
}

/// Salt's lattice energy is 787 kJ/mol, and its ions are 2.820 Å apart at room temperature, 2.795 Å near 0 K (CRC Handbook of Chemistry
/// and Physics). This model's is known to be some percent less, and the crystal of least energy is between.
#[test]
fn salt_has_its_lattice_energy() {
    let energy = |distance: f64| {
        let of = |middle: u32| {
            let (state, place) = salt(7, distance, middle);
            let more =
                [("damping", 0.2), ("range", 18.0), ("coulomb", 14.399_645)].map(|(name, x)| (name, Value::Number(x)));
            accelerations(&[ions(tosi_fumi(), &[&more[..], &[("over", word("within"))]].concat())], &state, 0.0)[place]
                .w
        };
        // Of a pair of ions, in kJ/mol.
        (of(0) + of(1)) * 96.485
    };
    let [near, at, far] = [2.78, 2.81, 2.84].map(energy);
    assert!(at < near && at < far, "{near} {at} {far}");
    assert!((at / -787.0 - 1.0).abs() < 0.02, "{at} kJ/mol");
}

#[test]
fn every_coefficient_of_every_pair_counts_in_both_orders() {
    let keys = motes::forces::entry("born_mayer").expect("it").keys;
    let Kind::Pairs(coefficients) = keys[0].kind else { panic!("{:?}", keys[0]) };
    let table = choices::table(coefficients);
    let state = spread(64, 0.8);
    let at = |table: Vec<Pair>| accelerations(&[ions(table, &[("range", Value::Number(1.7))])], &state, 0.0);
    let want = at(table.clone());
    let mut turned = table.clone();
    turned.iter_mut().for_each(|row| row.species.reverse());
    turned.reverse();
    assert_eq!(at(turned), want);
    for (place, row) in table.iter().enumerate() {
        for (member, (name, _)) in row.values.iter().enumerate() {
            let mut other = table.clone();
            other[place].values[member].1 = 0.77;
            assert_ne!(at(other), want, "{name} of {:?} changes nothing", row.species);
        }
    }
}

#[test]
fn energy_and_force_end_at_the_range() {
    let at = |distance: f64| {
        let mut state = State::default();
        state.push(DVec3::ZERO, DVec3::ZERO, 1.0, 0.0);
        state.push(DVec3::X * distance, DVec3::ZERO, 1.0, 0.0);
        state.set("charge", Array::Float(vec![0.0, 0.7])).expect("charges");
        let strong = ions(vec![row([0, 0], [30.0, 0.5, 2.0, 3.0])], &[("range", Value::Number(2.0))]);
        accelerations(&[strong], &state, 0.0)[0]
    };
    assert!(at(1.9).truncate().length() > 1e-3 && at(1.9).w.abs() > 1e-5, "{}", at(1.9));
    let [edge, beyond] = [at(2.0 - 1e-7), at(2.0 + 1e-7)];
    // The second derivative, below 10, times the way.
    assert!(edge.truncate().length() < 1e-6 && edge.w.abs() < 1e-12, "{edge}");
    assert_eq!(beyond.length(), 0.0);
}

#[test]
fn ions_agree_with_their_reference() {
    let settings = choices::variants(motes::forces::entry("born_mayer").expect("it").keys);
    assert_eq!(settings.len(), 3, "over each search");
    for settings in settings {
        for count in [2, 63, 64, 65, 333] {
            let mut state = spread(count, 0.8);
            state.set("charge", scalars(count, 3, |x| 0.9 * x)).expect("charges");
            let side = DVec3::splat(0.8 * side(count) as f64);
            let periodic = Bounds::new(DVec3::splat(-0.4), side - 0.4, Side::Periodic);
            for bounds in [Bounds::default(), periodic] {
                if bounds != Bounds::default() && count < 333 {
                    continue;
                }
                let settings: &Settings = &settings;
                let law = (motes::forces::entry("born_mayer").expect("it").build)(settings);
                agrees(&setup(state.clone(), vec![law], bounds, 0.01), 2, 1.0, &["born_mayer"]);
            }
        }
    }
}

const SCENE: &str = "[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0] }, { position = [1, 0, 0], charge = -1 }]
[[particles]]
bodies = [{ position = [0, 3, 0] }]
species = 2
[[force]]
kind = \"born_mayer\"
range = 2
";

fn faults(pairs: &str) -> String {
    let text = format!("{SCENE}{pairs}\n");
    let source = Source::Text { name: "a.toml".to_owned(), text, folder: ".".into() };
    Scene::load(&source, &[], &Options::default()).err().map_or_else(String::new, |faults| faults.to_string())
}

#[test]
fn every_pair_that_is_missing_is_named_in_the_scene() {
    let some = faults("pairs = [{ species = [2, 0], repulsion = 1, decay = 0.3 }]");
    assert!(some.contains("no entry for species 0 and 0") && some.contains("species 2 and 2"), "{some}");
    assert!(!some.contains("species 0 and 2") && some.ends_with("a.toml: 2 errors"), "{some}");
    assert!(some.contains("^^^^^ add { species = [0, 0], … }"), "{some}");
    let twice =
        "pairs = [{ species = [0, 1], repulsion = 1, decay = 1 }, { species = [1, 0], repulsion = 1, decay = 1 }]";
    assert!(faults(twice).contains("the pair of species 1 and 0 is given twice"), "{}", faults(twice));
    let wrong = faults("pairs = [{ species = [0, 1], repulson = 1, decay = -1 }, { repulsion = 1, decay = 1 }, 3]");
    for word in [
        "unknown key `repulson`",
        "did you mean `repulsion`?",
        "lacks `repulsion`",
        "`decay` must be a number above zero",
        "lacks `species`",
        "a list of tables",
    ] {
        assert!(wrong.contains(word), "{word}: {wrong}");
    }
    assert!(faults("").contains("[[force]] born_mayer lacks `pairs`"), "{}", faults(""));
    // All is well, and the resolved scene says the same.
    let good = "pairs = [{ species = [2, 0], repulsion = 1, decay = 0.3 }, { species = [0, 0], repulsion = 1.5, decay = 0.25, dispersion = 2 }, { species = [2, 2], repulsion = 0, decay = 1 }]";
    let load = |text: String| {
        let source = Source::Text { name: "a.toml".to_owned(), text, folder: ".".into() };
        Scene::load(&source, &[], &Options::default()).unwrap_or_else(|faults| panic!("{faults}"))
    };
    let scene = load(format!("{SCENE}{good}\n"));
    assert_eq!(scene.particles.scalar("charge"), Some(&[0.0, -1.0, 0.0][..]));
    assert!(scene.resolved.contains("species = [2, 0], repulsion = 1.0, decay = 0.3"), "{}", scene.resolved);
    let again = load(scene.resolved.clone());
    assert_eq!(again.resolved.lines().last(), scene.resolved.lines().last());
    let table = |scene: &Scene| scene.forces[0].laws()[0].pairs.clone();
    assert_eq!(table(&again), table(&scene));
}

#[test]
fn a_library_gets_the_same_errors() {
    let refused = |rows: Vec<Pair>, species: &[u32]| {
        let mut state = spread(species.len(), 0.8);
        state.species_mut().copy_from_slice(species);
        let law = ions(rows, &[("range", Value::Number(1.0))]);
        match setup(state, vec![law], Bounds::default(), 0.1).plans(motes::kernel::Machine::HOST).map(|_| ()) {
            Err(Error::Scene(why)) => why,
            other => panic!("{other:?}"),
        }
    };
    let one = |species| row(species, [1.0, 0.3, 0.0, 0.0]);
    let why = refused(vec![one([0, 1])], &[0, 1, 1]);
    assert!(why.contains("species 0 and 0, of species 1 and 1") && why.contains("{ species = [1, 1], … }"), "{why}");
    let many: Vec<u32> = (0..9).collect();
    let all = many.iter().flat_map(|a| many[..=*a as usize].iter().map(|b| one([*a, *b]))).collect();
    let why = refused(all, &many);
    assert!(why.contains("9 species, and room for 8"), "{why}");
    let mut lacking = one([0, 0]);
    lacking.values.pop();
    let why = refused(vec![lacking], &[0, 0]);
    assert!(why.contains("a key `pairs` of another kind"), "{why}");
}
