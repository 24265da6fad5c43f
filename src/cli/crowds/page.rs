//! A report as Markdown, and as lines on the terminal.

use std::fmt::Write as _;

use motes::evacuation::{Bottleneck, HELD_UP, Model, SHARE};

use super::Evacuation;

fn some(x: Option<f64>, digits: usize) -> String {
    x.map_or_else(|| "—".to_owned(), |x| format!("{x:.digits$}"))
}

/// A sentence on a bottleneck.
fn words(one: &Bottleneck, number: usize, spent: f64) -> String {
    format!(
        "{number}. at {:.1} {:.1}, {:.2} m wide: {:.0} person-seconds lost ({:.0} % of all time inside), {} held up",
        one.place().x,
        one.place().y,
        one.passage.width(),
        one.lost,
        100.0 * one.lost / spent,
        one.held_up
    )
}

/// The main results, a line each.
pub fn summary(done: &Evacuation<'_>) -> Vec<String> {
    let report = &done.report;
    let mut lines = Vec::new();
    let count = report.pedestrians.len();
    if let Some(last) = report.time_of(1.0) {
        lines.push(format!(
            "all {count} have left after {last:.1} s (95 %: {} s, half: {} s)",
            some(report.time_of(0.95), 1),
            some(report.time_of(0.5), 1)
        ));
    } else {
        let why = match (done.driven.stopped, done.driven.stuck) {
            (true, _) => "it was stopped".to_owned(),
            (_, true) => format!("nothing has moved for {} s, so that they block each other", super::drive::STILL),
            _ => "the limit of time was reached".to_owned(),
        };
        lines.push(format!("{} of {count} are still inside: {why}; {}", report.inside(), inside(done)));
    }
    lines.push(format!("{:.0} of {:.0} person-seconds are lost", report.delay(), report.spent()));
    if report.bottlenecks.is_empty() {
        lines.push(format!("no bottleneck: nowhere is {:.0} % of all time lost", 100.0 * SHARE));
    }
    lines.extend(
        report.bottlenecks.iter().zip(1..).map(|(one, n)| format!("bottleneck {}", words(one, n, report.spent()))),
    );
    lines
}

/// Where those are that have not left.
fn inside(done: &Evacuation<'_>) -> String {
    let all = done.report.pedestrians.iter().zip(&done.driven.record.tracks);
    let places = all.filter(|(one, _)| one.exit.is_none()).filter_map(|(_, track)| track.last());
    let mut places: Vec<String> = places.map(|x| format!("{:.1} {:.1}", x.x, x.y)).collect();
    let more = places.len().saturating_sub(8);
    places.truncate(8);
    let more = if more > 0 { format!(", and {more} more") } else { String::new() };
    format!("they are at {}{more}", places.join(", "))
}

/// Whether time is lost, or gained by those that are pushed ahead.
fn gained(lost: f64) -> &'static str {
    if lost < 0.0 { "are gained" } else { "are lost" }
}

