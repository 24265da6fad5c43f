//! `energy.svg`: energies over time, and their errors.

use std::io::Write;
use std::path::Path;

use crate::error::Error;
use crate::formats::atomically;
use crate::measure::Energy;
use plotters::coord::Shift;
use plotters::coord::ranged1d::{Ranged, ValueFormatter};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Width and height in pixels of a viewer.
const SIZE: (u32, u32) = (960, 720);
/// The number of units per pixel: the backend rounds to integers, and this makes lines smooth.
const FINE: u32 = 8;
/// The colour of axes and text.
pub const INK: RGBColor = RGBColor(38, 42, 51);
/// The colour of meshes.
pub const FAINT: RGBColor = RGBColor(226, 229, 235);
const KINETIC: RGBColor = RGBColor(214, 112, 32);
const POTENTIAL: RGBColor = RGBColor(36, 104, 196);
const DRIFT: RGBColor = RGBColor(150, 40, 110);
/// Errors below this are drawn at it: f64 cannot resolve them.
const FLOOR: f64 = 1e-16;

/// A part of a picture.
pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Points = Vec<(f64, f64)>;

/// Draws the measurements of a run: energies above, the relative error of the total below, or the drift of the momentum, where there is no
/// energy to compare with. Values that are not finite are left out.
///
/// # Errors
/// [`Error::Output`] when the file cannot be written.
pub fn energy(path: &Path, rows: &[Energy], title: &str) -> Result<(), Error> {
    write(path, SIZE, |root| panels(root, rows, title))
}

/// Draws into an SVG of `size` pixels, which is written when the drawing is complete.
///
/// # Errors
/// [`Error::Output`] when the file cannot be written.
pub fn write(path: &Path, size: (u32, u32), panels: impl FnOnce(&Area) -> Result<(), String>) -> Result<(), Error> {
    let failed = |message: String| Error::Output { file: path.to_owned(), message };
    let mut svg = String::new();
    draw(&mut svg, size, panels).map_err(&failed)?;
    atomically(path, |out| out.write_all(svg.as_bytes()))
}

fn draw(svg: &mut String, size: (u32, u32), panels: impl FnOnce(&Area) -> Result<(), String>) -> Result<(), String> {
    let (width, height) = (size.0 * FINE, size.1 * FINE);
    let root = SVGBackend::with_string(svg, (width, height)).into_drawing_area();
    let done = panels(&root).and_then(|()| root.present().map_err(|e| e.to_string()));
    drop(root);
    let shown = format!("width=\"{}\" height=\"{}\"", size.0, size.1);
    *svg = svg.replacen(&format!("width=\"{width}\" height=\"{height}\""), &shown, 1);
    done
}

fn panels(root: &Area, rows: &[Energy], title: &str) -> Result<(), String> {
    root.fill(&WHITE).map_err(|e| e.to_string())?;
    let style = text(22).pos(Pos::new(HPos::Left, VPos::Center));
    root.draw_text(title, &style, (fine(20), fine(28))).map_err(|e| e.to_string())?;
    let (_, below) = root.split_vertically(fine(52));
    let (upper, lower) = below.split_vertically(fine(370));
    // Above the upper panel, to the right, outside the lines.
    let names = [("kinetic", KINETIC), ("potential", POTENTIAL), ("total", INK)];
    legend(root, &names, (SIZE.0.cast_signed() - 320, 28), 105)?;
    energies(&upper, rows)?;
    errors(&lower, rows)
}

/// Pixels in units of the backend.
#[must_use]
pub fn fine(pixels: i32) -> i32 {
    pixels * FINE.cast_signed()
}

/// Text with a height of `size` pixels.
#[must_use]
pub fn text(size: i32) -> TextStyle<'static> {
    ("sans-serif", fine(size)).into_font().color(&INK)
}

/// A line of a width in pixels.
#[must_use]
pub fn line(color: RGBColor, width: u32) -> ShapeStyle {
    color.stroke_width(width * FINE)
}

/// One axis of a chart.
pub struct Axis<'a> {
    /// Its title; none if it is empty.
    pub title: &'a str,
    /// The maximum number of labels.
    pub labels: usize,
    /// The format of a number.
    pub format: &'a dyn Fn(f64) -> String,
}

impl<'a> Axis<'a> {
    /// An axis with at most ten labels.
    pub fn new(title: &'a str, format: &'a dyn Fn(f64) -> String) -> Self {
        Self { title, labels: 10, format }
    }
}

