//! Floor plans as GeoJSON (RFC 7946): Polygon and MultiPolygon features are the floor, LineString and MultiLineString features are exits, unless a
//! property `kind` (or `type`, `layer`, `class`, `indoor`) says otherwise: `wall`, `exit` or `floor`. A property `name` names an exit.
//!
//! Coordinates are metres. Longitudes and latitudes, as RFC 7946 has them, are recognised by a plan that would be smaller than a hand: they become metres to
//! the east and to the north of the lowest ones.

use glam::DVec2;
use serde_json::{Map, Value};

use super::canvas::{Canvas, Ink, Rule};
use super::layer::Layer;
use super::measure::Measure;
use super::{Drawn, ExitLine, Plan};
use crate::floor_plan::Polygon;

/// Numbers and names in a file, at most.
const MOST: usize = 2_000_000;
/// Collections within each other.
const DEEPEST: usize = 16;
/// Properties that say what a feature is.
const KINDS: [&str; 5] = ["kind", "type", "layer", "class", "indoor"];
/// What reaches less far is in degrees: no floor is as small in metres, and none as large in degrees.
const DEGREES: f64 = 0.05;
/// Lines of walls are as wide as this \[m\].
const WALL: f64 = 0.1;
/// The ellipsoid WGS 84: its equatorial radius \[m\], and the square of its eccentricity.
const RADIUS: f64 = 6_378_137.0;
const ECCENTRICITY: f64 = 6.694_379_990_14e-3;

/// What a feature is, with its points.
struct Shape {
    layer: Layer,
    name: Option<String>,
    /// A polygon's outline and holes, or a line alone.
    rings: Vec<Vec<DVec2>>,
    is_line: bool,
}

/// Reads a plan.
///
/// # Errors
/// A sentence: what is no GeoJSON, with the line and column, or the number of the feature.
pub fn read(text: &str, measure: &Measure) -> Result<Plan, String> {
    let values = text.bytes().filter(|byte| matches!(byte, b',' | b'[' | b'{')).count();
    if values > MOST {
        return Err(format!("it has about {values} values, and the most is {MOST}: leave out what is no plan"));
    }
    let root: Value = serde_json::from_str(text).map_err(|why| format!("it is no GeoJSON ({why})"))?;
    let root = root.as_object().ok_or("it is JSON, and no GeoJSON: that is an object with the member \"type\"")?;
    let mut reader = Reader::default();
    reader.add(root)?;
    let mut remarks = reader.remarks();
    let mut shapes = reader.shapes;
    match measure.unit()? {
        Some(unit) => shapes.iter_mut().flat_map(|one| &mut one.rings).flatten().for_each(|x| *x *= unit),
        None => remarks.extend(projected(&mut shapes)),
    }
    let is_exact = shapes.iter().all(|one| one.is_line == (one.layer == Layer::Exits) && one.layer != Layer::Walls);
    let mut plan = if is_exact {
        measure.without_pixel("floors without features of walls are taken as they are, without pixels")?;
        Plan { drawn: exact(shapes), ..Plan::default() }
    } else {
        on_grid(&shapes, measure)?
    };
    plan.remarks.extend(remarks);
    Ok(plan)
}

/// What the properties of a feature say.
#[derive(Debug, Clone, Default)]
struct Said {
    layer: Option<Layer>,
    name: Option<String>,
}

/// What has been read so far.
#[derive(Default)]
struct Reader {
    shapes: Vec<Shape>,
    features: usize,
    /// Points and features without a geometry, and what is left out by its name.
    points: usize,
    left_out: usize,
    height: Option<f64>,
}

