//! `motes info`

use std::collections::BTreeMap;

use glam::DVec3;
use motes::formats::{self, Contents};
use motes::kernel::{Array, Column, Shape};
use motes::measure::Energy;
use motes::{Error, State};
use serde_json::{Value, json};

use super::args::InfoArgs;
use super::failure::Failure;

/// Prints the contents of a file of particles.
pub fn info(args: &InfoArgs) -> Result<(), Failure> {
    let path = &args.file;
    let contents = formats::contents(path)?;
    let columns = formats::known(&contents);
    let state = formats::read(path, &columns)?;
    let format = formats::of(path)?.map_or("", |format| format.about);
    let bytes = std::fs::metadata(path).map_or(0, |data| data.len());
    if args.json {
        out!("{:#}", as_json(args, &state, &contents, format)?);
        return Ok(());
    }
    out!("{}: {bytes} bytes, {format}", path.display());
    out!("particles  {}", state.len());
    out!("time       {:?}, step {}", state.time, state.step);
    let bounds = contents.bounds.map_or_else(|| "none in the file".to_owned(), |bounds| bounds.to_string());
    out!("box        {bounds}");
    if let Some((low, high)) = extent(state.position()) {
        out!("extent     {} to {}", corner(low), corner(high));
    }
    let there = |name: &str| is_there(name, &contents);
    if let ([first, ..], [.., last]) = (&*state.ids(), &*state.ids())
        && there("id")
    {
        out!("ids        {first} to {last}");
    }
    let mut species: BTreeMap<u32, u64> = BTreeMap::new();
    state.species().iter().for_each(|of| *species.entry(*of).or_default() += 1);
    let listed: Vec<_> = species.iter().take(SHOWN).map(|(of, count)| format!("{count} of {of}")).collect();
    let more = if species.len() > SHOWN { format!(" and {} more", species.len() - SHOWN) } else { String::new() };
    if there("species") {
        out!("species    {}{more}", listed.join(", "));
    }
    if state.has_inactive() {
        let population = state.population();
        out!("active     {}, {} pending, {} removed", population.active, population.pending, population.removed);
    }
    match (there("mass"), there("velocity")) {
        (true, true) => energies(&state)?,
        (true, false) => out!("mass       {}", number(state.mass().iter().sum())),
        (false, _) => {}
    }
    let listed = || state.columns().filter(|(column, _)| there(&column.name));
    let wide = listed().map(|(column, _)| column.name.len()).max().unwrap_or(0);
    for (column, values) in listed() {
        out!("column     {:wide$}  {}{}", column.name, kind(column), range(values));
    }
    let read: Vec<&str> = contents.headings.iter().map(|heading| heading.title.as_str()).collect();
    let unread = read.into_iter().filter(|title| !is_held(title, &state));
    let unread: Vec<&str> = unread.chain(contents.left_out.iter().map(String::as_str)).take(SHOWN).collect();
    if !unread.is_empty() {
        out!("left out   {}", unread.join(", "));
    }
    Ok(())
}

fn as_json(args: &InfoArgs, state: &State, contents: &Contents, format: &str) -> Result<Value, Error> {
    let there = |name: &str| is_there(name, contents);
    let corner = |x: DVec3| json!(x.to_array());
    let columns: Vec<Value> = state
        .columns()
        .filter(|(column, _)| there(&column.name))
        .map(|(column, values)| json!({ "name": column.name, "kind": column.kind.name(), "unit": column.unit, "length": values.len() }))
        .collect();
    let energy = if there("mass") && there("velocity") && state.get("potential").is_some() {
        let energy = Energy::of(state)?;
        json!({ "kinetic": energy.kinetic, "potential": energy.potential, "total": energy.total() })
    } else {
        Value::Null
    };
    let population = state.population();
    let unread: Vec<&str> =
        contents.headings.iter().map(|heading| heading.title.as_str()).filter(|title| !is_held(title, state)).collect();
    Ok(json!({ "file": args.file, "format": format, "particles": state.len(), "time": state.time, "step": state.step,
        "box": contents.bounds.map(|bounds| json!({ "low": corner(bounds.low), "high": corner(bounds.high), "text": bounds.to_string() })),
        "extent": extent(state.position()).map(|(low, high)| json!({ "low": corner(low), "high": corner(high) })),
        "active": population.active, "pending": population.pending, "removed": population.removed, "columns": columns,
        "energy": energy, "left_out": unread.into_iter().chain(contents.left_out.iter().map(String::as_str)).collect::<Vec<_>>() }))
}

