//! VTP, the polygons of VTK as XML with raw data behind it, which ParaView reads: particles are points, springs and rods are lines,
//! triangles are polygons. Format: the VTK file formats page, "XML File Formats", PolyData.
//!
//! Point data has one array for each column: `velocity`, `mass`, …, `id`. Field data holds `TimeValue`, `step` and `box`. What other
//! programs write is read too: appended raw, in base 64 or as text, also compressed with zlib. Lines and polygons are not read.

use std::io::{self, Write};

use super::binary::{Type, bytes_of, single};
use super::blocks::{Coding, ZLIB, packed};
use super::contents::counted;
use super::sheet::{self, ID, Place, Sheet};
use super::tags::{Tag, base64};
use super::titles::{self, Field, Number};
use super::{Format, Input, Options, Precision, input, shortened};
use crate::error::Error;
use crate::kernel::{Bounds, Columns, Side};
use crate::state::State;

pub use super::collection::Collection;

/// Its entry in the register.
pub(super) const FORMAT: Format = Format {
    name: "vtp",
    about: "VTK polygons for ParaView, with a list of all states, snapshots.pvd; springs are lines, triangles are polygons",
    endings: &["vtp"],
    begins: |start| start.windows(15).any(|part| part == b"type=\"PolyData\""),
    contents: |path| Ok(sheet(path, &|_| false)?.contents),
    read: Some(read),
    write: Some(|out, state, options| write_vtp(out, state, options)),
    left_out: None,
    compresses: true,
    divides: false,
};

/// The names of field data.
const TIME: &str = "TimeValue";
const STEP: &str = "step";
const BOX: &str = "box";

/// An array of the appended data.
enum Data<'a> {
    /// A column, in this precision.
    Field(&'a Field<'a>, Precision),
    /// Ids of particles.
    Ids(&'a [u32]),
    /// Indices of points, or ends of cells.
    Places(Vec<u64>),
}

/// An array after the XML: in its final form, or already compressed.
enum Appended<'a> {
    Plain(Data<'a>),
    Packed(Vec<u8>),
}

impl Data<'_> {
    fn kind(&self) -> (&'static str, usize) {
        match self {
            Self::Field(field, _) if field.is_whole() => ("UInt32", 4),
            Self::Field(_, Precision::Single) => ("Float32", 4),
            Self::Field(_, Precision::Double) => ("Float64", 8),
            Self::Ids(_) => ("UInt32", 4),
            Self::Places(_) => ("Int64", 8),
        }
    }
    fn length(&self, rows: usize) -> u64 {
        let numbers = match self {
            Self::Field(field, _) => rows * field.strips.len(),
            Self::Ids(list) => list.len(),
            Self::Places(list) => list.len(),
        };
        (numbers * self.kind().1) as u64
    }
    fn write(&self, out: &mut impl Write, rows: usize) -> io::Result<()> {
        match self {
            Self::Ids(list) => list.iter().try_for_each(|id| out.write_all(&id.to_le_bytes())),
            Self::Places(list) => list.iter().try_for_each(|place| out.write_all(&place.to_le_bytes())),
            Self::Field(field, precision) => {
                for strip in (0..rows).flat_map(|row| field.strips.iter().map(move |strip| strip.of(row))) {
                    match (strip, precision) {
                        (Number::Whole(number), _) => out.write_all(&number.to_le_bytes())?,
                        (Number::Real(number), Precision::Single) => out.write_all(&single(number)?.to_le_bytes())?,
                        (Number::Real(number), Precision::Double) => out.write_all(&number.to_le_bytes())?,
                    }
                }
                Ok(())
            }
        }
    }
}

/// The XML, and the arrays that follow it.
struct Document<'a> {
    text: String,
    arrays: Vec<Appended<'a>>,
    offset: u64,
    rows: usize,
    compress: bool,
}

