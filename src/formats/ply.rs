//! PLY, the polygon file of Stanford (Turk 1994), which Blender, Houdini and MeshLab read: particles are vertices, springs are edges,
//! triangles are faces.
//!
//! Titles of properties are those of a CSV file: `x`, `y`, `z`, `vx`, …, `id`. Comments hold the time, the step and the box. Files are
//! written binary and little-endian; ASCII and big-endian ones are read too. Edges and faces are not read: `[[links]]` makes them. Nor are
//! properties of vertices that are lists.

use std::fmt::Write as _;
use std::io::{self, Write};

use super::binary::{Type, bytes_of, single};
use super::contents::counted;
use super::sheet::{self, ID, Place, Sheet};
use super::titles::{self, Number};
use super::{Format, Input, Options, Precision, input, shortened};
use crate::error::Error;
use crate::kernel::{Bounds, Columns, Side};
use crate::state::State;

/// Its entry in the register.
pub(super) const FORMAT: Format = Format {
    name: "ply",
    about: "PLY, points for Blender, Houdini and MeshLab; springs are edges, triangles are faces",
    endings: &["ply"],
    begins: |start| start.starts_with(b"ply\n") || start.starts_with(b"ply\r"),
    contents: |path| Ok(sheet(path, &|_| false)?.contents),
    read: Some(read),
    write: Some(|out, state, options| write_ply(out, state, options)),
    left_out: None,
    compresses: false,
    divides: false,
};

/// Writes a state: a vertex for each particle in the order of the ids.
///
/// # Errors
/// Those of `out`; a number that does not fit single precision, where that is asked for.
pub fn write_ply(mut out: impl Write, state: &State, options: &Options) -> io::Result<()> {
    let strips = titles::strips(state);
    let real = if options.precision == Precision::Single { "float" } else { "double" };
    let mut head = format!(
        "ply\nformat binary_little_endian 1.0\ncomment motes {}\ncomment time {:?}\ncomment step {}\n",
        env!("CARGO_PKG_VERSION"),
        state.time,
        state.step
    );
    // Writing into a String cannot fail.
    if let Some(bounds) = &options.bounds {
        let [low, high, sides] = [bounds.low.to_string(), bounds.high.to_string(), bounds.sides.map(Side::name).join(" ")];
        let plain = |corner: String| corner.replace(['[', ']', ','], "");
        let _ = writeln!(head, "comment box {} {} {sides}", plain(low), plain(high));
    }
    let _ = writeln!(head, "element vertex {}", state.len());
    for strip in &strips {
        let _ = writeln!(head, "property {} {}", if strip.is_whole() { "uint" } else { real }, strip.text);
    }
    let _ = writeln!(head, "property uint {ID}");
    let links = &state.links;
    let pairs: Vec<[u32; 2]> =
        links.springs.iter().map(|link| link.ends).chain(links.rods.iter().map(|rod| rod.ends)).collect();
    if !pairs.is_empty() {
        let _ = writeln!(head, "element edge {}\nproperty int vertex1\nproperty int vertex2", pairs.len());
    }
    if !links.triangles.is_empty() {
        let _ = writeln!(head, "element face {}\nproperty list uchar int vertex_indices", links.triangles.len());
    }
    head.push_str("end_header\n");
    out.write_all(head.as_bytes())?;
    let ids = state.ids();
    for (row, id) in ids.iter().enumerate() {
        for strip in &strips {
            match (strip.of(row), options.precision) {
                (Number::Whole(number), _) => out.write_all(&number.to_le_bytes())?,
                (Number::Real(number), Precision::Single) => out.write_all(&single(number)?.to_le_bytes())?,
                (Number::Real(number), Precision::Double) => out.write_all(&number.to_le_bytes())?,
            }
        }
        out.write_all(&id.to_le_bytes())?;
    }
    for end in pairs.iter().flatten() {
        out.write_all(&end.to_le_bytes())?;
    }
    for ends in &links.triangles {
        out.write_all(&[3])?;
        ends.iter().try_for_each(|end| out.write_all(&end.to_le_bytes()))?;
    }
    Ok(())
}

