//! Pictures of a report: the plan with tracks, the density, the delay map with its bottlenecks, and how many have left over time.

use std::path::Path;

use glam::DVec2;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::record::Record;
use super::report::Report;
use crate::error::Error;
use crate::floor_plan::FloorPlan;
use crate::run::plot::{Area, Axis, INK, axes, fine, legend, line, text, write};

/// The longer side of the plan, and the space around it \[pixels\].
const LONG: f64 = 860.0;
const MARGIN: [i32; 4] = [30, 64, 110, 36];
/// Steps of a scale of colours.
const LEVELS: usize = 24;
/// From little to much: the colours of a scale.
const SCALE: [[f64; 3]; 5] =
    [[255.0, 246.0, 224.0], [253.0, 204.0, 128.0], [240.0, 120.0, 60.0], [186.0, 30.0, 60.0], [84.0, 8.0, 70.0]];
const EXITS: [RGBColor; 6] = [
    RGBColor(36, 104, 196),
    RGBColor(214, 112, 32),
    RGBColor(30, 140, 90),
    RGBColor(150, 40, 110),
    RGBColor(110, 110, 30),
    RGBColor(60, 60, 160),
];
const EXIT: RGBColor = RGBColor(20, 150, 80);
const MARK: RGBColor = RGBColor(20, 60, 200);

type Done = Result<(), String>;

fn fault(why: impl std::fmt::Display) -> String {
    why.to_string()
}

/// A plan on paper.
struct Sheet<'a> {
    plan: &'a FloorPlan,
    low: DVec2,
    high: DVec2,
    /// Pixels of a unit of length.
    scale: f64,
}

impl<'a> Sheet<'a> {
    fn of(plan: &'a FloorPlan) -> Self {
        let (low, high) = plan.extent();
        Self { plan, low, high, scale: LONG / (high - low).max_element().max(f64::MIN_POSITIVE) }
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "pixels")]
    fn size(&self) -> (u32, u32) {
        let size = (self.high - self.low) * self.scale;
        let [left, top, right, bottom] = MARGIN.map(f64::from);
        ((size.x + left + right).max(520.0) as u32, (size.y + top + bottom).max(300.0) as u32)
    }
    #[expect(clippy::cast_possible_truncation, reason = "pixels")]
    fn at(&self, x: DVec2) -> (i32, i32) {
        let place = DVec2::new(x.x - self.low.x, self.high.y - x.y) * self.scale;
        let unit = f64::from(fine(1));
        (fine(MARGIN[0]) + (place.x * unit).round() as i32, fine(MARGIN[1]) + (place.y * unit).round() as i32)
    }
    fn title(&self, root: &Area, title: &str, about: &str) -> Done {
        root.fill(&WHITE).map_err(fault)?;
        let left = |size| text(size).pos(Pos::new(HPos::Left, VPos::Center));
        root.draw_text(title, &left(20), (fine(MARGIN[0]), fine(22))).map_err(fault)?;
        root.draw_text(about, &left(13), (fine(MARGIN[0]), fine(46))).map_err(fault)?;
        // A bar of a round length.
        let most = 0.25 * (self.high - self.low).max_element();
        let power = 10f64.powf(most.log10().floor());
        let length = [5.0, 2.0, 1.0].into_iter().map(|n| n * power).find(|x| *x <= most).unwrap_or(power);
        let from = self.at(self.low);
        let (x, y) = (from.0, from.1 + fine(16));
        let (end, _) = self.at(self.low + DVec2::X * length);
        root.draw(&PathElement::new([(x, y), (end, y)], line(INK, 2))).map_err(fault)?;
        root.draw_text(&format!("{length} m"), &left(13), (end + fine(6), y)).map_err(fault)
    }
    fn walls(&self, root: &Area) -> Done {
        for wall in self.plan.segments() {
            root.draw(&PathElement::new([self.at(wall.a), self.at(wall.b)], line(INK, 2))).map_err(fault)?;
        }
        for piece in self.plan.exits().iter().flat_map(crate::floor_plan::Exit::pieces) {
            root.draw(&PathElement::new(piece.map(|x| self.at(x)), line(EXIT, 4))).map_err(fault)?;
        }
        Ok(())
    }
    /// The values of a map's squares as colours, up to a largest one, with their scale at the right.
    fn squares(&self, root: &Area, map: &super::Map, (values, most): (&[f64], f64), unit: &str) -> Done {
        let nx = map.count[0];
        for (row, y) in values.chunks(nx).zip(0..) {
            let mut x = 0;
            while x < nx {
                let own = level(row[x], most);
                let end = (x..nx).find(|x| level(row[*x], most) != own).unwrap_or(nx);
                if let Some(own) = own {
                    let (a, b) = (map.corner(y * nx + x), map.corner(y * nx + end - 1) + map.side);
                    let ((left, low), (right, high)) = (self.at(a), self.at(b));
                    let fill = color(own).filled();
                    // A quarter of a pixel over its neighbour, so that no seam is seen.
                    root.draw(&Rectangle::new([(left, high), (right + 2, low + 2)], fill)).map_err(fault)?;
                }
                x = end;
            }
        }
        let (right, top) = self.at(self.high);
        let (left, top, high) = (right + fine(20), top + fine(20), fine(10));
        let style = text(13).pos(Pos::new(HPos::Left, VPos::Center));
        for (n, place) in (0..LEVELS).rev().zip(0..) {
            let corners = [(left, top + place * high), (left + fine(16), top + (place + 1) * high + 2)];
            root.draw(&Rectangle::new(corners, color(n).filled())).map_err(fault)?;
        }
        let bottom = top + high * i32::try_from(LEVELS).unwrap_or(0);
        let digits = |x: f64| if x >= 10.0 { format!("{x:.0}") } else { format!("{x:.1}") };
        root.draw_text(&digits(most), &style, (left + fine(22), top)).map_err(fault)?;
        root.draw_text("0", &style, (left + fine(22), bottom)).map_err(fault)?;
        root.draw_text(unit, &style, (left, bottom + fine(18))).map_err(fault)
    }
}

