//! Extended XYZ, the text that programs for molecules read (ASE, OVITO, VMD): the number of particles, a line of `key=value`,
//! one line for each particle.
//!
//! `Properties` names what a line holds: `species` (an element: its number in the periodic table is the species, `X` is species 0),
//! `pos`, `velo`, `masses`, `radius` (the size), `id`, and any other column by its own name. `Time` and `Step` are those of the state.
//! Where a file has ASE's `momenta`, velocities are these divided by `masses`.
//! `Lattice`, `Origin` and `pbc` are the box, where it is closed along every axis. Format: the specification of libAtoms (extxyz).

use std::fmt::Write as _;
use std::io::{self, BufRead, Write};

use super::problems::{Problems, order, ordered};
use super::titles;
use super::{Contents, Format, Heading, Input, Options, input, sheet};
use crate::error::Error;
use crate::kernel::{Bounds, Column, Columns, Side};
use crate::state::State;

/// Its entry in the register.
pub(super) const FORMAT: Format = Format {
    name: "xyz",
    about: "extended XYZ: text, one line for each particle, for OVITO, ASE and VMD",
    endings: &["xyz", "extxyz"],
    begins: |start| {
        let mut lines = start.split(|byte| *byte == b'\n');
        let count = lines.next().is_some_and(|line| line.trim_ascii().iter().all(u8::is_ascii_digit) && !line.is_empty());
        count && lines.next().is_some_and(|line| line.windows(11).any(|part| part == b"Properties="))
    },
    contents,
    read: Some(read),
    write: Some(|out, state, options| write_xyz(out, state, options)),
    left_out: None,
    compresses: false,
    divides: false,
};

/// Elements by their numbers; species beyond them have no name here.
const ELEMENTS: &str = "X H He Li Be B C N O F Ne Na Mg Al Si P S Cl Ar K Ca Sc Ti V Cr Mn Fe Co Ni Cu Zn Ga Ge As Se Br Kr Rb Sr Y Zr Nb \
                        Mo Tc Ru Rh Pd Ag Cd In Sn Sb Te I Xe Cs Ba La Ce Pr Nd Pm Sm Eu Gd Tb Dy Ho Er Tm Yb Lu Hf Ta W Re Os Ir Pt Au Hg \
                        Tl Pb Bi Po At Rn Fr Ra Ac Th Pa U Np Pu Am Cm Bk Cf Es Fm Md No Lr Rf Db Sg Bh Hs Mt Ds Rg Cn Nh Fl Mc Lv Ts Og";

/// The properties of a plain XYZ file, which does not state them.
const PLAIN: &str = "species:S:1:pos:R:3";

/// The property that ASE writes in place of velocities: velocity times mass.
const MOMENTA: &str = "momenta";

/// The column of a property: that of its name, or the one for which other programs use that name.
fn column_of<'a>(property: &'a str, columns: &Columns) -> &'a str {
    match property {
        name if columns.get(name).is_some() => name,
        "pos" | "positions" => "position",
        "velo" | "vel" | "velocities" | MOMENTA => "velocity",
        "masses" => "mass",
        "radius" => "size",
        name => name,
    }
}

/// The property of a column: the name in other programs, if no other of these columns has that name.
fn property_of<'a>(column: &'a Column, columns: &[&Column]) -> &'a str {
    let usual = match column.name.as_ref() {
        "position" => "pos",
        "velocity" => "velo",
        "mass" => "masses",
        "size" => "radius",
        name => return name,
    };
    if columns.iter().any(|other| other.name == usual) { &column.name } else { usual }
}