/// Reads a state of these columns. Properties without a column, such as colours and normals, are skipped.
///
/// # Errors
/// [`Error::Input`] with the line of an invalid header, or the byte of truncated, missing, non-numeric or invalid data.
pub fn read(path: &Input<'_>, columns: &Columns) -> Result<State, Error> {
    sheet::read(path, columns, sheet)
}

/// The encoding of numbers in a file.
#[derive(Clone, Copy, PartialEq)]
enum Body {
    Text,
    Little,
    Big,
}

/// A property: its type, and that of its length if it is a list.
struct Property {
    name: String,
    kind: Type,
    length: Option<Type>,
}

struct Element {
    name: String,
    count: u64,
    properties: Vec<Property>,
}

struct Header {
    body: Body,
    elements: Vec<Element>,
    time: f64,
    step: u64,
    bounds: Option<Bounds>,
    /// The start of the numbers.
    end: usize,
}

/// The longest header \[bytes\].
const LONGEST: usize = 1 << 20;

fn sheet(path: &Input<'_>, wanted: &dyn Fn(&str) -> bool) -> Result<Sheet, Error> {
    let bytes = bytes_of(path)?;
    let refuse = |message: String| input(path, message);
    let header = header(&bytes).map_err(refuse)?;
    let mut sheet = Sheet { time: header.time, step: header.step, ..Sheet::default() };
    sheet.contents.bounds = header.bounds;
    if !header.elements.iter().any(|element| element.name == "vertex") {
        return Err(input(path, "the header has no `element vertex`: particles are vertices"));
    }
    let mut at = header.end;
    for element in &header.elements {
        let start = at;
        at = passed(&bytes, at, element, header.body).map_err(refuse)?;
        if element.name != "vertex" {
            sheet.contents.left_out.extend(left_out(element));
            continue;
        }
        if element.properties.iter().any(|property| property.length.is_some()) {
            let columns = uneven(&bytes[start..at], element, header.body).map_err(refuse)?;
            sheet.contents.rows = usize::try_from(element.count).unwrap_or(usize::MAX);
            for (Property { name, kind, length }, values) in element.properties.iter().zip(columns) {
                if length.is_some() {
                    sheet.contents.left_out.push(format!("the list `{}` of vertices", shortened(name)));
                } else {
                    sheet.enter(name, kind.is_whole(), wanted, || (values, Place::Named(name.clone())));
                }
            }
            continue;
        }
        let rows = usize::try_from(element.count).unwrap_or(usize::MAX);
        sheet.contents.rows = rows;
        let stride: usize = element.properties.iter().map(|property| property.kind.width()).sum();
        let words: Vec<&[u8]> = match header.body {
            Body::Text if element.properties.iter().any(|property| wanted(&property.name)) => words(&bytes[start..at]).collect(),
            _ => Vec::new(),
        };
        let mut first = start;
        for (number, Property { name, kind, .. }) in element.properties.iter().enumerate() {
            let mut wrong = None;
            sheet.enter(name, kind.is_whole(), wanted, || {
                if header.body == Body::Text {
                    let cells = words.iter().skip(number).step_by(element.properties.len());
                    let number = |word: &&[u8]| {
                        let text = String::from_utf8_lossy(word);
                        text.parse().unwrap_or_else(|_| {
                            wrong = Some(format!("`{}`, a value of the property `{name}`, is no number", shortened(&text)));
                            0.0
                        })
                    };
                    (cells.map(number).collect(), Place::Named(name.clone()))
                } else {
                    let one = |row: usize| kind.number(&bytes[first + row * stride..], header.body == Body::Big);
                    ((0..rows).map(one).collect(), Place::Byte { first: first as u64, stride: stride as u64 })
                }
            });
            if let Some(wrong) = wrong {
                return Err(input(path, wrong));
            }
            first += kind.width();
        }
    }
    if header.body == Body::Text && !bytes[at..].trim_ascii().is_empty() {
        return Err(input(path, format!("byte {at}: lines follow what the header announces")));
    }
    if header.body != Body::Text && at != bytes.len() {
        return Err(input(path, format!("byte {at}: {} bytes follow what the header announces", bytes.len() - at)));
    }
    Ok(sheet)
}