impl<'a> Document<'a> {
    // Writing into a String cannot fail.
    fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }
    fn array(&mut self, name: &str, data: Data<'a>) -> io::Result<()> {
        let components = if let Data::Field(field, _) = &data { field.strips.len() } else { 1 };
        let (kind, offset) = (data.kind().0, self.offset);
        self.line(&format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"appended\" offset=\"{offset}\"/>"
        ));
        if self.compress {
            let mut bytes = Vec::new();
            data.write(&mut bytes, self.rows)?;
            let bytes = packed(&bytes)?;
            self.offset += bytes.len() as u64;
            self.arrays.push(Appended::Packed(bytes));
        } else {
            self.offset += 8 + data.length(self.rows);
            self.arrays.push(Appended::Plain(data));
        }
        Ok(())
    }
    fn cells(&mut self, name: &str, cells: impl Iterator<Item = Vec<u64>>) -> io::Result<()> {
        let (mut ends, mut all) = (Vec::new(), Vec::new());
        for cell in cells {
            all.extend(cell);
            ends.push(all.len() as u64);
        }
        self.line(&format!("<{name}>"));
        self.array("connectivity", Data::Places(all))?;
        self.array("offsets", Data::Places(ends))?;
        self.line(&format!("</{name}>"));
        Ok(())
    }
    fn single(&mut self, kind: &str, name: &str, numbers: &[String]) {
        self.line(&format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfTuples=\"{}\" format=\"ascii\">{}</DataArray>",
            numbers.len(),
            numbers.join(" ")
        ));
    }
}

