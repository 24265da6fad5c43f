//! Wavefront OBJ, the text that programs of animation read: a vertex for each particle, a line for each spring and rod, a face for each
//! triangle. A file of each state is the sequence that such programs take as the motion of a cloth.
//!
//! Files hold positions, in the order of the ids; a comment at the beginning has the number of particles, the step and the time, so that
//! a file that is cut is noticed. Of other files vertices are read, and all else is passed over.

use std::fmt::Write as _;
use std::io::{self, Write};

use super::binary::bytes_of;
use super::contents::counted;
use super::problems::Problems;
use super::sheet::{self, List, Place, Sheet};
use super::titles;
use super::{Format, Heading, Input, Options, input, shortened};
use crate::error::Error;
use crate::kernel::Columns;
use crate::state::State;

/// Its entry in the register.
pub(super) const FORMAT: Format = Format {
    name: "obj",
    about: "Wavefront OBJ: positions, springs as lines, triangles as faces; a file of each state is a sequence of meshes",
    endings: &["obj"],
    begins: |start| start.starts_with(MARK.as_bytes()) || start.starts_with(b"mtllib "),
    contents: |path| sheet(path, &|_| false).map(|sheet| sheet.contents),
    read: Some(read),
    write: Some(|out, state, options| write_obj(out, state, options)),
    left_out: Some(left_out),
    compresses: false,
    divides: false,
};

const HELD: [&str; 3] = ["x", "y", "z"];
/// The beginning and the end of files that motes writes.
const MARK: &str = "# motes ";
const END: &str = "# end";

/// Data of a state that files do not hold, where it differs from initial values.
fn left_out(state: &State) -> Vec<String> {
    let titles = titles::strips(state).into_iter().map(|strip| strip.text);
    let mut names: Vec<String> = titles.filter(|title| !HELD.contains(&title.as_str())).collect();
    if state.ids().iter().zip(0..).any(|(id, place)| *id != place) {
        names.push(sheet::ID.to_owned());
    }
    names
}

/// Writes a state: a vertex for each particle in the order of the ids.
///
/// # Errors
/// Those of `out`; a number that does not fit single precision, where that is asked for.
pub fn write_obj(mut out: impl Write, state: &State, options: &Options) -> io::Result<()> {
    let strips: Vec<_> =
        titles::strips(state).into_iter().filter(|strip| HELD.contains(&strip.text.as_str())).collect();
    titles::fit(&strips, state.len(), options.precision)?;
    let (version, count, links) = (env!("CARGO_PKG_VERSION"), state.len(), &state.links);
    writeln!(out, "{MARK}{version}: {count} vertices, step {}, time {:?}", state.step, state.time)?;
    let mut line = String::new();
    for row in 0..count {
        line.clear();
        line.push('v');
        for strip in &strips {
            line.push(' ');
            strip.of(row).write(&mut line, options.precision);
        }
        writeln!(out, "{line}")?;
    }
    // Vertices are counted from 1.
    let mut element = |letter: &str, places: &[u32]| {
        line.clear();
        line.push_str(letter);
        places.iter().for_each(|place| {
            // Writing into a String cannot fail.
            let _ = write!(line, " {}", u64::from(*place) + 1);
        });
        writeln!(out, "{line}")
    };
    links.springs.iter().try_for_each(|spring| element("l", &spring.ends))?;
    links.rods.iter().try_for_each(|rod| element("l", &rod.ends))?;
    links.triangles.iter().try_for_each(|corners| element("f", corners))?;
    writeln!(out, "{END}")
}

/// Reads a state of these columns: the vertices.
///
/// # Errors
/// [`Error::Input`] with the line of an invalid vertex, and for a truncated file of motes.
pub fn read(path: &Input<'_>, columns: &Columns) -> Result<State, Error> {
    sheet::read(path, columns, sheet)
}

fn sheet(path: &Input<'_>, wanted: &dyn Fn(&str) -> bool) -> Result<Sheet, Error> {
    let bytes = bytes_of(path)?;
    let text = std::str::from_utf8(&bytes)
        .map_err(|why| input(path, format!("byte {}: is no text in UTF-8", why.valid_up_to())))?;
    let (mut problems, mut sheet) = (Problems::default(), Sheet::default());
    let mut lists: [Vec<f64>; 3] = Default::default();
    let (mut faces, mut lines) = (0, 0);
    for (line, number) in text.lines().zip(1_u64..) {
        let mut words = line.split('#').next().unwrap_or_default().split_ascii_whitespace();
        match words.next() {
            Some("v") => {
                for (axis, list) in HELD.iter().zip(&mut lists) {
                    let word = words.next();
                    let value = word.and_then(|word| word.parse::<f64>().ok()).filter(|value| value.is_finite());
                    if value.is_none() {
                        problems.note(|| match word {
                            Some(word) => format!("line {number}: {axis} is `{}`, which is no finite number", shortened(word)),
                            None => format!("line {number}: the vertex has no {axis}"),
                        });
                    }
                    list.push(value.unwrap_or(0.0));
                }
            }
            Some("f") => faces += 1,
            Some("l") => lines += 1,
            _ => {}
        }
    }
    let rows = lists[0].len();
    if let Some(head) = text.strip_prefix(MARK) {
        match marked(head.lines().next().unwrap_or_default()) {
            Some((count, step, time)) if count == rows => (sheet.step, sheet.time) = (step, time),
            Some((count, ..)) => problems.note(|| format!("line 1: {count} vertices are announced, and {rows} are there")),
            None => problems.note(|| "line 1: vertices, step and time are announced, and cannot be read".to_owned()),
        }
        if !text.trim_end().ends_with(END) {
            problems.note(|| format!("the file ends without `{END}`: it is truncated"));
        }
    } else if rows == 0 {
        problems.note(|| "has no vertices: lines such as `v 1 2 3`".to_owned());
    }
    problems.check(path)?;
    sheet.contents.rows = rows;
    for (title, values) in HELD.into_iter().zip(lists) {
        sheet.contents.headings.push(Heading { title: title.to_owned(), whole: false });
        if wanted(title) {
            sheet.lists.push(List { title: title.to_owned(), values, place: Place::Named("v".to_owned()) });
        }
    }
    let there = [(lines, "line"), (faces, "face")].into_iter().filter(|(count, _)| *count > 0);
    sheet.contents.left_out = there.map(|(count, what)| counted(count, what)).collect();
    Ok(sheet)
}

/// The number of vertices, the step and the time from the first line of a file of motes.
fn marked(head: &str) -> Option<(usize, u64, f64)> {
    let (_, rest) = head.split_once(": ")?;
    let (count, rest) = rest.split_once(" vertices, step ")?;
    let (step, time) = rest.split_once(", time ")?;
    Some((count.parse().ok()?, step.parse().ok()?, time.trim().parse().ok()?))
}
