//! A sheet of cloth.

use std::borrow::Cow;

use glam::DVec3;

use super::build::{CENTER, MASS, PARTICLE_SIZE, Reader, SEED, VELOCITY, hold};
use super::random::Random;
use super::{Amount, Resolution, Shape, one_part};
use crate::error::Error;
use crate::links::{Link, Links};
use crate::settings::{Key, Kind, Settings, Value};
use crate::state::State;

/// The shape `cloth`.
pub const CLOTH: Shape = Shape {
    name: "cloth",
    about: "a sheet of springs: along the threads, across the squares, and over two against bending (Provot 1995)",
    keys: KEYS,
    build,
    amount,
    parts: one_part,
    resolution: Resolution::Grid { keys: &["columns", "rows"], least: 2 },
};

const KEYS: &[Key] = &[
    Key::required("columns", Kind::Count, "particles along `right`, 2 or above"),
    Key::required("rows", Kind::Count, "particles along `down`, 2 or above"),
    Key::new("spacing", Kind::Positive, Value::Number(0.01), "distance between neighbours along a thread [length]"),
    Key::new("right", Kind::Direction, Value::Vector(DVec3::X), "the way along a row"),
    Key::new("down", Kind::Direction, Value::Vector(DVec3::NEG_Y), "the way from row to row"),
    MASS,
    Key::new(
        "stretch",
        Kind::NotNegative,
        Value::Number(1000.0),
        "stiffness of the springs along the threads [mass / time²]",
    ),
    Key::new(
        "shear",
        Kind::NotNegative,
        Value::Number(500.0),
        "stiffness of the springs across each square [mass / time²]; 0: none",
    ),
    Key::new(
        "bend",
        Kind::NotNegative,
        Value::Number(10.0),
        "stiffness of the springs over two, against bending [mass / time²]; 0: none",
    ),
    Key::new(
        "damping",
        Kind::NotNegative,
        Value::Number(0.0),
        "damping of the springs along the threads, of others by their stiffness [mass / time]",
    ),
    Key::new(
        "rest",
        Kind::NotNegative,
        Value::Number(1.0),
        "rest lengths, relative to the distances; 0: equally stiff in all directions",
    ),
    Key::new(
        "pins",
        Kind::Choice(PINS),
        Value::Text(Cow::Borrowed("none")),
        "which particles are fixed: two corners of the first row, the first row, the first column, or the whole edge",
    ),
    Key::new(
        "jitter",
        Kind::NotNegative,
        Value::Number(0.0),
        "largest random displacement of a particle normal to the sheet, in spacings: a perfectly flat sheet does not buckle",
    ),
    SEED,
    CENTER,
    VELOCITY,
    PARTICLE_SIZE,
];

const PINS: &[&str] = &["none", "corners", "row", "column", "rim"];

fn amount(settings: &Settings) -> Amount {
    let (columns, rows) = (settings.number("columns"), settings.number("rows"));
    let less = |n: f64, by: f64| (n - by).max(0.0);
    let squares = less(columns, 1.0) * less(rows, 1.0);
    let threads = less(columns, 1.0) * rows + columns * less(rows, 1.0);
    let over_two = less(columns, 2.0) * rows + columns * less(rows, 2.0);
    let kinds = [("stretch", threads), ("shear", 2.0 * squares), ("bend", over_two)];
    let springs = kinds.iter().filter(|(key, _)| settings.number(key) > 0.0).map(|(_, n)| n).sum();
    Amount { springs, triangles: 2.0 * squares, ..Amount::of(columns * rows) }
}

