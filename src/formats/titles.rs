//! Names of the components of columns in files, and their valid values.

use std::borrow::Cow;
use std::fmt::Write as _;
use std::io;

use super::Precision;
use super::binary::single;
use crate::kernel::{Array, Column, Columns, ID, Kind, LIFE, Shape};
use crate::life::Life;
use crate::state::State;

/// The message for an id that has more than 32 bits; the last one is reserved.
pub(super) const LARGE_ID: &str = "ids above 4294967294 are not supported: renumber the particles";

/// A component of a column, with its title in files.
#[derive(Debug, Clone)]
pub(super) struct Title<'a> {
    /// The title.
    pub text: String,
    /// The column.
    pub column: &'a Column,
    /// Its index among the numbers of a particle.
    pub place: usize,
}

/// Numbers of a column for one particle.
fn width(column: &Column) -> usize {
    column.kind.components() * column.shape.len(1)
}

/// The titles of a column: `x`, `y`, `z`; `vx`, `vy`, `vz`; otherwise its name, the number of the slot where there are several, and `_x`,
/// `_y`, `_z`, `_w`.
pub(super) fn titles(column: &Column) -> Vec<Title<'_>> {
    let one = |(place, text): (usize, String)| Title { text, column, place };
    let own = |list: [&str; 3]| list.map(str::to_owned).into_iter().enumerate().map(one).collect();
    match column.name.as_ref() {
        "position" => return own(["x", "y", "z"]),
        "velocity" => return own(["vx", "vy", "vz"]),
        _ => {}
    }
    let suffixes = column.kind.suffixes();
    let slots = if let Shape::Slots(k) = column.shape { Some(k as usize) } else { None };
    let text = |place: usize| {
        let slot = slots.map_or_else(String::new, |_| format!("_{}", place / suffixes.len()));
        format!("{}{slot}{}", column.name, suffixes[place % suffixes.len()])
    };
    (0..width(column)).map(|place| one((place, text(place)))).collect()
}

/// The columns that have a value for each particle, except ids, which formats treat separately.
fn of_tables(columns: &Columns) -> impl Iterator<Item = &Column> {
    columns.iter().filter(|column| !matches!(column.shape, Shape::System(_)) && column.name != ID.name)
}

/// The titles of all columns that have a value for each particle, but ids.
pub(super) fn all(columns: &Columns) -> Vec<Title<'_>> {
    of_tables(columns).flat_map(titles).collect()
}

impl Title<'_> {
    /// A number in a message: without a decimal point in columns of integers.
    pub fn shown(&self, value: f64) -> String {
        let whole = self.column.kind == Kind::Whole && value.fract() == 0.0 && value.abs() < 1e15;
        if whole { format!("{value:.0}") } else { format!("{value:?}") }
    }
    /// The fault of a number, if it is invalid.
    pub fn fault(&self, value: f64) -> Option<Cow<'static, str>> {
        if !value.is_finite() {
            return Some("is not finite".into());
        }
        let whole = value.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&value);
        match self.column.name.as_ref() {
            "mass" | "size" if value < 0.0 => Some("is below 0".into()),
            name if name == LIFE.name && !(whole && value <= f64::from(Life::Removed.word())) => {
                Some("is none of 0 (pending), 1 (active) and 2 (removed)".into())
            }
            name if name == ID.name && value.fract() == 0.0 && value >= f64::from(u32::MAX) => {
                Some(format!("is too large: {LARGE_ID}").into())
            }
            _ if self.column.kind == Kind::Whole && !whole => {
                Some(format!("is not a whole number from 0 to {}", u32::MAX).into())
            }
            _ => None,
        }
    }
}

/// The values of a column from the data of its titles; components that are left out have their initial value.
pub(super) fn array(column: &Column, given: &[Option<Vec<f64>>], particles: usize) -> Array {
    let initial = column.initial.unwrap_or_default();
    let components = column.kind.components();
    let number = |place: usize, row: usize| {
        given[place].as_ref().and_then(|list| list.get(row)).copied().unwrap_or(initial[place % components])
    };
    let slots = column.shape.len(1);
    let rows = (0..particles).flat_map(|row| (0..slots).map(move |slot| (row, slot * components)));
    match column.kind {
        Kind::Scalar => Array::Float(rows.map(|(row, first)| number(first, row)).collect()),
        Kind::Vector => {
            let one = |(row, first)| [0, 1, 2].map(|k| number(first + k, row)).into();
            Array::Vec3(rows.map(one).collect())
        }
        Kind::Quaternion => {
            let one = |(row, first)| [0, 1, 2, 3].map(|k| number(first + k, row)).into();
            Array::Vec4(rows.map(one).collect())
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked by `Title::fault`")]
        Kind::Whole => Array::Uint(rows.map(|(row, first)| number(first, row) as u32).collect()),
    }
}

/// A state from the numbers of a file, by the index of the title in [`all`]; columns without any data are not given.
pub(super) fn state(columns: &Columns, mut given: Vec<Option<Vec<f64>>>, particles: usize) -> State {
    let mut state = State::default();
    for column in of_tables(columns) {
        let rest = given.split_off(width(column));
        let own = std::mem::replace(&mut given, rest);
        let basic = state.get(&column.name).is_some();
        if basic || own.iter().any(Option::is_some) {
            state.put(column, Some(array(column, &own, particles)));
        }
    }
    state
}

/// The numbers of a title, in the form that writers use.
pub(super) struct Strip<'a> {
    /// Their names.
    pub text: String,
    values: &'a Array,
    slots: usize,
    slot: usize,
    axis: usize,
}

