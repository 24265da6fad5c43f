//! `--scale`: the same scene with more or fewer particles. Fluids and lattices fill the same space by a wider or narrower spacing, and
//! keep their mass.

use motes::scene::Scene;
use motes::settings::Key;
use motes::shapes::{Resolution, SHAPES};
use toml::{Table, Value};

/// The values that multiply the number of particles of a scene by a factor, as `--set` takes them.
pub fn overrides(scene: &Scene, factor: f64) -> Vec<String> {
    // It was written with every value, and is read again without faults.
    let root: Table = scene.resolved.parse().unwrap_or_default();
    let narrower = factor.powf(if scene.bounds.dimensions == 2 { 1.0 / 2.0 } else { 1.0 / 3.0 });
    let mut all = Vec::new();
    for section in ["particles", "emitter", "force"] {
        let tables = root.get(section).and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_table);
        for (number, table) in tables.enumerate() {
            let word = |key: &str| table.get(key).and_then(Value::as_str);
            let values = match section {
                "particles" => word("shape")
                    .and_then(|name| SHAPES.iter().find(|shape| shape.name == name))
                    .map(|shape| shaped(shape.resolution, table, [factor, narrower])),
                "emitter" => Some(emitted(table, [factor, narrower])),
                _ => word("kind")
                    .and_then(motes::forces::entry)
                    .filter(|entry| has_spacing(entry.keys))
                    .map(|_| spaced(table, narrower)),
            };
            let set = |(key, value): (&'static str, String)| format!("{section}.{number}.{key}={value}");
            all.extend(values.unwrap_or_default().into_iter().map(set));
        }
    }
    all
}

type Values = Vec<(&'static str, String)>;

fn has_spacing(keys: &[Key]) -> bool {
    keys.iter().any(|key| key.of_fluid && key.name == "spacing")
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
        Resolution::Spacing => return spaced(table, narrower),
        Resolution::Grid { keys, least } => (keys.iter().filter_map(|key| at(table, key)).collect(), least, 1.0),
        Resolution::Cells { key, least, periodic } => {
            let list = table.get(key).and_then(Value::as_array);
            (list.into_iter().flatten().filter_map(number).collect(), least, if periodic { 0.0 } else { 1.0 })
        }
    };
    // Along axes of one particle there is nothing to divide.
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

/// A count of at least so many.
fn whole(count: f64, least: u32) -> String {
    format!("{}", count.round().max(f64::from(least)))
}