/// The page.
pub fn text(done: &Evacuation<'_>) -> String {
    let report = &done.report;
    let (spent, lost, count) = (report.spent(), report.delay(), report.pedestrians.len());
    let mut page = format!("# {}: {count} pedestrians\n\n", done.name);
    for line in summary(done) {
        let _ = writeln!(page, "- {line}");
    }
    for remark in &done.remarks {
        let _ = writeln!(page, "- Note: {remark}");
    }
    page.push_str("\n## Bottlenecks\n\n![where time is lost](delay.svg)\n\n");
    if report.bottlenecks.is_empty() {
        let _ = writeln!(
            page,
            "None: there is no passage before which {:.0} % of the time inside is lost.\n",
            100.0 * SHARE
        );
    } else {
        page.push_str("| | position [m] | clear width [m] | person-seconds lost | of all lost | held up | most lost by one [s] | passed | flow [1/s] | flow per metre [1/(m s)] |\n|---|---|---|---|---|---|---|---|---|---|\n");
    }
    for (one, n) in report.bottlenecks.iter().zip(1..) {
        let (at, width) = (one.place(), one.passage.width());
        let _ = writeln!(
            page,
            "| {n} | {:.2} {:.2} | {width:.2} | {:.0} | {:.0} % | {} | {:.1} | {} | {} | {} |",
            at.x,
            at.y,
            one.lost,
            100.0 * one.lost / lost,
            one.held_up,
            one.most,
            one.passed.len(),
            some(one.flow(), 2),
            some(one.flow().map(|flow| flow / width), 2)
        );
    }
    let small: f64 = report.small.iter().map(|one| one.lost).sum();
    let smaller = match report.small.len() {
        0 => String::new(),
        n => format!("{:.0} {} before {n} smaller passages, and ", small.abs(), gained(small)),
    };
    let _ = writeln!(
        page,
        "\nOf these {lost:.0} person-seconds {smaller}{:.0} {} where no jam is near: while pedestrians start, turn and avoid each other, or are pushed ahead.",
        report.elsewhere.abs(),
        gained(report.elsewhere)
    );
    page.push_str("\n## Exits\n\n![how many have left](left.svg)\n\n| exit | line [m] | left | share | first [s] | last [s] | flow [1/s] |\n|---|---|---|---|---|---|---|\n");
    for exit in &report.exits {
        let _ = writeln!(
            page,
            "| {} | {:.2} | {} | {:.0} % | {} | {} | {} |",
            exit.name.replace('|', "\\|"),
            exit.width,
            exit.times.len(),
            100.0 * exit.times.len() as f64 / count as f64,
            some(exit.times.first().copied(), 1),
            some(exit.times.last().copied(), 1),
            some(exit.flow(), 2)
        );
    }
    let mean = |x: f64| x / count as f64;
    let most = report.pedestrians.iter().map(motes::evacuation::Pedestrian::delay).fold(0.0, f64::max);
    let _ = write!(
        page,
        "\n## Time of a pedestrian\n\n| | mean [s] | all together [s] |\n|---|---|---|\n| inside | {:.1} | {spent:.0} |\n| alone, at the desired speed | {:.1} | {:.0} |\n\
         | lost | {:.1} | {lost:.0} |\n\nThe largest loss of one is {most:.1} s.\n\n![density](density.svg)\n\n![ways](tracks.svg)\n",
        mean(spent),
        mean(spent - lost),
        spent - lost,
        mean(lost)
    );
    let args = done.args;
    let fluctuating = match args.model {
        Model::SocialForce => ", with fluctuations of velocities of 0.2 m/s (`wander`)",
        Model::CollisionFreeSpeed => "",
    };
    let _ = write!(
        page,
        "\n## How it was measured\n\nPedestrians follow {} to the nearest exit round walls, with desired speeds of {} m/s in the mean \
         (normal, deviation 0.19 of that) and radii of {} to {} m{}, from places at random (seed {}), in steps of {} s on {}. {} times a pedestrian was put back in front of a wall.\n\n\
         Places are sampled every {} s. Between two samples a pedestrian with the desired speed v₀ loses Δt − ΔT / v₀, with ΔT the distance to the exit that it gained. The map adds this up \
         in squares of {:.2} m, half way between the samples; it may be negative where a pedestrian is pushed ahead. The sum over the map, {:.1} s, is that of all pedestrians, {lost:.1} s, of time inside \
         less distance / desired speed.\n\n\
         A square is jammed where more than half of the time in it and in those around it is lost. From each place of a jam the way is followed to the jam's end; the narrowest clear width between walls from 1.5 m before it to 1 m \
         behind it is the bottleneck, if the way before it is wider by half somewhere in the jam, and the time lost from there back through the jam is counted for it. Named are those before which {:.0} % of all time inside is lost, or more. Held up: {HELD_UP} s lost there, \
         or more. Flows are those of the middle eight tenths that pass. `trajectories.csv` has the samples, `report.json` all numbers; `motes run scene.toml` makes the same run.\n",
        args.model.about(),
        args.speed,
        args.model.radii()[0],
        args.model.radii()[1],
        fluctuating,
        args.seed,
        done.dt,
        done.device,
        done.driven.corrections,
        done.sample,
        report.map.side,
        report.map.total(),
        100.0 * SHARE
    );
    page
}
