//! The measurements as JSON; their file is written anew after each measurement.

use std::io::Write as _;
use std::path::PathBuf;

use motes::formats::atomically;
use motes::gpu::Found;
use serde_json::{Value, json};

use super::super::args::BenchArgs;
use super::super::failure::Failure;

pub struct Results {
    value: Value,
    file: Option<PathBuf>,
}

impl Results {
    pub fn new(args: &BenchArgs, found: &Found) -> Self {
        let info = found.adapter.get_info();
        let value = json!({ "device": found.describe(), "driver": format!("{} {}", info.driver, info.driver_info),
            "version": env!("CARGO_PKG_VERSION"), "commit": std::env::var("MOTES_COMMIT").ok(), "repeat": args.repeat,
            "topics": [] });
        Self { value, file: args.output.clone() }
    }
    /// Adds a measurement.
    pub fn add(&mut self, row: Value) -> Result<(), Failure> {
        if let Some(rows) = self.value["topics"].as_array_mut() {
            rows.push(row);
        }
        if let Some(path) = &self.file {
            atomically(path, |file| writeln!(file, "{:#}", self.value))?;
        }
        Ok(())
    }
    pub fn text(&self) -> String {
        format!("{:#}", self.value)
    }
}
