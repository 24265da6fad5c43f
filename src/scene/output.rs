//! `[output]`: how often the run is written down, and in which formats.

use crate::formats::{FORMATS, Format};
use crate::kernel::Columns;
use crate::settings::{Key, Kind};

use super::report::{Fault, Report};
use super::resolved::Writer;
use super::tree::Data;
use super::value;
use super::walk::{self, Table};

pub(super) const KEYS: &[Key] = &[];
pub(super) const OWN: &[&str] = &["every", "formats", "columns", "frames"];

/// What a run writes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Output {
    /// A snapshot is written each time that this many steps are done; at least one.
    pub every: u64,
    /// In which formats, each once; none at all leaves only the table of energies, and pictures.
    pub formats: Vec<&'static Format>,
    /// Whether a picture is drawn with each.
    pub pictures: bool,
    /// How many pictures of a film, evenly spaced over the run; zero for none, and one more than the steps at most.
    pub frames: u64,
    /// Columns that snapshots have beside those of the state: what laws compute.
    pub columns: Vec<String>,
}

/// The scene's word for pictures, which stand among the formats.
const PICTURES: &str = "png";

/// The words that `formats` takes: formats that states can be written in, and pictures.
#[must_use]
fn words() -> Vec<&'static str> {
    let mut words: Vec<_> = writable().map(|format| format.name).collect();
    words.push(PICTURES);
    words
}

fn writable() -> impl Iterator<Item = &'static Format> {
    FORMATS.iter().filter(|format| format.write.is_some())
}

pub(super) fn read(table: Option<&Table<'_>>, steps: u64, known: &Columns, report: &mut Report) -> Output {
    let mut output = Output {
        every: (steps / 10).max(1),
        formats: FORMATS.iter().filter(|format| format.name == "csv").collect(),
        pictures: true,
        frames: 0,
        columns: Vec::new(),
    };
    let Some(table) = table else { return output };
    table.settings(KEYS, OWN, report);
    if let Some(every) = table.get("every").and_then(|e| walk::whole_from_one(e, report)) {
        output.every = every;
    }
    if let Some(entry) = table.get("formats") {
        let names = words();
        if let Data::List(list) = &entry.node.data {
            let words: Vec<_> =
                list.iter().filter_map(|node| value::choice(node, "formats", "format", &names, report)).collect();
            output.formats = writable().filter(|format| words.contains(&format.name)).collect();
            output.pictures = words.contains(&PICTURES);
        } else {
            value::refuse::<()>(&entry.node, "formats", "a list, as in [\"csv\", \"png\"]", report);
        }
    }
    if let Some(entry) = table.get("frames") {
        let frames = value::number(&entry.node, "frames", Kind::Whole, &Kind::Whole.wanted(), report);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole, and from 0 to 2^53")]
        let frames = frames.map_or(0, |x| x as u64);
        if frames > steps + 1 {
            let fault = format!("{frames} `frames` are more than the states of {steps} steps, the first one included");
            report.push(Fault::at(&entry.node.place, fault).label(format!("at most {}, or more steps", steps + 1)));
        }
        output.frames = frames;
    }
    if let Some(entry) = table.get("columns") {
        let names: Vec<&str> = known.iter().map(|column| column.name.as_ref()).collect();
        if let Data::List(list) = &entry.node.data {
            let chosen = list.iter().filter_map(|node| value::choice(node, "columns", "column", &names, report));
            output.columns = chosen.map(str::to_owned).collect();
        } else {
            value::refuse::<()>(&entry.node, "columns", "a list, as in [\"acceleration\"]", report);
        }
    }
    output
}

impl Output {
    pub(super) fn write(&self, out: &mut Writer) {
        out.header("[output]");
        out.line("every", &self.every.to_string());
        let formats = self.formats.iter().map(|format| format.name);
        let names: Vec<_> =
            formats.chain(self.pictures.then_some(PICTURES)).map(|name| format!("\"{name}\"")).collect();
        out.line("formats", &format!("[{}]", names.join(", ")));
        out.line("frames", &self.frames.to_string());
        let columns: Vec<_> = self.columns.iter().map(|name| format!("\"{name}\"")).collect();
        out.line("columns", &format!("[{}]", columns.join(", ")));
    }
}
