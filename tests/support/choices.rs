//! Settings for every entry of a register, without naming it: no number in them is 0 or 1, so that a wrong operator shows.

use std::borrow::Cow;

use glam::DVec3;
use motes::forces::{self, Component, Entry};
use motes::motion::{Keyframe, Motion};
use motes::settings::{Key, Kind, Pair, Settings, Value};

/// Forces of several searches in a row, which take up what those before them left: they have tests of their own, in
/// `tests/physics/fluids` and `tests/mutants/fluids.rs`. Walls have no laws, and history: `tests/physics/matter` and
/// `tests/mutants/matter.rs`. Pedestrians on a plan: `tests/physics/crowds` and `tests/mutants/crowds.rs`. Bodies with radii: `tests/physics/collisions` and
/// `tests/mutants/collide.rs`.
const OWN: [&str; 6] = ["fluid", "contact_wall", "navigate", "social_wall", "collision_free_speed", "collide"];

/// Forces that want other states than a cloud of points: atoms apart, spheres that touch, pedestrians. `tests/physics/matter`,
/// `tests/physics/molecular`, `tests/physics/crowds`, `tests/mutants/matter.rs` and `tests/mutants/crowds.rs` have these.
const STATED: [&str; 11] = [
    "contact",
    "social_force",
    "walk",
    "nose_hoover",
    "langevin",
    "andersen",
    "berendsen",
    "csvr",
    "berendsen_pressure",
    "cell_rescaling",
    "minimize",
];

/// Laws of atoms that have no centre at one place.
pub const ATOMS: [&str; 7] = ["born_mayer", "coulomb", "lennard_jones", "wca", "morse", "yukawa", "soft"];

/// The entries of the register of forces, without those that have tests of their own.
pub fn entries() -> impl Iterator<Item = &'static Entry> {
    lawful().filter(|entry| !STATED.contains(&entry.name) && !ATOMS.contains(&entry.name))
}

/// The same, and those that want other states than a cloud: what every force must obey.
pub fn lawful() -> impl Iterator<Item = &'static Entry> {
    forces::entries().filter(|entry| !OWN.contains(&entry.name))
}

/// Fluids without friction, of which forces are the slope of the internal energy, with a cell list and with a list. Their settings contradict each other in
/// most combinations: all else that they may have is in `tests/physics/fluids`.
pub fn fluids() -> Vec<Settings> {
    let keys = forces::entry("fluid").expect("fluids").keys;
    let numbers = [("density", 0.7), ("spacing", 0.4375), ("support", 2.25), ("sound_speed", 0.3125), ("gamma", 3.0)];
    let mut all = Vec::new();
    for over in ["near", "list"] {
        for kernel in ["cubic", "wendland"] {
            let words = [("over", over), ("kernel", kernel)].map(|(key, word)| (key, Value::Text(Cow::Borrowed(word))));
            let settings =
                numbers.into_iter().fold(Settings::defaults(keys), |all, (key, x)| all.with(key, Value::Number(x)));
            let settings = settings.with("negative_pressure", Value::Flag(true));
            all.push(words.into_iter().fold(settings, |all, (key, word)| all.with(key, word)));
        }
    }
    all
}

/// Every combination of the words and flags that some keys accept; all numbers nudged away from their defaults.
pub fn variants(keys: &[Key]) -> Vec<Settings> {
    keys.iter().fold(vec![Settings::default()], |some, key| {
        let values = values(key);
        some.iter().flat_map(|s| values.iter().map(|v| s.clone().with(key.name, v.clone()))).collect()
    })
}

/// The forces of an entry in all its variants, each with a name for messages.
pub fn forces(entry: &Entry) -> Vec<(String, Box<dyn Component>)> {
    let named = |s: &Settings| (format!("{} {}", entry.name, words(s)), (entry.build)(s));
    variants(entry.keys).iter().map(named).collect()
}

