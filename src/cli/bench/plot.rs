//! How the time of a step grows with the agents, out of the numbers that `motes bench --json` gives.

use std::path::Path;

use motes::Error;
use motes::io::atomically;
use plotters::prelude::*;
use serde_json::Value;

const SIZE: (u32, u32) = (880, 520);
const INK: RGBColor = RGBColor(38, 42, 51);
const FAINT: RGBColor = RGBColor(226, 229, 235);
/// What is drawn: the rows, the times in them, what it is called, its colour.
const LINES: [(&str, &str, &str, RGBColor); 3] = [
    ("circles", "seconds_per_step", "circles, 33 neighbours each", RGBColor(36, 104, 196)),
    ("circles", "plain_seconds_per_step", "circles in plain Rust", RGBColor(150, 156, 168)),
    ("boids", "seconds_per_step", "boids, 7 neighbours each", RGBColor(214, 112, 32)),
];

/// Draws the searches of a bench.
///
/// # Errors
/// [`Error::Output`] when there is nothing to draw, or the file cannot be written.
pub fn neighbors(path: &Path, bench: &Value) -> Result<(), Error> {
    let mut svg = String::new();
    draw(&mut svg, bench).map_err(|message| Error::Output { file: path.to_owned(), message })?;
    atomically(path, |out| std::io::Write::write_all(out, svg.as_bytes()))
}

/// Agents and the median time of a step, in milliseconds.
fn points(bench: &Value, rows: &str, times: &str) -> Vec<(f64, f64)> {
    let rows = bench[rows].as_array().map_or(&[][..], Vec::as_slice);
    let point = |row: &Value| {
        let times: Vec<f64> = row[times].as_array()?.iter().filter_map(Value::as_f64).collect();
        (!times.is_empty()).then(|| Some((row["agents"].as_f64()?, 1e3 * super::median(&times))))?
    };
    rows.iter().filter_map(point).collect()
}

fn draw(svg: &mut String, bench: &Value) -> Result<(), String> {
    let lines = LINES.map(|(rows, times, name, color)| (points(bench, rows, times), name, color));
    let all = || lines.iter().flat_map(|(points, _, _)| points);
    let ends = |of: fn(&(f64, f64)) -> f64| all().map(of).fold((f64::MAX, 0.0_f64), |(a, b), x| (a.min(x), b.max(x)));
    let (agents, times) = (ends(|p| p.0), ends(|p| p.1));
    if agents.1 <= 0.0 || times.0 <= 0.0 {
        return Err("there are no searches to draw: let `motes bench` measure neighbors".to_owned());
    }
    let root = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    root.fill(&WHITE).map_err(|e| e.to_string())?;
    let mut chart = ChartBuilder::on(&root)
        .margin(18)
        .x_label_area_size(46)
        .y_label_area_size(74)
        .build_cartesian_2d((0.8 * agents.0..1.25 * agents.1).log_scale(), (0.7 * times.0..1.5 * times.1).log_scale())
        .map_err(|e| e.to_string())?;
    let text = |size: i32| ("sans-serif", size).into_font().color(&INK);
    chart
        .configure_mesh()
        .axis_style(INK)
        .bold_line_style(FAINT)
        .light_line_style(TRANSPARENT)
        .label_style(text(14))
        .axis_desc_style(text(15))
        .x_desc("agents")
        .y_desc("a step [ms]")
        .x_label_formatter(&|x| super::large(*x))
        .y_label_formatter(&|y| format!("{y}"))
        .draw()
        .map_err(|e| e.to_string())?;
    for (points, name, color) in lines {
        // As it would be if a step took as long for every agent as it does in the largest flock.
        if let Some((most, time)) = points.last().copied() {
            let straight = [agents.0, most].map(|n| (n, time * n / most));
            chart.draw_series(LineSeries::new(straight, color.mix(0.35))).map_err(|e| e.to_string())?;
        }
        let dots = points.iter().map(|at| Circle::new(*at, 4, color.filled()));
        let series = chart.draw_series(dots).map_err(|e| e.to_string())?;
        series.label(name).legend(move |(x, y)| Circle::new((x + 8, y), 4, color.filled()));
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .margin(14)
        .label_font(text(15))
        .draw()
        .map_err(|e| e.to_string())?;
    root.present().map_err(|e| e.to_string())
}
