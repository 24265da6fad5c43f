//! The table of a sweep, as text and as CSV.

use std::io::Write;
use std::path::Path;

use motes::Error;
use motes::formats::atomically;

use super::outcome::Ended;
use super::vary::Varied;

const COLUMNS: [&str; 8] = [
    "steps",
    "dt",
    "seconds",
    "energy_error",
    "worst_energy_error",
    "momentum_change",
    "difference_rms",
    "difference_max",
];

fn numbers(one: &Ended<'_>) -> [Option<f64>; 5] {
    let some = |x: f64| Some(x).filter(|x| x.is_finite());
    [
        some(one.energy),
        some(one.worst_energy),
        some(one.momentum),
        one.difference.map(|d| d[0]),
        one.difference.map(|d| d[1]),
    ]
}

/// Writes it as comma-separated values; the last column is the reason of a failure.
///
/// # Errors
/// [`Error::Output`] when the file cannot be written.
pub fn write(path: &Path, varied: &[Varied], ended: &[Ended<'_>]) -> Result<(), Error> {
    let quoted = |text: &str| format!("\"{}\"", text.replace('"', "\"\""));
    let keys = varied.iter().map(|one| one.key.as_str()).chain(COLUMNS).chain(["error"]);
    let mut text = keys.collect::<Vec<_>>().join(",") + "\n";
    for one in ended {
        let mut words: Vec<String> = one
            .values()
            .iter()
            .map(|value| if value.contains([',', '"']) { quoted(value) } else { (*value).to_owned() })
            .collect();
        words.extend([one.steps.to_string(), format!("{:?}", one.dt), format!("{:?}", one.seconds)]);
        words.extend(numbers(one).map(|x| x.map_or_else(String::new, |x| format!("{x:?}"))));
        words.push(one.error.as_deref().map_or_else(String::new, quoted));
        text += &(words.join(",") + "\n");
    }
    atomically(path, |out| out.write_all(text.as_bytes()))
}

/// The same as text.
pub fn text(varied: &[Varied], ended: &[Ended<'_>]) -> String {
    let head = ["steps", "seconds", "energy error", "largest", "momentum", "difference (rms)", "largest"];
    let mut rows: Vec<Vec<String>> =
        vec![varied.iter().map(|one| one.key.as_str()).chain(head).map(str::to_owned).collect()];
    for one in ended {
        let mut row: Vec<String> = one.values().into_iter().map(str::to_owned).collect();
        if let Some(error) = &one.error {
            row.push(format!("failed: {}", error.lines().next().unwrap_or_default()));
        } else {
            row.extend([one.steps.to_string(), format!("{:.2}", one.seconds)]);
            row.extend(numbers(one).map(|x| x.map_or_else(|| "-".to_owned(), |x| format!("{x:.1e}"))));
        }
        rows.push(row);
    }
    // The reason of a failure follows all columns, and does not widen any.
    let failed = |row: &[String], place: usize| row.len() == varied.len() + 1 && place == varied.len();
    let width = |place: usize| {
        let cells = rows.iter().filter(|row| !failed(row, place)).filter_map(|row| row.get(place));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..rows[0].len()).map(width).collect();
    let line = |row: &Vec<String>| {
        let cells = row.iter().enumerate().map(|(place, cell)| {
            if failed(row, place) { cell.clone() } else { format!("{cell:>width$}", width = widths[place]) }
        });
        cells.collect::<Vec<_>>().join("  ")
    };
    let what = "difference: of the final positions from those of the last run that finished";
    rows.iter().map(line).chain([what.to_owned()]).collect::<Vec<_>>().join("\n")
}
