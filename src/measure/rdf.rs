//! The radial distribution function g(r).

use std::borrow::Cow;
use std::f64::consts::PI;

use glam::DVec3;
use rayon::prelude::*;

use super::{Measure, Moment, Row, Series, Times};
use crate::error::Error;
use crate::kernel::{Bounds, Side};
use crate::neighbors::Cells;
use crate::settings::{Key, Kind, Value};
use crate::state::State;

/// The number of axes of a box that is periodic along all of them; `what` begins the error where it is not.
pub(super) fn periodic_axes(bounds: &Bounds, what: &str) -> Result<usize, Error> {
    let axes = if bounds.dimensions == 2 { 2 } else { 3 };
    if (0..axes).all(|axis| bounds.sides[axis] == Side::Periodic) {
        return Ok(axes);
    }
    Err(Error::Scene(format!(
        "{what}, and this box is not periodic along all axes: set [box] boundary = \"periodic\", or leave it out"
    )))
}

/// `rdf.csv`.
pub const MEASURE: Measure = Measure {
    name: "rdf",
    about: "the radial distribution function g(r) of a periodic box (Allen & Tildesley 2017, 8.2): several rows for each output",
    keys: &[
        Key::required("range", Kind::Positive, "the largest distance, at most half a period of the box [length]"),
        Key::new("bins", Kind::Count, Value::Number(100.0), "how many intervals of r there are"),
        Key::new("species", ALL.0, ALL.1, "the species at the centre, or \"all\""),
        Key::new("others", ALL.0, ALL.1, "the species around it, or \"all\""),
    ],
    cells: &[
        ("r", "the middle of an interval [length]"),
        ("g", "the density of particles there, relative to their mean density in the box"),
        ("within", "the mean number of particles from 0 to the end of the interval"),
    ],
    times: Times::Chosen,
    usual: |_| Ok(None),
    begin: |setup, settings| {
        let bounds = setup.bounds;
        let axes = periodic_axes(&bounds, "the measure `rdf` compares with the mean density of a box")?;
        let (range, period) = (settings.number("range"), bounds.period());
        let half = 0.5 * (0..axes).map(|axis| period[axis]).fold(f64::INFINITY, f64::min);
        if range > half {
            let why = format!("`rdf` has range = {range}, more than half a period of the box, beyond which images repeat: set it to {half} at most");
            return Err(Error::Setting { key: "range", why });
        }
        let bins = usize::try_from(settings.whole("bins")).unwrap_or(usize::MAX);
        if bins > MOST {
            return Err(Error::Setting { key: "bins", why: format!("`rdf` has bins = {bins}: set {MOST} at most") });
        }
        for key in ["species", "others"] {
            let Some(species) = settings.species(key) else { continue };
            if !setup.state.species().contains(&species) {
                return Err(Error::Setting { key, why: format!("`rdf` has {key} = {species}, and no particle is of it: choose another, or \"all\"") });
            }
        }
        Ok(Box::new(Distances { bounds, range, bins, pair: [settings.species("species"), settings.species("others")] }))
    },
};

const ALL: (Kind, Value) = (Kind::Species, Value::Text(Cow::Borrowed("all")));
/// The maximum number of intervals: each is a row of every output.
const MOST: usize = 100_000;

/// Counts of distances.
#[derive(Debug)]
struct Distances {
    bounds: Bounds,
    range: f64,
    bins: usize,
    pair: [Option<u32>; 2],
}

impl Distances {
    /// The ordered pairs in each interval, all that there are at any distance, and the particles at their centres.
    fn count(&self, state: &State, bounds: Bounds) -> Result<(Vec<u64>, u64, u64), Error> {
        let active: Vec<usize> = (0..state.len()).filter(|i| state.is_active(*i)).collect();
        let places: Vec<DVec3> = active.iter().map(|i| state.position()[*i]).collect();
        let kind = |place: usize| state.species().get(active[place]).copied().unwrap_or(0);
        let is = |place: usize, of: Option<u32>| of.is_none_or(|species| kind(place) == species);
        let cells = Cells::new(&places, bounds, self.range)?;
        let [centre, around] = self.pair;
        let add = |mut bins: Vec<u64>, i: usize| {
            cells.around(i, |j| {
                let r = bounds.shortest(places[j] - places[i]).length();
                #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below the number of bins")]
                let bin = (r / self.range * self.bins as f64) as usize;
                if is(j, around) && bin < self.bins {
                    bins[bin] += 1;
                }
            });
            bins
        };
        let both = |a: Vec<u64>, b: Vec<u64>| a.iter().zip(&b).map(|(a, b)| a + b).collect();
        let zeros = || vec![0_u64; self.bins];
        let chosen = (0..places.len()).into_par_iter().filter(|i| is(*i, centre));
        let bins = chosen.fold(zeros, add).reduce(zeros, both);
        let number = |of: &dyn Fn(usize) -> bool| (0..places.len()).filter(|i| of(*i)).count() as u64;
        let [centres, others] = self.pair.map(|of| number(&|i| is(i, of)));
        // A particle is not its own neighbour.
        let pairs = centres * others - number(&|i| is(i, centre) && is(i, around));
        Ok((bins, pairs, centres))
    }
}

impl Series for Distances {
    fn take(&mut self, moment: &Moment<'_>) -> Result<Vec<Row>, Error> {
        let bounds = moment.bounds(&self.bounds);
        let (flat, period) = (bounds.dimensions == 2, bounds.period());
        let shortest = period.to_array().into_iter().filter(|side| *side > 0.0).fold(f64::INFINITY, f64::min);
        if 2.0 * self.range > shortest {
            return Err(Error::Scene(format!(
                "the measure `rdf` reaches as far as {}, and the box has shrunk to a side of {shortest}, less than twice that: choose a shorter range",
                self.range
            )));
        }
        let (bins, pairs, centres) = self.count(moment.state, bounds)?;
        let volume = if flat { period.x * period.y } else { period.x * period.y * period.z };
        let ball = |r: f64| if flat { PI * r * r } else { 4.0 / 3.0 * PI * r * r * r };
        let others = pairs as f64 / centres.max(1) as f64;
        let (width, mut within) = (self.range / self.bins as f64, 0.0);
        let rows = bins.iter().enumerate().map(|(k, count)| {
            let (low, high) = (k as f64 * width, (k + 1) as f64 * width);
            let mean = *count as f64 / centres.max(1) as f64;
            within += mean;
            let expected = others / volume * (ball(high) - ball(low));
            let g = if expected > 0.0 { mean / expected } else { 0.0 };
            [0.5 * (low + high), g, within].map(Into::into).to_vec()
        });
        Ok(rows.collect())
    }
    fn recall(&mut self, _: u64, _: &[&str]) {}
}