/// What a key is set to: all its words, or one number that f32 holds.
fn values(key: &Key) -> Vec<Value> {
    match (key.kind, &key.default) {
        // Only a list lacks pairs: `tests/engine/neighbors/exclusions.rs`.
        _ if key.name == "exclude" => vec![Value::Number(0.0)],
        // Wants a column that not every state has: `tests/engine/tree/softenings.rs`.
        _ if key.name == "individual_softening" => vec![Value::Flag(false)],
        // What wants a box of its own has tests of its own.
        _ if key.name == "hubble" => vec![Value::Number(0.0)],
        (Kind::Choice(["nearest", "ewald"]), _) => vec![Value::Text("nearest".into())],
        // The faster one of two searches is one of them, and has tests of its own.
        (Kind::Choice(words), _) if words.contains(&"list") => {
            let all = words.iter().filter(|word| **word != "auto");
            all.map(|word| Value::Text(Cow::Borrowed(*word))).collect()
        }
        (Kind::Choice(words), _) => words.iter().map(|w| Value::Text(Cow::Borrowed(*w))).collect(),
        (Kind::Flag, _) => vec![Value::Flag(false), Value::Flag(true)],
        // What goes along with a motion has tests of its own.
        (Kind::Motion | Kind::Column, _) => vec![Value::Text("".into())],
        (Kind::Species, Some(Value::Number(n))) => vec![Value::Text("all".into()), Value::Number(n + 1.0)],
        (Kind::Species, _) => vec![Value::Text("all".into()), Value::Number(1.0)],
        (Kind::Pairs(keys), _) => vec![Value::Pairs(table(keys))],
        // That of a vacuum is 1.
        _ if key.name == "permittivity" => vec![Value::Number(5.125)],
        // Longer than any link in a cloud.
        _ if key.name == "max_length" => vec![Value::Number(4.125)],
        (_, None) => vec![nudged(key.kind, &default(key.kind))],
        (_, Some(value)) => vec![nudged(key.kind, value)],
    }
}

/// Coefficients of all pairs of species 0 to 2, in an order that is not sorted: other ones for each, that f32 holds.
pub fn table(keys: &[Key]) -> Vec<Pair> {
    let number = |a: u32, b: u32, place: usize| {
        0.3 + 0.125 * f64::from(a + 2 * a.max(b)) / (1.0 + place as f64) + 0.0625 * f64::from(b)
    };
    let row = |[a, b]: [u32; 2]| {
        let value = |(place, key): (usize, &Key)| (key.name.to_owned(), f64::from(number(a, b, place) as f32));
        Pair { species: [a, b], values: keys.iter().enumerate().map(value).collect() }
    };
    [[2, 0], [1, 1], [0, 1], [2, 2], [0, 0], [2, 1]].map(row).to_vec()
}

/// The motion that forces may go along with: numbers that are neither 0 nor 1, begun before the run and not over soon.
pub fn swing() -> Motion {
    let key = |time, shift: [f64; 3], turn: [f64; 3]| Keyframe { time, shift: shift.into(), turn: turn.into() };
    Motion {
        name: "swing".to_owned(),
        about: DVec3::new(0.3, -0.2, 0.6),
        keys: vec![
            key(-1.3, [0.13, 0.2, -0.3], [0.3, 0.2, -0.7]),
            key(2.9, [0.4, -0.25, 0.31], [0.7, -0.9, 0.4]),
            key(7.7, [-0.2, 0.6, 0.1], [-0.4, 2.3, 0.5]),
        ],
        smooth: true,
        repeat: false,
    }
}

/// Another value of the same kind: not the old one, not 0, not 1.
pub fn nudged(kind: Kind, value: &Value) -> Value {
    match value {
        // Above 0, and 1 at most.
        Value::Number(x) if kind == Kind::Fraction => {
            let more = x * 1.3 + 0.17;
            Value::Number(f64::from((if more < 1.0 { more } else { x * 0.6 }) as f32))
        }
        Value::Number(x) if matches!(kind, Kind::Whole | Kind::Count | Kind::Species) => Value::Number(x + 2.0),
        Value::Number(x) if *x > 1.0 && x.fract() == 0.0 => Value::Number(x + 2.0),
        Value::Number(x) => Value::Number(f64::from((x * 1.3 + 0.17) as f32)),
        Value::Vector(v) => Value::Vector((*v + DVec3::new(0.31, -0.23, 0.47)).as_vec3().as_dvec3()),
        Value::Flag(on) => Value::Flag(!on),
        Value::Text(_) if kind == Kind::Motion => Value::Text("swing".into()),
        Value::Text(word) => Value::Text(word.clone()),
        Value::Pairs(table) => {
            let mut table = table.clone();
            for (_, x) in table.iter_mut().flat_map(|pair| &mut pair.values) {
                *x = f64::from((*x * 1.3 + 0.17) as f32);
            }
            Value::Pairs(table)
        }
    }
}

fn default(kind: Kind) -> Value {
    match kind {
        Kind::Vector | Kind::Direction => Value::Vector(DVec3::new(0.2, 0.6, -0.4)),
        Kind::Count | Kind::Whole => Value::Number(3.0),
        _ => Value::Number(0.7),
    }
}

fn words(settings: &Settings) -> String {
    let word = |v: &Value| match v {
        Value::Text(t) => Some(t.to_string()),
        Value::Flag(on) => Some(on.to_string()),
        _ => None,
    };
    settings.0.values().filter_map(word).collect::<Vec<_>>().join(" ")
}
