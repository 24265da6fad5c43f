//! The report on the neighbour list of a run.

use motes::simulation::ListReport;
use serde_json::json;

use super::progress::Progress;

/// Reports the skin of the list, and how often it was built.
pub fn tell(progress: &Progress, list: Option<ListReport>) {
    let Some(ListReport { range, skin, chosen, every }) = list.filter(|list| list.every > 0.0) else { return };
    progress.event(
        "neighbor_list",
        json!({ "range": range, "skin": skin, "chosen": chosen, "steps_between_builds": every }),
    );
    let (range, skin, by) = (shown(range), shown(skin), if chosen { ", chosen while it ran" } else { "" });
    progress.conclude(&format!("neighbour list: range {range}, skin {skin}{by}; built once in {every:.1} steps"));
}

/// Three digits.
fn shown(x: f64) -> f64 {
    format!("{x:.2e}").parse().unwrap_or(x)
}
