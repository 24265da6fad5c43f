//! Bottlenecks: the passages at which jams end.
//!
//! A square is jammed where more than half of the time in it is lost. From each place of a jam the way to the exit is followed to where the jam ends;
//! the narrowest cross-section close to that end is the passage that holds the jam. So a queue that reaches back through an earlier door counts for the
//! door at its front.

use std::collections::BTreeMap;

use glam::DVec2;

use super::map::{Map, Part};
use super::passage::Passage;
use super::record::Record;
use super::ways::Ways;
use crate::floor_plan::FloorPlan;

/// A square is jammed where this part of the time in it and in the eight around it is lost.
const JAMMED: f64 = 0.5;
/// And where at least this much was spent there \[time\].
const LEAST_SPENT: f64 = 5.0;
/// A jam goes on across gaps of this length on the way \[length\].
const GAP: f64 = 1.5;
/// Places up to this far before a jam count for it \[length\].
const APPROACH: f64 = 1.0;
/// The passage is looked for this far before the end of a jam, and behind it \[length\].
const AROUND: [f64; 2] = [1.5, 1.0];
/// Passages nearer to each other than this, or than half of their width, are one \[length\].
const APART: f64 = 0.75;
/// A passage holds pedestrians up where the way before it is wider by this factor, somewhere in the jam.
const NARROWER: f64 = 1.5;
/// A pedestrian is held up where it loses this much \[time\].
pub const HELD_UP: f64 = 1.0;

/// A passage that holds pedestrians up.
#[derive(Debug, Clone, PartialEq)]
pub struct Bottleneck {
    /// Its cross-section.
    pub passage: Passage,
    /// The time lost before it by all together \[time\].
    pub lost: f64,
    /// The number that lost a second or more there.
    pub held_up: usize,
    /// The most that one of them lost \[time\].
    pub most: f64,
    /// The times at which pedestrians passed it, in order \[time\].
    pub passed: Vec<f64>,
}

impl Bottleneck {
    /// Its middle \[length\].
    #[must_use]
    pub fn place(&self) -> DVec2 {
        self.passage.middle()
    }
    /// The flow through it while the middle eight tenths pass \[1 / time\]; none for fewer than ten.
    #[must_use]
    pub fn flow(&self) -> Option<f64> {
        flow(&self.passed)
    }
}

/// The rate of events at these times, between the tenth and the last tenth of them; none for fewer than ten.
pub fn flow(times: &[f64]) -> Option<f64> {
    let skip = times.len() / 10;
    let (first, last) = (times.get(skip)?, times.get(times.len() - 1 - skip)?);
    let count = times.len() - 1 - 2 * skip;
    (skip > 0 && last > first).then(|| count as f64 / (last - first))
}

/// Where the jam ends that a cell is in, or the first one on its way.
#[derive(Debug, Clone, Copy)]
struct Ahead {
    /// The way to the first jammed cell \[length\].
    away: f64,
    /// The last cell of that jam.
    end: usize,
}

/// All bottlenecks of a run, those with the largest loss first; and the time that was lost elsewhere \[time\].
pub fn find(
    plan: &FloorPlan,
    (ways, map): (&Ways, &Map),
    record: &Record,
    all: &[Vec<Part>],
) -> (Vec<Bottleneck>, f64) {
    let ahead = ahead(ways, map);
    let mut passages = BTreeMap::new();
    let mut lost = vec![0.0; ways.cells.open.len()];
    let parts = || all.iter().flatten();
    parts().filter_map(|part| Some((ways.cell(part.place)?, part))).for_each(|(k, part)| lost[k] += part.lost);
    // The passage of each cell that has a share in a jam.
    let mut found: Vec<(usize, Way)> = Vec::new();
    for k in (0..lost.len()).filter(|k| lost[*k] != 0.0) {
        let Some(jam) = ahead[k].filter(|jam| jam.away <= APPROACH) else { continue };
        found.extend(narrowest(plan, ways, k, jam.end, &mut passages).map(|way| (k, way)));
    }
    let mut order: Vec<usize> = (0..found.len()).collect();
    order.sort_by(|a, b| lost[found[*b].0].total_cmp(&lost[found[*a].0]).then(a.cmp(b)));
    let mut clusters: Vec<(DVec2, Way)> = Vec::new();
    let mut member = vec![None; lost.len()];
    for at in order {
        let (k, Way { passage, widest }) = found[at];
        let near = |(middle, other): &(DVec2, Way)| {
            middle.distance(passage.middle()) <= APART.max(0.5 * other.passage.width().min(passage.width()))
        };
        if let Some(place) = clusters.iter().position(near) {
            let known = &mut clusters[place].1;
            known.widest = known.widest.max(widest);
            if passage.width() < known.passage.width() - 1e-9 {
                known.passage = passage;
            }
            member[k] = Some(place);
        } else {
            member[k] = Some(clusters.len());
            clusters.push((passage.middle(), Way { passage, widest }));
        }
    }
    let mut own = vec![vec![0.0; all.len()]; clusters.len()];
    let mut elsewhere = 0.0;
    for (i, part) in all.iter().enumerate().flat_map(|(i, parts)| parts.iter().map(move |part| (i, part))) {
        let holds = |cluster: &usize| clusters[*cluster].1.widest >= NARROWER * clusters[*cluster].1.passage.width();
        match ways.cell(part.place).and_then(|k| member[k]).filter(holds) {
            Some(cluster) => own[cluster][i] += part.lost,
            None => elsewhere += part.lost,
        }
    }
    let bottleneck = |((_, Way { passage, .. }), own): ((DVec2, Way), Vec<f64>)| Bottleneck {
        passage,
        lost: own.iter().sum(),
        held_up: own.iter().filter(|lost| **lost >= HELD_UP).count(),
        most: own.iter().copied().fold(0.0, f64::max),
        passed: passed(record, &passage),
    };
    let mut all: Vec<Bottleneck> =
        clusters.into_iter().zip(own).map(bottleneck).filter(|one| one.lost != 0.0).collect();
    all.sort_by(|a, b| b.lost.total_cmp(&a.lost));
    (all, elsewhere)
}