/// Draws the axes and the mesh of a chart, in the common style of all plots.
///
/// # Errors
/// Errors of the drawing.
pub fn axes<X, Y>(
    chart: &mut ChartContext<'_, SVGBackend<'_>, Cartesian2d<X, Y>>,
    x: &Axis,
    y: &Axis,
) -> Result<(), String>
where
    X: Ranged<ValueType = f64> + ValueFormatter<f64>,
    Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
{
    let (across, up) = (|value: &f64| (x.format)(*value), |value: &f64| (y.format)(*value));
    let mut mesh = chart.configure_mesh();
    mesh.axis_style(line(INK, 1))
        .bold_line_style(line(FAINT, 1))
        .light_line_style(TRANSPARENT)
        .label_style(text(14))
        .axis_desc_style(text(15))
        .set_all_tick_mark_size(fine(5))
        .x_labels(x.labels)
        .y_labels(y.labels)
        .x_label_formatter(&across)
        .y_label_formatter(&up);
    if !x.title.is_empty() {
        mesh.x_desc(x.title);
    }
    if !y.title.is_empty() {
        mesh.y_desc(y.title);
    }
    mesh.draw().map_err(|e| e.to_string())
}

fn energies(area: &Area, rows: &[Energy]) -> Result<(), String> {
    let lines = [
        (KINETIC, points(rows, |row| row.kinetic)),
        (POTENTIAL, points(rows, |row| row.potential)),
        (INK, points(rows, Energy::total)),
    ];
    let all = || lines.iter().flat_map(|(_, values)| values);
    let (times, values) = (times(rows), range(all().map(|(_, value)| *value)));
    let mut chart = ChartBuilder::on(area)
        .margin(fine(14))
        .margin_right(fine(30))
        .x_label_area_size(fine(28))
        .y_label_area_size(fine(86))
        .build_cartesian_2d(times.0..times.1, values.0..values.1)
        .map_err(|e| e.to_string())?;
    let x = Axis { labels: 8, ..Axis::new("", &short) };
    axes(&mut chart, &x, &Axis { labels: 6, ..Axis::new("energy", &short) })?;
    for (color, values) in &lines {
        chart.draw_series(LineSeries::new(values.iter().copied(), line(*color, 2))).map_err(|e| e.to_string())?;
        dots(values, |dots| chart.draw_series(dots.map(|at| Circle::new(at, fine(3), color.filled()))).map(drop))?;
    }
    Ok(())
}

/// Names beside dashes of their colours, in a row: the first dash begins at `at`, and successive ones are `apart` pixels apart.
///
/// # Errors
/// Errors of the backend.
pub fn legend(area: &Area, names: &[(&str, RGBColor)], at: (i32, i32), apart: i32) -> Result<(), String> {
    let style = text(14).pos(Pos::new(HPos::Left, VPos::Center));
    for (place, (name, color)) in (0..).zip(names) {
        let (x, y) = (fine(at.0 + apart * place), fine(at.1));
        let dash = PathElement::new([(x, y), (x + fine(20), y)], line(*color, 3));
        area.draw(&dash).map_err(|e| e.to_string())?;
        area.draw_text(name, &style, (x + fine(27), y)).map_err(|e| e.to_string())?;
    }
    Ok(())
}

fn errors(area: &Area, rows: &[Energy]) -> Result<(), String> {
    let (what, values) = drift(rows);
    let largest = values.iter().map(|(_, error)| *error).fold(FLOOR, f64::max);
    let smallest = values.iter().map(|(_, error)| *error).filter(|error| *error > FLOOR).fold(largest, f64::min);
    let low = 10f64.powf(smallest.log10().floor().max(FLOOR.log10()));
    let high = 10f64.powf((largest * 1.001).log10().ceil()).max(low * 100.0);
    let times = times(rows);
    let mut chart = ChartBuilder::on(area)
        .margin(fine(14))
        .margin_right(fine(30))
        .x_label_area_size(fine(46))
        .y_label_area_size(fine(86))
        .build_cartesian_2d(times.0..times.1, (low..high).log_scale())
        .map_err(|e| e.to_string())?;
    let x = Axis { labels: 8, ..Axis::new("time", &short) };
    axes(&mut chart, &x, &Axis { labels: 6, ..Axis::new(what, &|y| format!("{y:.0e}")) })?;
    // A logarithmic axis cannot show a zero error: it is left out, or drawn on the lower edge if all errors are zero.
    let none = values.iter().all(|(_, error)| *error == 0.0);
    let seen = values.into_iter().filter(|(_, error)| none || *error > 0.0);
    let values: Points = seen.map(|(time, error)| (time, error.max(low))).collect();
    chart.draw_series(LineSeries::new(values.iter().copied(), line(DRIFT, 2))).map_err(|e| e.to_string())?;
    dots(&values, |dots| chart.draw_series(dots.map(|at| Circle::new(at, fine(3), DRIFT.filled()))).map(drop))
}