/// Writes a state: species, positions, and all that a CSV file has, one line for each particle in the order of the ids.
///
/// # Errors
/// Those of `out`; a species above 118, for which there is no element; a number that does not fit single precision, where that is
/// asked for.
pub fn write_xyz(mut out: impl Write, state: &State, options: &Options) -> io::Result<()> {
    let precision = options.precision;
    let elements: Vec<&str> = ELEMENTS.split_whitespace().collect();
    if let Some(unnamed) = state.species().iter().find(|species| **species as usize >= elements.len()) {
        return Err(io::Error::other(format!(
            "extended XYZ names species by elements, 0 to {}, and a particle has species {unnamed}: choose npz or csv",
            elements.len() - 1
        )));
    }
    let columns: Vec<&Column> =
        titles::kept(state).into_iter().map(|(column, _)| column).filter(|column| column.name != "species").collect();
    let mut properties = "species:S:1:id:I:1".to_owned();
    for field in titles::fields(state).iter().filter(|field| field.name != "species") {
        let letter = if field.is_whole() { 'I' } else { 'R' };
        let own = columns.iter().find(|column| column.name == field.name.as_str());
        let name = own.map_or(field.name.as_str(), |column| property_of(column, &columns));
        let _ = write!(properties, ":{name}:{letter}:{}", field.strips.len());
    }
    writeln!(out, "{}", state.len())?;
    if let Some(bounds) = options.closed() {
        let ([x, y, z], low) = ((bounds.high - bounds.low).to_array(), bounds.low);
        write!(out, "Lattice=\"{x:?} 0 0 0 {y:?} 0 0 0 {z:?}\" Origin=\"{:?} {:?} {:?}\" ", low.x, low.y, low.z)?;
    }
    let periodic = |side| options.closed().is_some() && side == Side::Periodic;
    let pbc = options.bounds.map_or([Side::Open; 3], |bounds| bounds.sides);
    let pbc = pbc.map(|side| if periodic(side) { "T" } else { "F" }).join(" ");
    writeln!(out, "Properties={properties} pbc=\"{pbc}\" Time={:?} Step={}", state.time, state.step)?;
    let strips: Vec<_> = titles::strips(state).into_iter().filter(|strip| strip.text != "species").collect();
    titles::fit(&strips, state.len(), precision)?;
    let (mut line, ids) = (String::new(), state.ids());
    for (id, name) in ids.iter().enumerate() {
        line.clear();
        let species = state.species().get(id).copied().unwrap_or(0);
        let _ = write!(line, "{} {name}", elements[species as usize]);
        for strip in &strips {
            line.push(' ');
            strip.of(id).write(&mut line, precision);
        }
        line.push('\n');
        out.write_all(line.as_bytes())?;
    }
    Ok(())
}

/// The headings of the second line, and the box.
fn contents(path: &Input<'_>) -> Result<Contents, Error> {
    let (file, _) = path.open()?;
    let failed = |error: io::Error| input(path, error.to_string());
    let mut lines = Lines { file, line: Vec::new() };
    let count = lines.next().map_err(failed)?.unwrap_or_default();
    let header = lines.next().map_err(failed)?.unwrap_or_default();
    let pairs = pairs(&header);
    let said = |key: &str| pairs.iter().find(|(name, _)| name.eq_ignore_ascii_case(key)).map(|(_, value)| value.as_str());
    let mut problems = Problems::default();
    let properties = properties(said("Properties").unwrap_or(PLAIN), &mut problems);
    problems.check(path)?;
    let mut contents = Contents { rows: count.trim().parse().unwrap_or(0), ..Contents::default() };
    for property in &properties {
        let usual = column_of(&property.name, &Columns::default());
        // Where a file has `position` too, `pos` is a column of its own.
        let own = usual != property.name && properties.iter().any(|other| other.name == usual);
        let name = if own { property.name.clone() } else { usual.to_owned() };
        let headings = sheet::titles_of(&name, property.width).into_iter().map(|title| Heading { title, whole: false });
        contents.headings.extend(headings);
    }
    let numbers = |text: &str| text.split_whitespace().filter_map(|word| word.parse().ok()).collect::<Vec<f64>>();
    let origin = said("Origin").map_or([0.0; 3], |text| numbers(text).try_into().unwrap_or([0.0; 3]));
    let sides: Vec<Side> = said("pbc")
        .unwrap_or("T T T")
        .split_whitespace()
        .map(|word| if matches!(word, "T" | "1" | "true") { Side::Periodic } else { Side::Open })
        .collect();
    if let (Some([x, _, _, _, y, _, _, _, z]), Ok(sides)) = (said("Lattice").map(numbers).as_deref(), sides.try_into()) {
        let low: glam::DVec3 = origin.into();
        contents.bounds = Some(Bounds { low, high: low + glam::DVec3::new(*x, *y, *z), sides, dimensions: 3 });
    }
    Ok(contents)
}

/// A property of the second line.
struct Property {
    name: String,
    kind: char,
    width: usize,
}

