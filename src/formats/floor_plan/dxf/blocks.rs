//! What is drawn in the model space, with the blocks that are inserted.

use std::collections::{BTreeMap, HashMap, HashSet};

use glam::{DAffine2, DMat2, DVec2};

use super::groups::Object;
use super::outline::{self, Corner, Fine, Outline};
use crate::formats::floor_plan::layer::Layer;

/// Blocks within each other.
const DEEPEST: usize = 16;
/// Points of all shapes together, and entities that are looked at.
const MOST: usize = 2_000_000;
/// Entities that draw nothing.
const SILENT: [&str; 4] = ["SEQEND", "VERTEX", "ENDBLK", "ATTDEF"];

/// What an entity draws, in units of the file.
#[derive(Debug, Clone)]
pub struct Shape {
    pub layer: Option<Layer>,
    /// The name of its layer.
    pub name: String,
    pub outline: Outline,
}

/// All that is drawn.
#[derive(Debug, Default)]
pub struct Drawing {
    pub shapes: Vec<Shape>,
    pub remarks: Vec<String>,
    /// Shapes by the names of their layers.
    pub layers: BTreeMap<String, usize>,
}

/// A block: its origin and its entities.
#[derive(Debug, Default)]
struct Block<'a> {
    origin: DVec2,
    entities: Vec<&'a Object<'a>>,
}

struct Reader<'a> {
    blocks: HashMap<&'a str, Block<'a>>,
    hidden: HashSet<&'a str>,
    fine: Fine,
    drawing: Drawing,
    /// Entities that are not understood, by kind.
    others: BTreeMap<&'a str, usize>,
    /// Shapes on layers that are left out, by layer; those on hidden ones, and those on paper.
    left_out: BTreeMap<String, usize>,
    unseen: usize,
    points: usize,
}

/// Where entities of a block are.
#[derive(Clone, Copy)]
struct Within<'a> {
    place: DAffine2,
    /// The layer of what is on layer 0.
    layer: &'a str,
    depth: usize,
}

impl Drawing {
    /// Reads all sections.
    pub fn of<'a>(objects: &'a [Object<'a>], fine: Fine) -> Result<Self, String> {
        let mut reader = Reader {
            blocks: HashMap::new(),
            hidden: HashSet::new(),
            fine,
            drawing: Self::default(),
            others: BTreeMap::new(),
            left_out: BTreeMap::new(),
            unseen: 0,
            points: 0,
        };
        let (mut section, mut block, mut entities) = ("", None, Vec::new());
        for object in objects {
            match (object.kind, section) {
                ("SECTION", _) => section = object.text(2).unwrap_or_default(),
                ("ENDSEC", _) => section = "",
                ("LAYER", "TABLES") => {
                    let is_off = object.text(62).is_some_and(|color| color.starts_with('-'));
                    if is_off || object.has_bit(70, 1) {
                        reader.hidden.extend(object.text(2));
                    }
                }
                ("BLOCK", "BLOCKS") => {
                    let name = object.text(2).unwrap_or_default();
                    let origin = DVec2::new(object.number_or(10, 0.0)?, object.number_or(20, 0.0)?);
                    reader.blocks.insert(name, Block { origin, entities: Vec::new() });
                    block = Some(name);
                }
                ("ENDBLK", "BLOCKS") => block = None,
                (_, "BLOCKS") => {
                    if let Some(block) = block.and_then(|name| reader.blocks.get_mut(name)) {
                        block.entities.push(object);
                    }
                }
                (_, "ENTITIES") => entities.push(object),
                _ => {}
            }
        }
        reader.draw(&entities, Within { place: DAffine2::IDENTITY, layer: "0", depth: 0 })?;
        Ok(reader.said())
    }
}