impl Reader {
    fn add(&mut self, root: &Map<String, Value>) -> Result<(), String> {
        match root.get("type").and_then(Value::as_str) {
            Some("FeatureCollection") => {
                let features = root.get("features").and_then(Value::as_array);
                let features = features.ok_or("its FeatureCollection has no list of \"features\"")?;
                features.iter().try_for_each(|one| self.feature(one))
            }
            Some("Feature") => {
                self.features += 1;
                self.properties(root)
            }
            Some(_) => {
                self.features += 1;
                self.geometry(root, &Said::default(), 0)
            }
            None => Err("it is JSON, and no GeoJSON: it has no member \"type\"".to_owned()),
        }
    }
    fn feature(&mut self, value: &Value) -> Result<(), String> {
        self.features += 1;
        match value.as_object() {
            Some(one) if one.get("type").and_then(Value::as_str) == Some("Feature") => self.properties(one),
            _ => Err(format!("feature {} is no object of the type \"Feature\"", self.features)),
        }
    }
    fn properties(&mut self, feature: &Map<String, Value>) -> Result<(), String> {
        let properties = feature.get("properties").and_then(Value::as_object);
        let property = |name: &str| properties.and_then(|all| all.get(name)).and_then(Value::as_str);
        let layer = KINDS.iter().find_map(|kind| property(kind).and_then(Layer::of));
        let name = property("name").filter(|name| !name.trim().is_empty()).map(str::to_owned);
        match feature.get("geometry") {
            Some(Value::Object(geometry)) => self.geometry(geometry, &Said { layer, name }, 0),
            Some(Value::Null) | None => {
                self.points += 1;
                Ok(())
            }
            Some(_) => Err(format!("the geometry of feature {} is no object", self.features)),
        }
    }
    fn geometry(&mut self, geometry: &Map<String, Value>, said: &Said, depth: usize) -> Result<(), String> {
        let number = self.features;
        let kind = geometry.get("type").and_then(Value::as_str).unwrap_or_default();
        let many = |what: &str| {
            let list = geometry.get(what).and_then(Value::as_array);
            list.ok_or_else(|| format!("the {kind} of feature {number} has no list of \"{what}\""))
        };
        if said.layer == Some(Layer::LeftOut) {
            self.left_out += 1;
            return Ok(());
        }
        match kind {
            "Polygon" => self.polygon(many("coordinates")?, said),
            "MultiPolygon" => many("coordinates")?.iter().try_for_each(|one| {
                let rings =
                    one.as_array().ok_or_else(|| format!("a polygon of feature {number} is no list of rings"))?;
                self.polygon(rings, said)
            }),
            "LineString" => self.line(many("coordinates")?, said),
            "MultiLineString" => many("coordinates")?.iter().try_for_each(|one| {
                let line = one.as_array().ok_or_else(|| format!("a line of feature {number} is no list of points"))?;
                self.line(line, said)
            }),
            "GeometryCollection" if depth < DEEPEST => many("geometries")?.iter().try_for_each(|one| {
                let one = one.as_object().ok_or_else(|| format!("a geometry of feature {number} is no object"))?;
                self.geometry(one, said, depth + 1)
            }),
            "GeometryCollection" => Err(format!("feature {number} is nested more than {DEEPEST} deep")),
            "Point" | "MultiPoint" => {
                self.points += 1;
                Ok(())
            }
            "Feature" | "FeatureCollection" => Err(format!("feature {number} has a {kind} as its geometry")),
            other => Err(format!(
                "feature {number} is of the type \"{}\", which GeoJSON has not: Polygon and MultiPolygon are the floor, LineString is an exit",
                super::super::shortened(other)
            )),
        }
    }
    fn polygon(&mut self, rings: &[Value], said: &Said) -> Result<(), String> {
        let number = self.features;
        let mut all = Vec::new();
        for ring in rings {
            let ring = ring.as_array().ok_or_else(|| format!("a ring of feature {number} is no list of points"))?;
            let mut points = self.points(ring)?;
            if let (Some(first), Some(last)) = (points.first().copied(), points.last().copied())
                && first != last
            {
                return Err(format!(
                    "a ring of feature {number} is not closed: it begins at {} {} and ends at {} {}; repeat the first point at the end",
                    first.x, first.y, last.x, last.y
                ));
            }
            points.pop();
            all.push(points);
        }
        if all.first().is_none_or(Vec::is_empty) {
            return Err(format!("the polygon of feature {number} is empty"));
        }
        self.shapes.push(Shape {
            layer: said.layer.unwrap_or(Layer::Floor),
            name: said.name.clone(),
            rings: all,
            is_line: false,
        });
        Ok(())
    }
    fn line(&mut self, line: &[Value], said: &Said) -> Result<(), String> {
        let rings = vec![self.points(line)?];
        let layer = said.layer.unwrap_or(Layer::Exits);
        if layer == Layer::Floor {
            return Err(format!("feature {} is a line that is to be floor: a floor is a Polygon", self.features));
        }
        self.shapes.push(Shape { layer, name: said.name.clone(), rings, is_line: true });
        Ok(())
    }
    fn points(&mut self, line: &[Value]) -> Result<Vec<DVec2>, String> {
        let number = self.features;
        let point = |value: &Value| {
            let numbers: Option<Vec<f64>> = value.as_array()?.iter().map(Value::as_f64).collect();
            numbers.filter(|all| matches!(all.len(), 2 | 3) && all.iter().all(|x| x.is_finite()))
        };
        let mut points = Vec::new();
        for (value, place) in line.iter().zip(1..) {
            let at = point(value).ok_or_else(|| {
                format!(
                    "point {place} of feature {number} is {}, and it must be [x, y] in metres",
                    super::super::shortened(&value.to_string())
                )
            })?;
            let height = at.get(2).copied().unwrap_or(0.0) + 0.0;
            let floor = *self.height.get_or_insert(height);
            if floor.total_cmp(&height).is_ne() {
                return Err(format!(
                    "point {place} of feature {number}, at {} {}, is at the height {height}, and others at {floor}: a plan is one flat floor; write \
                     each floor into its own file, or the points without height",
                    at[0], at[1]
                ));
            }
            points.push(DVec2::new(at[0], at[1]));
        }
        Ok(points)
    }
    fn remarks(&self) -> Vec<String> {
        let mut remarks = Vec::new();
        if self.points > 0 {
            remarks.push(format!("{} features are points or have no geometry: they are left out", self.points));
        }
        if self.left_out > 0 {
            remarks.push(format!(
                "{} features are doors, furniture or text by their property: they are left out",
                self.left_out
            ));
        }
        remarks
    }
}