/// Reads a state of these columns: the one frame of a file, plain XYZ too.
///
/// # Errors
/// [`Error::Input`] that lists all faults with their lines: a count that is invalid or not that of the lines, properties that are unknown,
/// of another width or kind than their column, or given twice, invalid numbers, a second frame.
pub fn read(path: &Input<'_>, columns: &Columns) -> Result<State, Error> {
    let (file, _) = path.open()?;
    let failed = |error: io::Error| input(path, error.to_string());
    let mut lines = Lines { file, line: Vec::new() };
    let count = lines.next().map_err(failed)?.map(|text| text.trim().to_owned()).unwrap_or_default();
    let count: usize =
        count.parse().map_err(|_| input(path, format!("line 1: `{}` is no number of particles", super::shortened(&count))))?;
    let header = lines.next().map_err(failed)?.unwrap_or_default();
    let pairs = pairs(&header);
    let said = |key: &str| pairs.iter().find(|(name, _)| name.eq_ignore_ascii_case(key)).map(|(_, value)| value.as_str());
    let mut problems = Problems::default();
    let properties = properties(said("Properties").unwrap_or(PLAIN), &mut problems);
    let known = titles::all(columns);
    let mut given: Vec<Option<Vec<f64>>> = known.iter().map(|_| None).collect();
    // The destination of a property's numbers: the index of its first title.
    let places: Vec<Option<usize>> = properties.iter().map(|property| place(property, columns, &known, &mut problems)).collect();
    for (property, place) in properties.iter().zip(&places) {
        for k in 0..if place.is_some() { property.width } else { 0 } {
            let list = &mut given[place.unwrap_or(0) + k];
            if list.replace(Vec::new()).is_some() && k == 0 {
                problems.note(|| format!("line 2: `{}` is there twice: remove one of them", property.name));
            }
        }
    }
    if properties.iter().filter(|property| property.name == "id").count() > 1 {
        problems.note(|| "line 2: `id` is there twice: remove one of them".to_owned());
    }
    if !known.iter().zip(&given).any(|(title, list)| title.column.name == "position" && list.is_some()) {
        problems.note(|| "line 2: Properties has no `pos:R:3`: positions are missing".to_owned());
    }
    let momenta = columns.get(MOMENTA).is_none() && properties.iter().any(|property| property.name == MOMENTA);
    if momenta && !properties.iter().any(|property| column_of(&property.name, columns) == "mass") {
        problems.note(|| "line 2: `momenta` are velocities times `masses`, and there are none: give `masses:R:1` too".to_owned());
    }
    problems.stop(path)?;
    let width: usize = properties.iter().map(|property| property.width).sum();
    let mut ids = Vec::new();
    for row in 0..count {
        let Some(text) = lines.next().map_err(failed)? else {
            problems.note(|| format!("line {}: the file ends here; line 1 announces {count} particles, and there are {row}", row + 3));
            break;
        };
        let cells: Vec<&str> = text.split_whitespace().collect();
        if cells.len() != width {
            problems.note(|| format!("line {}: {} words; Properties asks for {width}", row + 3, cells.len()));
            continue;
        }
        let mut cells = cells.into_iter();
        for (property, place) in properties.iter().zip(&places) {
            for k in 0..property.width {
                let cell = cells.next().unwrap_or_default();
                let number = number(property, cell);
                let fault = match (number, place) {
                    (None, _) => Some("is no number".into()),
                    (Some(number), Some(place)) => known[place + k].fault(number),
                    (Some(number), None) if number.fract() != 0.0 || !(0.0..=f64::from(u32::MAX)).contains(&number) => {
                        Some("is no id: ids are whole numbers from 0".into())
                    }
                    (Some(_), None) => None,
                };
                if let Some(fault) = fault {
                    problems.note(|| format!("line {}, {}: `{}` {fault}", row + 3, property.name, super::shortened(cell)));
                }
                let number = number.unwrap_or(0.0);
                match place {
                    Some(place) => given[place + k].get_or_insert_default().push(number),
                    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "ids are checked")]
                    None => ids.push(number as u64),
                }
            }
        }
    }
    if momenta && problems.none() {
        divide(&mut given, &known, &mut problems);
    }
    let mut after = lines.next().map_err(failed)?;
    while after.as_ref().is_some_and(|text| text.trim().is_empty()) {
        after = lines.next().map_err(failed)?;
    }
    if after.is_some() {
        problems.note(|| format!("line {}: a second frame begins; one state is one frame: give the file of one", count + 3));
    }
    let places = (ids.len() == count && problems.none()).then(|| order(&ids, |row| format!("line {}", row + 3), &mut problems));
    problems.check(path)?;
    let mut state = titles::state(columns, given, count);
    if let Some(order) = places.filter(|order| order.len() == count && !ids.is_empty()) {
        state = ordered(&state, &ids, &order);
    }
    state.time = said("Time").and_then(|text| text.parse().ok()).filter(|time: &f64| time.is_finite()).unwrap_or(0.0);
    state.step = said("Step").and_then(|text| text.parse().ok()).unwrap_or(0);
    Ok(state)
}

