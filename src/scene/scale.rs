//! `--scale`: the same scene with more or fewer particles. Fluids and lattices fill the same space by a wider or narrower spacing, and
//! keep their mass.

use toml::{Table, Value};

use super::Scene;
use crate::error::Error;
use crate::settings::Key;
use crate::shapes::{self, Resolution};

/// The overrides, in the form of `--set`, that multiply the number of particles of a scene by a factor.
///
/// # Errors
/// [`Error::Scene`] if the scene has no other resolution: it names particles by their ids, or they are ions or single bodies.
pub fn overrides(scene: &Scene, factor: f64) -> Result<Vec<String>, Error> {
    // The resolved scene has every value, and parses without errors.
    let root: Table = scene.resolved.parse().unwrap_or_default();
    refuse(&root)?;
    let narrower = factor.powf(if scene.bounds.dimensions == 2 { 1.0 / 2.0 } else { 1.0 / 3.0 });
    let narrower = fitting(&root, narrower);
    let mut all = Vec::new();
    for section in ["particles", "emitter", "force"] {
        for (number, table) in tables(&root, section).enumerate() {
            let word = |key: &str| table.get(key).and_then(Value::as_str);
            let values = match section {
                "particles" => word("shape")
                    .and_then(shapes::shape)
                    .map(|shape| shaped(shape.resolution, table, [factor, narrower])),
                "emitter" => Some(emitted(table, [factor, narrower])),
                _ => word("kind")
                    .and_then(crate::forces::entry)
                    .filter(|entry| has_spacing(entry.keys))
                    .map(|_| spaced(table, narrower)),
            };
            let set = |(key, value): (&'static str, String)| format!("{section}.{number}.{key}={value}");
            all.extend(values.unwrap_or_default().into_iter().map(set));
        }
    }
    if all.is_empty() {
        return Err(Error::Scene(format!(
            "--scale: `{}` has no shape with an adjustable number of particles: leave it out",
            scene.name
        )));
    }
    Ok(all)
}

/// Refuses scenes that depend on their number of particles.
fn refuse(root: &Table) -> Result<(), Error> {
    let refused = |what: &str| {
        Err(Error::Scene(format!(
            "--scale: {what}, which holds for the number of particles of the scene alone: leave it out"
        )))
    };
    if root.contains_key("links") {
        return refused("the scene links particles by their ids ([[links]])");
    }
    for table in tables(root, "particles") {
        if table.get("fixed").and_then(Value::as_array).is_some_and(|list| !list.is_empty()) {
            return refused("the scene names fixed particles by their ids (`fixed`)");
        }
    }
    let kind = |table: &Table| table.get("kind").and_then(Value::as_str).unwrap_or_default().to_owned();
    let touch = |table: &Table| {
        ["contact", "contact_wall"].contains(&kind(table).as_str())
            || table.get("grains").and_then(Value::as_bool) == Some(true)
    };
    if tables(root, "force").any(touch) {
        return refused("the scene has grains, and its walls and its time step fit their radius");
    }
    if tables(root, "force").any(|table| table.contains_key("pairs")) {
        return refused("the scene has atoms, and its box and the ranges of their forces fit their number");
    }
    Ok(())
}

fn tables<'a>(root: &'a Table, section: &str) -> impl Iterator<Item = &'a Table> {
    root.get(section).and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_table)
}

/// A factor of the spacing of a fluid close to `narrower`, such that blocks and tanks remain whole numbers of spacings.
fn fitting(root: &Table, narrower: f64) -> f64 {
    let mut common = 0_u64;
    for table in tables(root, "particles") {
        let shape = table.get("shape").and_then(Value::as_str).and_then(shapes::shape);
        let spacing =
            at(table, "spacing").filter(|_| shape.is_some_and(|shape| shape.resolution == Resolution::Spacing));
        let sides = table.get("size").and_then(Value::as_array).into_iter().flatten().filter_map(number);
        let Some(spacing) = spacing else { continue };
        for cells in sides.map(|side| side / spacing) {
            if (cells - cells.round()).abs() > 1e-6 * cells.max(1.0) {
                return narrower;
            }
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a number of spacings")]
            let cells = cells.round() as u64;
            common = divisor(common, cells);
        }
    }
    if common == 0 {
        return narrower;
    }
    (common as f64 * narrower).round().max(1.0) / common as f64
}

