//! Draws the shapes of a tree on a grid.

use std::collections::{BTreeMap, HashSet};

use usvg::tiny_skia_path::Transform;
use usvg::{ClipPath, Group, Node, Paint, PaintOrder, Path, Tree};

use super::super::canvas::{Canvas, Clip, Ink, Rule};
use super::super::layer::Layer;
use super::super::picture::colors;
use super::super::picture::{EXIT, WALL};
use super::names::{Named, Names};
use super::{listed, path};

/// What is as light is paper, also where it is named a wall.
const LIGHT: u8 = 250;
/// What is less opaque covers nothing.
const OPAQUE: f64 = 0.5;

/// Draws a tree.
pub struct Painter<'a> {
    canvas: Canvas,
    names: &'a Names,
    /// From pixels of CSS to those of the grid.
    transform: Transform,
    has: Has,
    /// What is left out, by what it is.
    left_out: BTreeMap<String, usize>,
    /// Ids of named shapes that have been drawn.
    drawn: HashSet<String>,
    /// Masks that are not applied.
    masks: usize,
}

/// Names that a drawing uses.
#[derive(Clone, Copy)]
struct Has {
    walls: bool,
    exits: bool,
    floor: bool,
}

/// What is around a shape.
#[derive(Clone, Copy)]
struct Around<'a> {
    named: Option<&'a Named>,
    clip: Option<&'a Clip>,
    opacity: f64,
}

impl<'a> Painter<'a> {
    #[expect(clippy::cast_possible_truncation, reason = "in single precision, as paths")]
    pub fn new(canvas: Canvas, names: &'a Names, per_pixel: f64, tree: &Tree) -> Self {
        let scale = (per_pixel / canvas.side) as f32;
        // The lower side of the drawing is a row of the grid.
        let bottom = canvas.place(glam::DVec2::ZERO).y as f32;
        let transform = Transform::from_row(scale, 0.0, 0.0, scale, 0.0, bottom - tree.size().height() * scale);
        let has =
            Has { walls: names.has(Layer::Walls), exits: names.has(Layer::Exits), floor: names.has(Layer::Floor) };
        Self { canvas, names, transform, has, left_out: BTreeMap::new(), drawn: HashSet::new(), masks: 0 }
    }
    pub fn draw(&mut self, tree: &Tree) -> Result<(), String> {
        self.group(tree.root(), Around { named: None, clip: None, opacity: 1.0 })
    }
    /// The grid, and what one should know.
    pub fn done(self) -> (Canvas, Vec<String>) {
        let mut remarks = Vec::new();
        let undrawn = |layer: Layer| {
            let all = self.names.shapes.iter().filter(move |(_, named)| named.layer == layer);
            let mut lines: Vec<u32> =
                all.filter(|(id, _)| !self.drawn.contains(*id)).map(|(_, named)| named.line).collect();
            lines.sort_unstable();
            lines
        };
        for (layer, what) in [(Layer::Exits, "exits"), (Layer::Walls, "walls"), (Layer::Floor, "floor")] {
            let lines = undrawn(layer);
            if let Some(first) = lines.first() {
                remarks.push(format!(
                    "{} shapes named {what} draw nothing, the first in line {first}: they are hidden, outside of the drawing, white, or have neither fill nor stroke",
                    lines.len()
                ));
            }
        }
        let mut left_out = self.left_out;
        for (name, count) in &self.names.others {
            *left_out.entry(format!("<{name}>")).or_default() += count;
        }
        if !left_out.is_empty() {
            remarks.push(format!("left out of the drawing: {}", listed(&left_out)));
        }
        if self.masks > 0 {
            remarks.push(format!("{} groups have masks, which are not applied", self.masks));
        }
        (self.canvas, remarks)
    }
    fn group(&mut self, group: &Group, around: Around<'_>) -> Result<(), String> {
        let named = self.names.shapes.get(group.id()).or(around.named);
        if named.is_some() && !group.id().is_empty() {
            self.drawn.insert(group.id().to_owned());
        }
        let opacity = around.opacity * f64::from(group.opacity().get());
        self.masks += usize::from(group.mask().is_some());
        let clip = match group.clip_path() {
            Some(clip) => Some(self.clip(clip, group.abs_transform(), around.clip)?),
            None => None,
        };
        let inner = Around { named, clip: clip.as_ref().or(around.clip), opacity };
        for node in group.children() {
            match node {
                Node::Group(group) => self.group(group, inner)?,
                Node::Path(path) if path.is_visible() => self.path(path, inner)?,
                // Images and text are counted by their elements.
                Node::Path(_) | Node::Image(_) | Node::Text(_) => {}
            }
        }
        Ok(())
    }
    /// The part of the grid that a clip path leaves.
    fn clip(&mut self, clip: &ClipPath, transform: Transform, within: Option<&Clip>) -> Result<Clip, String> {
        let outer = match clip.clip_path() {
            Some(outer) => Some(self.clip(outer, transform, within)?),
            None => None,
        };
        let place = self.transform.pre_concat(transform).pre_concat(clip.transform());
        let mut shapes = Vec::new();
        shapes_of(clip.root(), place, &mut shapes);
        self.canvas.clip(&shapes, outer.as_ref().or(within))
    }
    fn path(&mut self, path: &Path, around: Around<'_>) -> Result<(), String> {
        let named = self.names.shapes.get(path.id()).or(around.named);
        let layer = named.map(|named| named.layer);
        if layer == Some(Layer::LeftOut) {
            *self.left_out.entry("shapes named doors, furniture or text".to_owned()).or_default() += 1;
            return Ok(());
        }
        let transform = self.transform.pre_concat(path.abs_transform());
        let bounds = path.data().bounds();
        // A line is filled by default, too, and has no area.
        let fill = path.fill().filter(|_| bounds.width() > 0.0 && bounds.height() > 0.0);
        let fill = fill.map(|fill| (fill.paint(), f64::from(fill.opacity().get()), Some(fill.rule())));
        let stroke = path.stroke().map(|stroke| (stroke.paint(), f64::from(stroke.opacity().get()), None));
        let mut parts = [fill, stroke];
        if path.paint_order() == PaintOrder::StrokeAndFill {
            parts.reverse();
        }
        for (paint, opacity, rule) in parts.into_iter().flatten() {
            let Some(ink) = self.ink(paint, opacity * around.opacity, layer, rule.is_some()) else { continue };
            let (outlines, rule) = match rule {
                Some(usvg::FillRule::EvenOdd) => (path::outlines(path.data(), transform), Rule::EvenOdd),
                Some(usvg::FillRule::NonZero) => (path::outlines(path.data(), transform), Rule::NonZero),
                None => {
                    let Some(stroke) = path.stroke() else { continue };
                    let Some(outlines) = path::stroke(path.data(), stroke, transform, ink) else { continue };
                    (outlines, Rule::NonZero)
                }
            };
            if self.canvas.fill(&outlines, rule, ink, around.clip)? {
                self.drawn.insert(path.id().to_owned());
                if ink == Ink::Exit {
                    self.canvas.name_exit(named.and_then(|named| named.name.clone()));
                }
            }
        }
        Ok(())
    }
    /// What a fill or a stroke is; `None`: it is not drawn.
    fn ink(&mut self, paint: &Paint, opacity: f64, layer: Option<Layer>, is_fill: bool) -> Option<Ink> {
        let Some([r, g, b, a]) = color(paint, opacity) else {
            *self.left_out.entry("fills with patterns".to_owned()).or_default() += 1;
            return None;
        };
        let is_light = [r, g, b].iter().all(|x| *x >= LIGHT);
        let by_color = match colors::kind([r, g, b], a) {
            WALL => Ink::Wall,
            EXIT => Ink::Exit,
            _ => Ink::Open,
        };
        let is_seen = by_color != Ink::Open || f64::from(a) >= 255.0 * OPAQUE;
        let is_none = f64::from(a) < 1.0;
        match layer {
            _ if is_none => None,
            Some(Layer::Floor) if is_fill => Some(Ink::Open),
            Some(Layer::Walls) => is_seen.then_some(if is_light { Ink::Open } else { Ink::Wall }),
            Some(Layer::Exits) => (!is_light).then_some(Ink::Exit),
            Some(Layer::LeftOut) => None,
            Some(Layer::Floor) | None => {
                // What has a layer of its own is that layer alone.
                let is_other = match by_color {
                    Ink::Wall => self.has.walls,
                    Ink::Exit => self.has.exits,
                    // Paper would be floor.
                    Ink::Open if self.has.floor => return None,
                    Ink::Open => false,
                };
                if is_other {
                    let what = if by_color == Ink::Wall {
                        "dark shapes not named walls"
                    } else {
                        "coloured shapes not named exits"
                    };
                    *self.left_out.entry(what.to_owned()).or_default() += 1;
                    return None;
                }
                is_seen.then_some(by_color)
            }
        }
    }
}