/// Makes metres of degrees, if these are degrees. A remark on that.
fn projected(shapes: &mut [Shape]) -> Option<String> {
    let points = || shapes.iter().flat_map(|one| &one.rings).flatten().copied();
    let (low, high) = (points().reduce(DVec2::min)?, points().reduce(DVec2::max)?);
    let size = high - low;
    let on_earth = low.cmpge(DVec2::new(-180.0, -90.0)).all() && high.cmple(DVec2::new(180.0, 90.0)).all();
    if !on_earth || size.max_element() >= DEGREES || size.max_element() <= 0.0 {
        return None;
    }
    // Along the meridian and along the parallel, at the middle of the plan.
    let latitude = (0.5 * (low.y + high.y)).to_radians();
    let w = (1.0 - ECCENTRICITY * latitude.sin().powi(2)).sqrt();
    let metres = DVec2::new(RADIUS / w * latitude.cos(), RADIUS * (1.0 - ECCENTRICITY) / w.powi(3)) * 1f64.to_radians();
    shapes.iter_mut().flat_map(|one| &mut one.rings).flatten().for_each(|x| *x = (*x - low) * metres);
    Some(format!(
        "its coordinates are longitudes and latitudes: places are metres to the east and to the north of {} {}; give --scale 1 if they are metres",
        low.x, low.y
    ))
}

/// The floors and the exits as they are.
fn exact(shapes: Vec<Shape>) -> Drawn {
    let mut drawn = Drawn::default();
    for shape in shapes {
        let mut rings = shape.rings.into_iter();
        let first = rings.next().unwrap_or_default();
        if shape.is_line {
            drawn.exits.push(ExitLine { path: first, name: shape.name });
        } else {
            drawn.polygons.push(Polygon { outline: first, holes: rings.collect() });
        }
    }
    drawn
}

/// Floors with walls on them.
fn on_grid(shapes: &[Shape], measure: &Measure) -> Result<Plan, String> {
    let has = |layer: Layer| shapes.iter().any(|one| one.layer == layer);
    if !has(Layer::Exits) {
        return Err("it has no exit, so that no way leads out: add a LineString on its floor, with \"kind\": \"exit\" among its properties".to_owned());
    }
    let points = || shapes.iter().flat_map(|one| &one.rings).flatten().copied();
    let (low, high) =
        (points().reduce(DVec2::min).unwrap_or_default(), points().reduce(DVec2::max).unwrap_or_default());
    let has_floor = has(Layer::Floor);
    let background = if has_floor { Ink::Wall } else { Ink::Open };
    // Walls along the edge have room for half of their width.
    let mut canvas = Canvas::over(low - WALL, high + WALL, measure, background)?;
    for (layer, ink) in [(Layer::Floor, Ink::Open), (Layer::Walls, Ink::Wall), (Layer::Exits, Ink::Exit)] {
        for shape in shapes.iter().filter(|one| one.layer == layer) {
            let rings: Vec<Vec<DVec2>> =
                shape.rings.iter().map(|ring| ring.iter().map(|x| canvas.place(*x)).collect()).collect();
            let width = if ink == Ink::Wall { WALL / canvas.side } else { 0.0 };
            let drawn = match (&rings[..], shape.is_line) {
                ([line], true) => canvas.line(line, width, ink)?,
                _ => canvas.fill(&rings, Rule::EvenOdd, ink, None)?,
            };
            if drawn && ink == Ink::Exit {
                canvas.name_exit(shape.name.clone());
            }
        }
    }
    canvas.plan()
}
