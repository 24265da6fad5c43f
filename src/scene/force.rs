//! `[[force]]`: one of the register by its `kind`, or a user's own law in WGSL.

use std::path::Path;

use crate::forces::{self, Custom, FORCES, Force, Over, Problem};
use crate::kernel::{Machine, Pace, Plan};
use crate::motion::Motion;
use crate::settings::{Kind, Settings, Value};
use crate::tree::Opening;

use super::files::Files;
use super::held;
use super::report::{Fault, Place, Report};
use super::resolved::{self, Writer};
use super::tree::{Data, Entry};
use super::value;
use super::walk::{self, Table};

pub(super) const OWN: &[&str] = &["kind", "wgsl", "over", "range", "neighbors", "theta", "params"];

/// A force as the scene gives it.
pub(super) enum Chosen {
    Known(&'static forces::Entry, Settings),
    Own { law: Custom, path: String },
}

pub(super) fn read(table: &Table<'_>, (files, motions): (&Files, &[Motion]), report: &mut Report) -> Option<Chosen> {
    let entry = table.one_of(&["kind", "wgsl"], report)?;
    if entry.key == "wgsl" {
        return read_own(&table.named(format!("{} wgsl", table.name)), entry, files, report);
    }
    let names: Vec<_> = FORCES.iter().map(|f| f.name).collect();
    let name = walk::choice(entry, "force", &names, report)?;
    let force = FORCES.iter().find(|f| f.name == name)?;
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
    let name = value::text(&wgsl.node, "wgsl", "the name of a file", report)?;
    let text = files
        .locate("wgsl", name, &wgsl.node.place)
        .and_then(|f| Ok((f.shader(&wgsl.node.place)?, f.name().to_owned())));
    match text {
        Ok((text, path)) => {
            let stem =
                Path::new(name).file_stem().map_or_else(|| name.to_owned(), |s| s.to_string_lossy().into_owned());
            Some(Chosen::Own {
                law: Custom { name: stem, over: over?, wgsl: text, file: name.to_owned(), params },
                path,
            })
        }
        Err(fault) => {
            report.push(fault);
            None
        }
    }
}

/// Who meets whom, with the range or the number of neighbours that this asks for.
fn over(table: &Table<'_>, report: &mut Report) -> Option<Over> {
    let Some(entry) = table.get("over") else {
        report.push(table.lacks("over", &value::wanted(Kind::Choice(Over::NAMES)), "who meets whom"));
        return None;
    };
    let word = walk::choice(entry, "over", Over::NAMES, report)?;
    let wanted = match word {
        "within" | "near" => Some("range"),
        "nearest" => Some("neighbors"),
        "tree" | "auto" => Some("theta"),
        _ => None,
    };
    for given in ["range", "neighbors", "theta"].into_iter().filter_map(|key| table.get(key)) {
        if wanted != Some(given.key.as_str()) {
            let fault = Fault::at(&given.place, format!("a law over \"{word}\" has no use for `{}`", given.key));
            report.push(fault.label("remove it, or change `over`"));
        }
    }
    let Some(wanted) = wanted else {
        return Some(match word {
            "each" => Over::Each,
            "links" => Over::Links,
            "joints" => Over::Joints,
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
            "range" => "how far one meets another [length]",
            "theta" => "the opening angle, at most 1: a group of size l is met as one from l / theta on",
            _ => "how many are met",
        };
        report.push(table.lacks(wanted, &value::wanted(kind), about));
        return None;
    };
    let number = value::number(&given.node, wanted, kind, &value::wanted(kind), report)?;
    match word {
        "within" => Some(Over::Within { range: number }),
        "near" => Some(Over::Near { range: number, of: None }),
        "tree" | "auto" => {
            Some(Over::Tree { opening: Opening::Geometric { theta: number }, core: 0.0, auto: word == "auto" })
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count fits 32 bits")]
        _ => Some(Over::Nearest { count: number as u32 }),
    }
}

fn params(entry: &Entry, report: &mut Report) -> Vec<(String, Value)> {
    let Data::Table(list) = &entry.node.data else {
        value::refuse::<()>(&entry.node, "params", "a table, as in { strength = 2.0 }", report);
        return Vec::new();
    };
    list.iter().filter_map(|e| Some((e.key.clone(), param(e, report)?))).collect()
}

fn param(entry: &Entry, report: &mut Report) -> Option<Value> {
    let kind = match entry.node.data {
        Data::Integer(_) | Data::Float(_) => Kind::Number,
        Data::List(_) => Kind::Vector,
        Data::Flag(_) => Kind::Flag,
        _ => return value::refuse(&entry.node, &entry.key, "a number, three numbers, or true or false", report),
    };
    value::read(&entry.node, &entry.key, kind, report)
}

impl Chosen {
    pub(super) fn build(self) -> Box<dyn Force> {
        match self {
            Self::Known(entry, settings) => (entry.build)(&settings),
            Self::Own { law, .. } => Box::new(law),
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
                    Over::Tree { opening, .. } => out.number("theta", opening.theta()),
                    Over::Nearest { count } => out.line("neighbors", &count.to_string()),
                    _ => {}
                }
                let params: Vec<_> =
                    law.params.iter().map(|(k, v)| format!("{} = {}", resolved::bare(k), resolved::value(v))).collect();
                out.line("params", &format!("{{ {} }}", params.join(", ")));
            }
        }
    }
}

/// Refuses adaptive steps that no force limits, or that one does not bear.
pub(super) fn paced(forces: &[Box<dyn Force>], (pace, place): (Pace, &Place), report: &mut Report) {
    if let Some(why) = forces.iter().find_map(|force| force.keeps_to_even_steps()) {
        report.push(Fault::at(place, "steps cannot be adaptive").label(format!("{why}: leave this out")));
    }
    let machine = Machine::HOST;
    let problem = Problem::new(1, machine).paced(Some(pace));
    // What is wrong with a force by itself is told where it is built.
    let offers = |force: &dyn Force| force.paces(&mut Plan::default(), &problem).map_or(true, |limit| limit.is_some());
    if !forces.iter().any(|force| offers(force.as_ref())) {
        let fault = Fault::at(place, "no force says how long a step may be, so that its length cannot be adaptive");
        report.push(fault.label("leave this out, or add a fluid"));
    }
}
