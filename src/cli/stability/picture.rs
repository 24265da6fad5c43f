//! The picture: the energy above, the decay below, one labelled curve for each integrator.

use std::path::Path;

use motes::Error;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::Course;
use crate::cli::args::StabilityArgs;
use motes::run::plot::{Area, Axis, INK, axes, fine, line, text, write};

const SIZE: (u32, u32) = (1080, 1000);
/// Pixels above a panel: its title, and a row of names.
const TOP: i32 = 72;
/// Pixels between two names.
const APART: i32 = 19;
/// The number of decades shown above and below 1.
const DECADES: i32 = 4;

/// The colour of an integrator: warm for explicit ones that lose or gain energy, blue and green for symplectic ones, violet for
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

/// Integrators with the same curve, under one name.
struct Curve<'a> {
    name: String,
    color: RGBColor,
    values: &'a [f64],
}

/// Draws the solutions into a file.
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

/// One curve for all integrators with solutions that differ by less than a line's width everywhere.
fn curves(courses: &[Course], values: fn(&Course) -> &Vec<f64>) -> Vec<Curve<'_>> {
    let mut list: Vec<(bool, Vec<&str>, &[f64])> = Vec::new();
    for course in courses {
        let (own, kind) = (values(course), implicit(course.name));
        let level = |x: f64| shown(x).log10();
        let alike = |known: &[f64]| known.iter().zip(own).all(|(a, b)| (level(*a) - level(*b)).abs() < 0.02);
        match list.iter_mut().find(|(other, _, known)| *other == kind && alike(known)) {
            Some((_, names, _)) => names.push(course.name),
            None => list.push((kind, vec![course.name], own)),
        }
    }
    let curve =
        |(_, names, values): (bool, Vec<&str>, _)| Curve { name: together(&names), color: color(names[0]), values };
    list.into_iter().map(curve).collect()
}

/// Whether it is implicit.
fn implicit(name: &str) -> bool {
    ["backward_euler", "trapezoid", "implicit_midpoint"].iter().any(|end| name.ends_with(end))
}

/// All names; a linear and a Newton variant with one curve appear once.
fn together(names: &[&str]) -> String {
    let solved = |name: &str| names.iter().any(|other| other.strip_prefix("linear_") == Some(name));
    let once = |name: &&&str| !name.strip_prefix("linear_").is_some_and(|whole| names.contains(&whole));
    let words = names
        .iter()
        .filter(once)
        .map(|name| if solved(name) { format!("(linear_){name}") } else { (*name).to_owned() });
    words.collect::<Vec<_>>().join(", ")
}

/// A value limited to a decade beyond the range shown, so that curves are compared only where they are visible.
fn shown(x: f64) -> f64 {
    let edge = 10f64.powi(DECADES + 1);
    if x.is_finite() { x.abs().clamp(1.0 / edge, edge) } else { edge }
}

fn panel(area: &Area, curves: &[Curve], title: &str, what: &str, steps: u32) -> Result<(), String> {
    let style = text(20).pos(Pos::new(HPos::Left, VPos::Center));
    area.draw_text(title, &style, (fine(86), fine(24))).map_err(|e| e.to_string())?;
    let (low, high) = (10f64.powi(-DECADES), 10f64.powi(DECADES));
    let mut chart = ChartBuilder::on(area)
        .margin(fine(14))
        .margin_top(fine(TOP))
        .margin_right(fine(350))
        .x_label_area_size(fine(46))
        .y_label_area_size(fine(76))
        .build_cartesian_2d(0.0..f64::from(steps), (low..high).log_scale())
        .map_err(|e| e.to_string())?;
    let x = Axis { labels: 9, ..Axis::new("steps", &|x| format!("{x:.0}")) };
    axes(&mut chart, &x, &Axis { labels: 9, ..Axis::new(what, &power) })?;
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

/// A power of ten with superscript digits, such as `10⁻³`.
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

/// The points up to the edge of the picture, and the position at which the curve leaves it.
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
        let part = (edge.copysign(level) - before) / (level - before);
        let at = f64::from(step.max(1)) - 1.0 + part.clamp(0.0, 1.0);
        points.push((at, 10f64.powf(edge.copysign(level))));
        break;
    }
    points
}

