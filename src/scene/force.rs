//! `[[force]]`: one of the register by its `kind`, or a user's own law in WGSL.

use std::path::Path;

use crate::error::Error;
use crate::forces::{self, Component, Custom, Over};
use crate::integrators::Integrator;
use crate::kernel::Bounds;
use crate::links::too_many_bonds;
use crate::motion::Motion;
use crate::settings::{Kind, Settings, Value};
use crate::state::State;
use crate::tree::Opening;

use super::files::Files;
use super::held;
use super::pairs;
use super::report::{Fault, Place, Report};
use super::resolved::{self, Writer};
use super::tree::{Data, Entry};
use super::value;
use super::walk::{self, Table};

pub(super) const OWN: &[&str] = &[
    "kind",
    "wgsl",
    "over",
    "range",
    "skin",
    "exclude",
    "slots",
    "neighbors",
    "theta",
    "params",
    "pairs",
    "tables",
    "into",
    "grains",
];

/// A force as the scene gives it.
pub(super) enum Chosen {
    Known(&'static forces::Entry, Settings),
    Own { law: Box<Custom>, path: String },
}

pub(super) fn read(table: &Table<'_>, (files, motions): (&Files, &[Motion]), report: &mut Report) -> Option<Chosen> {
    let entry = table.one_of(&["kind", "wgsl"], report)?;
    if entry.key == "wgsl" {
        return read_own(&table.named(format!("{} wgsl", table.name)), entry, files, report);
    }
    let names: Vec<_> = forces::entries().map(|f| f.name).collect();
    let name = walk::choice(entry, "force", &names, report)?;
    let force = forces::entries().find(|f| f.name == name)?;
    let table = table.named(format!("{} {name}", table.name));
    let settings = table.settings(force.keys, &["kind"], report);
    if !settings.text("motion").is_empty() {
        let names: Vec<_> = motions.iter().map(|motion| motion.name.as_str()).collect();
        held::motion(&table, &names, report);
    }
    Some(Chosen::Known(force, settings))
}

fn read_own(table: &Table<'_>, wgsl: &Entry, files: &Files, report: &mut Report) -> Option<Chosen> {
    table.settings(&[], &OWN[1..], report);
    let over = over(table, report);
    let params = table.get("params").map_or_else(Vec::new, |entry| params(entry, report));
    let pairs = table.get("pairs").and_then(|entry| pairs::of_any_names(&entry.node, report));
    let tables = table.get("tables").map_or_else(Vec::new, |entry| tables(entry, report));
    let into = table.get("into").map_or_else(|| vec!["acceleration".into()], |entry| into(entry, report));
    let exclude = optional(table, "exclude", Kind::Whole, report).flatten().unwrap_or(0.0);
    if let (Some(entry), Some(why)) = (table.get("exclude"), too_many_bonds(exclude)) {
        report.push(Fault::at(&entry.node.place, why));
    }
    let grains = table.get("grains").is_some_and(|entry| flag(entry, report));
    let name = value::text(&wgsl.node, "wgsl", "the name of a file", report)?;
    let text = files
        .locate("wgsl", name, &wgsl.node.place)
        .and_then(|f| Ok((f.shader(&wgsl.node.place)?, f.name().to_owned())));
    match text {
        Ok((text, path)) => {
            let stem =
                Path::new(name).file_stem().map_or_else(|| name.to_owned(), |s| s.to_string_lossy().into_owned());
            Some(Chosen::Own {
                law: Box::new(Custom {
                    name: stem,
                    over: over?,
                    wgsl: text,
                    file: name.to_owned(),
                    params,
                    pairs,
                    tables,
                    into,
                    #[expect(
                        clippy::cast_possible_truncation,
                        clippy::cast_sign_loss,
                        reason = "too many are refused"
                    )]
                    exclude: exclude as u32,
                    grains,
                }),
                path,
            })
        }
        Err(fault) => {
            report.push(fault);
            None
        }
    }
}

