//! `[[column]]`: quantities that a scene declares, and what the sections of particles may give of any column.

use crate::component::declared as declared_by;
use crate::forces::Component;
use crate::kernel::{Array, Column, Columns, Kind, Shape};
use crate::settings::{self, Key, Value};
use crate::state::State;

use super::report::{Fault, Place, Report, listed, nearest, shorten};
use super::resolved::{self, Writer};
use super::sections::SECTIONS;
use super::tree::{Data, Node};
use super::value;
use super::walk::Table;

pub(super) const OWN: &[&str] = &["name", "unit", "initial", "rate"];
/// The keys of a column in addition to its name, unit, initial value and rate.
pub const COLUMN_KEYS: &[Key] = &[
    Key::new(
        "kind",
        settings::Kind::Choice(&["scalar", "vector", "whole", "quaternion"]),
        Value::Text(std::borrow::Cow::Borrowed("scalar")),
        "the type of a value: a number, three numbers, a whole number from 0 on, or a unit quaternion x, y, z, w",
    ),
    Key::new(
        "role",
        settings::Kind::Choice(&["state", "derived", "sum"]),
        Value::Text(std::borrow::Cow::Borrowed("state")),
        "state: saved, written and restored; derived: computed by one law in each evaluation; sum: zeroed at the start of an evaluation, and laws add to it",
    ),
];

/// Reads the declarations of a scene.
pub(super) fn read<'a>(
    tables: impl Iterator<Item = &'a Table<'a>>,
    out: &mut Writer,
    report: &mut Report,
) -> Vec<(Column, Place)> {
    tables.filter_map(|table| Some((one(table, out, report)?, table.place.clone()))).collect()
}

/// Checks the column by which pictures are coloured.
pub(super) fn of_picture(table: &Table<'_>, picture: &settings::Settings, columns: &Columns, report: &mut Report) {
    let (name, wanted) = (picture.text("column"), picture.text("color") == "column");
    match table.get("column") {
        _ if wanted && name.is_empty() => {
            report.push(table.lacks("column", "the name of a column", "the one that colours show"));
        }
        Some(entry) if !name.is_empty() => {
            let known =
                || columns.iter().filter(|column| column.shape == Shape::Particle).map(|column| column.name.as_ref());
            if !known().any(|one| one == name) {
                let fault = Fault::at(
                    &entry.node.place,
                    format!("there is no column `{}` with a value for each particle", shorten(name)),
                );
                let near = nearest(name, known()).map(|near| format!("did you mean `{near}`?"));
                let fault = near.into_iter().fold(fault, Fault::label);
                report.push(fault.note(format!("columns of this scene: {}", listed(known()))));
            } else if !wanted {
                let fault = Fault::at(
                    &entry.node.place,
                    format!("`column` is used with color = \"column\", and color is \"{}\"", picture.text("color")),
                );
                report.push(fault.label("remove it, or set color = \"column\""));
            }
        }
        _ => {}
    }
}

fn one(table: &Table<'_>, out: &mut Writer, report: &mut Report) -> Option<Column> {
    let faults = report.len();
    let settings = table.settings(COLUMN_KEYS, OWN, report);
    let Some(entry) = table.get("name") else {
        report.push(table.lacks("name", "a text", "what the column is called in WGSL, in scenes and in files"));
        return None;
    };
    let name = value::text(&entry.node, "name", "the name of a column", report)?.to_owned();
    let text = |key: &str, report: &mut Report| {
        let entry = table.get(key)?;
        value::text(&entry.node, key, "a text", report).map(str::to_owned)
    };
    let (unit, rate) = (text("unit", report), text("rate", report));
    let kind = Kind::ALL.into_iter().find(|kind| kind.name() == settings.text("kind")).unwrap_or(Kind::Scalar);
    let column = Column { unit: unit.unwrap_or_default().into(), ..Column::new(name.clone(), kind, "", "") }.required();
    let column = match settings.text("role") {
        "derived" => column.derived(),
        "sum" => column.summed(),
        _ => column,
    };
    let column = Column { rate: rate.map(Into::into), ..column };
    let initial = table.get("initial").and_then(|entry| given(&entry.node, "initial", kind, report));
    let column = Column { initial, ..column };
    let homes = || SECTIONS.iter().filter(|section| ["particles", "emitter"].contains(&section.name));
    if homes().any(|section| section.knows(&name)) {
        let fault = Fault::at(&entry.node.place, format!("`{name}` is a key of [[particles]] or [[emitter]] already"));
        report.push(fault.label("give the column another name"));
    }
    if report.len() > faults {
        return None;
    }
    out.header("[[column]]");
    out.text("name", &column.name);
    if !column.unit.is_empty() {
        out.text("unit", &column.unit);
    }
    out.settings(COLUMN_KEYS, &settings);
    column.initial.into_iter().for_each(|value| out.line("initial", &shown(kind, value)));
    column.rate.iter().for_each(|rate| out.text("rate", rate));
    Some(column)
}