/// The names of curves: at their right ends, moved apart; in a row above those that leave at the top; and beside those that
/// leave at the bottom.
fn label(area: &Area, mut names: Vec<((i32, i32), bool, &Curve)>) -> Result<(), String> {
    let write = |name: &str, color: RGBColor, at: (i32, i32)| {
        let style = text(15).color(&color).pos(Pos::new(HPos::Left, VPos::Center));
        area.draw_text(name, &style, at).map_err(|e| e.to_string())
    };
    let join = |color: RGBColor, from: (i32, i32), to: (i32, i32)| {
        area.draw(&PathElement::new([from, to], line(color, 1))).map_err(|e| e.to_string())
    };
    names.sort_by_key(|((x, y), ..)| (*y, *x));
    let (ends, leaving): (Vec<_>, Vec<_>) = names.into_iter().partition(|(_, whole, _)| *whole);
    let (mut free, mut lowest) = (0, i32::MAX);
    for ((x, y), _, curve) in leaving {
        let width = i32::try_from(curve.name.chars().count()).unwrap_or(0) * fine(7);
        if y < fine(TOP + 9) {
            let at = ((x - fine(12)).max(free), fine(TOP - 18));
            join(curve.color, (x, y - fine(2)), (at.0 + fine(12), at.1 + fine(9)))?;
            write(&curve.name, curve.color, at)?;
            free = at.0 + width + fine(12);
        } else {
            lowest = (y - fine(14)).min(lowest - fine(APART));
            write(&curve.name, curve.color, (x + fine(10), lowest))?;
        }
    }
    let wanted: Vec<i32> = ends.iter().map(|((_, y), ..)| *y).collect();
    for (((x, y), _, curve), place) in ends.into_iter().zip(apart(&wanted, fine(APART))) {
        let at = (x + fine(26), place);
        join(curve.color, (x + fine(3), y), (x + fine(20), place))?;
        write(&curve.name, curve.color, at)?;
    }
    Ok(())
}

/// Positions in order, moved apart to a minimum distance: groups that would overlap are centred on their mean.
fn apart(wanted: &[i32], distance: i32) -> Vec<i32> {
    // The first position and the length of each group.
    let mut groups: Vec<(i32, i32)> = Vec::new();
    for place in wanted {
        groups.push((*place, 1));
        while let [.., (above, many), (below, few)] = groups[..] {
            if above + many * distance <= below {
                break;
            }
            let middle = |first: i32, count: i32| first + (count - 1) * distance / 2;
            let both = many + few;
            let center = (many * middle(above, many) + few * middle(below, few)) / both;
            groups.truncate(groups.len() - 2);
            groups.push((center - (both - 1) * distance / 2, both));
        }
    }
    groups.into_iter().flat_map(|(first, count)| (0..count).map(move |i| first + i * distance)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stand_apart_and_near() {
        assert_eq!(apart(&[], 10), Vec::<i32>::new());
        assert_eq!(apart(&[0, 50, 100], 10), [0, 50, 100]);
        assert_eq!(apart(&[50, 50, 50], 10), [40, 50, 60]);
        assert_eq!(apart(&[0, 98, 102], 10), [0, 95, 105]);
    }
    #[test]
    fn names_stand_together() {
        assert_eq!(together(&["midpoint", "heun"]), "midpoint, heun");
        assert_eq!(together(&["linear_trapezoid", "trapezoid", "linear_b"]), "(linear_)trapezoid, linear_b");
    }
    #[test]
    fn curves_end_at_the_edge() {
        assert_eq!(inside(&[1.0, 1e2, 1e3]), [(0.0, 1.0), (1.0, 1e2), (2.0, 1e3)]);
        assert_eq!(inside(&[1.0, 1e3, 1e5]), [(0.0, 1.0), (1.0, 1e3), (1.5, 1e4)]);
        assert_eq!(inside(&[1.0, 1e-3, 0.0]), [(0.0, 1.0), (1.0, 1e-3), (1.5, 1e-4)]);
        assert_eq!(inside(&[1.0, f64::NAN]), [(0.0, 1.0), (0.8, 1e4)]);
        assert_eq!([1.0, 1e4, 1e-3].map(power), ["1", "10⁴", "10⁻³"]);
    }
}
