//! The files of a report.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use motes::Error;
use motes::evacuation::{Record, pictures};
use motes::formats::atomically;

use super::{Evacuation, page, table};

/// All files.
const FILES: [&str; 8] = [
    "report.md",
    "report.json",
    "scene.toml",
    "trajectories.csv",
    "delay.svg",
    "density.svg",
    "tracks.svg",
    "left.svg",
];

/// A folder for a report.
pub struct Folder(PathBuf);

impl Folder {
    /// Makes it. Earlier results in it are kept unless they may be replaced.
    pub fn open(path: &Path, overwrite: bool) -> Result<Self, Error> {
        let failed = |message: String| Error::Output { file: path.to_owned(), message };
        std::fs::create_dir_all(path).map_err(|why| failed(why.to_string()))?;
        match FILES.iter().find(|name| !overwrite && path.join(name).exists()) {
            Some(name) => Err(failed(format!(
                "it contains {name} of an earlier run: choose another folder with -o, or replace it with --overwrite"
            ))),
            None => Ok(Self(path.to_owned())),
        }
    }
    /// Writes everything; the report last.
    pub fn write(&self, done: &Evacuation<'_>, scene: &str) -> Result<(), Error> {
        let [report, values, toml, ways, delay, density, tracks, left] = FILES.map(|name| self.0.join(name));
        let written = |path: &Path, text: &str| atomically(path, |out| out.write_all(text.as_bytes()));
        written(&toml, scene)?;
        written(&ways, &trajectories(&done.driven.record))?;
        pictures::tracks(&tracks, &done.plan, &done.driven.record, &done.report)?;
        pictures::density(&density, &done.plan, &done.report)?;
        pictures::delay(&delay, &done.plan, &done.report)?;
        pictures::left(&left, &done.report)?;
        written(&values, &format!("{:#}\n", table::value(done)))?;
        written(&report, &page::text(done))
    }
}

/// A row for each sample of each pedestrian.
fn trajectories(record: &Record) -> String {
    let mut text = "pedestrian,time,x,y\n".to_owned();
    for (i, track) in record.tracks.iter().enumerate() {
        for (k, x) in track.iter().enumerate() {
            let last = record.left[i].filter(|_| k + 1 == track.len());
            let time = last.unwrap_or(record.times[k]);
            // Writing to a String cannot fail.
            let _ = writeln!(text, "{i},{time:.4},{:.4},{:.4}", x.x, x.y);
        }
    }
    text
}
