//! Keys and parameters that components share.

use std::borrow::Cow;

use crate::error::Error;
use crate::kernel::Scalar;
use crate::links::too_many_bonds;
use crate::settings::{Key, Kind, Settings, Value};
use crate::visit::{Law, Over};

/// The settings that a shader's `Params` contains under the same names.
pub fn params(settings: &Settings, names: &[&str]) -> Vec<(String, Scalar)> {
    let scalar = |name: &&str| {
        let value = match settings.0.get(*name) {
            Some(Value::Vector(v)) => Scalar::Vector(*v),
            _ => Scalar::Float(settings.number(name)),
        };
        ((*name).to_owned(), value)
    };
    names.iter().map(scalar).collect()
}

/// Which pairs are evaluated, where a force has a cut-off radius; `of` is the species of the neighbours.
pub fn over(settings: &Settings, of: Option<u32>) -> Over {
    over_within(settings, settings.number("range"), of)
}

/// The same within a range that has no key of its own.
pub fn over_within(settings: &Settings, range: f64, of: Option<u32>) -> Over {
    let skin = Some(settings.number("skin")).filter(|skin| *skin > 0.0);
    match settings.text("over") {
        "within" => Over::Within { range },
        "list" => Over::List { range, skin, slots: 0 },
        // A cell list of one species is shorter than a list of all, and no list is of one.
        "auto" if of.is_none() => Over::Auto { range, skin },
        _ => Over::Near { range, of },
    }
}

/// The search for neighbours.
pub const SEE_NEAR: Key = Key::new(
    "over",
    Kind::Choice(&["near", "list", "auto", "within"]),
    Value::Text(Cow::Borrowed("near")),
    "how neighbours in range are found: by a cell list, by a neighbour list that is reused over steps, by the faster of both, or by brute force",
);

/// The distance by which a list exceeds the range.
pub const SKIN: Key = Key::new(
    "skin",
    Kind::NotNegative,
    Value::Number(0.0),
    "over = \"list\" or \"auto\": the skin of the neighbour list beyond the range; 0: a fifth of the range, and chosen anew while it runs [length]",
);

/// Pairs of few bonds.
pub const EXCLUDE: Key = Key::new(
    "exclude",
    Kind::Whole,
    Value::Number(0.0),
    "over = \"list\" or \"auto\": pairs up to so many bonds apart (springs, ropes and rods) are left out: 1, 1–2 pairs; 2, 1–3 pairs too; 3, 1–4 pairs too; 0: none",
);

/// A law without the pairs that settings leave out.
pub fn excluding(settings: &Settings, law: Law) -> Law {
    law.excluding(u32::try_from(settings.whole("exclude")).unwrap_or(u32::MAX))
}

/// Checks that a list is kept that can lack pairs.
pub fn check_exclude(settings: &Settings) -> Result<(), Error> {
    let bonds = settings.number("exclude");
    let over = settings.text("over");
    let why = if let Some(why) = too_many_bonds(bonds) {
        why
    } else if bonds > 0.0 && !["list", "auto"].contains(&over) {
        format!("exclude = {bonds} beside over = \"{over}\": only a kept list lacks pairs; set over = \"list\"")
    } else {
        return Ok(());
    };
    Err(Error::Setting { key: "exclude", why })
}

/// The seed of random numbers.
pub const SEED: Key =
    Key::new("seed", Kind::Whole, Value::Number(1.0), "seed of the random numbers, counted by id and step");

/// The words of the seed, as in shaders.
pub fn seed(settings: &Settings) -> [(String, Scalar); 2] {
    let [low, high] = crate::visit::random::words(settings.whole("seed"));
    [("seed_low".to_owned(), Scalar::Uint(low)), ("seed_high".to_owned(), Scalar::Uint(high))]
}

/// Whether r is shorter than a range, by the device's own arithmetic.
pub fn is_nearer(r: glam::DVec3, range: f64) -> bool {
    #[expect(clippy::cast_possible_truncation, reason = "as the device holds it")]
    let (r, range) = (r.as_vec3(), range as f32);
    r.length_squared() < range * range
}

/// Each particle alone.
pub const EACH: Key = Key::new(
    "over",
    Kind::Choice(&["each"]),
    Value::Text(Cow::Borrowed("each")),
    "what is evaluated: single particles",
);
