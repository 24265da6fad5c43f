//! The table of claims, as Markdown.

use std::fmt::Write as _;

use super::claim::Verdict;
use super::number;
use crate::cli::words::duration;

/// A page of the results on a device.
pub fn text(device: &str, verdicts: &[Verdict]) -> String {
    let mut text = format!(
        "# Claims\n\nBy `motes validate` on {device}.\n\n| claim | set-up | measured quantity | published | measured | control | limit | time | source |\n\
         |---|---|---|---|---|---|---|---|---|\n"
    );
    for verdict in verdicts {
        let claim = verdict.claim;
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "| `{}` | {} | {} | {} | {}, {} | {} | {}: {} | {} | {} |",
            claim.name,
            claim.about,
            claim.quantity.replace('|', "\\|"),
            number(claim.published),
            number(verdict.measured),
            verdict.word(),
            verdict.control.map_or_else(|| "—".to_owned(), number),
            claim.tolerance,
            claim.because,
            duration(verdict.time),
            claim.source
        );
    }
    text
}