impl<'a> Reader<'a> {
    fn draw(&mut self, entities: &[&'a Object<'a>], within: Within<'a>) -> Result<(), String> {
        for (k, entity) in entities.iter().enumerate() {
            self.pay(1, entity)?;
            let layer = match entity.text(8) {
                None | Some("0") => within.layer,
                Some(layer) => layer,
            };
            if entity.has_bit(67, 1) || self.hidden.contains(layer) {
                self.unseen += usize::from(!SILENT.contains(&entity.kind));
                continue;
            }
            let kind = Layer::of(layer);
            if kind == Some(Layer::LeftOut) {
                if !SILENT.contains(&entity.kind) {
                    *self.left_out.entry(layer.to_owned()).or_default() += 1;
                }
                continue;
            }
            let place = within.place * mirrored(entity)?;
            let outline = match entity.kind {
                "INSERT" => {
                    self.insert(entity, Within { place, layer, depth: within.depth + 1 })?;
                    continue;
                }
                "POLYLINE" => Some(self.polyline(entity, &entities[k + 1..])?),
                _ => outline::of(entity, self.fine)?,
            };
            let Some(mut outline) = outline else {
                if !SILENT.contains(&entity.kind) {
                    *self.others.entry(entity.kind).or_default() += 1;
                }
                continue;
            };
            self.pay(outline.points.len(), entity)?;
            outline.points.iter_mut().for_each(|x| *x = place.transform_point2(*x));
            outline.width *= place.matrix2.determinant().abs().sqrt();
            *self.drawing.layers.entry(layer.to_owned()).or_default() += 1;
            self.drawing.shapes.push(Shape { layer: kind, name: layer.to_owned(), outline });
        }
        Ok(())
    }
    /// Draws a block.
    fn insert(&mut self, entity: &Object<'a>, within: Within<'a>) -> Result<(), String> {
        let name = entity.text(2).unwrap_or_default();
        let line = entity.line;
        let shown = super::super::super::shortened(name);
        if within.depth > DEEPEST {
            return Err(format!(
                "the block \"{shown}\", inserted in line {line}, is within more than {DEEPEST} others, or within itself"
            ));
        }
        let Some(block) = self.blocks.get(name) else {
            return Err(format!("line {line} inserts the block \"{shown}\", which the file does not have"));
        };
        let (origin, entities) = (block.origin, block.entities.clone());
        let scale = DVec2::new(entity.number_or(41, 1.0)?, entity.number_or(42, 1.0)?);
        let angle = entity.number_or(50, 0.0)?.to_radians();
        let at = DVec2::new(entity.number(10)?, entity.number(20)?);
        let matrix = DMat2::from_angle(angle) * DMat2::from_diagonal(scale);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 1 and 1000")]
        let count = |code: i32| Ok::<_, String>(entity.number_or(code, 1.0)?.clamp(1.0, 1000.0) as usize);
        let apart = DVec2::new(entity.number_or(44, 0.0)?, entity.number_or(45, 0.0)?);
        for row in 0..count(71)? {
            for column in 0..count(70)? {
                self.pay(1, entity)?;
                let shift = DMat2::from_angle(angle) * (apart * DVec2::new(column as f64, row as f64));
                let place = DAffine2::from_mat2_translation(matrix, at + shift - matrix * origin);
                self.draw(&entities, Within { place: within.place * place, ..within })?;
            }
        }
        Ok(())
    }
    /// A POLYLINE, whose corners follow.
    fn polyline(&self, entity: &Object<'a>, rest: &[&'a Object<'a>]) -> Result<Outline, String> {
        let vertices = rest.iter().take_while(|one| one.kind == "VERTEX");
        // Those of the frame of a spline are not on it.
        let vertices = vertices.filter(|one| !one.has_bit(70, 16));
        let corner = |one: &&Object<'a>| {
            Ok(Corner { at: DVec2::new(one.number(10)?, one.number(20)?), bulge: one.number_or(42, 0.0)? })
        };
        let corners: Vec<Corner> = vertices.map(corner).collect::<Result<_, String>>()?;
        Ok(outline::polyline(&corners, entity.has_bit(70, 1), entity.number_or(40, 0.0)?.abs(), self.fine))
    }
    fn pay(&mut self, points: usize, entity: &Object<'_>) -> Result<(), String> {
        self.points += points;
        if self.points <= MOST {
            return Ok(());
        }
        Err(format!(
            "it has more than {MOST} points and entities, with the blocks that it inserts, up to line {}: leave out what is no plan",
            entity.line
        ))
    }
    fn said(self) -> Drawing {
        let mut drawing = self.drawing;
        if !self.others.is_empty() {
            let all: BTreeMap<String, usize> = self.others.iter().map(|(k, n)| ((*k).to_owned(), *n)).collect();
            drawing.remarks.push(format!("entities that are no lines are left out: {}", super::listed(&all)));
        }
        if !self.left_out.is_empty() {
            let list = super::listed(&self.left_out);
            drawing.remarks.push(format!("layers of doors, furniture and text are left out: {list}"));
        }
        if self.unseen > 0 {
            let count = self.unseen;
            drawing
                .remarks
                .push(format!("{count} entities are on layers that are off, or on paper: they are left out"));
        }
        drawing
    }
}

/// The plane of an entity: seen from below, x goes the other way. A LINE has none.
fn mirrored(entity: &Object<'_>) -> Result<DAffine2, String> {
    let is_below = !matches!(entity.kind, "LINE" | "ELLIPSE") && entity.number_or(230, 1.0)? < 0.0;
    Ok(DAffine2::from_scale(DVec2::new(if is_below { -1.0 } else { 1.0 }, 1.0)))
}