/// A number of a file.
pub(super) enum Number {
    /// A real number.
    Real(f64),
    /// An integer.
    Whole(u32),
}

impl Number {
    /// Appends the shortest decimal that reads back to the same bits of the precision, with an exponent where that is shorter.
    pub fn write(&self, text: &mut String, precision: Precision) {
        let start = text.len();
        // Writing into a String cannot fail.
        let _ = match (self, precision) {
            (Self::Whole(number), _) => write!(text, "{number}"),
            (Self::Real(number), Precision::Double) => write!(text, "{number:?}"),
            (Self::Real(number), Precision::Single) => {
                #[expect(clippy::cast_possible_truncation, reason = "single precision was asked for")]
                let single = *number as f32;
                let written = write!(text, "{single:?}");
                if reads_back(&text[start..], single) {
                    written
                } else {
                    text.truncate(start);
                    write!(text, "{:?}", f64::from(single))
                }
            }
        };
    }
}

/// Whether a reader that uses only f64 obtains the same f32 after narrowing: rounding twice may differ from rounding once. Of all f32 only
/// ±7.038531e-26 fails, whose decimal is half way between two f32 as an f64.
fn reads_back(text: &str, single: f32) -> bool {
    #[expect(clippy::cast_possible_truncation, reason = "this is the question")]
    text.parse::<f64>().is_ok_and(|wide| (wide as f32).to_bits() == single.to_bits())
}

impl Strip<'_> {
    /// The number of a particle.
    pub fn of(&self, id: usize) -> Number {
        let place = id * self.slots + self.slot;
        match self.values {
            Array::Float(list) => Number::Real(list[place]),
            Array::Vec3(list) => Number::Real(list[place][self.axis]),
            Array::Vec4(list) => Number::Real(list[place][self.axis]),
            Array::Uint(list) => Number::Whole(list[place]),
        }
    }
    /// Whether they are integers.
    pub fn is_whole(&self) -> bool {
        matches!(self.values, Array::Uint(_))
    }
}

/// Refuses names of columns that mean something else in files of a format; `meant` gives that meaning.
///
/// # Errors
/// The first of them.
pub(super) fn reserved<'a>(
    mut names: impl Iterator<Item = &'a str>,
    format: &str,
    meant: impl Fn(&str) -> Option<String>,
) -> io::Result<()> {
    match names.find_map(|name| Some((name, meant(name)?))) {
        Some((name, meant)) => Err(io::Error::other(format!(
            "the column `{name}` has the name that {format} files give to `{meant}`: rename the column, or choose another format"
        ))),
        None => Ok(()),
    }
}

/// Checks whether single precision holds all numbers, if that is requested.
///
/// # Errors
/// The title and the particle of the first number that does not fit.
pub(super) fn fit(strips: &[Strip<'_>], particles: usize, precision: Precision) -> io::Result<()> {
    if precision == Precision::Double {
        return Ok(());
    }
    for strip in strips.iter().filter(|strip| !strip.is_whole()) {
        for row in 0..particles {
            if let Number::Real(number) = strip.of(row) {
                single(number).map_err(|why| io::Error::other(format!("{} of particle {row}: {why}", strip.text)))?;
            }
        }
    }
    Ok(())
}

/// The numbers of one slot of a column: what formats of vectors write as one array.
pub(super) struct Field<'a> {
    /// The name of the column, with the number of the slot where there are several.
    pub name: String,
    /// Its components.
    pub strips: Vec<Strip<'a>>,
}

impl Field<'_> {
    /// Whether they are integers.
    pub fn is_whole(&self) -> bool {
        self.strips.first().is_some_and(Strip::is_whole)
    }
}

/// The same as [`strips`], by columns and slots.
pub(super) fn fields(state: &State) -> Vec<Field<'_>> {
    let mut fields = Vec::new();
    for (column, values) in kept(state) {
        let mut strips = of(column, values).peekable();
        let mut slot = 0;
        while strips.peek().is_some() {
            let one: Vec<_> = strips.by_ref().take(column.kind.components()).collect();
            let name = match column.shape {
                Shape::Slots(_) => format!("{}_{slot}", column.name),
                _ => column.name.to_string(),
            };
            fields.push(Field { name, strips: one });
            slot += 1;
        }
    }
    fields
}

/// The strips of one column.
fn of<'a>(column: &'a Column, values: &'a Array) -> impl Iterator<Item = Strip<'a>> {
    let (slots, components) = (column.shape.len(1), column.kind.components());
    titles(column).into_iter().map(move |title| Strip {
        text: title.text,
        values,
        slots,
        slot: title.place / components,
        axis: title.place % components,
    })
}

/// All columns that a table of particles holds: positions, velocities and masses; sizes and species where any is not 0, life where any is
/// not active; and every other column of the state.
pub(super) fn strips(state: &State) -> Vec<Strip<'_>> {
    kept(state).into_iter().flat_map(|(c, v)| of(c, v)).collect()
}

/// The columns of these, with their values.
pub(super) fn kept(state: &State) -> Vec<(&Column, &Array)> {
    let usual = |column: &Column| match column.name.as_ref() {
        "size" => state.size().iter().any(|size| *size != 0.0),
        "species" => state.species().iter().any(|species| *species != 0),
        name if name == LIFE.name => (0..state.len()).any(|id| !state.is_active(id)),
        name => name != ID.name && !matches!(column.shape, Shape::System(_)),
    };
    state.columns().filter(|(column, _)| usual(column)).collect()
}