/// For each cell the jam that it is in, or the first one on its way: from exits backwards.
fn ahead(ways: &Ways, map: &Map) -> Vec<Option<Ahead>> {
    let count = ways.cells.open.len();
    let mut order: Vec<(f64, usize)> = (0..count).filter_map(|k| Some((ways.of(k)?, k))).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut ahead: Vec<Option<Ahead>> = vec![None; count];
    for (_, k) in order {
        let square = map.square(ways.centre(k));
        let [lost, spent] = map.around(square);
        let is_jammed = spent >= LEAST_SPENT && lost >= JAMMED * spent;
        let next = ways.down(k);
        let after = next.and_then(|next| {
            let jam = ahead[next]?;
            Some(Ahead { away: jam.away + ways.centre(k).distance(ways.centre(next)), end: jam.end })
        });
        ahead[k] = match (is_jammed, after) {
            (true, Some(jam)) if jam.away <= GAP => Some(Ahead { away: 0.0, end: jam.end }),
            (true, _) => Some(Ahead { away: 0.0, end: k }),
            (false, after) => after,
        };
    }
    ahead
}

/// The narrowest passage on a way, and the largest clear width before it \[length\].
#[derive(Debug, Clone, Copy)]
struct Way {
    passage: Passage,
    widest: f64,
}

/// The narrowest cross-section on the way of a cell, close to where a jam ends.
fn narrowest(
    plan: &FloorPlan,
    ways: &Ways,
    from: usize,
    end: usize,
    known: &mut BTreeMap<usize, Known>,
) -> Option<Way> {
    let last = ways.of(end)?;
    let (mut k, mut best, mut widest): (usize, Option<Passage>, f64) = (from, None, 0.0);
    let mut steps: Vec<[DVec2; 2]> = Vec::new();
    let mut slanting: Vec<Passage> = Vec::new();
    // The first of several that are as narrow, to a hundredth.
    let narrower = |best: Option<Passage>, one: Passage| match best {
        Some(best) if one.width() >= 0.99 * best.width() => Some(best),
        _ => Some(one),
    };
    loop {
        let behind = last - ways.of(k)?;
        if behind > AROUND[1] {
            break;
        }
        let here = known.entry(k).or_insert_with(|| Known::new(plan, ways.centre(k), ways.heading(k)));
        if behind <= 0.0 {
            widest = widest.max(here.across.map_or(0.0, |one| one.width()));
        }
        if behind >= -AROUND[0] {
            best = here.across.map_or(best, |one| narrower(best, one));
            slanting.extend(here.slanting.iter().flatten());
        }
        let Some(next) = ways.down(k) else { break };
        steps.push([ways.centre(k), ways.centre(next)]);
        k = next;
    }
    let is_crossed = |one: &Passage| steps.iter().any(|step| one.crossed(*step).is_some());
    best = slanting.into_iter().filter(is_crossed).fold(best, narrower);
    best.map(|passage| Way { passage, widest })
}

/// The passages at a cell.
struct Known {
    /// The one across the direction of motion.
    across: Option<Passage>,
    /// Those for directions turned by 45° and 90°: a way that turns in a door crosses it at a slant. They count where the way crosses them.
    slanting: [Option<Passage>; 3],
}

impl Known {
    fn new(plan: &FloorPlan, x: DVec2, heading: DVec2) -> Self {
        let turned = [(1.0, 1.0), (1.0, -1.0), (0.0, 1.0)].map(|(x, y)| DVec2::new(x, y).normalize().rotate(heading));
        Self {
            across: Passage::through(plan, x, heading),
            slanting: turned.map(|heading| Passage::through(plan, x, heading)),
        }
    }
}

/// The times at which pedestrians cross a passage for the first time, in order.
fn passed(record: &Record, passage: &Passage) -> Vec<f64> {
    let first = |i: usize| {
        let across = |piece: super::record::Piece| {
            let part = passage.crossed(piece.ends)?;
            Some(piece.times[0] + part * (piece.times[1] - piece.times[0]))
        };
        record.pieces(i).find_map(across)
    };
    let mut times: Vec<f64> = (0..record.tracks.len()).filter_map(first).collect();
    times.sort_by(f64::total_cmp);
    times
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flows_leave_out_the_first_and_the_last_tenth() {
        let mut times: Vec<f64> = (0..20).map(|n| 10.0 + 0.5 * f64::from(n)).collect();
        (times[0], times[19]) = (0.0, 90.0);
        assert!((flow(&times).expect("a flow") - 2.0).abs() < 1e-12);
        assert_eq!(flow(&times[..9]), None);
        assert_eq!(flow(&[1.0; 20]), None);
    }
}