/// The maximum length of a list.
const SHOWN: usize = 12;

fn extent(places: &[DVec3]) -> Option<(DVec3, DVec3)> {
    let first = *places.first()?;
    Some(places.iter().fold((first, first), |(low, high), x| (low.min(*x), high.max(*x))))
}

fn corner(x: DVec3) -> String {
    format!("({}, {}, {})", number(x.x), number(x.y), number(x.z))
}

/// A number with the digits of single precision.
fn number(x: f64) -> String {
    #[expect(clippy::cast_possible_truncation, reason = "for reading")]
    let narrow = x as f32;
    if narrow.is_finite() { format!("{narrow:?}") } else { format!("{x:?}") }
}

fn kind(column: &Column) -> String {
    match column.shape {
        Shape::System(count) => format!("{} of the system, {count}", column.kind.name()),
        _ => column.kind.name().to_owned(),
    }
}

fn range(values: &Array) -> String {
    let of = |numbers: &mut dyn Iterator<Item = f64>| {
        let ends = numbers.fold(None, |ends: Option<(f64, f64)>, x| {
            Some(ends.map_or((x, x), |(low, high)| (low.min(x), high.max(x))))
        });
        ends.map_or_else(String::new, |(low, high)| format!(", {} to {}", number(low), number(high)))
    };
    match values {
        Array::Float(list) => of(&mut list.iter().copied()),
        Array::Uint(list) => of(&mut list.iter().map(|x| f64::from(*x))),
        Array::Vec3(list) => {
            let text = of(&mut list.iter().map(|x| x.length()));
            if text.is_empty() { text } else { format!("{text} long") }
        }
        Array::Vec4(_) => String::new(),
    }
}

/// Momentum and kinetic energy; and the potential energy if the file has the column `potential`.
fn energies(state: &State) -> Result<(), Error> {
    let active = (0..state.len()).filter(|row| state.is_active(*row));
    let (mut mass, mut momentum, mut kinetic) = (0.0, DVec3::ZERO, 0.0);
    for row in active {
        let (m, v) = (state.mass()[row], state.velocity()[row]);
        mass += m;
        momentum += m * v;
        kinetic += 0.5 * m * v.length_squared();
    }
    out!("mass       {}, momentum {}", number(mass), corner(momentum));
    if state.get("potential").is_some() {
        let energies = Energy::of(state)?;
        out!("energy     {}, of which {} is kinetic", number(energies.total()), number(kinetic));
    } else {
        out!("energy     {} is kinetic; the file has no column `potential`", number(kinetic));
    }
    Ok(())
}

/// Whether a file has values of a column: few files have all columns of a state.
fn is_there(column: &str, contents: &Contents) -> bool {
    let own: &[&str] = match column {
        "velocity" => &["vx", "vy", "vz"],
        "mass" => &["mass", "m"],
        "size" => &["size"],
        "species" => &["species"],
        "life" => &["life"],
        "id" => &["id"],
        _ => return true,
    };
    contents.headings.iter().any(|heading| own.contains(&heading.title.as_str()))
}

/// Whether a title in the file belongs to a column of the state.
fn is_held(title: &str, state: &State) -> bool {
    let stem = title.rsplit_once('_').map_or(title, |(stem, _)| stem);
    let usual = ["x", "y", "z", "vx", "vy", "vz", "id", "name", "m"];
    usual.contains(&title) || state.columns().any(|(column, _)| column.name == title || column.name == stem)
}