/// Remarks on forces that are given the skin of a list and keep none, or leave out bonded pairs where there are no bonds.
pub(super) fn unused<'a>(sections: &'a [(&'static str, Table<'a>)], particles: &State) -> Vec<String> {
    let tables = sections.iter().filter(|(name, _)| *name == "force").map(|(_, table)| table);
    let links = particles.all_links();
    let bonded = !(links.springs.is_empty() && links.rods.is_empty());
    let leaves_out = |table: &&Table<'a>| {
        let bonds = optional(table, "exclude", Kind::Whole, &mut Report::default()).flatten();
        !bonded && bonds.is_some_and(|bonds| bonds > 0.0)
    };
    let excludes = tables.clone().filter(leaves_out);
    let no_bonds = excludes.map(|table| {
        format!("{} has `exclude`, and no particle has a spring, a rope or a rod: no pair is left out", table.name)
    });
    let remark = |table: &Table<'a>| {
        let kind = value::text(&table.get("kind")?.node, "kind", "", &mut Report::default()).and_then(forces::entry)?;
        let settings = table.settings(kind.keys, &["kind"], &mut Report::default());
        let has = |name: &str| kind.keys.iter().any(|key| key.name == name);
        let skin = Some(table.get("skin")?).filter(|_| has("over") && settings.number("skin") > 0.0)?;
        let over = Some(settings.text("over")).filter(|over| !["list", "auto"].contains(over))?;
        let number = settings.number(&skin.key);
        Some(format!(
            "{} has skin = {number}, which over = \"{over}\" does not use: it is that of a \"list\"",
            table.name
        ))
    };
    tables.filter_map(remark).chain(no_bonds).collect()
}

/// Reports settings of a force that are invalid together, or in such a box, at the key concerned, or else at its table. Returns whether
/// they are valid.
pub(super) fn agrees(table: &Table<'_>, force: &dyn Component, bounds: &Bounds, report: &mut Report) -> bool {
    let fault = match force.check(bounds) {
        Ok(()) => return true,
        Err(Error::Setting { key, why }) => {
            Fault::at(table.get(key).map_or(table.place, |entry| &entry.node.place), why)
        }
        Err(why) => Fault::at(table.place, why.to_string()),
    };
    report.push(fault);
    false
}