/// The step of the scale of a value; none for what is nearly 0.
fn level(value: f64, most: f64) -> Option<usize> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a step of a scale")]
    let step = (value / most.max(f64::MIN_POSITIVE) * LEVELS as f64).clamp(0.0, LEVELS as f64 - 1.0) as usize;
    (value > 0.25 * most / LEVELS as f64).then_some(step)
}

fn color(step: usize) -> RGBColor {
    let place = step as f64 / (LEVELS - 1) as f64 * (SCALE.len() - 1) as f64;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place in a list")]
    let first = (place as usize).min(SCALE.len() - 2);
    let part = place - first as f64;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a byte")]
    let byte = |n: usize| (SCALE[first][n] * (1.0 - part) + SCALE[first + 1][n] * part).round() as u8;
    RGBColor(byte(0), byte(1), byte(2))
}

/// Draws the plan with the tracks of all pedestrians, in a colour for each exit.
///
/// # Errors
/// [`Error::Output`] when the file cannot be written, as for all pictures here.
pub fn tracks(path: &Path, plan: &FloorPlan, record: &Record, report: &Report) -> Result<(), Error> {
    let sheet = Sheet::of(plan);
    write(path, sheet.size(), |root| {
        let about =
            format!("tracks of {} pedestrians, in a colour for each exit; dots: where they start", record.tracks.len());
        sheet.title(root, "Plan and ways", &about)?;
        for (track, one) in record.tracks.iter().zip(&report.pedestrians) {
            let own = one.exit.map_or(INK, |exit| EXITS[exit % EXITS.len()]);
            let points = track.iter().map(|x| sheet.at(x.as_dvec2()));
            let style = own.mix(0.35).stroke_width(fine(1).unsigned_abs());
            root.draw(&PathElement::new(points.collect::<Vec<_>>(), style)).map_err(fault)?;
        }
        for (track, one) in record.tracks.iter().zip(&report.pedestrians) {
            let own = one.exit.map_or(INK, |exit| EXITS[exit % EXITS.len()]);
            if let Some(start) = track.first() {
                root.draw(&Circle::new(sheet.at(start.as_dvec2()), fine(2), own.filled())).map_err(fault)?;
            }
        }
        sheet.walls(root)
    })
}

