//! Floor plans in files: as polygons (WKT, GeoJSON), as drawings (SVG, DXF) and as pictures (PNG).
//!
//! Polygons are taken as they are. Of a drawing, and of a picture, what is dark is a wall, and what is coloured is an exit, unless names of layers say
//! otherwise: it is drawn on a grid of pixels, so that walls may overlap, and the outlines of the floor are those on the grid.

mod canvas;
mod dxf;
mod geojson;
mod layer;
mod measure;
mod picture;
mod svg;
mod wkt;

use glam::DVec2;

use crate::floor_plan::Polygon;
pub use measure::{Measure, PIXEL, Scale};

/// What a file has.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Drawn {
    /// The floor \[m\].
    pub polygons: Vec<Polygon>,
    /// The exits.
    pub exits: Vec<ExitLine>,
}

/// The line of an exit.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ExitLine {
    /// Its points \[m\].
    pub path: Vec<DVec2>,
    /// Its name, if the file has one.
    pub name: Option<String>,
}

/// The floor outside of an exit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Landing {
    /// The middle of the exit \[m\].
    pub middle: DVec2,
    /// Out of the building.
    pub outward: DVec2,
    /// How far from the middle it reaches \[m\].
    pub radius: f64,
}

/// A plan that was read.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Plan {
    /// The floor and the exits.
    pub drawn: Drawn,
    /// The floor outside of exits.
    pub landings: Vec<Landing>,
    /// What one should know about it, in sentences.
    pub remarks: Vec<String>,
}

impl Landing {
    /// Whether a place is on it \[m\].
    #[must_use]
    pub fn holds(&self, x: DVec2) -> bool {
        let r = x - self.middle;
        r.length() <= self.radius && r.dot(self.outward) > 0.0
    }
}

impl Plan {
    /// The same seen from an origin, which is subtracted from all points \[length\].
    #[must_use]
    pub fn from_origin(mut self, origin: DVec2) -> Self {
        let floor = self.drawn.polygons.iter_mut();
        let floor = floor.flat_map(|one| std::iter::once(&mut one.outline).chain(&mut one.holes));
        floor.chain(self.drawn.exits.iter_mut().map(|exit| &mut exit.path)).flatten().for_each(|x| *x -= origin);
        self.landings.iter_mut().for_each(|landing| landing.middle -= origin);
        self
    }
    /// The names of its exits: those that are given, or those of the file, or numbers.
    #[must_use]
    pub fn names(&self, given: &[String]) -> Vec<String> {
        let named = |(exit, number): (&ExitLine, usize)| {
            let name = given.get(number - 1).or(exit.name.as_ref());
            name.cloned().unwrap_or_else(|| format!("exit {number}"))
        };
        self.drawn.exits.iter().zip(1..).map(named).collect()
    }
    fn scaled(mut self, unit: f64) -> Self {
        let floor = self.drawn.polygons.iter_mut();
        let floor = floor.flat_map(|one| std::iter::once(&mut one.outline).chain(&mut one.holes));
        floor.chain(self.drawn.exits.iter_mut().map(|exit| &mut exit.path)).flatten().for_each(|x| *x *= unit);
        self
    }
}

/// What a file is, by its first bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Form {
    Png,
    Svg,
    GeoJson,
    Dxf,
    Wkt,
}

/// First bytes of files that are no plans here, what they are, and the way out.
const OTHERS: [(&[u8], &str); 8] = [
    (b"%PDF", "a PDF: save its drawing as SVG, as Inkscape does"),
    (b"AC10", "a DWG: save it as DXF"),
    (b"AutoCAD Binary DXF", "a binary DXF: save it as DXF in ASCII"),
    (b"\x1f\x8b", "compressed (gzip, as in .svgz): unpack it"),
    (b"\xff\xd8\xff", "a JPEG, whose colours run along walls: draw it over as SVG, or save it as PNG"),
    (b"GIF8", "a GIF: save it as PNG"),
    (b"\xff\xfe", "UTF-16: save it as UTF-8"),
    (b"\xfe\xff", "UTF-16: save it as UTF-8"),
];

impl Form {
    fn of(bytes: &[u8]) -> Result<Self, String> {
        if bytes.starts_with(b"\x89PNG") {
            return Ok(Self::Png);
        }
        if let Some((_, what)) = OTHERS.iter().find(|(begins, _)| bytes.starts_with(begins)) {
            return Err(format!("it is {what}"));
        }
        let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
        let first = text.split(|byte| matches!(byte, b'\n' | b'\r')).next().unwrap_or_default().trim_ascii();
        Ok(match text.first() {
            Some(b'<') => Self::Svg,
            Some(b'{' | b'[') => Self::GeoJson,
            _ if matches!(first, b"0" | b"999") => Self::Dxf,
            _ => Self::Wkt,
        })
    }
}

/// Reads a plan of any format, by its first bytes.
///
/// # Errors
/// A sentence, with the place: what is of no known format, damaged, has no scale where its format has none, or cannot be a plan.
pub fn read(bytes: &[u8], measure: &Measure) -> Result<Plan, String> {
    let form = Form::of(bytes)?;
    if form == Form::Png {
        return png(bytes, measure);
    }
    let text = std::str::from_utf8(bytes).map_err(|why| {
        let at = why.valid_up_to();
        format!("its byte {at} is no UTF-8, so that it is no text: a plan is WKT, GeoJSON, SVG, DXF or a picture (PNG)")
    })?;
    let text = text.trim_start_matches('\u{feff}');
    match form {
        Form::Svg => svg::read(text, measure),
        Form::GeoJson => geojson::read(text, measure),
        Form::Dxf => dxf::read(text, measure),
        Form::Wkt | Form::Png => {
            measure.without_pixel("well-known text has no pixels")?;
            let plan = Plan { drawn: wkt::read(text)?, ..Plan::default() };
            Ok(plan.scaled(measure.unit_or_metres()?))
        }
    }
}

#[cfg(feature = "images")]
fn png(bytes: &[u8], measure: &Measure) -> Result<Plan, String> {
    picture::read(bytes, measure.of_picture()?)
}
#[cfg(not(feature = "images"))]
fn png(_: &[u8], _: &Measure) -> Result<Plan, String> {
    Err("it is a picture (PNG), and this program was built without pictures: build it with the feature `images`, or give the plan as SVG".to_owned())
}
