//! How the time of a step grows, out of the numbers that `cargo bench --bench baselines -- --json` gives.

use std::path::Path;

use motes::Error;
use motes::run::plot::{self, Area, Axis, axes, fine, text};
use plotters::prelude::*;
use serde_json::Value;

use crate::words::large;

const SIZE: (u32, u32) = (880, 520);
const BLUE: RGBColor = RGBColor(36, 104, 196);
const GRAY: RGBColor = RGBColor(150, 156, 168);
const ORANGE: RGBColor = RGBColor(214, 112, 32);
const GREEN: RGBColor = RGBColor(46, 140, 96);

/// What is measured at some sizes.
struct Line {
    /// Sizes, and the median time of a step in milliseconds.
    points: Vec<(f64, f64)>,
    name: String,
    color: RGBColor,
    /// The power of the size that a step is expected to grow with: drawn through the largest size.
    growth: i32,
}

/// Draws the searches of a bench.
///
/// # Errors
/// [`Error::Output`] when there is nothing to draw, or the file cannot be written.
pub fn neighbors(path: &Path, bench: &Value) -> Result<(), Error> {
    let line = |rows: &str, times: &str, name: &str, color| Line {
        points: points(&bench[rows], "agents", times),
        name: name.to_owned(),
        color,
        growth: 1,
    };
    let lines = [
        line("circles", "seconds_per_step", "circles, 33 neighbours each", BLUE),
        line("circles", "plain_seconds_per_step", "circles in plain Rust", GRAY),
        line("boids", "seconds_per_step", "boids, 7 neighbours each", ORANGE),
    ];
    write(
        path,
        "agents",
        &lines,
        "there are no searches to draw: let `cargo bench --bench baselines` measure neighbors",
    )
}

/// Draws gravity through a tree, the first way of opening it, and all pairs over the bodies of the first set.
///
/// # Errors
/// [`Error::Output`] when there is nothing to draw, or the file cannot be written.
pub fn tree(path: &Path, bench: &Value) -> Result<(), Error> {
    let sets = bench["tree"].as_array().map_or(&[][..], Vec::as_slice);
    let walk = |(set, color): (&Value, RGBColor)| {
        let variant = &set["variants"][0];
        let name = [&variant["name"], &set["set"]].map(|word| word.as_str().unwrap_or_default()).join(", ");
        Line {
            points: points(&variant["sizes"], "bodies", "seconds_per_step"),
            name: format!("tree, {name}"),
            color,
            growth: 1,
        }
    };
    let mut lines: Vec<Line> = sets.iter().zip([BLUE, ORANGE, GREEN]).map(walk).collect();
    if let Some(set) = sets.first() {
        let points = points(&set["pairs"], "bodies", "seconds_per_step");
        lines.push(Line { points, name: "all pairs".to_owned(), color: GRAY, growth: 2 });
    }
    write(path, "bodies", &lines, "there is no tree to draw: let `cargo bench --bench baselines -- tree` measure one")
}

/// Sizes and the median time of a step, in milliseconds.
fn points(rows: &Value, sizes: &str, times: &str) -> Vec<(f64, f64)> {
    let rows = rows.as_array().map_or(&[][..], Vec::as_slice);
    let point = |row: &Value| {
        let times: Vec<f64> = row[times].as_array()?.iter().filter_map(Value::as_f64).collect();
        (!times.is_empty()).then(|| Some((row[sizes].as_f64()?, 1e3 * crate::median(&times))))?
    };
    rows.iter().filter_map(point).collect()
}

fn write(path: &Path, sizes: &str, lines: &[Line], nothing: &str) -> Result<(), Error> {
    let fault = |message| Error::Output { file: path.to_owned(), message };
    if lines.iter().all(|line| line.points.is_empty()) {
        return Err(fault(nothing.to_owned()));
    }
    plot::write(path, SIZE, |root| draw(root, sizes, lines))
}

fn draw(root: &Area, sizes: &str, lines: &[Line]) -> Result<(), String> {
    let all = || lines.iter().flat_map(|line| &line.points);
    let ends = |of: fn(&(f64, f64)) -> f64| all().map(of).fold((f64::MAX, 0.0_f64), |(a, b), x| (a.min(x), b.max(x)));
    let (counts, times) = (ends(|p| p.0), ends(|p| p.1));
    root.fill(&WHITE).map_err(|e| e.to_string())?;
    let mut chart = ChartBuilder::on(root)
        .margin(fine(18))
        .x_label_area_size(fine(46))
        .y_label_area_size(fine(74))
        .build_cartesian_2d((0.8 * counts.0..1.25 * counts.1).log_scale(), (0.7 * times.0..1.5 * times.1).log_scale())
        .map_err(|e| e.to_string())?;
    axes(&mut chart, &Axis::new(sizes, &large), &Axis::new("a step [ms]", &|y| format!("{y}")))?;
    for Line { points, name, color, growth } in lines {
        let color = *color;
        // As it would be if a step grew just so on the way to the largest size.
        if let Some((most, time)) = points.last().copied() {
            let ideal = |n: f64| time * (n / most).powi(*growth);
            let least = counts.0.max(most * (0.7 * times.0 / time).powf(1.0 / f64::from(*growth)));
            let ends = [least, most].map(|n| (n, ideal(n)));
            chart
                .draw_series(LineSeries::new(ends, color.mix(0.35).stroke_width(fine(1).cast_unsigned())))
                .map_err(|e| e.to_string())?;
        }
        let dots = points.iter().map(|at| Circle::new(*at, fine(4), color.filled()));
        let series = chart.draw_series(dots).map_err(|e| e.to_string())?;
        series.label(name).legend(move |(x, y)| Circle::new((x + fine(8), y), fine(4), color.filled()));
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .margin(fine(14).cast_unsigned())
        .label_font(text(15))
        .draw()
        .map_err(|e| e.to_string())
}
