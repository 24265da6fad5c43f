//! Floor plans: where pedestrians may be, what is a wall, and where they leave. A plan is one or more polygons with holes, in a plane; its
//! walls are their sides.

mod cells;
mod exit;
mod nested;
mod ring;
mod wall;

pub use cells::{Cells, MOST_CELLS};
pub use exit::{AHEAD, Exit, MOST_PIECES};
pub use wall::{MOST_SEGMENTS, Nearest, Segment};

use std::sync::{Arc, OnceLock};

use glam::DVec2;

use crate::solids::{Solid, Standing};
use ring::Ring;

/// A polygon: its outline, and the outlines of its holes, without repeated last points \[length\].
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Polygon {
    /// The outline, in any direction.
    pub outline: Vec<DVec2>,
    /// The holes, in any direction.
    pub holes: Vec<Vec<DVec2>>,
}

/// A floor plan, checked.
#[derive(Debug, Clone, PartialEq)]
pub struct FloorPlan {
    rings: Vec<Ring>,
    segments: Vec<Segment>,
    exits: Vec<Exit>,
    cell: f64,
    /// Its cells, which follow from the rest, after they have been asked for.
    cells: Asked,
}

/// Cells after they have been asked for. Plans are the same whether or not they were.
#[derive(Clone, Default)]
struct Asked(OnceLock<Arc<Cells>>);

impl PartialEq for Asked {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}
impl std::fmt::Debug for Asked {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str("…")
    }
}

/// Coordinates are known to this part of a cell in single precision.
const FINE: f64 = 0.01;

impl FloorPlan {
    /// A plan of polygons that do not meet, with exits, and cells of this side for the ways to them \[length\].
    ///
    /// # Errors
    /// A sentence with the place: outlines of fewer than three points, without area or that cross themselves or each other, holes outside,
    /// outlines within others, exits that leave the floor, numbers that are not finite or too large for single precision, more walls than
    /// [`MOST_SEGMENTS`], more cells than [`MOST_CELLS`], or exits of more pieces than [`MOST_PIECES`].
    pub fn new(polygons: &[Polygon], exits: Vec<Exit>, cell: f64) -> Result<Self, String> {
        let mut rings = Vec::new();
        for (polygon, number) in polygons.iter().zip(1..) {
            let name = if polygons.len() > 1 { format!("polygon {number}") } else { "the floor".to_owned() };
            let outline = Ring::new(&polygon.outline, false, &name)?;
            for (hole, place) in polygon.holes.iter().zip(1..) {
                let hole = Ring::new(hole, true, &format!("hole {place} of {name}"))?;
                if let Some(out) = hole.points.iter().find(|x| !outline.holds(**x)) {
                    return Err(format!("{} has the point {} {} outside of the outline", hole.name, out.x, out.y));
                }
                rings.push(hole);
            }
            rings.push(outline);
        }
        if rings.is_empty() {
            return Err("there is no floor: it needs a POLYGON or a MULTIPOLYGON".to_owned());
        }
        let count: usize = rings.iter().map(|ring| ring.points.len()).sum();
        if count > MOST_SEGMENTS {
            return Err(format!(
                "it has {count} walls, and the most is {MOST_SEGMENTS}: leave out details below a pedestrian's radius"
            ));
        }
        ring::apart(&rings)?;
        nested::check(&rings)?;
        let segments = wall::segments(&rings);
        let plan = Self { rings, segments, exits, cell, cells: Asked::default() };
        plan.cells_fit()?;
        plan.resolved()?;
        plan.exits_fit()?;
        Ok(plan)
    }
    /// The walls, those of one wall in a row.
    #[must_use]
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }
    /// The exits.
    #[must_use]
    pub fn exits(&self) -> &[Exit] {
        &self.exits
    }
    /// The side of a cell \[length\].
    #[must_use]
    pub fn cell(&self) -> f64 {
        self.cell
    }
    /// The lowest and the highest corner \[length\].
    #[must_use]
    pub fn extent(&self) -> (DVec2, DVec2) {
        let points = || self.rings.iter().flat_map(|ring| &ring.points).copied();
        (points().reduce(DVec2::min).unwrap_or_default(), points().reduce(DVec2::max).unwrap_or_default())
    }
    /// Whether a point is on the floor.
    #[must_use]
    pub fn holds(&self, x: DVec2) -> bool {
        self.rings.iter().filter(|ring| ring.holds(x)).count() % 2 == 1
    }
    /// The first wall between two points, if there is one.
    #[must_use]
    pub fn between(&self, a: DVec2, b: DVec2) -> Option<&Segment> {
        self.segments.iter().find(|wall| wall.crosses(a, b))
    }
    /// The distance to the nearest wall \[length\].
    #[must_use]
    pub fn distance(&self, x: DVec2) -> f64 {
        self.segments.iter().map(|wall| (x - wall::foot(wall.a, wall.b, x).0).length()).fold(f64::INFINITY, f64::min)
    }
    /// Its walls, for pictures: capsules whose radius is a three-hundredth of the plan.
    #[must_use]
    pub fn standing(&self) -> Vec<Standing> {
        let (low, high) = self.extent();
        let radius = (high - low).max_element() / 300.0;
        let wall = |one: &Segment| Standing {
            solid: Solid::Capsule((one.b - one.a).extend(0.0), radius),
            position: (0.5 * (one.a + one.b)).extend(0.0),
            motion: String::new(),
            inside: false,
        };
        self.segments.iter().map(wall).collect()
    }
    /// Refuses coordinates so large that single precision moves walls.
    fn resolved(&self) -> Result<(), String> {
        let (low, high) = self.extent();
        let largest = low.abs().max(high.abs()).max_element();
        let (apart, fine) = (f64::from(f32::EPSILON) * largest.log2().floor().exp2(), FINE * self.cell);
        if apart <= fine {
            return Ok(());
        }
        let near = low.floor();
        Err(format!(
            "its coordinates go up to {largest}, where numbers of single precision are {apart} apart, and the most is {fine}, a hundredth of a cell: \
             subtract a point near it, with origin = [{}, {}, 0] in [plan], or --origin {},{} of `motes crowds`, or choose larger cells",
            near.x, near.y, near.x, near.y
        ))
    }
}