/// Writes a state: a point for each particle in the order of the ids.
///
/// # Errors
/// Those of `out`; a number that does not fit single precision, where that is asked for.
pub fn write_vtp(mut out: impl Write, state: &State, options: &Options) -> io::Result<()> {
    let (rows, links, ids) = (state.len(), &state.links, state.ids());
    let fields = titles::fields(state);
    let lines: Vec<[u32; 2]> =
        links.springs.iter().map(|link| link.ends).chain(links.rods.iter().map(|rod| rod.ends)).collect();
    let mut document = Document { text: String::new(), arrays: Vec::new(), offset: 0, rows, compress: options.compress };
    document.line("<?xml version=\"1.0\"?>");
    let compressor = if options.compress { format!(" compressor=\"{ZLIB}\"") } else { String::new() };
    document.line(&format!(
        "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\"{compressor}>"
    ));
    document.line(&format!("<!-- motes {} -->\n<PolyData>\n<FieldData>", env!("CARGO_PKG_VERSION")));
    document.single("Float64", TIME, &[format!("{:?}", state.time)]);
    document.single("UInt64", STEP, &[state.step.to_string()]);
    if let Some(bounds) = &options.bounds {
        let sides = bounds.sides.map(|side| f64::from(side as u8));
        let numbers = [bounds.low.to_array(), bounds.high.to_array(), sides].concat();
        document.single("Float64", BOX, &numbers.iter().map(|number| format!("{number:?}")).collect::<Vec<_>>());
    }
    document.line(&format!(
        "</FieldData>\n<Piece NumberOfPoints=\"{rows}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" \
         NumberOfPolys=\"{}\">\n<PointData>",
        u8::from(rows > 0),
        lines.len(),
        links.triangles.len()
    ));
    let (points, data): (Vec<_>, Vec<_>) = fields.iter().partition(|field| field.name == "position");
    for field in data {
        document.array(&field.name, Data::Field(field, options.precision))?;
    }
    document.array(ID, Data::Ids(&ids))?;
    document.line("</PointData>\n<Points>");
    for field in points {
        document.array("Points", Data::Field(field, options.precision))?;
    }
    document.line("</Points>");
    // All points are one cell: it takes one index for each, and no end.
    document.cells("Verts", std::iter::once((0..rows as u64).collect()).filter(|all: &Vec<u64>| !all.is_empty()))?;
    document.cells("Lines", lines.iter().map(|ends| ends.map(u64::from).to_vec()))?;
    document.cells("Polys", links.triangles.iter().map(|ends| ends.map(u64::from).to_vec()))?;
    document.line("</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">");
    document.text.push('_');
    out.write_all(document.text.as_bytes())?;
    for data in &document.arrays {
        match data {
            Appended::Plain(data) => {
                out.write_all(&data.length(rows).to_le_bytes())?;
                data.write(&mut out, rows)?;
            }
            Appended::Packed(bytes) => out.write_all(bytes)?,
        }
    }
    out.write_all(b"\n</AppendedData>\n</VTKFile>\n")
}

/// Reads a state of these columns. Arrays without a column are skipped.
///
/// # Errors
/// [`Error::Input`] with the byte of an invalid tag, of a truncated array, or of an invalid number; a compression other than zlib.
pub fn read(path: &Input<'_>, columns: &Columns) -> Result<State, Error> {
    sheet::read(path, columns, sheet)
}

/// The attributes of the whole file for its arrays.
#[derive(Clone, Copy)]
struct Layout {
    big: bool,
    /// The type of the counts before arrays.
    counts: Type,
    /// Whether arrays are compressed.
    packed: bool,
    /// The byte after `_`, and whether the data there is in base 64.
    appended: Option<(usize, bool)>,
}

/// The section of an array.
#[derive(Clone, Copy, PartialEq)]
enum Section {
    Field,
    Points,
    Data,
    Other,
}

fn sheet(path: &Input<'_>, wanted: &dyn Fn(&str) -> bool) -> Result<Sheet, Error> {
    let bytes = bytes_of(path)?;
    parsed(&bytes, wanted).map_err(|message| input(path, message))
}

fn parsed(bytes: &[u8], wanted: &dyn Fn(&str) -> bool) -> Result<Sheet, String> {
    let mut sheet = Sheet::default();
    let mut layout = Layout { big: false, counts: Type::U32, packed: false, appended: appended(bytes)? };
    let (mut section, mut pieces, mut boxed, mut kind) = (Section::Other, 0, Vec::new(), false);
    let mut at = 0;
    while let Some(tag) = Tag::next(bytes, at)? {
        at = tag.to;
        match tag.name {
            "VTKFile" => {
                kind = tag.get("type") == Some("PolyData");
                layout.big = tag.get("byte_order") == Some("BigEndian");
                layout.counts = if tag.get("header_type") == Some("UInt64") { Type::U64 } else { Type::U32 };
                layout.packed = match tag.get("compressor") {
                    None => false,
                    Some(ZLIB) => true,
                    Some(other) => {
                        let why = "save it with zlib or without compression";
                        return Err(format!("the data is compressed ({}): {why}", shortened(other)));
                    }
                };
            }
            "Piece" => {
                pieces += 1;
                let count = tag.get("NumberOfPoints").and_then(|count| count.parse::<u64>().ok());
                let count = count.ok_or_else(|| format!("byte {}: a piece has no NumberOfPoints", tag.from))?;
                if pieces > 1 {
                    return Err(format!("byte {}: a second piece; files of one are read: merge them", tag.from));
                }
                sheet.contents.rows = usize::try_from(count).unwrap_or(usize::MAX);
                let cells = [("NumberOfLines", "line"), ("NumberOfStrips", "strip"), ("NumberOfPolys", "polygon")];
                let there = |(key, name)| Some((tag.get(key)?.parse::<u64>().ok().filter(|count| *count > 0)?, name));
                let cells = cells.into_iter().filter_map(there).map(|(count, name)| counted(count, name));
                sheet.contents.left_out.extend(cells);
            }
            "FieldData" => section = Section::Field,
            "PointData" => section = Section::Data,
            "Points" => section = Section::Points,
            "/FieldData" | "/PointData" | "/Points" => section = Section::Other,
            "AppendedData" => break,
            "DataArray" => array(bytes, &tag, (layout, section), wanted, &mut sheet, &mut boxed)?,
            _ => {}
        }
    }
    if !kind || pieces == 0 {
        return Err("is no VTK file of polygons: it has no PolyData with a piece".to_owned());
    }
    if layout.appended.is_some() && !bytes.trim_ascii_end().ends_with(b"</VTKFile>") {
        return Err(format!("byte {}: the file ends here, without </VTKFile>: it is truncated", bytes.len()));
    }
    if let [a, b, c, d, e, f, x, y, z] = boxed[..] {
        let sides = [x, y, z].map(|side| match side {
            1.0 => Side::Periodic,
            2.0 => Side::Reflecting,
            _ => Side::Open,
        });
        sheet.contents.bounds = Some(Bounds { low: [a, b, c].into(), high: [d, e, f].into(), sides, dimensions: 3 });
    }
    Ok(sheet)
}

/// The start of the appended data.
fn appended(bytes: &[u8]) -> Result<Option<(usize, bool)>, String> {
    let word = b"<AppendedData";
    let Some(from) = bytes.windows(word.len()).position(|part| part == word) else { return Ok(None) };
    let Some(tag) = Tag::next(bytes, from)? else { return Ok(None) };
    let mark = bytes[tag.to..].iter().position(|byte| *byte == b'_');
    let mark = mark.ok_or_else(|| format!("byte {}: appended data begins with `_`, and there is none", tag.to))?;
    Ok(Some((tag.to + mark + 1, tag.get("encoding") == Some("base64"))))
}

fn array(
    bytes: &[u8],
    tag: &Tag<'_>,
    (layout, section): (Layout, Section),
    wanted: &dyn Fn(&str) -> bool,
    sheet: &mut Sheet,
    boxed: &mut Vec<f64>,
) -> Result<(), String> {
    let name = tag.get("Name").unwrap_or_default();
    let name = if section == Section::Points { "position" } else { name };
    let components: usize = tag.get("NumberOfComponents").and_then(|n| n.parse().ok()).unwrap_or(1);
    if section == Section::Other || section == Section::Field && ![TIME, STEP, BOX].contains(&name) {
        return Ok(());
    }
    let kind = match tag.get("type") {
        Some("Int8") => Type::I8,
        Some("UInt8") => Type::U8,
        Some("Int16") => Type::I16,
        Some("UInt16") => Type::U16,
        Some("Int32") => Type::I32,
        Some("UInt32") => Type::U32,
        Some("Int64") => Type::I64,
        Some("UInt64") => Type::U64,
        Some("Float32") => Type::F32,
        Some("Float64") => Type::F64,
        // Such as strings.
        _ => return Ok(()),
    };
    if !(1..=MOST).contains(&components) {
        return Err(format!("byte {}: {components} components; 1 to {MOST} are read", tag.from));
    }
    let rows = sheet.contents.rows;
    let numbers = match section {
        Section::Field => tag.get("NumberOfTuples").and_then(|n| n.parse().ok()).unwrap_or(1),
        _ => rows.checked_mul(components).ok_or_else(|| format!("byte {}: {rows} points are too many", tag.from))?,
    };
    let data = data(bytes, tag, kind, layout, numbers)?;
    if section == Section::Field {
        let numbers: Vec<f64> = (0..numbers).map(|n| data.number(n)).collect();
        match (name, numbers.first()) {
            (TIME, Some(time)) => sheet.time = *time,
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates, which suits a step")]
            (STEP, Some(step)) => sheet.step = *step as u64,
            _ => *boxed = numbers,
        }
        return Ok(());
    }
    if section == Section::Points && components != 3 {
        return Err(format!("byte {}: `{name}` has {components} components, and 3 are read", tag.from));
    }
    for (k, title) in sheet::titles_of(name, components).into_iter().enumerate() {
        sheet.enter(&title, kind.is_whole(), wanted, || {
            let place = match &data {
                Numbers::There { first, kind, .. } => Place::Byte {
                    first: (first + k * kind.width()) as u64,
                    stride: (components * kind.width()) as u64,
                },
                _ => Place::Named(name.to_owned()),
            };
            ((0..rows).map(|row| data.number(row * components + k)).collect(), place)
        });
    }
    Ok(())
}

/// The maximum number of components.
const MOST: usize = 4096;

/// The numbers of an array.
enum Numbers<'a> {
    /// Raw in the file, from this byte on.
    There { bytes: &'a [u8], first: usize, kind: Type, big: bool },
    /// Decoded from base 64.
    Decoded { bytes: Vec<u8>, first: usize, kind: Type, big: bool },
    /// Parsed from text.
    Text(Vec<f64>),
}

impl Numbers<'_> {
    fn number(&self, place: usize) -> f64 {
        match self {
            Self::There { bytes, first, kind, big } => kind.number(&bytes[first + place * kind.width()..], *big),
            Self::Decoded { bytes, first, kind, big } => kind.number(&bytes[first + place * kind.width()..], *big),
            Self::Text(list) => list.get(place).copied().unwrap_or(0.0),
        }
    }
}

