//! `[[force]]`: one of the register by its `kind`, or a user's own law in WGSL.

use std::path::Path;

use crate::forces::{self, Custom, FORCES, Force, Over};
use crate::settings::{Settings, Value};

use super::files::Files;
use super::report::Report;
use super::resolved::{self, Writer};
use super::tree::{Data, Entry};
use super::value;
use super::walk::{self, Table};

pub(super) const OWN: &[&str] = &["kind", "wgsl", "over", "params"];

/// A force as the scene gives it.
pub(super) enum Chosen {
    Known(&'static forces::Entry, Settings),
    Own { law: Custom, path: String },
}

pub(super) fn read(table: &Table<'_>, files: &Files, report: &mut Report) -> Option<Chosen> {
    let entry = table.one_of(&["kind", "wgsl"], report)?;
    if entry.key == "wgsl" {
        return read_own(&table.named(format!("{} wgsl", table.name)), entry, files, report);
    }
    let names: Vec<_> = FORCES.iter().map(|f| f.name).collect();
    let name = walk::choice(entry, "force", &names, report)?;
    let force = FORCES.iter().find(|f| f.name == name)?;
    let settings = table.named(format!("{} {name}", table.name)).settings(force.keys, &["kind"], report);
    Some(Chosen::Known(force, settings))
}

fn read_own(table: &Table<'_>, wgsl: &Entry, files: &Files, report: &mut Report) -> Option<Chosen> {
    table.settings(&[], &["wgsl", "over", "params"], report);
    let over = table.get("over").and_then(|entry| walk::choice(entry, "over", &["each", "pairs"], report));
    if table.get("over").is_none() {
        report.push(table.lacks("over", "either \"each\" or \"pairs\"", "who meets whom"));
    }
    let params = table.get("params").map_or_else(Vec::new, |entry| params(entry, report));
    let name = value::text(&wgsl.node, "wgsl", "the name of a file", report)?;
    let text = files
        .locate("wgsl", name, &wgsl.node.place)
        .and_then(|f| Ok((f.shader(&wgsl.node.place)?, f.name().to_owned())));
    match text {
        Ok((text, path)) => {
            let stem =
                Path::new(name).file_stem().map_or_else(|| name.to_owned(), |s| s.to_string_lossy().into_owned());
            let over = if over? == "each" { Over::Each } else { Over::Pairs };
            Some(Chosen::Own { law: Custom { name: stem, over, wgsl: text, file: name.to_owned(), params }, path })
        }
        Err(fault) => {
            report.push(fault);
            None
        }
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
    use crate::settings::Kind;
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
                out.text("over", if matches!(law.over, Over::Each) { "each" } else { "pairs" });
                let params: Vec<_> =
                    law.params.iter().map(|(k, v)| format!("{} = {}", resolved::bare(k), resolved::value(v))).collect();
                out.line("params", &format!("{{ {} }}", params.join(", ")));
            }
        }
    }
}
