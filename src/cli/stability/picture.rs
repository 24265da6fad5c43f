//! The picture: energies above, what decays below, one curve for each integrator, with its name where it ends.

use std::path::Path;

use motes::Error;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::Course;
use crate::cli::args::StabilityArgs;
use crate::cli::plot::{Area, FAINT, INK, fine, line, text, write};

const SIZE: (u32, u32) = (1040, 1000);
/// Pixels between two names.
const APART: i32 = 19;
/// So many decades up and down are shown.
const DECADES: i32 = 4;

/// The color of an integrator: warm for explicit ones that lose or gain, blue and green for symplectic ones, violet for
/// implicit ones.
fn color(name: &str) -> RGBColor {
    match name {
        "forward_euler" => RGBColor(196, 30, 38),
        "midpoint" => RGBColor(236, 112, 30),
        "heun" => RGBColor(250, 160, 90),
        "rk4" => RGBColor(212, 154, 0),
        "symplectic_euler" => RGBColor(22, 140, 110),
        "leapfrog" => RGBColor(36, 104, 196),
        "forest_ruth" => RGBColor(90, 170, 220),
        "pefrl" => RGBColor(20, 52, 120),
        name if name.ends_with("backward_euler") => RGBColor(124, 58, 170),
        name if name.ends_with("midpoint") => RGBColor(196, 80, 170),
        name if name.ends_with("trapezoid") => RGBColor(110, 90, 130),
        _ => INK,
    }
}

/// Integrators that do the same, under one name.
struct Curve<'a> {
    name: String,
    color: RGBColor,
    values: &'a [f64],
}

/// Draws the courses into a file.
///
/// # Errors
/// [`Error::Output`] when the file cannot be written.
pub fn draw(path: &Path, courses: &[Course], args: &StabilityArgs) -> Result<(), Error> {
    write(path, SIZE, |root| {
        root.fill(&WHITE).map_err(|e| e.to_string())?;
        let (above, below) = root.split_vertically(fine(520));
        let swings = (
            curves(courses, |c| &c.energy),
            format!("x″ = −ω² x,  h ω = {}", args.omega_step),
            "energy / energy at the start",
        );
        let decays =
            (curves(courses, |c| &c.size), format!("u′ = −a u,  h a = {}", args.decay_step), "|u| / |u| at the start");
        panel(&above, &swings.0, &swings.1, swings.2, args.steps)?;
        panel(&below, &decays.0, &decays.1, decays.2, args.steps)
    })
}

/// One curve for all that differ by less than a line's width everywhere.
fn curves<'a>(courses: &'a [Course], values: fn(&Course) -> &Vec<f64>) -> Vec<Curve<'a>> {
    let mut list: Vec<Curve> = Vec::new();
    for course in courses {
        let own = values(course);
        let level = |x: f64| shown(x).log10();
        let same = |curve: &&mut Curve| curve.values.iter().zip(own).all(|(a, b)| (level(*a) - level(*b)).abs() < 0.02);
        match list.iter_mut().find(same) {
            Some(curve) => curve.name += &format!(", {}", course.name),
            None => list.push(Curve { name: course.name.to_owned(), color: color(course.name), values: own }),
        }
    }
    list
}

/// Within a decade of what is shown, so that equal curves are equal where nobody sees them.
fn shown(x: f64) -> f64 {
    let edge = 10f64.powi(DECADES + 1);
    if x.is_finite() { x.abs().clamp(1.0 / edge, edge) } else { edge }
}

fn panel(area: &Area, curves: &[Curve], title: &str, what: &str, steps: u32) -> Result<(), String> {
    let style = text(20).pos(Pos::new(HPos::Left, VPos::Center));
    area.draw_text(title, &style, (fine(86), fine(26))).map_err(|e| e.to_string())?;
    let (low, high) = (10f64.powi(-DECADES), 10f64.powi(DECADES));
    let mut chart = ChartBuilder::on(area)
        .margin(fine(14))
        .margin_top(fine(48))
        .margin_right(fine(310))
        .x_label_area_size(fine(46))
        .y_label_area_size(fine(76))
        .build_cartesian_2d(0.0..f64::from(steps), (low..high).log_scale())
        .map_err(|e| e.to_string())?;
    chart
        .configure_mesh()
        .axis_style(line(INK, 1))
        .bold_line_style(line(FAINT, 1))
        .light_line_style(TRANSPARENT)
        .label_style(text(14))
        .axis_desc_style(text(15))
        .set_all_tick_mark_size(fine(5))
        .x_labels(9)
        .y_labels(9)
        .x_label_formatter(&|x| format!("{x:.0}"))
        .y_label_formatter(&|y| power(*y))
        .x_desc("steps")
        .y_desc(what)
        .draw()
        .map_err(|e| e.to_string())?;
    let mut names = Vec::new();
    for curve in curves {
        let points = inside(curve.values);
        let end = points.last().copied().unwrap_or((0.0, 1.0));
        chart.draw_series(LineSeries::new(points, line(curve.color, 3))).map_err(|e| e.to_string())?;
        names.push((chart.backend_coord(&end), end.0 >= f64::from(steps), curve));
    }
    drop(chart);
    let (left, top) = area.get_base_pixel();
    let names = names.into_iter().map(|((x, y), whole, curve)| ((x - left, y - top), whole, curve)).collect();
    label(area, names)
}

