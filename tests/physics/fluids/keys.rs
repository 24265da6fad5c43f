//! Every key of a fluid is read.

use motes::forces;
use motes::kernel::Array;
use motes::settings::{Kind, Settings, Value};
use motes::{Side, VELOCITY};

use crate::support::choices::nudged;
use crate::support::fluids::{DENSITY, SPACING, bounds, cloud};
use crate::support::states::{cpu_in, vector, word};
use Value::Number;

/// What becomes of a cloud with walls in it.
fn becomes(settings: &Settings) -> [Option<Array>; 2] {
    let entry = forces::entry("fluid").expect("a fluid");
    let particles = cloud(60, false, true);
    let mut simulation =
        cpu_in(&bounds(60, false, Side::Open), &particles, vec![(entry.build)(settings)], "leapfrog", 0.002);
    simulation.step(3).expect("steps");
    let host = simulation.backend().host();
    [host.get(VELOCITY.name), host.get("density")]
}

#[test]
fn a_key_that_is_changed_changes_something() {
    let entry = forces::entry("fluid").expect("a fluid");
    let some = [("spacing", Number(SPACING)), ("density", Number(DENSITY)), ("sound_speed", Number(2.7))];
    let more = [
        ("density_by", word("continuity")),
        ("walls", word("extrapolate")),
        ("weight", vector(0.2, -0.7, 0.1)),
        ("alpha", Number(0.2)),
        ("viscosity", Number(0.03)),
    ];
    let with = |settings: Settings, list: &[(&'static str, Value)]| {
        list.iter().fold(settings, |settings, (key, value)| settings.with(key, value.clone()))
    };
    let plain = with(Settings::defaults(entry.keys), &some);
    let full = with(plain.clone(), &more);
    let before = [&plain, &full].map(becomes);
    // The keys of a solver of pressure have tests of their own, and so has the regime, which changes defaults. References meet the same pairs
    // over any visit: `tests/physics/fluids/listed.rs`.
    let solvers = ["over", "skin", "regime", "tolerance", "divergence_tolerance", "min_iterations", "max_iterations"];
    for key in entry.keys.iter().filter(|key| !solvers.contains(&key.name)) {
        let read = [&plain, &full].into_iter().zip(&before).any(|(settings, before)| {
            let value = &settings.0[key.name];
            let others: Vec<Value> = match key.kind {
                Kind::Choice(words) => {
                    words.iter().filter(|w| *w != &settings.text(key.name)).map(|w| Value::Text((*w).into())).collect()
                }
                kind => vec![nudged(kind, value)],
            };
            // Diffusion is of densities by continuity alone.
            let sums = key.name == "diffusion" && settings.text("density_by") == "summation";
            let differs = |other: Value| becomes(&settings.clone().with(key.name, other)) != *before;
            !sums && others.into_iter().any(differs)
        });
        assert!(read, "the key `{}` changes nothing", key.name);
    }
}
