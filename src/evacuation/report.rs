//! The results of a run: times to leave, exits, and bottlenecks.

use super::bottleneck::{self, Bottleneck};
use super::map::{self, Map};
use super::record::Record;
use super::ways::Ways;
use crate::floor_plan::FloorPlan;

/// Passages are named as bottlenecks where the time lost before them is this part of the time spent by all, or more.
pub const SHARE: f64 = 0.02;

/// A pedestrian of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pedestrian {
    /// The exit that it left by; none while it is inside.
    pub exit: Option<usize>,
    /// The time at which it left, or that of the last sample \[time\].
    pub time: f64,
    /// The time that it would need alone for the way that it made: distance / desired speed \[time\].
    pub desired: f64,
}

impl Pedestrian {
    /// The time that it lost \[time\].
    #[must_use]
    pub fn delay(&self) -> f64 {
        self.time - self.desired
    }
}

/// The pedestrians that left by an exit.
#[derive(Debug, Clone, PartialEq)]
pub struct Left {
    /// The name of the exit.
    pub name: String,
    /// The length of its line \[length\].
    pub width: f64,
    /// The times at which they left, in order \[time\].
    pub times: Vec<f64>,
}

impl Left {
    /// The flow while the middle eight tenths leave \[1 / time\]; none for fewer than ten.
    #[must_use]
    pub fn flow(&self) -> Option<f64> {
        bottleneck::flow(&self.times)
    }
}

/// A report.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// Every pedestrian.
    pub pedestrians: Vec<Pedestrian>,
    /// Every exit.
    pub exits: Vec<Left>,
    /// Maps of time lost, time spent and density.
    pub map: Map,
    /// The bottlenecks, those with the largest loss first.
    pub bottlenecks: Vec<Bottleneck>,
    /// Passages where less is lost than [`SHARE`].
    pub small: Vec<Bottleneck>,
    /// The time lost where no jam is near \[time\].
    pub elsewhere: f64,
}

impl Report {
    /// The report of a run on a plan.
    #[must_use]
    pub fn of(plan: &FloorPlan, ways: &Ways, record: &Record) -> Self {
        let parts: Vec<_> = (0..record.tracks.len()).map(|i| map::parts(record, ways, i)).collect();
        let map = Map::of(ways, &parts);
        let (all, elsewhere) = bottleneck::find(plan, (ways, &map), record, &parts);
        let pedestrian = |i: usize| {
            let place = |x: Option<&glam::Vec2>| x.and_then(|x| ways.at(x.as_dvec2()));
            let (track, is_out) = (&record.tracks[i], record.left[i].is_some());
            let exit = track.last().filter(|_| is_out).and_then(|x| {
                let far = |n: &usize| plan.exits()[*n].distance(x.as_dvec2());
                (0..plan.exits().len()).min_by(|a, b| far(a).total_cmp(&far(b)))
            });
            let start = place(track.first()).unwrap_or(0.0);
            let end = if is_out { 0.0 } else { track.iter().rev().find_map(|x| place(Some(x))).unwrap_or(start) };
            let begun = record.times.first().copied().unwrap_or_default();
            Pedestrian { exit, time: record.until(i) - begun, desired: (start - end) / record.speeds[i] }
        };
        let pedestrians: Vec<Pedestrian> = (0..record.tracks.len()).map(pedestrian).collect();
        let exit = |(n, exit): (usize, &crate::floor_plan::Exit)| {
            let own = pedestrians.iter().filter(|one| one.exit == Some(n));
            let mut times: Vec<f64> = own.map(|one| one.time).collect();
            times.sort_by(f64::total_cmp);
            Left { name: exit.name.clone(), width: exit.width(), times }
        };
        let exits = plan.exits().iter().enumerate().map(exit).collect();
        let spent: f64 = pedestrians.iter().map(|one| one.time).sum();
        let (bottlenecks, small) = all.into_iter().partition(|one| one.lost >= SHARE * spent && one.held_up > 1);
        Self { pedestrians, exits, map, bottlenecks, small, elsewhere }
    }
    /// The time at which this part of all have left, such as 0.95; none where fewer did \[time\].
    #[must_use]
    pub fn time_of(&self, part: f64) -> Option<f64> {
        let mut times: Vec<f64> = self.exits.iter().flat_map(|exit| exit.times.iter().copied()).collect();
        times.sort_by(f64::total_cmp);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a number of pedestrians")]
        let count = (part * self.pedestrians.len() as f64 - 1e-9).ceil().max(1.0) as usize;
        times.get(count - 1).copied()
    }
    /// The time that all together spent inside \[time\].
    #[must_use]
    pub fn spent(&self) -> f64 {
        self.pedestrians.iter().map(|one| one.time).sum()
    }
    /// The time that all together lost \[time\].
    #[must_use]
    pub fn delay(&self) -> f64 {
        self.pedestrians.iter().map(Pedestrian::delay).sum()
    }
    /// The number that are still inside.
    #[must_use]
    pub fn inside(&self) -> usize {
        self.pedestrians.iter().filter(|one| one.exit.is_none()).count()
    }
}
