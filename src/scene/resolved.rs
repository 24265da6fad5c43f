//! The scene written back as TOML, with every default filled in.

use std::fmt::Write;
use std::path::{Component, Path, PathBuf};

use glam::DVec3;

use crate::kernel::Scalar;
use crate::settings::{Key, Kind, Settings, Value};
use crate::visit::{PairRow, PairTable};

/// TOML under construction. Numbers have the digits that read back to the same bits.
#[derive(Default)]
pub(super) struct Writer(pub(super) String);

impl Writer {
    /// Comment lines.
    pub(super) fn comment(&mut self, text: &str) {
        for line in text.lines() {
            let line: String = line.chars().filter(|c| !c.is_control()).collect();
            self.0.push_str(if line.is_empty() { "#" } else { "# " });
            self.0.push_str(&line);
            self.0.push('\n');
        }
    }
    /// A header, with an empty line before it.
    pub(super) fn header(&mut self, header: &str) {
        self.0.push('\n');
        self.0.push_str(header);
        self.0.push('\n');
    }
    /// A key with a value that is TOML already.
    pub(super) fn line(&mut self, key: &str, value: &str) {
        // Writing to a String cannot fail.
        let _ = writeln!(self.0, "{} = {value}", bare(key));
    }
    /// A number.
    pub(super) fn number(&mut self, key: &str, value: f64) {
        self.line(key, &number(value));
    }
    /// A text.
    pub(super) fn text(&mut self, key: &str, value: &str) {
        self.line(key, &quoted(value));
    }
    /// Settings, in the order of their keys.
    pub(super) fn settings(&mut self, keys: &[Key], settings: &Settings) {
        for key in keys {
            if let Some(v) = settings.0.get(key.name) {
                self.line(key.name, &written(key.kind, v));
            }
        }
    }
}

/// A value of a kind as TOML.
pub fn written(kind: Kind, given: &Value) -> String {
    match given {
        // Whole numbers below 2^53 have no other digits.
        Value::Number(x) if kind.is_whole() => format!("{x:.0}"),
        other => value(other),
    }
}

/// A value as TOML.
pub(super) fn value(value: &Value) -> String {
    match value {
        Value::Number(x) => number(*x),
        Value::Vector(v) => vector(*v),
        Value::Text(t) => quoted(t),
        Value::Flag(f) => f.to_string(),
        Value::Pairs(rows) => pairs(&PairTable::from(rows.as_slice())),
    }
}

/// Parameters of pairs of species as TOML.
pub(super) fn pairs(table: &PairTable) -> String {
    let shown = |scalar: &Scalar| match scalar {
        Scalar::Float(x) => number(*x),
        Scalar::Uint(n) => n.to_string(),
        Scalar::Vector(v) => vector(*v),
        Scalar::Uints(v) => format!("{v:?}"),
        Scalar::Vector4(v) => format!("{v:?}"),
    };
    let row = |row: &PairRow| {
        let values = row.values.iter().map(|(name, value)| format!(", {} = {}", bare(name), shown(value)));
        format!("{{ species = {:?}{} }}", row.species, values.collect::<String>())
    };
    format!("[{}]", table.rows.iter().map(row).collect::<Vec<_>>().join(", "))
}

/// A float with the digits that read back to the same bits.
pub(super) fn number(x: f64) -> String {
    format!("{x:?}")
}

/// Three floats.
pub(super) fn vector(v: DVec3) -> String {
    format!("[{:?}, {:?}, {:?}]", v.x, v.y, v.z)
}

/// A key, in quotes where necessary.
pub(super) fn bare(key: &str) -> String {
    let plain = !key.is_empty() && key.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
    if plain { key.to_owned() } else { quoted(key) }
}

/// A text in quotes.
pub(super) fn quoted(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            c if c.is_control() => {
                // Writing to a String cannot fail.
                let _ = write!(out, "\\U{:08x}", u32::from(c));
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

/// The same scene with these files named by paths relative to a folder.
pub(super) fn nearby(text: &str, files: &[PathBuf], folder: &Path) -> String {
    let Ok(folder) = std::fs::canonicalize(folder) else { return text.to_owned() };
    let named = |file: &PathBuf| {
        let (from, to) = (file.to_str()?, way(&folder, file)?);
        Some((format!(" = {}", quoted(from)), format!(" = {}", quoted(&to))))
    };
    let names: Vec<_> = files.iter().filter_map(named).collect();
    let mut out = String::with_capacity(text.len());
    for line in text.lines() {
        match names.iter().find_map(|(from, to)| Some((line.strip_suffix(from)?, to))) {
            Some((key, to)) => out.extend([key, to, "\n"]),
            None => out.extend([line, "\n"]),
        }
    }
    out
}

/// The same scene with each file in a numbered folder beside it; with these names, and the paths of the files.
pub(super) fn packed(text: &str, files: &[PathBuf]) -> (String, Vec<(String, PathBuf)>) {
    let (mut text, mut named) = (text.to_owned(), Vec::new());
    for file in files {
        let Some(from) = file.to_str().map(quoted).filter(|from| text.contains(from)) else { continue };
        let Some(end) = file.file_name().and_then(|end| end.to_str()) else { continue };
        // Each file keeps its own name: messages and laws refer to it.
        let name = format!("{}/{}", named.len(), plain(end));
        text = text.replace(&from, &quoted(&name));
        named.push((name, file.clone()));
    }
    (text, named)
}

/// The name of a file with `_` for characters that are path separators on other systems.
pub(crate) fn plain(name: &str) -> String {
    name.chars().map(|c| if matches!(c, '/' | '\\' | ':') || c.is_control() { '_' } else { c }).collect()
}

/// The relative path from a folder to a file, with slashes; `None` between two drives.
fn way(folder: &Path, file: &Path) -> Option<String> {
    let (from, to): (Vec<_>, Vec<_>) = (folder.components().collect(), file.components().collect());
    let shared = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    if shared == 0 {
        return None;
    }
    let up = from[shared..].iter().map(|_| Some(".."));
    let down = to[shared..].iter().map(|part| match part {
        Component::Normal(name) => name.to_str(),
        _ => None,
    });
    Some(up.chain(down).collect::<Option<Vec<_>>>()?.join("/"))
}
