//! Pair laws: lockstep, coefficients and mixing, and how energies end.

use glam::DVec3;
use motes::kernel::Array;
use motes::settings::{Pair, Value};
use motes::{Error, State};

use super::{cut, lennard_jones, periodic, setup};
use crate::matter::{agrees, side, spread};
use crate::support::choices;
use crate::support::states::{accelerations, force, word};

/// Two atoms at a distance, of species 0 and this one: the force on the second, and its energy.
fn two(law: Box<dyn motes::forces::Component>, species: u32, distance: f64) -> [f64; 2] {
    let mut state = State::default();
    state.push(DVec3::ZERO, DVec3::ZERO, 1.0, 0.0);
    state.push(DVec3::X * distance, DVec3::ZERO, 1.0, 0.0);
    state.species_mut()[1] = species;
    let a = accelerations(&[law], &state, 0.0)[1];
    // Each of a pair holds half.
    [a.x, 2.0 * a.w]
}

fn near(got: [f64; 2], want: [f64; 2]) {
    let off = (got[0] - want[0]).abs().max((got[1] - want[1]).abs());
    assert!(off < 1e-13 * (1.0 + want[0].abs()), "{got:?} is not {want:?}");
}

#[test]
fn numbers_of_two_atoms() {
    let law = || cut(3.0, "cut", "within");
    near(two(law(), 0, 1.0), [24.0, 0.0]);
    near(two(law(), 0, 2f64.powf(1.0 / 6.0)), [0.0, -1.0]);
    near(two(law(), 0, 3.001), [0.0; 2]);
    // (1/2)⁶ = 1/64: 4 (1/4096 − 1/64), 24 (2/4096 − 1/64) / 2
    let [pull, value] = [24.0 * (2.0 / 4096.0 - 1.0 / 64.0) / 2.0, 4.0 * (1.0 / 4096.0 - 1.0 / 64.0)];
    near(two(law(), 0, 2.0), [pull, value]);
    let numbers = [
        ("epsilon", Value::Number(3.0)),
        ("sigma", Value::Number(0.5)),
        ("range", Value::Number(3.0)),
        ("truncation", word("cut")),
    ];
    near(two(lennard_jones(&numbers), 0, 1.0), [6.0 * pull, 3.0 * value]);
    // At the range 2.5, by an independent program: U = −0.016316891136, U' = 0.038999477.
    let end = 2.5f64.powi(-6);
    let (taken, slope) = (4.0 * end * (end - 1.0), 24.0 * end * (1.0 - 2.0 * end) / 2.5);
    assert!((taken + 0.016_316_891_136).abs() < 1e-12, "{taken}");
    near(two(cut(2.5, "shift", "within"), 0, 2.0), [pull, value - taken]);
    near(two(cut(2.5, "force_shift", "within"), 0, 2.0), [pull + slope, value - taken + 0.5 * slope]);
    // (R² − r²)² (R² + 2 r² − 3 a²) / (R² − a²)³ at r = 2, R = 2.5 and a = 1.75.
    let smooth = |onset: f64, r: f64| {
        let numbers = [("onset", Value::Number(onset)), ("range", Value::Number(2.5)), ("truncation", word("xplor"))];
        two(lennard_jones(&numbers), 0, r)
    };
    let (range, square, onset) = (6.25_f64, 4.0_f64, 3.0625_f64);
    let part = (range - square).powi(2) * (range + 2.0 * square - 3.0 * onset) / (range - onset).powi(3);
    assert!((smooth(0.7, 2.0)[1] - part * value).abs() < 1e-15);
    near(smooth(0.8, 2.0), [pull, value]);
    near(smooth(0.8, 1.9), two(law(), 0, 1.9));
    // Both end at 0, and the seam at the onset is smooth: slope and value differ by the way times U' and U''.
    for r in [1.75, 2.5] {
        let [below, above] = [smooth(0.7, r - 1e-7), smooth(0.7, r + 1e-7)];
        assert!((below[0] - above[0]).abs() < 1e-6 && (below[1] - above[1]).abs() < 1e-7, "{below:?} {above:?}");
    }
}

fn row(species: [u32; 2], epsilon: f64, sigma: f64) -> Pair {
    Pair { species, values: vec![("epsilon".to_owned(), epsilon), ("sigma".to_owned(), sigma)] }
}

fn mixed(mixing: &'static str, rows: Vec<Pair>) -> Box<dyn motes::forces::Component> {
    let numbers = [("epsilon", 2.0), ("sigma", 0.5), ("range", 9.0)].map(|(name, x)| (name, Value::Number(x)));
    let words = [("pairs", Value::Pairs(rows)), ("mixing", word(mixing)), ("truncation", word("cut"))];
    lennard_jones(&[&numbers[..], &words].concat())
}