/// Red, green, blue and opacity; of a gradient in the mean of its stops; `None`: a pattern has none.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "means of bytes")]
fn color(paint: &Paint, opacity: f64) -> Option<[u8; 4]> {
    let stops = match paint {
        Paint::Color(color) => return Some([color.red, color.green, color.blue, (255.0 * opacity).round() as u8]),
        Paint::LinearGradient(gradient) => gradient.stops(),
        Paint::RadialGradient(gradient) => gradient.stops(),
        Paint::Pattern(_) => return None,
    };
    let mean = |of: &dyn Fn(&usvg::Stop) -> f64| stops.iter().map(of).sum::<f64>() / stops.len().max(1) as f64;
    Some([
        mean(&|stop| f64::from(stop.color().red)) as u8,
        mean(&|stop| f64::from(stop.color().green)) as u8,
        mean(&|stop| f64::from(stop.color().blue)) as u8,
        (255.0 * opacity * mean(&|stop| f64::from(stop.opacity().get()))).round() as u8,
    ])
}

/// The outlines of a clip path.
fn shapes_of(group: &Group, place: Transform, shapes: &mut Vec<(Vec<Vec<glam::DVec2>>, Rule)>) {
    for node in group.children() {
        match node {
            Node::Group(group) => shapes_of(group, place, shapes),
            Node::Path(path) => {
                let rule = match path.fill().map(usvg::Fill::rule) {
                    Some(usvg::FillRule::EvenOdd) => Rule::EvenOdd,
                    _ => Rule::NonZero,
                };
                shapes.push((path::outlines(path.data(), place.pre_concat(path.abs_transform())), rule));
            }
            Node::Image(_) | Node::Text(_) => {}
        }
    }
}
