//! `motes convert`

use motes::Error;
use motes::formats::{self, Precision};
use serde_json::json;

use super::args::{ConvertArgs, Width};
use super::failure::Failure;

/// Writes the particles of a file in another format.
pub fn convert(args: &ConvertArgs) -> Result<(), Failure> {
    let refuse = |message: &str| Error::Output { file: args.to.clone(), message: message.to_owned() };
    let real = |path: &std::path::Path| std::fs::canonicalize(path).ok();
    // `formats::convert` refuses a file that would replace itself.
    if args.to.exists() && !args.overwrite && real(&args.from) != real(&args.to) {
        return Err(refuse("the file exists: choose another name, or use --overwrite").into());
    }
    let precision = match args.precision {
        Width::Auto => None,
        Width::Single => Some(Precision::Single),
        Width::Double => Some(Precision::Double),
    };
    let done = formats::convert(&args.from, &args.to, precision)?;
    let digits = if done.precision == Precision::Single { "single" } else { "double" };
    if args.json {
        out!(
            "{:#}",
            json!({ "particles": done.count, "from": args.from, "from_format": done.from.name, "to": args.to,
                "to_format": done.to.name, "precision": digits, "lost": done.lost })
        );
        return Ok(());
    }
    out!(
        "{} particles from {} ({}) to {} ({}, {digits} precision)",
        done.count,
        args.from.display(),
        done.from.name,
        args.to.display(),
        done.to.name
    );
    if !done.lost.is_empty() {
        note!("note: {} does not hold {}", args.to.display(), done.lost.join(", "));
    }
    Ok(())
}