/// The visit, with the cut-off radius or the number of neighbours that it needs.
fn over(table: &Table<'_>, report: &mut Report) -> Option<Over> {
    let Some(entry) = table.get("over") else {
        report.push(table.lacks("over", &Kind::Choice(Over::NAMES).wanted(), "which pairs are evaluated"));
        return None;
    };
    let word = walk::choice(entry, "visit", Over::NAMES, report)?;
    // With a range, `auto` is the faster of two searches; otherwise a tree, or all pairs.
    let faster = word == "auto" && table.get("range").is_some() && table.get("theta").is_none();
    let wanted = match word {
        "within" | "near" | "list" => Some("range"),
        "auto" if faster => Some("range"),
        "nearest" => Some("neighbors"),
        "tree" | "auto" => Some("theta"),
        _ => None,
    };
    for given in
        ["range", "skin", "slots", "exclude", "neighbors", "theta"].into_iter().filter_map(|key| table.get(key))
    {
        let key = given.key.as_str();
        let kept = word == "list" && ["skin", "slots", "exclude"].contains(&key)
            || faster && ["skin", "exclude"].contains(&key);
        if wanted != Some(given.key.as_str()) && !kept {
            let fault = Fault::at(&given.place, format!("a law over \"{word}\" does not use `{}`", given.key));
            report.push(fault.label("remove it, or change `over`"));
        }
    }
    let Some(wanted) = wanted else {
        return Some(match word {
            "each" => Over::Each,
            "links" => Over::Links,
            "joints" => Over::Joints,
            "dihedrals" => Over::Dihedrals,
            "triangles" => Over::Triangles,
            _ => Over::Pairs,
        });
    };
    let kind = match wanted {
        "neighbors" => Kind::Count,
        "theta" => Kind::Fraction,
        _ => Kind::Positive,
    };
    let Some(given) = table.get(wanted) else {
        let about = match wanted {
            "range" => "the cut-off radius [length]",
            "theta" => "the opening angle, at most 1: a group of size l is approximated beyond the distance l / theta",
            _ => "the number of neighbours",
        };
        report.push(table.lacks(wanted, &kind.wanted(), about));
        return None;
    };
    let number = value::number(&given.node, wanted, kind, &kind.wanted(), report)?;
    match word {
        "within" => Some(Over::Within { range: number }),
        "near" => Some(Over::Near { range: number, of: None }),
        "list" => {
            let skin = optional(table, "skin", Kind::NotNegative, report)?;
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count fits 32 bits")]
            let slots = optional(table, "slots", Kind::Count, report)?.map_or(0, |slots| slots as u32);
            Some(Over::List { range: number, skin, slots })
        }
        "auto" if faster => {
            let skin = optional(table, "skin", Kind::NotNegative, report)?;
            Some(Over::Auto { range: number, skin })
        }
        "tree" | "auto" => {
            Some(Over::Tree { opening: Opening::Geometric { theta: number }, core: 0.0, auto: word == "auto" })
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count fits 32 bits")]
        _ => Some(Over::Nearest { count: number as u32 }),
    }
}

/// An optional number; `None` if it is invalid.
#[expect(clippy::option_option, reason = "a number that is wrong is not one that is left out")]
fn optional(table: &Table<'_>, key: &str, kind: Kind, report: &mut Report) -> Option<Option<f64>> {
    match table.get(key) {
        Some(given) => value::number(&given.node, key, kind, &kind.wanted(), report).map(Some),
        None => Some(None),
    }
}

fn flag(entry: &Entry, report: &mut Report) -> bool {
    value::read(&entry.node, &entry.key, Kind::Flag, report) == Some(Value::Flag(true))
}

fn params(entry: &Entry, report: &mut Report) -> Vec<(String, Value)> {
    let Data::Table(list) = &entry.node.data else {
        value::refuse::<()>(&entry.node, "params", "a table, as in { strength = 2.0 }", report);
        return Vec::new();
    };
    list.iter().filter_map(|e| Some((e.key.clone(), param(e, report)?))).collect()
}

/// Tables of data: `{ lookup = [0.0, 0.5, 1.0] }`, each an `array<f32>`.
fn tables(entry: &Entry, report: &mut Report) -> Vec<crate::kernel::Table> {
    let Data::Table(list) = &entry.node.data else {
        value::refuse::<()>(
            &entry.node,
            "tables",
            "a table of lists of numbers, as in { lookup = [0.0, 1.0] }",
            report,
        );
        return Vec::new();
    };
    let words = |entry: &Entry, report: &mut Report| {
        let Data::List(list) = &entry.node.data else {
            return value::refuse(&entry.node, &entry.key, "a list of numbers", report);
        };
        #[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is what the device does")]
        let word = |node: &super::tree::Node, report: &mut Report| {
            value::number(node, &entry.key, Kind::Number, "a number", report).map(|x| (x as f32).to_bits())
        };
        list.iter().map(|node| word(node, report)).collect::<Option<Vec<u32>>>()
    };
    let table = |entry: &Entry| Some((entry.key.clone().into(), std::sync::Arc::new(words(entry, report)?)));
    list.iter().filter_map(table).collect()
}

/// The columns that a law writes.
fn into(entry: &Entry, report: &mut Report) -> Vec<crate::kernel::Name> {
    let Data::List(list) = &entry.node.data else {
        value::refuse::<()>(&entry.node, "into", "a list of columns, as in [\"density\"]", report);
        return Vec::new();
    };
    list.iter()
        .filter_map(|node| value::text(node, "into", "the name of a column", report))
        .map(|name| name.to_owned().into())
        .collect()
}

pub(super) fn param(entry: &Entry, report: &mut Report) -> Option<Value> {
    let kind = match entry.node.data {
        Data::Integer(_) | Data::Float(_) => Kind::Number,
        Data::List(_) => Kind::Vector,
        Data::Flag(_) => Kind::Flag,
        _ => return value::refuse(&entry.node, &entry.key, "a number, three numbers, or true or false", report),
    };
    value::read(&entry.node, &entry.key, kind, report)
}

impl Chosen {
    pub(super) fn build(self) -> Box<dyn Component> {
        match self {
            Self::Known(entry, settings) => (entry.build)(&settings),
            Self::Own { law, .. } => law,
        }
    }
    pub(super) fn write(&self, out: &mut Writer) {
        out.header("[[force]]");
        match self {
            Self::Known(entry, settings) => {
                out.text("kind", entry.name);
                out.settings(entry.keys, settings);
            }
            Self::Own { law, path } => {
                out.text("wgsl", path);
                out.text("over", law.over.name());
                match law.over {
                    Over::Within { range } | Over::Near { range, .. } => out.number("range", range),
                    Over::List { range, skin, slots } => {
                        out.number("range", range);
                        skin.into_iter().for_each(|skin| out.number("skin", skin));
                        if slots > 0 {
                            out.line("slots", &slots.to_string());
                        }
                    }
                    Over::Auto { range, skin } => {
                        out.number("range", range);
                        skin.into_iter().for_each(|skin| out.number("skin", skin));
                    }
                    Over::Tree { opening, .. } => out.number("theta", opening.theta()),
                    Over::Nearest { count } => out.line("neighbors", &count.to_string()),
                    _ => {}
                }
                let params: Vec<_> =
                    law.params.iter().map(|(k, v)| format!("{} = {}", resolved::bare(k), resolved::value(v))).collect();
                out.line("params", &format!("{{ {} }}", params.join(", ")));
                own_tables(law, out);
                if law.exclude > 0 {
                    out.line("exclude", &law.exclude.to_string());
                }
                if law.grains {
                    out.line("grains", "true");
                }
            }
        }
    }
}

/// Refuses columns that an integrator does not advance.
pub(super) fn advanced(forces: &[Box<dyn Component>], integrator: &str, place: &Place, report: &mut Report) {
    for force in forces {
        if let Some(column) = force.columns().iter().find(|column| column.is_advanced()) {
            let fault = format!(
                "{integrator} advances positions and velocities alone, and {} has `{}`",
                force.name(),
                column.name
            );
            report.push(Fault::at(place, fault).label("choose \"rk4\" or \"leapfrog\""));
        }
    }
}

/// Refuses adaptive steps where no force limits them, or a force does not allow them.
pub(super) fn adapted(forces: &[Box<dyn Component>], integrator: &dyn Integrator, place: &Place, report: &mut Report) {
    if let Some(why) = forces.iter().find_map(|force| force.properties().fixed_step) {
        report.push(Fault::at(place, "steps cannot be adaptive").label(format!("{why}: leave this out")));
    }
    let limits = forces.iter().find(|force| force.properties().limits_steps);
    match (limits, integrator.estimates_error()) {
        (None, false) => {
            let fault = Fault::at(place, "no force limits the time step, so it cannot be adaptive");
            report.push(fault.label("leave this out, add a fluid, or choose integrator = \"gauss_radau\""));
        }
        (Some(force), true) => {
            let (name, its) = (force.name(), integrator.name());
            let fault = format!("{its} chooses its steps by its own error, and {name} limits them too");
            report.push(Fault::at(place, fault).label("choose integrator = \"leapfrog\", or leave this out"));
        }
        _ => {}
    }
}

/// The lines of a law's tables and columns.
fn own_tables(law: &Custom, out: &mut Writer) {
    if let Some(pairs) = &law.pairs {
        out.line("pairs", &resolved::pairs(pairs));
    }
    if !law.tables.is_empty() {
        let words = |words: &[u32]| {
            let cells = words.iter().map(|word| resolved::value(&Value::Number(f64::from(f32::from_bits(*word)))));
            cells.collect::<Vec<_>>().join(", ")
        };
        let tables = law.tables.iter().map(|(name, list)| format!("{} = [{}]", resolved::bare(name), words(list)));
        out.line("tables", &format!("{{ {} }}", tables.collect::<Vec<_>>().join(", ")));
    }
    if law.into.len() != 1 || law.into[0] != "acceleration" {
        out.line(
            "into",
            &format!("[{}]", law.into.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ")),
        );
    }
}
