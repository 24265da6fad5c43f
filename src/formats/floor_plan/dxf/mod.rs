//! Floor plans as DXF in ASCII: lines on layers. What is on a layer whose name has the word `walls` is a wall, or all lines, if there is no such layer; what
//! is on a layer with `exits` is an exit; closed outlines on a layer `floor` are the floor. Layers of doors, stairs, furniture, dimensions and text are left out.
//!
//! Understood are LINE, LWPOLYLINE, POLYLINE, ARC, CIRCLE, ELLIPSE, SOLID, TRACE, and INSERT of blocks of these; others are counted. Units are those of
//! `$INSUNITS`.

mod blocks;
mod groups;
mod outline;

use std::collections::BTreeMap;

use glam::DVec2;

use super::Plan;
use super::canvas::{Canvas, Ink, Rule};
use super::layer::Layer;
use super::measure::{Measure, rounded};
use blocks::{Drawing, Shape};
use groups::Object;
use outline::Fine;

/// How far curves may be from their pieces \[m\].
const FINE: f64 = 0.002;
/// Around what is drawn \[m\].
const MARGIN: f64 = 0.1;
/// Names of layers in messages, at most.
const NAMED: usize = 12;

/// Units by `$INSUNITS`, and their lengths in metres.
const UNITS: [(u32, f64); 16] = [
    (1, 0.0254),
    (2, 0.3048),
    (3, 1609.344),
    (4, 1e-3),
    (5, 1e-2),
    (6, 1.0),
    (7, 1e3),
    (8, 2.54e-8),
    (9, 2.54e-5),
    (10, 0.9144),
    (13, 1e-6),
    (14, 0.1),
    (15, 10.0),
    (16, 100.0),
    (21, 1200.0 / 3937.0),
    (22, 100.0 / 3937.0),
];

/// Reads a plan.
///
/// # Errors
/// A sentence, with the line: what is no DXF, is cut off, or has no unit or no exit.
pub fn read(text: &str, measure: &Measure) -> Result<Plan, String> {
    let objects = groups::objects(text)?;
    let given = measure.unit()?;
    let unit = given.or_else(|| unit(&objects));
    let fine = Fine(FINE / unit.unwrap_or(1.0));
    let drawing = Drawing::of(&objects, fine)?;
    let points = || drawing.shapes.iter().flat_map(|shape| &shape.outline.points).copied();
    let (Some(low), Some(high)) = (points().reduce(DVec2::min), points().reduce(DVec2::max)) else {
        return Err("it has no LINE, LWPOLYLINE or other entity of a plan in its model space".to_owned());
    };
    let Some(unit) = unit else {
        let size = high - low;
        return Err(format!(
            "it has no unit ($INSUNITS): it is {} by {} units large; give the length of one in metres, as in --scale 0.001, or scale = 0.001 in \
             [plan], if these are millimetres",
            rounded(size.x),
            rounded(size.y)
        ));
    };
    plan(drawing, (low * unit, high * unit, unit), measure)
}

/// The length of a unit \[m\].
fn unit(objects: &[Object<'_>]) -> Option<f64> {
    let header = objects.iter().find(|one| one.kind == "SECTION" && one.text(2) == Some("HEADER"))?;
    let mut after = header.groups.iter().skip_while(|group| !(group.code == 9 && group.value == "$INSUNITS"));
    let number: u32 = after.nth(1)?.value.parse().ok()?;
    UNITS.iter().find(|(code, _)| *code == number).map(|(_, unit)| *unit)
}

fn plan(drawing: Drawing, (low, high, unit): (DVec2, DVec2, f64), measure: &Measure) -> Result<Plan, String> {
    let mut remarks = drawing.remarks;
    let has = |layer: Layer| drawing.shapes.iter().any(|shape| shape.layer == Some(layer));
    if !has(Layer::Exits) {
        return Err(format!(
            "it has no exit, so that no way leads out: draw a line across each door that leads out, on a layer with the word exits in its name; its layers \
             are {}",
            listed(&drawing.layers)
        ));
    }
    let (named_walls, has_floor) = (has(Layer::Walls), has(Layer::Floor));
    let is_wall = |shape: &&Shape| match shape.layer {
        Some(layer) => layer == Layer::Walls,
        None => !named_walls && !has_floor,
    };
    let others: BTreeMap<String, usize> =
        drawing.shapes.iter().filter(|shape| shape.layer.is_none()).fold(BTreeMap::new(), |mut count, shape| {
            *count.entry(shape.name.clone()).or_default() += 1;
            count
        });
    if !others.is_empty() {
        let list = listed(&others);
        remarks.push(if named_walls || has_floor {
            format!("layers without a word such as walls are left out, as others have one: {list}")
        } else {
            format!("no layer has the word walls: the lines of all others are walls: {list}")
        });
    }
    let background = if has_floor { Ink::Wall } else { Ink::Open };
    let mut canvas = Canvas::over(low - MARGIN, high + MARGIN, measure, background)?;
    let draw = |canvas: &mut Canvas, shape: &Shape, ink: Ink| {
        let points: Vec<DVec2> = shape.outline.points.iter().map(|x| canvas.place(*x * unit)).collect();
        let width = shape.outline.width * unit / canvas.side;
        if shape.outline.is_filled || ink == Ink::Open {
            canvas.fill(&[points], Rule::EvenOdd, ink, None)
        } else {
            canvas.line(&points, width, ink)
        }
    };
    let shapes = || drawing.shapes.iter();
    for shape in shapes().filter(|shape| shape.layer == Some(Layer::Floor)) {
        draw(&mut canvas, shape, Ink::Open)?;
    }
    for shape in shapes().filter(is_wall) {
        draw(&mut canvas, shape, Ink::Wall)?;
    }
    for shape in shapes().filter(|shape| shape.layer == Some(Layer::Exits)) {
        draw(&mut canvas, shape, Ink::Exit)?;
    }
    let mut plan = canvas.plan()?;
    plan.remarks.extend(remarks);
    Ok(plan)
}

/// Names with their numbers, for a message.
fn listed(all: &BTreeMap<String, usize>) -> String {
    let mut names: Vec<String> = all
        .iter()
        .take(NAMED)
        .map(|(name, count)| format!("\"{}\" ({count})", super::super::shortened(name)))
        .collect();
    if all.len() > NAMED {
        names.push(format!("and {} others", all.len() - NAMED));
    }
    names.join(", ")
}
