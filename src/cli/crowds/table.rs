//! A report as JSON.

use motes::evacuation::Bottleneck;
use serde_json::{Value, json};

use super::Evacuation;

/// Nine digits: those of the device are fewer.
fn number(x: f64) -> Value {
    format!("{x:.8e}").parse::<f64>().map_or(Value::Null, |x| json!(x))
}

fn some(x: Option<f64>) -> Value {
    x.map_or(Value::Null, number)
}

/// All numbers of a report.
pub fn value(done: &Evacuation<'_>) -> Value {
    let report = &done.report;
    let exits: Vec<Value> = report
        .exits
        .iter()
        .map(|exit| {
            json!({ "name": exit.name, "width": number(exit.width), "count": exit.times.len(),
                "share": number(exit.times.len() as f64 / report.pedestrians.len() as f64),
                "first": some(exit.times.first().copied()), "last": some(exit.times.last().copied()), "flow": some(exit.flow()),
                "times": exit.times.iter().copied().map(number).collect::<Vec<_>>() })
        })
        .collect();
    let pedestrians: Vec<Value> = report
        .pedestrians
        .iter()
        .map(|one| {
            json!({ "exit": one.exit, "time": number(one.time), "desired": number(one.desired), "delay": number(one.delay()) })
        })
        .collect();
    let map = &report.map;
    let cells = |values: &[f64]| values.iter().copied().map(number).collect::<Vec<_>>();
    json!({
        "plan": done.name, "people": done.args.people, "model": done.args.model.name(), "seed": done.args.seed, "speed": done.args.speed, "dt": done.dt,
        "remarks": done.remarks, "sample": done.sample, "device": done.device, "steps": done.driven.steps, "stopped": done.driven.stopped, "stuck": done.driven.stuck,
        "inside": report.inside(), "wall_corrections": done.driven.corrections,
        "evacuation": { "last": some(report.time_of(1.0)), "most": some(report.time_of(0.95)), "median": some(report.time_of(0.5)) },
        "person_seconds": { "spent": number(report.spent()), "lost": number(report.delay()), "on_the_map": number(map.total()),
            "elsewhere": number(report.elsewhere) },
        "bottlenecks": report.bottlenecks.iter().map(bottleneck).collect::<Vec<_>>(),
        "small": report.small.iter().map(bottleneck).collect::<Vec<_>>(),
        "exits": exits, "pedestrians": pedestrians,
        "map": { "low": map.low.to_array(), "side": number(map.side), "count": map.count, "lost": cells(&map.lost),
            "spent": cells(&map.spent), "density": cells(&map.density) },
    })
}

fn bottleneck(one: &Bottleneck) -> Value {
    let [a, b] = one.passage.ends.map(|end| end.to_array().map(number));
    json!({ "position": one.place().to_array().map(number), "ends": [a, b], "width": number(one.passage.width()), "lost": number(one.lost),
        "held_up": one.held_up, "most": number(one.most), "passed": one.passed.len(), "flow": some(one.flow()),
        "flow_per_metre": some(one.flow().map(|flow| flow / one.passage.width())) })
}