/// A line of one or two points is hard to see without dots.
fn dots<E: std::fmt::Display>(
    values: &[(f64, f64)],
    draw: impl FnOnce(std::iter::Copied<std::slice::Iter<'_, (f64, f64)>>) -> Result<(), E>,
) -> Result<(), String> {
    if values.len() > 2 {
        return Ok(());
    }
    draw(values.iter().copied()).map_err(|e| e.to_string())
}

/// The label of the lower panel, and the line in it.
fn drift(rows: &[Energy]) -> (&'static str, Points) {
    let Some(first) = rows.first() else {
        return ("|ΔE / E₀|", Points::new());
    };
    if first.total() != 0.0 && rows.iter().any(|row| row.potential != 0.0) {
        return ("|ΔE / E₀|", points(rows, |row| row.drift_from(first).abs()));
    }
    let start = first.momentum.length();
    let label = if start > 0.0 { "|Δp / p₀|" } else { "|Δp|" };
    let scale = if start > 0.0 { start } else { 1.0 };
    (label, points(rows, |row| (row.momentum - first.momentum).length() / scale))
}

fn points(rows: &[Energy], value: impl Fn(&Energy) -> f64) -> Points {
    rows.iter()
        .map(|row| (row.time, value(row)))
        .filter(|(time, value)| time.is_finite() && value.is_finite())
        .collect()
}

/// The range of times; never empty.
fn times(rows: &[Energy]) -> (f64, f64) {
    let finite = || rows.iter().map(|row| row.time).filter(|time| time.is_finite());
    let (first, last) = (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max));
    if first < last { (first, last) } else { range(finite()) }
}

/// The range of values with a margin; never empty.
fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let finite = values.filter(|x| x.is_finite());
    let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    if low > high {
        return (0.0, 1.0);
    }
    let size = low.abs().max(high.abs());
    // A constant is a line in the middle, rather than noise scaled to the height of the panel.
    let room = if high - low > 1e-9 * size {
        0.06 * (high - low)
    } else if size > 0.0 {
        0.1 * size
    } else {
        1.0
    };
    (low - room, high + room)
}

/// At most four digits: `-0.25`, `1200`, `6.67e-11`.
fn short(x: f64) -> String {
    let size = x.abs();
    if size != 0.0 && !(1e-3..1e5).contains(&size) {
        let text = format!("{x:.2e}");
        return text.replace(".00e", "e").replace("0e", "e");
    }
    let text = format!("{x:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn svg(rows: &[Energy]) -> String {
        let mut svg = String::new();
        draw(&mut svg, SIZE, |root| panels(root, rows, "a <test>")).unwrap();
        svg
    }

    #[test]
    fn any_rows_give_a_picture_without_broken_numbers() {
        let row = |time: f64, kinetic: f64, potential: f64| Energy { time, kinetic, potential, ..Energy::default() };
        for rows in [
            vec![],
            vec![row(0.0, 0.0, 0.0)],
            vec![row(0.0, 1.5, -3.0)],
            vec![row(0.0, 1.5, -3.0); 3],
            vec![row(0.0, 1.5, -3.0), row(1.0, f64::NAN, -3.1), row(2.0, 1.6, f64::INFINITY), row(3.0, 1.7, -3.1)],
            vec![row(0.0, 0.0, 0.0), row(1.0, 2.0, 0.0)],
            vec![row(0.0, 1e300, -2e300), row(1e-300, 1.1e300, -2e300)],
            vec![row(0.0, 1e-300, -2e-300), row(1e300, 1.1e-300, -2e-300)],
        ] {
            let svg = svg(&rows);
            assert!(svg.ends_with("</svg>\n") && svg.contains("kinetic") && svg.contains("a &lt;test&gt;"));
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{rows:?}");
        }
    }
    #[test]
    fn labels_are_short() {
        let cases =
            [(-0.25, "-0.25"), (1200.0, "1200"), (6.67e-11, "6.67e-11"), (1e9, "1e9"), (-0.0, "0"), (2e10, "2e10")];
        for (x, text) in cases {
            assert_eq!(short(x), text);
        }
    }
}
