//! `[output]`: intervals and formats of written states.

use crate::formats::{FORMATS, Format};
use crate::kernel::Columns;
use crate::settings::{Key, Kind, LARGEST_WHOLE, Value};

use super::checkpoint::Every;
use super::report::{Fault, Report};
use super::resolved::Writer;
use super::tree::{Data, Entry};
use super::value;
use super::walk::{self, Table};

/// The maximum number of files of a set.
const MOST: f64 = 4096.0;

/// The keys of the section, beside those that it reads by itself.
pub(super) const KEYS: &[Key] = &[
    Key::new(
        "compress",
        Kind::Flag,
        Value::Flag(false),
        "whether states are compressed without loss, in formats that can be: npz, hdf5 and vtp",
    ),
    Key::new(
        "files",
        Kind::Count,
        Value::Number(1.0),
        "into how many files a state is divided, in formats that can be: hdf5",
    ),
];
pub(super) const OWN: &[&str] = &["every", "formats", "columns", "frames"];

/// The output of a run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Output {
    /// A snapshot is written each time that this many steps are done; at least one.
    pub every: u64,
    /// The formats, each once; without any, only the table of energies and pictures are written.
    pub formats: Vec<&'static Format>,
    /// Whether a picture is drawn with each.
    pub pictures: bool,
    /// The number of pictures of a film, evenly spaced over the run; zero for no film, and at most one more than the steps.
    pub frames: u64,
    /// Columns of snapshots in addition to those of the state: computed by laws.
    pub columns: Vec<String>,
    /// Whether states are compressed, in formats that support it.
    pub compress: bool,
    /// The number of files that a state is divided into, in formats that support it; at least one.
    pub files: u32,
}

const FORMS: &str = "a whole number of steps, or time of the scene as in \"0.5 time\"";

/// Steps between two outputs, given as a number or as a time; with wall-clock time the files would differ each time.
pub(super) fn interval(entry: &Entry, dt: f64, report: &mut Report) -> Option<u64> {
    let Data::Text(text) = &entry.node.data else { return walk::whole_from_one(entry, report) };
    let Some(Every::Time(time)) = Every::parse(text) else {
        let of_time = text.trim().split_once(' ').is_some_and(|(_, unit)| unit.trim() == "time");
        let hint = "; wall-clock time is only for [checkpoint], because the outputs would differ from run to run";
        let label = format!("it must be {FORMS}{}", if of_time { "" } else { hint });
        report.push(Fault::at(&entry.node.place, "`every` is not a valid interval of outputs").label(label));
        return None;
    };
    let (steps, whole) = (time / dt, (time / dt).round());
    // A quotient of two decimal numbers has a few rounding errors.
    if (1.0..=LARGEST_WHOLE).contains(&whole) && (steps - whole).abs() <= 1e-12 * whole {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole, from one to 2^53")]
        return Some(whole as u64);
    }
    let label = format!("{time:?} is {} steps of dt = {dt:?}: choose a multiple of dt", plain(steps));
    report.push(Fault::at(&entry.node.place, "`every` is not a whole number of steps").label(label));
    None
}

/// A number in a few digits.
fn plain(x: f64) -> String {
    format!("{}", format!("{x:.5e}").parse().unwrap_or(x))
}

/// The name of pictures in scenes, listed among the formats.
const PICTURES: &str = "png";

/// The values of `formats`: formats that states can be written in, and pictures.
#[must_use]
fn words() -> Vec<&'static str> {
    let mut words: Vec<_> = writable().map(|format| format.name).collect();
    words.push(PICTURES);
    words
}

fn writable() -> impl Iterator<Item = &'static Format> {
    FORMATS.iter().filter(|format| format.write.is_some())
}

pub(super) fn read(table: Option<&Table<'_>>, (steps, dt): (u64, f64), known: &Columns, report: &mut Report) -> Output {
    let mut output = Output {
        every: (steps / 10).max(1),
        formats: FORMATS.iter().filter(|format| format.name == "csv").collect(),
        pictures: true,
        frames: 0,
        columns: Vec::new(),
        compress: false,
        files: 1,
    };
    let Some(table) = table else { return output };
    let settings = table.settings(KEYS, OWN, report);
    if let Some(every) = table.get("every").and_then(|e| interval(e, dt, report)) {
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
    let files = settings.number("files");
    if files > MOST {
        let place = table.get("files").map_or(table.place, |entry| &entry.node.place);
        report.push(Fault::at(place, format!("{files} `files` are too many")).label(format!("at most {MOST}")));
    } else {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "whole, and at most a few thousand"
        )]
        (output.files = files as u32);
    }
    output.compress = settings.flag("compress");
    for (key, chosen, can) in [
        ("files", output.files > 1, (|format| format.divides) as fn(&Format) -> bool),
        ("compress", output.compress, |format| format.compresses),
    ] {
        if let (true, Some(entry)) = (chosen && !output.formats.iter().any(|format| can(format)), table.get(key)) {
            let names: Vec<_> = writable().filter(|format| can(format)).map(|format| format.name).collect();
            let fault = format!("`{key}` does nothing for these formats");
            report.push(Fault::at(&entry.node.place, fault).label(format!("it is for {}", names.join(", "))));
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
        out.line("compress", &self.compress.to_string());
        out.line("files", &self.files.to_string());
    }
}