#[test]
fn unlike_atoms_mix_where_they_are_not_given() {
    let like = || vec![row([0, 0], 1.0, 1.0), row([1, 1], 4.0, 4.0)];
    // 2 √(1 · 4) = 4; 0.5 (1 + 4) / 2 = 1.25, 0.5 √(1 · 4) = 1: U = 0 at σ, where F = 24 ε / σ.
    near(two(mixed("lorentz_berthelot", like()), 1, 1.25), [24.0 * 4.0 / 1.25, 0.0]);
    near(two(mixed("geometric", like()), 1, 1.0), [24.0 * 4.0, 0.0]);
    let explicit = || [like(), vec![row([1, 0], 3.0, 3.0)]].concat();
    for mixing in ["lorentz_berthelot", "geometric", "none"] {
        near(two(mixed(mixing, explicit()), 1, 1.5), [24.0 * 6.0 / 1.5, 0.0]);
        near(two(mixed(mixing, explicit()), 0, 0.5), [24.0 * 2.0 / 0.5, 0.0]);
    }
    let refused = |law, species: u32| {
        let mut state = spread(8, 1.0);
        state.species_mut().fill(0);
        state.species_mut()[3] = species;
        let all = setup(state, vec![law], motes::Bounds::default(), 0.01);
        match all.plans(motes::kernel::Machine::HOST).map(|_| ()) {
            Err(Error::Scene(why)) => why,
            other => panic!("{other:?}"),
        }
    };
    let why = refused(mixed("none", like()), 1);
    assert!(why.contains("no parameters for particles of species 0 and 1"), "{why}");
    let why = refused(mixed("geometric", like()), 2);
    assert!(why.contains("species 0 and 2, of species 2 and 2"), "{why}");
    // Without pairs all species are alike.
    near(two(cut(3.0, "cut", "within"), 7, 1.0), [24.0, 0.0]);
}

#[test]
fn laws_of_atoms_agree_with_their_references() {
    for name in choices::ATOMS.into_iter().filter(|name| *name != "born_mayer") {
        let entry = motes::forces::entry(name).expect("it");
        // Rows that are all given leave none to mix.
        let one = |settings: &motes::settings::Settings| ["", "none"].contains(&settings.text("mixing"));
        for settings in choices::variants(entry.keys).into_iter().filter(one) {
            for count in [2, 65, 333] {
                let mut state = spread(count, 0.8);
                let wide = 0.8 * side(count) as f64;
                let boxed = periodic(DVec3::splat(-0.4), DVec3::splat(wide - 0.4));
                let mut worlds = vec![motes::Bounds::default()];
                worlds.extend((count == 333).then_some(boxed));
                state.set("charge", Array::Float(vec![0.5; count])).expect("charges");
                for bounds in worlds {
                    let law = (entry.build)(&settings);
                    agrees(&setup(state.clone(), vec![law], bounds, 0.001), 1, 1.0, &[name]);
                }
            }
        }
    }
}

/// A pair that single precision finds in range, and double precision does not, has the energy at the range, and no NaN.
#[test]
fn a_pair_at_the_very_range_has_numbers() {
    let mut random = crate::support::Random::new(5);
    let mut found = 0;
    for _ in 0..4000 {
        let r = random.vector().normalize() * 12.0 * (1.0 + 2e-8);
        if !motes::Bounds::default().within(r, 12.0) {
            continue;
        }
        found += 1;
        for truncation in ["cut", "shift", "force_shift", "xplor"] {
            let law = lennard_jones(&[
                ("range", Value::Number(12.0)),
                ("sigma", Value::Number(4.0)),
                ("truncation", word(truncation)),
            ]);
            let mut state = State::default();
            state.push(DVec3::ZERO, DVec3::ZERO, 1.0, 0.0);
            state.push(r, DVec3::ZERO, 1.0, 0.0);
            let a = accelerations(&[law], &state, 0.0)[1];
            let sixth = 3f64.powi(-6);
            let want = if truncation == "cut" { 2.0 * sixth * (sixth - 1.0) } else { 0.0 };
            assert!((a.w - want).abs() < 1e-8 && a.truncate().length() < 1e-2, "{truncation}, {r}: {a}");
        }
    }
    assert!(found > 20, "{found} of such pairs");
}

#[test]
fn numbers_of_other_pairs() {
    let number = Value::Number;
    // exp(−2 (1.2 − 0.7)) = 1 / e
    let e = (-1f64).exp();
    let set = [
        ("depth", number(3.0)),
        ("steepness", number(2.0)),
        ("distance", number(0.7)),
        ("range", number(5.0)),
        ("truncation", word("cut")),
    ];
    near(two(force("morse", &set), 0, 1.2), [-12.0 * e * (1.0 - e), 3.0 * e * (e - 2.0)]);
    near(two(force("morse", &set), 0, 0.7), [0.0, -3.0]);
    let set =
        [("strength", number(-3.0)), ("screening", number(0.5)), ("range", number(5.0)), ("truncation", word("cut"))];
    near(two(force("yukawa", &set), 0, 2.0), [-3.0 * e * 0.5 * (0.5 + 0.5), -3.0 * e * 0.5]);
    let set = [("strength", number(3.0)), ("range", number(2.0))];
    near(two(force("soft", &set), 0, 0.5), [3.0 * 0.75, 3.0 * 0.75 * 0.75]);
    near(two(force("soft", &set), 0, 0.0), [0.0, 3.0]);
    let set = [("epsilon", number(3.0)), ("sigma", number(0.5))];
    near(two(force("wca", &set), 0, 0.5), [24.0 * 3.0 / 0.5, 3.0]);
    let minimum = 0.5 * 2f64.powf(1.0 / 6.0);
    let sixth = (0.5 / (minimum - 1e-4)).powi(6);
    let pull = 72.0 * sixth * (2.0 * sixth - 1.0) / (minimum - 1e-4);
    near(two(force("wca", &set), 0, minimum - 1e-4), [pull, 12.0 * sixth * (sixth - 1.0) + 3.0]);
    assert!(pull > 1e-2, "{pull}");
    near(two(force("wca", &set), 0, minimum + 1e-4), [0.0; 2]);
}
