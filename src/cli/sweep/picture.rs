//! The plot of a sweep of one number: errors over that number, with logarithmic axes where possible.

use std::path::Path;

use motes::Error;
use motes::run::plot::{Area, Axis, axes, fine, legend, line, text, write};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::outcome::Ended;
use super::vary::Varied;

const SIZE: (u32, u32) = (960, 600);
const ENERGY: RGBColor = RGBColor(150, 40, 110);
const DIFFERENCE: RGBColor = RGBColor(36, 104, 196);

type Points = Vec<(f64, f64)>;

/// Draws it. Returns whether there was anything to draw.
///
/// # Errors
/// [`Error::Output`] when the file cannot be written.
pub fn draw(path: &Path, name: &str, varied: &[Varied], ended: &[Ended<'_>]) -> Result<bool, Error> {
    let [one] = varied else { return Ok(false) };
    let Some(numbers) = one.numbers().filter(|numbers| numbers.len() == ended.len()) else { return Ok(false) };
    let points = |value: &dyn Fn(&Ended<'_>) -> Option<f64>| -> Points {
        let all = numbers.iter().zip(ended).filter_map(|(x, one)| Some((*x, value(one)?)));
        let mut points: Points = all.filter(|(x, y)| *x > 0.0 && *y > 0.0 && y.is_finite()).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points
    };
    let lines = [
        ("largest energy error", ENERGY, points(&|one| Some(one.worst_energy))),
        ("difference from the last run (rms)", DIFFERENCE, points(&|one| one.difference.map(|d| d[0]))),
    ];
    if lines.iter().all(|(_, _, points)| points.len() < 2) {
        return Ok(false);
    }
    write(path, SIZE, |root| panel(root, &format!("{name}: {}", one.key), &one.key, &lines))?;
    Ok(true)
}

/// The range of whole decades that contains some numbers.
fn decades(all: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = all.fold((f64::INFINITY, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
    let low = 10f64.powf(low.log10().floor());
    (low, 10f64.powf(high.log10().ceil()).max(10.0 * low))
}

fn panel(root: &Area, title: &str, key: &str, lines: &[(&str, RGBColor, Points)]) -> Result<(), String> {
    root.fill(&WHITE).map_err(|e| e.to_string())?;
    let style = text(20).pos(Pos::new(HPos::Left, VPos::Center));
    root.draw_text(title, &style, (fine(86), fine(26))).map_err(|e| e.to_string())?;
    let all = || lines.iter().flat_map(|(_, _, points)| points.iter());
    let (xs, ys) = (decades(all().map(|point| point.0)), decades(all().map(|point| point.1)));
    let mut chart = ChartBuilder::on(root)
        .margin(fine(14))
        .margin_top(fine(74))
        .margin_right(fine(30))
        .x_label_area_size(fine(46))
        .y_label_area_size(fine(76))
        .build_cartesian_2d((xs.0..xs.1).log_scale(), (ys.0..ys.1).log_scale())
        .map_err(|e| e.to_string())?;
    let power = |x: f64| format!("{x:.0e}");
    axes(&mut chart, &Axis::new(key, &power), &Axis::new("", &power))?;
    for (_, color, points) in lines {
        chart.draw_series(LineSeries::new(points.iter().copied(), line(*color, 2))).map_err(|e| e.to_string())?;
        let dots = points.iter().map(|at| Circle::new(*at, fine(4), color.filled()));
        chart.draw_series(dots).map_err(|e| e.to_string())?;
    }
    let drawn = lines.iter().filter(|(_, _, points)| points.len() > 1);
    let names: Vec<_> = drawn.map(|(name, color, _)| (*name, *color)).collect();
    legend(root, &names, (86, 56), 260)
}