/// The description of an element that is not read.
fn left_out(element: &Element) -> Option<String> {
    let Element { name, count, .. } = element;
    let text = match name.as_str() {
        "edge" | "face" => counted(*count, name),
        _ => format!("{count} of `{}`", shortened(name)),
    };
    (*count > 0).then_some(text)
}

/// The numbers of each property of an element, some of which are lists; those of the lists are skipped.
fn uneven(bytes: &[u8], element: &Element, body: Body) -> Result<Vec<Vec<f64>>, String> {
    let mut columns: Vec<Vec<f64>> = element.properties.iter().map(|_| Vec::new()).collect();
    let (mut words, mut at) = (words(bytes), 0);
    let mut next = |kind: Type| {
        if body == Body::Text {
            return words.next().and_then(|word| std::str::from_utf8(word).ok()?.parse::<f64>().ok());
        }
        let number = bytes.get(at..at + kind.width()).map(|part| kind.number(part, body == Body::Big));
        at += kind.width();
        number
    };
    for row in 0..element.count {
        for (Property { name, kind, length }, values) in element.properties.iter().zip(&mut columns) {
            let cut = || format!("`{}` of `{}` {row} is no number, or is missing", shortened(name), element.name);
            let Some(length) = length else {
                values.push(next(*kind).ok_or_else(cut)?);
                continue;
            };
            let items = next(*length).filter(|items| *items >= 0.0 && items.fract() == 0.0).ok_or_else(cut)?;
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "looked at")]
            for _ in 0..items as u64 {
                next(*kind).ok_or_else(cut)?;
            }
        }
    }
    if body == Body::Text && words.next().is_some() {
        return Err(format!("`{}` has more numbers than its {} properties announce", element.name, element.properties.len()));
    }
    Ok(columns)
}

