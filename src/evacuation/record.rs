//! What is recorded of a run: where all pedestrians are at some times, and when each has left.

use glam::{DVec2, Vec2};

/// Pedestrians that stay within this stand still \[length\].
const STILL: f32 = 0.1;

/// The tracks of a run.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Record {
    /// The desired speed of each pedestrian \[length / time\].
    pub speeds: Vec<f64>,
    /// The times of samples, from the start on \[time\].
    pub times: Vec<f64>,
    /// The places of each pedestrian: at each of the times while it was inside, and where it left \[length\].
    pub tracks: Vec<Vec<Vec2>>,
    /// The time at which each left, where it has \[time\].
    pub left: Vec<Option<f64>>,
}

/// A piece of a track.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// Its ends \[length\].
    pub ends: [DVec2; 2],
    /// The times there \[time\].
    pub times: [f64; 2],
    /// Whether its end is where the pedestrian left.
    pub leaves: bool,
}

impl Record {
    /// The record of pedestrians with these desired speeds, which are at these places at a time.
    #[must_use]
    pub fn begin(speeds: Vec<f64>, places: &[DVec2], time: f64) -> Self {
        let tracks = places.iter().map(|x| vec![x.as_vec2()]).collect();
        Self { left: vec![None; speeds.len()], speeds, times: vec![time], tracks }
    }
    /// Adds a sample: places, and the times at which pedestrians left or were seen last, which is before the present for those that have left.
    pub fn take(&mut self, time: f64, places: &[DVec2], inside: &[f64]) {
        // Times are sums in single precision on the device.
        let early = time - 1e-5 * time.abs().max(1.0);
        self.times.push(time);
        for (i, (place, until)) in places.iter().zip(inside).enumerate() {
            if self.left[i].is_none() {
                self.tracks[i].push(place.as_vec2());
                self.left[i] = (*until < early).then_some(*until);
            }
        }
    }
    /// The number that are still inside.
    #[must_use]
    pub fn inside(&self) -> usize {
        self.left.iter().filter(|left| left.is_none()).count()
    }
    /// Whether no pedestrian that is inside has moved by a tenth of a metre in the last while \[time\].
    #[must_use]
    pub fn stands_still(&self, time: f64) -> bool {
        let last = self.times.last().copied().unwrap_or_default();
        let first = self.times.partition_point(|at| *at < last - time);
        let inside = self.tracks.iter().zip(&self.left).filter(|(_, left)| left.is_none());
        let moves = |track: &Vec<Vec2>| track[first..].iter().any(|x| x.distance(track[first]) > STILL);
        first > 0 && !inside.map(|(track, _)| track).any(moves)
    }
    /// The pieces of a track.
    pub fn pieces(&self, i: usize) -> impl Iterator<Item = Piece> + '_ {
        let (track, left) = (&self.tracks[i], self.left[i]);
        track.windows(2).enumerate().map(move |(k, ends)| {
            let last = left.filter(|_| k + 2 == track.len());
            let times = [self.times[k], last.unwrap_or(self.times[k + 1])];
            Piece { ends: [ends[0].as_dvec2(), ends[1].as_dvec2()], times, leaves: last.is_some() }
        })
    }
    /// The last time of a pedestrian: that at which it left, or that of the last sample \[time\].
    #[must_use]
    pub fn until(&self, i: usize) -> f64 {
        self.left[i].unwrap_or_else(|| self.times.last().copied().unwrap_or_default())
    }
}