/// `10⁻³` as people write it.
fn power(x: f64) -> String {
    let digits = format!("{:.0}", x.log10());
    let raised = digits.chars().map(|c| match c {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '4' => '⁴',
        _ => '⁰',
    });
    if digits == "0" || digits == "-0" { "1".to_owned() } else { format!("10{}", raised.collect::<String>()) }
}

/// The points up to the edge of the picture, and the place at which the curve leaves it.
fn inside(values: &[f64]) -> Vec<(f64, f64)> {
    let edge = f64::from(DECADES);
    let mut points: Vec<(f64, f64)> = Vec::new();
    for (value, step) in values.iter().zip(0u32..) {
        let level = shown(*value).log10();
        if level.abs() <= edge {
            points.push((f64::from(step), 10f64.powf(level)));
            continue;
        }
        let before = points.last().map_or(0.0, |(_, value)| value.log10());
        let part = (edge - before.abs().copysign(before * level)).abs() / (level - before).abs();
        let at = f64::from(step.max(1)) - 1.0 + part.clamp(0.0, 1.0);
        points.push((at, 10f64.powf(edge.copysign(level))));
        break;
    }
    points
}

/// Names to the right of where curves end, moved apart; of those that leave the picture, beside that place.
fn label(area: &Area, mut names: Vec<((i32, i32), bool, &Curve)>) -> Result<(), String> {
    let write = |text_of: &str, color: RGBColor, at: (i32, i32)| {
        let style = text(15).color(&color).pos(Pos::new(HPos::Left, VPos::Center));
        area.draw_text(text_of, &style, at).map_err(|e| e.to_string())
    };
    // Who leaves: at the edge, one below the other where they leave together.
    let mut gone: Vec<(i32, i32)> = Vec::new();
    names.sort_by_key(|((x, y), ..)| (*y, *x));
    for ((x, y), _, curve) in names.iter().filter(|(_, whole, _)| !whole) {
        let inward = if gone.iter().any(|(_, other)| (other - y).abs() < fine(60)) || *y < fine(260) { 1 } else { -1 };
        let mut at = (x + fine(10), y + inward * fine(14));
        while gone.iter().any(|(u, v)| (v - at.1).abs() < fine(APART) && (u - at.0).abs() < fine(330)) {
            at.1 += inward * fine(APART);
        }
        gone.push(at);
        write(&curve.name, curve.color, at)?;
    }
    let mut ends: Vec<_> = names.into_iter().filter(|(_, whole, _)| *whole).collect();
    ends.sort_by_key(|((_, y), ..)| *y);
    // As low as the one above pushes it; then all up by half of what the last was pushed.
    let mut places: Vec<i32> = Vec::new();
    for ((_, y), ..) in &ends {
        let least = places.last().map_or(i32::MIN, |above| above + fine(APART));
        places.push((*y).max(least));
    }
    let mean = |list: &mut dyn Iterator<Item = i32>| -> i64 { list.map(i64::from).sum() };
    let count = i64::try_from(ends.len().max(1)).unwrap_or(1);
    let shift = (mean(&mut places.iter().copied()) - mean(&mut ends.iter().map(|((_, y), ..)| *y))) / count;
    let shift = i32::try_from(shift).unwrap_or(0);
    for (((x, y), _, curve), place) in ends.into_iter().zip(places) {
        let at = (x + fine(26), place - shift);
        let thread = PathElement::new([(x + fine(3), y), (x + fine(20), at.1)], line(curve.color, 1));
        area.draw(&thread).map_err(|e| e.to_string())?;
        write(&curve.name, curve.color, at)?;
    }
    Ok(())
}
