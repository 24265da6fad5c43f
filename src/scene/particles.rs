//! `[[particles]]`: from a file, from a generator, or listed in the scene.

use std::fmt::Write;

use glam::DVec3;

use crate::error::Error;
use crate::formats;
use crate::kernel::{Bounds, Column, Columns};
use crate::motion::{Held, Hold, Motion};
use crate::render::group_color;
use crate::settings::{Key, Kind, Settings, Value};
use crate::shapes::{Amount, SHAPES, Shape};
use crate::state::State;

use super::color;
use super::column;
use super::copies::{self, COPIES};
use super::files::Files;
use super::held;
use super::report::{Fault, Place, Report};
use super::resolved::{self, Writer};
use super::shared;
use super::tree::{Data, Entry};
use super::value;
use super::walk::{self, Table};

/// The keys of any entry in addition to those of its source.
const BESIDE: [&str; 4] = ["color", "species", held::OWN[0], held::OWN[1]];
/// The offsets of the particles of a file, or of listed ones.
pub(super) const OFFSETS: &[Key] = &[
    Key::new("center", Kind::Vector, Value::Vector(DVec3::ZERO), "is added to every position [length]"),
    Key::new("velocity", Kind::Vector, Value::Vector(DVec3::ZERO), "is added to every velocity [length / time]"),
    Key::new(
        "velocity_factor",
        Kind::Number,
        Value::Number(1.0),
        "multiplies every velocity, before `velocity` is added: for a snapshot of GADGET at redshift z where space expands, (1 + z)^-1.5",
    ),
];
/// The keys of every entry.
pub const EVERY: &[Key] = &[Key::new(
    "species",
    Kind::Whole,
    Value::Number(0.0),
    "the species, a number by which forces distinguish particles; left out: the file's own column",
)];
const BODY: &[Key] = &[
    Key::required("position", Kind::Vector, "its position [length]"),
    Key::new("velocity", Kind::Vector, Value::Vector(DVec3::ZERO), "its velocity [length / time]"),
    Key::new("mass", Kind::NotNegative, Value::Number(1.0), "its mass [mass]"),
    Key::new("size", Kind::NotNegative, Value::Number(0.0), "the radius that is drawn [length]"),
    Key::new("species", Kind::Whole, Value::Number(0.0), "its species; left out: that of the entry"),
    Key::new("fixed", Kind::Flag, Value::Flag(false), "whether it is fixed"),
];

/// An entry that was read.
pub(super) struct Block {
    pub(super) particles: State,
    /// Its parts in pictures: the number of particles of each, and their colour; the last one contains the rest.
    pub(super) parts: Vec<(u32, Option<[u8; 3]>)>,
    /// The entry in the resolved scene.
    pub(super) resolved: String,
}

/// Reads an entry of at most `room` particles.
pub(super) fn read(
    table: &Table<'_>,
    room: u32,
    (files, motions, said, bounds): (&Files, &[Motion], &[Entry], &Bounds),
    known: &Columns,
    report: &mut Report,
) -> Option<Block> {
    let columns = &column::givable(known);
    let color = table.get("color").and_then(|e| color::read(&e.node, "color", report));
    let species = table.get("species").and_then(|e| species(e, report));
    let mut out = Writer::default();
    out.header("[[particles]]");
    let entry = table.one_of(&["file", "shape", "bodies"], report)?;
    let faults = report.len();
    let mut others = Vec::new();
    let particles = match entry.key.as_str() {
        "file" => from_file(table, entry, (files, known), &mut out, report),
        "shape" => from_shape(table, entry, (room, files, said), columns, &mut others, &mut out, report),
        _ => from_bodies(table, entry, (columns, species), &mut out, report),
    };
    let particles = match entry.key.as_str() {
        "shape" => particles,
        _ => copies::read(table, particles, (room, bounds), &mut out, report),
    };
    let particles = particles.filter(|_| report.len() == faults)?;
    if let Err(fault) = sound(&particles, room, &entry.node.place) {
        report.push(if entry.key == "file" { fault.in_input() } else { fault });
        return None;
    }
    if let Some(rgb) = color {
        out.text("color", &color::shown(rgb));
    }
    // A file may have species of its own, and listed particles have them.
    let species = species.or((entry.key == "shape").then_some(0));
    if let Some(species) = species {
        out.line("species", &species.to_string());
    }
    let mut particles = species.into_iter().filter(|_| entry.key != "bodies").fold(particles, State::of_species);
    let shape = table.get("shape").and_then(|entry| match &entry.node.data {
        Data::Text(name) => SHAPES.iter().find(|shape| shape.name == name),
        _ => None,
    });
    let taken = shape.map_or([OFFSETS, COPIES].concat(), |shape| shape.keys.to_vec());
    column::give(table, (columns, &taken), &mut particles, &mut out, report);
    held::read(table, motions, &mut particles, &mut out, report);
    // Parts without colours of their own are one.
    if others.iter().all(|(_, own)| own.is_none()) {
        others.clear();
    }
    let first = particles.len() - others.iter().map(|(count, _)| *count as usize).sum::<usize>();
    let first = (u32::try_from(first).unwrap_or(u32::MAX), color);
    // Parts without a colour of their own have that of the entry.
    let others = others.into_iter().map(|(count, own)| (count, own.or(color)));
    let parts = std::iter::once(first).chain(others).collect();
    Some(Block { particles, parts, resolved: out.0 })
}