/// All columns of a scene: those of its forces, and those that it declares.
pub(super) fn all(
    forces: &[Box<dyn Component>],
    integrator: Vec<Column>,
    declared: &[(Column, Place)],
    report: &mut Report,
) -> Columns {
    let of_forces: Vec<Column> = declared_by(forces).chain(integrator).collect();
    // Faults of a force by itself are reported where it is built.
    let mut known = Columns::with(of_forces.clone()).unwrap_or_default();
    let mut all = of_forces;
    for (column, place) in declared {
        all.push(column.clone());
        // A rate may be declared after its column.
        match Columns::with(all.iter().map(|column| Column { rate: None, ..column.clone() })) {
            Ok(columns) => known = columns,
            Err(why) => {
                report.push(Fault::at(place, why.to_string()));
                all.pop();
            }
        }
    }
    match (Columns::with(all), declared.first()) {
        (Ok(columns), _) => columns,
        (Err(why), Some((_, place))) => {
            report.push(Fault::at(place, why.to_string()));
            known
        }
        _ => known,
    }
}

/// The columns that sections of particles may give, by keys of their names.
pub(super) fn givable(columns: &Columns) -> Vec<&Column> {
    let base = Columns::default();
    columns.state().filter(|column| base.get(&column.name).is_none() && column.shape == Shape::Particle).collect()
}

/// A value of a kind; a value other than a vector is in the first number.
pub(super) fn given(node: &Node, key: &str, kind: Kind, report: &mut Report) -> Option<[f64; 4]> {
    use settings::Kind as Wanted;
    match kind {
        Kind::Scalar => {
            let x = value::number(node, key, Wanted::Number, &Wanted::Number.wanted(), report)?;
            Some([x, 0.0, 0.0, 0.0])
        }
        Kind::Whole => {
            let x = value::number(node, key, Wanted::Whole, &Wanted::Whole.wanted(), report)?;
            if x > f64::from(u32::MAX) {
                let fault = Fault::at(&node.place, format!("`{key}` is too large"));
                report.push(fault.label(format!("it may be at most {}", u32::MAX)));
                return None;
            }
            Some([x, 0.0, 0.0, 0.0])
        }
        Kind::Vector => match value::read(node, key, Wanted::Vector, report)? {
            Value::Vector(v) => Some([v.x, v.y, v.z, 0.0]),
            _ => None,
        },
        Kind::Quaternion => {
            const WANTED: &str = "four numbers x, y, z, w of length 1";
            let Data::List(list) = &node.data else { return value::refuse(node, key, WANTED, report) };
            let numbers: Vec<f64> =
                list.iter().filter_map(|x| value::number(x, key, Wanted::Number, "a number", report)).collect();
            let four = <[f64; 4]>::try_from(numbers).ok();
            let four = four.filter(|four| (four.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-6);
            four.or_else(|| value::refuse(node, key, WANTED, report))
        }
    }
}

/// A value as TOML.
pub(super) fn shown(kind: Kind, [x, y, z, w]: [f64; 4]) -> String {
    match kind {
        Kind::Scalar => resolved::number(x),
        Kind::Whole => format!("{x:.0}"),
        Kind::Vector => resolved::vector(glam::DVec3::new(x, y, z)),
        Kind::Quaternion => format!("[{x:?}, {y:?}, {z:?}, {w:?}]"),
    }
}

/// Sets the columns of particles for which a table has keys, except `taken` keys, which have another meaning there; and reports required
/// columns that are missing.
pub(super) fn give(
    table: &Table<'_>,
    (columns, taken): (&[&Column], &[Key]),
    particles: &mut State,
    out: &mut Writer,
    report: &mut Report,
) {
    for column in columns.iter().filter(|column| taken.iter().all(|key| key.name != column.name)) {
        let Some(entry) = table.get(&column.name) else {
            if column.initial.is_none() && particles.get(&column.name).is_none() {
                report.push(table.lacks(&column.name, &column.described(), "the column has no initial value"));
            }
            continue;
        };
        let Some(value) = given(&entry.node, &column.name, column.kind, report) else { continue };
        particles.put(column, Some(column.kind.filled(value, particles.len())));
        out.line(&column.name, &shown(column.kind, value));
    }
}

/// Values of columns that bodies give one by one.
pub(super) struct Bodies<'a> {
    columns: &'a [&'a Column],
    given: Vec<Array>,
    any: Vec<bool>,
}

impl<'a> Bodies<'a> {
    /// No values yet, for a list of bodies.
    pub(super) fn new(columns: &'a [&'a Column], list: &[Node]) -> Self {
        let given = columns.iter().map(|column| column.kind.filled([0.0; 4], 0)).collect();
        let has = |node: &Node, column: &Column| matches!(&node.data, Data::Table(entries) if entries.iter().any(|e| e.key == column.name));
        let any = columns.iter().map(|column| list.iter().any(|node| has(node, column))).collect();
        Self { columns, given, any }
    }
    /// Reads those of one body, and returns them as TOML.
    pub(super) fn read(&mut self, table: &Table<'_>, report: &mut Report) -> String {
        let mut text = String::new();
        for ((column, list), any) in self.columns.iter().zip(&mut self.given).zip(&self.any) {
            let entry = table.get(&column.name);
            let value = entry.and_then(|entry| given(&entry.node, &column.name, column.kind, report));
            if let Some(value) = value {
                text += &format!(", {} = {}", column.name, shown(column.kind, value));
            }
            list.resize(list.len() + 1, value.or(column.initial).unwrap_or_default());
            if *any && entry.is_none() && column.initial.is_none() {
                report.push(table.lacks(&column.name, column.kind.name(), "other bodies have it"));
            }
        }
        text
    }
    /// Sets them in the particles.
    pub(super) fn give(self, particles: &mut State) {
        for ((column, values), any) in self.columns.iter().zip(self.given).zip(self.any) {
            if any {
                particles.put(column, Some(values));
            }
        }
    }
}