fn data<'a>(bytes: &'a [u8], tag: &Tag<'_>, kind: Type, layout: Layout, numbers: usize) -> Result<Numbers<'a>, String> {
    let (name, big, counted) = (tag.get("Name").unwrap_or_default(), layout.big, layout.counts.width());
    let at = tag.from;
    let needed = numbers.checked_mul(kind.width()).ok_or_else(|| format!("byte {at}: {numbers} numbers are too many"))?;
    let wrong = |there: f64| format!("byte {at}: `{}` needs {needed} bytes, and the file has {there} for it", shortened(name));
    // The bytes after their count.
    let counts = |bytes: &[u8]| {
        let count = bytes.get(..counted).map(|bytes| layout.counts.number(bytes, big)).ok_or_else(|| wrong(0.0))?;
        if count.to_bits() == (needed as f64).to_bits() {
            return Ok(());
        }
        Err(format!("byte {at}: `{}` needs {needed} bytes, and its count announces {count}", shortened(name)))
    };
    let text = !matches!(tag.get("format"), Some("appended" | "binary"));
    let coding = |encoded| Coding { counts: layout.counts, big, encoded };
    let unpacked = |from: &[u8], encoded| {
        let bytes = coding(encoded).unpacked(from, needed);
        let bytes = bytes.map_err(|why| format!("byte {at}: `{}` {why}", shortened(name)))?;
        Ok(Numbers::Decoded { bytes, first: 0, kind, big })
    };
    if !text && !layout.packed && needed > bytes.len() {
        return Err(wrong(bytes.len() as f64));
    }
    if tag.get("format") == Some("appended") {
        let offset: usize = tag.get("offset").and_then(|text| text.parse().ok()).ok_or_else(|| format!("byte {at}: no offset"))?;
        let (start, encoded) = layout.appended.ok_or_else(|| format!("byte {at}: there is no appended data"))?;
        let first = start.checked_add(offset).filter(|first| *first <= bytes.len()).ok_or_else(|| wrong(0.0))?;
        let rest = &bytes[first..];
        if layout.packed {
            return unpacked(rest, encoded);
        }
        if !encoded {
            counts(rest)?;
            let there = rest.len() - counted;
            return if there >= needed {
                Ok(Numbers::There { bytes, first: first + counted, kind, big })
            } else {
                Err(wrong(there as f64))
            };
        }
        let letters = (counted + needed).div_ceil(3).saturating_mul(4);
        let part = rest.get(..letters).ok_or_else(|| wrong((rest.len() / 4 * 3) as f64))?;
        return decoded(part, at, counts, needed + counted).map(|bytes| Numbers::Decoded { bytes, first: counted, kind, big });
    }
    let inner = if tag.empty { &[][..] } else { &bytes[tag.to..] };
    let inner = &inner[..inner.iter().position(|byte| *byte == b'<').unwrap_or(inner.len())];
    if tag.get("format") == Some("binary") && layout.packed {
        return unpacked(inner, true);
    }
    if tag.get("format") == Some("binary") {
        return decoded(inner, at, counts, needed + counted).map(|bytes| Numbers::Decoded { bytes, first: counted, kind, big });
    }
    let mut list = Vec::new();
    for word in inner.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()) {
        let text = String::from_utf8_lossy(word);
        list.push(text.parse::<f64>().map_err(|_| format!("byte {at}: `{}` is no number", shortened(&text)))?);
    }
    if list.len() == numbers {
        Ok(Numbers::Text(list))
    } else {
        Err(format!("byte {at}: `{}` has {} numbers of {numbers}", shortened(name), list.len()))
    }
}

fn decoded(
    text: &[u8],
    at: usize,
    counts: impl Fn(&[u8]) -> Result<(), String>,
    needed: usize,
) -> Result<Vec<u8>, String> {
    let bytes = base64(text).ok_or_else(|| format!("byte {at}: the array is not in base 64"))?;
    counts(&bytes)?;
    if bytes.len() < needed {
        return Err(format!("byte {at}: the array has {} bytes of {needed}", bytes.len()));
    }
    Ok(bytes)
}