fn beside<'a>(what: &'static str, columns: &[&'a Column]) -> Vec<&'a str> {
    let copies = COPIES.iter().filter(|_| what != "shape").map(|key| key.name);
    [what].into_iter().chain(BESIDE).chain(copies).chain(columns.iter().map(|column| column.name.as_ref())).collect()
}

fn species(entry: &Entry, report: &mut Report) -> Option<u32> {
    let wanted = Kind::Whole.wanted();
    let number = value::number(&entry.node, "species", Kind::Whole, &wanted, report)?;
    if number > f64::from(u32::MAX) {
        report.push(
            Fault::at(&entry.node.place, "`species` is too large").label(format!("it may be at most {}", u32::MAX)),
        );
        return None;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole, and it fits")]
    Some(number as u32)
}

fn from_file(
    table: &Table<'_>,
    entry: &Entry,
    (files, known): (&Files, &Columns),
    out: &mut Writer,
    report: &mut Report,
) -> Option<State> {
    let columns = column::givable(known);
    let offsets = table.named(format!("{} file", table.name)).settings(OFFSETS, &beside("file", &columns), report);
    let name = value::text(&entry.node, "file", "the name of a file", report)?;
    let place = &entry.node.place;
    let located =
        files.locate("file", name, place).and_then(|located| match formats::read_from(&located.input(), known) {
            Ok(particles) => Ok((particles, located.name().to_owned())),
            Err(why) => Err(Fault::at(place, why.to_string()).in_input()),
        });
    match located {
        Ok((particles, path)) => {
            out.text("file", &path);
            out.settings(OFFSETS, &offsets);
            Some(moved(particles, &offsets))
        }
        Err(fault) => {
            report.push(fault);
            None
        }
    }
}

/// `parts` gets the parts after the shape's first one: the number of particles of each, and its own colour.
fn from_shape(
    table: &Table<'_>,
    entry: &Entry,
    (room, files, said): (u32, &Files, &[Entry]),
    columns: &[&Column],
    parts: &mut Vec<(u32, Option<[u8; 3]>)>,
    out: &mut Writer,
    report: &mut Report,
) -> Option<State> {
    let names: Vec<_> = SHAPES.iter().map(|s| s.name).collect();
    let name = walk::choice(entry, "shape", &names, report)?;
    let shape = SHAPES.iter().find(|s| s.name == name)?;
    let faults = report.len();
    let entries = shared::completed(table, shape.keys, said);
    let table = &Table { entries: &entries, ..table.named(format!("{} {name}", table.name)) };
    let mut settings = table.settings(shape.keys, &beside("shape", columns), report);
    let shown = located(table, shape, files, &mut settings, report);
    if report.len() > faults {
        return None;
    }
    let wanted = (shape.amount)(&settings).particles;
    if wanted > f64::from(room) {
        let sizes = ["count", "columns", "strands", "size"];
        let place = sizes.iter().find_map(|key| table.get(key)).map_or(&entry.node.place, |e| &e.node.place);
        report
            .push(Fault::at(place, format!("{wanted} particles are too many")).label(format!("the maximum is {room}")));
        return None;
    }
    out.text("shape", name);
    out.settings(shape.keys, &shown);
    match (shape.build)(&settings) {
        Ok(particles) => {
            let plain = table.get("color").is_none();
            let own = |(part, key): (u32, &str)| {
                if key.is_empty() { plain.then(|| group_color(part)) } else { color::known(settings.text(key)) }
            };
            let all = (1..).zip((shape.parts)(&settings));
            parts.extend(all.map(|(part, (key, count))| (count, own((part, key)))));
            Some(particles)
        }
        Err(why) => {
            let message = match why {
                Error::Scene(message) => message,
                other => other.to_string(),
            };
            report.push(Fault::at(&entry.node.place, message));
            None
        }
    }
}

/// Inserts the contents of files into the settings that name them; returns the settings with the names of the resolved scene.
fn located(table: &Table<'_>, shape: &Shape, files: &Files, settings: &mut Settings, report: &mut Report) -> Settings {
    let mut shown = settings.clone();
    for key in shape.keys.iter().filter(|key| key.kind == Kind::File) {
        let (Some(entry), false) = (table.get(key.name), settings.text(key.name).is_empty()) else { continue };
        let place = &entry.node.place;
        let found = files.locate(key.name, settings.text(key.name), place);
        match found.and_then(|located| Ok((located.name().to_owned(), located.mesh(place)?))) {
            Ok((name, text)) => {
                shown.0.insert(key.name, Value::Text(name.into()));
                settings.0.insert(key.name, Value::Text(text.into()));
            }
            Err(fault) => report.push(fault),
        }
    }
    shown
}

/// The number of particles of an entry, by its settings; zero for files and listed particles.
pub(super) fn amount(table: &Table<'_>, said: &[Entry], columns: &[&Column], report: &mut Report) -> Amount {
    let shape = |report: &mut Report| {
        let entry = table.one_of(&["file", "shape", "bodies"], report).filter(|entry| entry.key == "shape")?;
        let names: Vec<_> = SHAPES.iter().map(|s| s.name).collect();
        let name = walk::choice(entry, "shape", &names, report)?;
        SHAPES.iter().find(|s| s.name == name)
    };
    let Some(shape) = shape(report) else { return Amount::default() };
    let entries = shared::completed(table, shape.keys, said);
    let table = Table { entries: &entries, ..table.named(format!("{} {}", table.name, shape.name)) };
    (shape.amount)(&table.settings(shape.keys, &beside("shape", columns), report))
}

fn from_bodies(
    table: &Table<'_>,
    entry: &Entry,
    (columns, usual): (&[&Column], Option<u32>),
    out: &mut Writer,
    report: &mut Report,
) -> Option<State> {
    let offsets = table.named(format!("{} bodies", table.name)).settings(OFFSETS, &beside("bodies", columns), report);
    let Data::List(list) = &entry.node.data else {
        return value::refuse(&entry.node, "bodies", "a list of tables, as in [{ position = [1, 0, 0] }]", report);
    };
    let mut particles = State::default();
    let mut own = column::Bodies::new(columns, list);
    let mut text = String::from("[\n");
    for node in list {
        let Data::Table(entries) = &node.data else {
            value::refuse::<()>(node, "bodies", "a list of tables, as in [{ position = [1, 0, 0] }]", report);
            continue;
        };
        let names: Vec<&str> = columns.iter().map(|column| column.name.as_ref()).collect();
        let one = Table { entries, place: &node.place, name: "a body".to_owned() };
        let body = one.settings(BODY, &names, report);
        let more = own.read(&one, report);
        let [position, velocity] = ["position", "velocity"].map(|k| body.vector(k));
        let [mass, size] = ["mass", "size"].map(|k| body.number(k));
        if body.flag("fixed") {
            particles.held.push(Held { id: u32::try_from(particles.len()).unwrap_or(u32::MAX), by: Hold::Fixed });
        }
        particles.push(position, velocity, mass, size);
        let own_species = one.get("species").and_then(|entry| self::species(entry, report));
        let species = own_species.or(usual).unwrap_or(0);
        if let Some(last) = particles.species_mut().last_mut() {
            *last = species;
        }
        let fixed = if body.flag("fixed") { ", fixed = true" } else { "" };
        let [position, velocity] = [position, velocity].map(resolved::vector);
        let [mass, size] = [mass, size].map(resolved::number);
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "  {{ position = {position}, velocity = {velocity}, mass = {mass}, size = {size}, species = {species}{fixed}{more} }},"
        );
    }
    own.give(&mut particles);
    out.line("bodies", &(text + "]"));
    out.settings(OFFSETS, &offsets);
    Some(moved(particles, &offsets))
}

fn moved(mut particles: State, offsets: &Settings) -> State {
    let [center, velocity] = ["center", "velocity"].map(|k| offsets.vector(k));
    particles.position_mut().iter_mut().for_each(|x| *x += center);
    let factor = offsets.number("velocity_factor");
    particles.velocity_mut().iter_mut().for_each(|v| *v = *v * factor + velocity);
    particles
}

/// The checks that apply to files and generators alike.
fn sound(particles: &State, room: u32, place: &Place) -> Result<(), Fault> {
    let count = particles.len();
    if count == 0 {
        return Err(Fault::at(place, "this entry has no particles"));
    }
    if count > room as usize {
        return Err(Fault::at(place, format!("{count} particles are too many")).label(format!("the maximum is {room}")));
    }
    let fits = |x: f64| x.abs() <= f64::from(f32::MAX);
    let vectors = [("position", particles.position()), ("velocity", particles.velocity())];
    let wrong = vectors.iter().find_map(|(what, list)| {
        let id = list.iter().position(|v| !v.to_array().into_iter().all(fits))?;
        Some((id, *what, format!("{:?}", list[id].to_array()), "finite numbers that fit single precision"))
    });
    let wrong = wrong.or_else(|| {
        [("mass", particles.mass()), ("size", particles.size())].iter().find_map(|(what, list)| {
            let id = list.iter().position(|&x| !(x >= 0.0 && fits(x)))?;
            Some((id, *what, format!("{:?}", list[id]), "a finite number, zero or above"))
        })
    });
    match wrong {
        Some((id, what, found, wanted)) => {
            Err(Fault::at(place, format!("particle {id} has the {what} {found}, not {wanted}")))
        }
        None => Ok(()),
    }
}