/// `columns * rows` particles, the middle of the sheet at `center`; those of a row follow each other, so particle i of row j
/// has the id  i + columns j. Squares are cut into triangles along alternate diagonals;
/// their front is towards a viewer that sees `right` to the right and `down` below.
fn build(settings: &Settings) -> Result<State, Error> {
    let reader = Reader { shape: "cloth", settings };
    let (columns, rows) = (settings.whole("columns"), settings.whole("rows"));
    if columns < 2 || rows < 2 {
        return Err(reader.error(&format!("columns and rows are {columns} and {rows}; each must be 2 or above")));
    }
    let (_, mut particles) = reader.room_for(columns.saturating_mul(rows))?;
    let [columns, rows] = [columns, rows].map(|n| u32::try_from(n).unwrap_or(u32::MAX));
    let spacing = reader.positive("spacing")?;
    let (right, down) = (reader.direction("right")?, reader.direction("down")?);
    if right.cross(down).length() < 1e-6 {
        return Err(reader.error("right and down are parallel: give two different directions"));
    }
    let mass = reader.positive("mass")?;
    let jitter = reader.not_negative("jitter")?;
    let (center, velocity) = (reader.vector("center")?, reader.vector("velocity")?);
    let radius = reader.not_negative("particle_size")?;
    let mut random = Random::new(settings.whole("seed"));
    let normal = right.cross(down).normalize();
    for j in 0..rows {
        for i in 0..columns {
            let [u, v] = [(i, columns), (j, rows)].map(|(at, of)| f64::from(at) - 0.5 * f64::from(of - 1));
            let aside = if jitter > 0.0 { random.between(-jitter, jitter) } else { 0.0 };
            particles.push((u * right + v * down + aside * normal) * spacing + center, velocity, mass, radius);
        }
    }
    let threads = Threads::read(&reader)?;
    let angle = right.dot(down);
    threads.tie(&mut particles.links, columns, rows, spacing, angle);
    match settings.text("pins") {
        "corners" => hold(&mut particles, [0, columns - 1]),
        "row" => hold(&mut particles, 0..columns),
        "column" => hold(&mut particles, (0..rows).map(|j| j * columns)),
        "rim" => {
            let inner = |n: u32, of: u32| n > 0 && n + 1 < of;
            let rim = |id: &u32| !(inner(id % columns, columns) && inner(id / columns, rows));
            hold(&mut particles, (0..columns * rows).filter(rim));
        }
        _ => {}
    }
    reader.finished(particles)
}

/// The threads of the sheet.
struct Threads {
    stretch: f64,
    shear: f64,
    bend: f64,
    damping: f64,
    rest: f64,
}

impl Threads {
    fn read(reader: &Reader) -> Result<Self, Error> {
        let number = |key| reader.not_negative(key);
        let (stretch, shear, bend) = (number("stretch")?, number("shear")?, number("bend")?);
        if stretch == 0.0 && number("damping")? > 0.0 {
            return Err(reader.error(
                "damping is set and stretch is 0, to which damping is proportional: set stretch, or leave damping out",
            ));
        }
        Ok(Self { stretch, shear, bend, damping: number("damping")?, rest: number("rest")? })
    }
    fn tie(&self, links: &mut Links, columns: u32, rows: u32, spacing: f64, angle: f64) {
        // A square that leans has a long and a short diagonal.
        let [long, short] = [angle, -angle].map(|cosine| (2.0 + 2.0 * cosine).sqrt());
        let mut tie = |a: u32, b: u32, stiffness: f64, length: f64| {
            if stiffness > 0.0 {
                let damping = self.damping * stiffness / self.stretch.max(f64::MIN_POSITIVE);
                let rest = self.rest * length * spacing;
                links.springs.push(Link { ends: [a, b], rest, stiffness, damping, rope: false });
            }
        };
        for j in 0..rows {
            for i in 0..columns {
                let at = |i: u32, j: u32| i + columns * j;
                let here = at(i, j);
                if i + 1 < columns {
                    tie(here, at(i + 1, j), self.stretch, 1.0);
                }
                if j + 1 < rows {
                    tie(here, at(i, j + 1), self.stretch, 1.0);
                }
                if i + 1 < columns && j + 1 < rows {
                    tie(here, at(i + 1, j + 1), self.shear, long);
                    tie(at(i + 1, j), at(i, j + 1), self.shear, short);
                }
                if i + 2 < columns {
                    tie(here, at(i + 2, j), self.bend, 2.0);
                }
                if j + 2 < rows {
                    tie(here, at(i, j + 2), self.bend, 2.0);
                }
            }
        }
        for j in 0..rows - 1 {
            for i in 0..columns - 1 {
                let [a, b, c, d] = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(u, v)| i + u + columns * (j + v));
                let halves = if (i + j) % 2 == 0 { [[a, c, b], [a, d, c]] } else { [[a, d, b], [b, d, c]] };
                links.triangles.extend(halves);
            }
        }
    }
}