/// The greatest common divisor (Euclid).
fn divisor(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { divisor(b, a % b) }
}

type Values = Vec<(&'static str, String)>;

fn has_spacing(keys: &[Key]) -> bool {
    keys.iter().any(|key| key.shared && key.name == "spacing")
}

fn number(value: &Value) -> Option<f64> {
    #[expect(clippy::cast_precision_loss, reason = "a count")]
    value.as_float().or_else(|| value.as_integer().map(|n| n as f64))
}

fn at(table: &Table, key: &str) -> Option<f64> {
    table.get(key).and_then(number)
}

fn spaced(table: &Table, narrower: f64) -> Values {
    at(table, "spacing").map(|spacing| ("spacing", format!("{:?}", spacing / narrower))).into_iter().collect()
}

fn emitted(table: &Table, [factor, narrower]: [f64; 2]) -> Values {
    let count = at(table, "count").filter(|count| *count > 0.0).map(|count| ("count", whole(count * factor, 1)));
    let rate = at(table, "rate").filter(|rate| *rate > 0.0).map(|rate| ("rate", format!("{:?}", rate * factor)));
    count.into_iter().chain(rate).chain(spaced(table, narrower)).collect()
}

fn shaped(resolution: Resolution, table: &Table, [factor, narrower]: [f64; 2]) -> Values {
    let (counts, least, periods): (Vec<f64>, u32, f64) = match resolution {
        Resolution::Count { key, least } => {
            return at(table, key).map(|count| (key, whole(count * factor, least))).into_iter().collect();
        }
        Resolution::Cube { key, least } => {
            let part = factor.cbrt();
            return at(table, key).map(|count| (key, whole(count * part, least))).into_iter().collect();
        }
        Resolution::Own => return Values::new(),
        Resolution::Spacing => return spaced(table, narrower),
        Resolution::Grid { keys, least } => (keys.iter().filter_map(|key| at(table, key)).collect(), least, 1.0),
        Resolution::Cells { key, least, periodic } => {
            let list = table.get(key).and_then(Value::as_array);
            (list.into_iter().flatten().filter_map(number).collect(), least, if periodic { 0.0 } else { 1.0 })
        }
    };
    // Axes with one particle are not divided.
    let axes = counts.iter().filter(|count| **count > 1.0).count().max(1);
    let part = factor.powf(1.0 / axes as f64);
    let scaled: Vec<f64> = counts
        .iter()
        .map(|count| if *count > 1.0 { (count * part).round().max(f64::from(least)) } else { *count })
        .collect();
    let words: Vec<_> = scaled.iter().map(|count| format!("{count}")).collect();
    let mut values: Values = match resolution {
        Resolution::Grid { keys, .. } => keys.iter().copied().zip(words).collect(),
        Resolution::Cells { key, .. } => vec![(key, format!("[{}]", words.join(", ")))],
        _ => Vec::new(),
    };
    let longest = counts.iter().zip(&scaled).max_by(|a, b| a.0.total_cmp(b.0));
    let wider = longest.map_or(1.0, |(before, after)| (before - periods) / (after - periods));
    let heavier = counts.iter().product::<f64>() / scaled.iter().product::<f64>();
    for (key, by) in [("spacing", wider), ("mass", heavier)] {
        values.extend(at(table, key).map(|value| (key, format!("{:?}", value * by))));
    }
    values
}

/// A scaled count with a minimum.
fn whole(count: f64, least: u32) -> String {
    format!("{}", count.round().max(f64::from(least)))
}