/// Draws the largest density of each square.
///
/// # Errors
/// As for [`tracks`].
pub fn density(path: &Path, plan: &FloorPlan, report: &Report) -> Result<(), Error> {
    let (sheet, map) = (Sheet::of(plan), &report.map);
    let most = map.density.iter().copied().fold(0.0, f64::max);
    write(path, sheet.size(), |root| {
        sheet.title(root, "Density", "the largest in each place: means over 5 s and about a square metre [1/m²]")?;
        sheet.squares(root, map, (&map.density, most), "1/m²")?;
        sheet.walls(root)
    })
}

/// Draws the time lost in each square, with the bottlenecks numbered.
///
/// # Errors
/// As for [`tracks`].
pub fn delay(path: &Path, plan: &FloorPlan, report: &Report) -> Result<(), Error> {
    let (sheet, map) = (Sheet::of(plan), &report.map);
    let rate: Vec<f64> = map.lost.iter().map(|lost| lost / (map.side * map.side)).collect();
    let most = rate.iter().copied().fold(0.0, f64::max);
    let about = format!(
        "{:.0} person-seconds lost in all; numbers: bottlenecks, across the passage that holds the jam",
        report.delay()
    );
    write(path, sheet.size(), |root| {
        sheet.title(root, "Where time is lost", &about)?;
        sheet.squares(root, map, (&rate, most), "s/m²")?;
        sheet.walls(root)?;
        for (one, number) in report.bottlenecks.iter().zip(1..) {
            let ends = one.passage.ends.map(|x| sheet.at(x));
            root.draw(&PathElement::new(ends, line(MARK, 4))).map_err(fault)?;
            let at = sheet.at(one.place());
            root.draw(&Circle::new(at, fine(13), WHITE.filled())).map_err(fault)?;
            root.draw(&Circle::new(at, fine(13), line(MARK, 2))).map_err(fault)?;
            let style = text(15).pos(Pos::new(HPos::Center, VPos::Center));
            root.draw_text(&number.to_string(), &style, at).map_err(fault)?;
        }
        Ok(())
    })
}

/// Draws how many have left over time, in all and by each exit.
///
/// # Errors
/// As for [`tracks`].
pub fn left(path: &Path, report: &Report) -> Result<(), Error> {
    let mut lines: Vec<(&str, RGBColor, Vec<f64>)> = Vec::new();
    let mut all: Vec<f64> = report.exits.iter().flat_map(|exit| exit.times.iter().copied()).collect();
    all.sort_by(f64::total_cmp);
    let end = report.pedestrians.iter().map(|one| one.time).fold(1.0, f64::max);
    if report.exits.len() > 1 {
        lines.push(("all", INK, all));
    }
    for (exit, n) in report.exits.iter().zip(0..) {
        lines.push((&exit.name, EXITS[n % EXITS.len()], exit.times.clone()));
    }
    write(path, (960, 480), |root| {
        root.fill(&WHITE).map_err(fault)?;
        let style = text(20).pos(Pos::new(HPos::Left, VPos::Center));
        root.draw_text("How many have left", &style, (fine(30), fine(22))).map_err(fault)?;
        let mut chart = ChartBuilder::on(root)
            .margin(fine(14))
            .margin_top(fine(70))
            .margin_right(fine(30))
            .x_label_area_size(fine(46))
            .y_label_area_size(fine(66))
            .build_cartesian_2d(0.0..end, 0.0..report.pedestrians.len() as f64)
            .map_err(fault)?;
        let whole = |x: f64| format!("{x:.0}");
        axes(&mut chart, &Axis::new("time [s]", &whole), &Axis::new("", &whole))?;
        for (_, color, times) in &lines {
            let mut points = vec![(0.0, 0.0)];
            times
                .iter()
                .zip(0..)
                .for_each(|(time, n)| points.extend([(*time, f64::from(n)), (*time, f64::from(n + 1))]));
            points.push((end, times.len() as f64));
            chart.draw_series(LineSeries::new(points, line(*color, 2))).map_err(fault)?;
        }
        let names: Vec<_> = lines.iter().take(6).map(|(name, color, _)| (*name, *color)).collect();
        legend(root, &names, (86, 52), 140)
    })
}