/// Converts momenta to velocities.
fn divide(given: &mut [Option<Vec<f64>>], known: &[titles::Title<'_>], problems: &mut Problems) {
    let of = |column: &str| known.iter().position(|title| title.column.name == column);
    let (Some(velocity), Some(mass)) = (of("velocity"), of("mass").and_then(|place| given[place].clone())) else { return };
    for list in given[velocity..velocity + 3].iter_mut().flatten() {
        for (row, (number, mass)) in list.iter_mut().zip(&mass).enumerate() {
            if *mass == 0.0 && *number != 0.0 {
                problems.note(|| format!("line {}, momenta: {number} of a particle of mass 0: its velocity is undefined", row + 3));
            }
            *number = if *mass == 0.0 { 0.0 } else { *number / mass };
        }
    }
}

/// The lines of a file. Invalid UTF-8 is replaced by replacement characters.
struct Lines<R> {
    file: R,
    line: Vec<u8>,
}

impl<R: BufRead> Lines<R> {
    fn next(&mut self) -> io::Result<Option<String>> {
        self.line.clear();
        let some = self.file.read_until(b'\n', &mut self.line)? > 0;
        Ok(some.then(|| String::from_utf8_lossy(&self.line).trim_end().to_owned()))
    }
}

/// The keys and values of a second line: `key=value`, `key="some values"`.
fn pairs(line: &str) -> Vec<(String, String)> {
    let mut all = Vec::new();
    let mut rest = line.trim_start();
    while let Some((key, after)) = rest.split_once('=') {
        let key = key.split_whitespace().next_back().unwrap_or_default();
        let (value, next) = match after.strip_prefix('"') {
            Some(quoted) => quoted.split_once('"').unwrap_or((quoted, "")),
            None => after.split_once(char::is_whitespace).unwrap_or((after, "")),
        };
        all.push((key.to_owned(), value.to_owned()));
        rest = next.trim_start();
    }
    all
}

fn properties(text: &str, problems: &mut Problems) -> Vec<Property> {
    let words: Vec<&str> = text.split(':').collect();
    let mut all = Vec::new();
    for three in words.chunks(3) {
        let property = match three {
            [name, kind, width] => {
                let kind = Some(*kind).filter(|kind| ["S", "R", "I", "L"].contains(kind)).and_then(|kind| kind.chars().next());
                // As many as any column has slots and components, and more.
                let width = width.parse().ok().filter(|width| (1..=4096).contains(width));
                kind.zip(width).map(|(kind, width)| Property { name: (*name).to_owned(), kind, width })
            }
            _ => None,
        };
        match property {
            Some(property) => all.push(property),
            None => problems.note(|| {
                format!("line 2: `{}` in Properties is no name:kind:width, as in pos:R:3", super::shortened(&three.join(":")))
            }),
        }
    }
    all
}

/// The index of the first title of a property's column; `None` for ids.
fn place(property: &Property, columns: &Columns, known: &[titles::Title<'_>], problems: &mut Problems) -> Option<usize> {
    let (name, width) = (column_of(&property.name, columns), property.width);
    if name == "id" && width == 1 {
        return None;
    }
    let first = known.iter().position(|title| title.column.name == name);
    // A slot of a column, or what no column is of.
    let titles = sheet::titles_of(name, width);
    let slot = known.iter().position(|title| title.text == titles[0]);
    let of = |first: usize| known.iter().skip(first).map(|title| &title.text).take(width).eq(&titles);
    if let (None, Some(slot)) = (first, slot.filter(|slot| of(*slot) && property.kind != 'S')) {
        return Some(slot);
    }
    let Some((first, column)) = first.zip(columns.get(name)) else {
        problems.note(|| {
            let all: Vec<&Column> = columns.iter().collect();
            let names: Vec<&str> = all.iter().map(|column| property_of(column, &all)).collect();
            format!("line 2: unknown property `{}`; known are id, {}", super::shortened(&property.name), names.join(", "))
        });
        return None;
    };
    let wanted = titles::titles(column).len();
    if width != wanted {
        problems.note(|| format!("line 2: `{}` has {width} numbers for each particle; it has {wanted}", property.name));
        return None;
    }
    if property.kind == 'S' && name != "species" {
        problems.note(|| format!("line 2: `{}` is text, and its column is of numbers", property.name));
        return None;
    }
    Some(first)
}

/// The number in a cell: for an element, its number in the periodic table.
fn number(property: &Property, cell: &str) -> Option<f64> {
    match property.kind {
        'S' => {
            let element = ELEMENTS.split_whitespace().position(|element| element == cell);
            element.map(|place| f64::from(u32::try_from(place).unwrap_or(0)))
        }
        'L' => match cell {
            "T" | "True" | "true" => Some(1.0),
            "F" | "False" | "false" => Some(0.0),
            _ => None,
        },
        _ => cell.parse().ok(),
    }
}