fn words(bytes: &[u8]) -> impl Iterator<Item = &[u8]> {
    bytes.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// The end of an element that begins here.
fn passed(bytes: &[u8], start: usize, element: &Element, body: Body) -> Result<usize, String> {
    let Element { name, count, properties } = element;
    let cut = |has: u64| format!("byte {}: the file ends here; the header announces {count} of `{name}`, and {has} are there", bytes.len());
    if properties.is_empty() && *count > 0 {
        return Err(format!("the header announces {count} of `{name}` and no properties of them"));
    }
    if body == Body::Text {
        let mut at = start;
        for done in 0..*count {
            let line = loop {
                let rest = bytes.get(at..).filter(|rest| !rest.is_empty()).ok_or_else(|| cut(done))?;
                let length = rest.iter().position(|byte| *byte == b'\n').map_or(rest.len(), |place| place + 1);
                at += length;
                if words(&rest[..length]).next().is_some() {
                    break &rest[..length];
                }
            };
            let lists = properties.iter().any(|property| property.length.is_some());
            let there = words(line).count();
            if !lists && there != properties.len() {
                return Err(format!("byte {}: {there} values in a line; `{name}` has {} properties", at - line.len(), properties.len()));
            }
        }
        return Ok(at);
    }
    let fixed: usize = properties.iter().map(|property| property.length.unwrap_or(property.kind).width()).sum();
    let left = (bytes.len() - start) as u64;
    if properties.iter().all(|property| property.length.is_none()) {
        let needed = count.checked_mul(fixed as u64).filter(|needed| *needed <= left);
        return needed.and_then(|needed| usize::try_from(needed).ok()).map(|needed| start + needed).ok_or_else(|| cut(left / fixed as u64));
    }
    let mut at = start;
    for done in 0..*count {
        for Property { kind, length, .. } in properties {
            let mut items = 1;
            if let Some(length) = length {
                let rest = bytes.get(at..at + length.width()).ok_or_else(|| cut(done))?;
                let number = length.number(rest, body == Body::Big);
                if number < 0.0 || number > left as f64 || number.fract() != 0.0 {
                    return Err(format!("byte {at}: a list of `{name}` announces {number} items"));
                }
                #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "looked at")]
                {
                    items = number as usize;
                }
                at += length.width();
            }
            at += items * kind.width();
            if at > bytes.len() {
                return Err(cut(done));
            }
        }
    }
    Ok(at)
}

fn header(bytes: &[u8]) -> Result<Header, String> {
    let mut found =
        Header { body: Body::Text, elements: Vec::new(), time: 0.0, step: 0, bounds: None, end: 0 };
    let mut format = false;
    let mut at = 0;
    for number in 1.. {
        let rest = &bytes[at..bytes.len().min(LONGEST)];
        let Some(length) = rest.iter().position(|byte| *byte == b'\n') else {
            return Err(format!("line {number}: the header does not end: `end_header` is missing"));
        };
        at += length + 1;
        let line = String::from_utf8_lossy(&rest[..length]);
        let parts: Vec<&str> = line.split_whitespace().collect();
        match parts.as_slice() {
            ["ply"] if number == 1 => {}
            _ if number == 1 => return Err("line 1: the file does not begin with `ply`".to_owned()),
            ["format", body, _] => {
                format = true;
                found.body = match *body {
                    "ascii" => Body::Text,
                    "binary_little_endian" => Body::Little,
                    "binary_big_endian" => Body::Big,
                    other => return Err(format!("line {number}: unknown format `{}`", shortened(other))),
                };
            }
            ["comment", "time", time] => found.time = time.parse().unwrap_or(0.0),
            ["comment", "step", step] => found.step = step.parse().unwrap_or(0),
            ["comment", "box", rest @ ..] => found.bounds = boxed(rest),
            [] | ["comment" | "obj_info", ..] => {}
            ["element", name, count] => {
                let count = count
                    .parse()
                    .map_err(|_| format!("line {number}: `{}` is no number of `{}`", shortened(count), shortened(name)))?;
                found.elements.push(Element { name: (*name).to_owned(), count, properties: Vec::new() });
            }
            ["property", rest @ ..] => {
                let property = property(rest)
                    .ok_or_else(|| format!("line {number}: `{}` is no property, as in `property float x`", shortened(&line)))?;
                let element = found.elements.last_mut().ok_or_else(|| format!("line {number}: a property of no element"))?;
                if element.properties.iter().any(|known| known.name == property.name) {
                    return Err(format!("line {number}: `{}` is there twice", shortened(&property.name)));
                }
                element.properties.push(property);
            }
            ["end_header"] if format => break,
            _ => return Err(format!("line {number}: `{}` is not a line of a PLY header", shortened(&line))),
        }
    }
    found.end = at;
    Ok(found)
}

fn property(words: &[&str]) -> Option<Property> {
    let kind = |word: &str| {
        Some(match word {
            "char" | "int8" => Type::I8,
            "uchar" | "uint8" => Type::U8,
            "short" | "int16" => Type::I16,
            "ushort" | "uint16" => Type::U16,
            "int" | "int32" => Type::I32,
            "uint" | "uint32" => Type::U32,
            "float" | "float32" => Type::F32,
            "double" | "float64" => Type::F64,
            _ => return None,
        })
    };
    match words {
        ["list", length, item, name] => Some(Property {
            name: (*name).to_owned(),
            kind: kind(item)?,
            length: Some(kind(length)?).filter(|kind| !matches!(kind, Type::F32 | Type::F64)),
        })
        .filter(|property| property.length.is_some()),
        [item, name] => Some(Property { name: (*name).to_owned(), kind: kind(item)?, length: None }),
        _ => None,
    }
}

/// The box given in a comment.
fn boxed(words: &[&str]) -> Option<Bounds> {
    let numbers: Vec<f64> = words.iter().map_while(|word| word.parse().ok()).collect();
    let sides: Vec<Side> = words.iter().skip(6).filter_map(|word| Side::from_name(word)).collect();
    let [a, b, c, d, e, f] = numbers[..] else { return None };
    Some(Bounds { low: [a, b, c].into(), high: [d, e, f].into(), sides: sides.try_into().ok()?, dimensions: 3 })
}
