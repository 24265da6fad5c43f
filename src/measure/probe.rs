//! Density and velocity at points along a line.

use glam::DVec3;
use rayon::prelude::*;

use super::{Cell, Measure, Moment, Row, Series, Times};
use crate::error::Error;
use crate::kernel::Bounds;
use crate::neighbors::Cells;
use crate::settings::{Key, Kind, Value};
use crate::sph::Smoothing;

/// `probe.csv`.
pub const MEASURE: Measure = Measure {
    name: "probe",
    about: "density and mean velocity at a point, or at points along a line, by Wendland's C2 kernel: a row for each point",
    keys: &[
        Key::required("start", Kind::Vector, "the first point [length]"),
        Key::new("span", Kind::Vector, Value::Vector(DVec3::ZERO), "from the first point to the last, where there are several [length]"),
        Key::new("count", Kind::Count, Value::Number(1.0), "how many points there are, evenly spaced"),
        Key::required("range", Kind::Positive, "the support radius of the kernel, beyond which particles do not count [length]"),
    ],
    cells: &[
        ("x", "the point [length]"),
        ("y", "along y"),
        ("z", "along z"),
        ("particles", "active particles in range, fixed ones too"),
        ("density", "Σ m W over these [mass / length³, or mass / length² in two dimensions]"),
        ("velocity_x", "Σ v W / Σ W over these; empty where there are none [length / time]"),
        ("velocity_y", "along y"),
        ("velocity_z", "along z"),
    ],
    times: Times::Chosen,
    usual: |_| Ok(None),
    begin: |setup, settings| {
        let (bounds, range, count) = (setup.bounds, settings.number("range"), settings.whole("count"));
        if count > MOST {
            return Err(Error::Setting { key: "count", why: format!("`probe` has count = {count}: set {MOST} at most") });
        }
        let [start, span] = [settings.vector("start"), settings.vector("span")];
        let refuse = |key: &'static str, why: String| Err(Error::Setting { key, why });
        if (count > 1) != (span != DVec3::ZERO) {
            return refuse("count", format!("`probe` has count = {count} and span = {span}: several points need a span, and a span needs several points"));
        }
        if bounds.dimensions == 2 && (start.z != 0.0 || span.z != 0.0) {
            return refuse("start", format!("`probe` is at z = {} in two dimensions, where all particles are at 0: set z to 0", start.z));
        }
        let half = half_period(&bounds);
        if range > half {
            return refuse("range", format!("`probe` has range = {range}, more than half a period of the box, beyond which images repeat: set it to {half} at most"));
        }
        let part = |k: u64| if count > 1 { k as f64 / (count - 1) as f64 } else { 0.0 };
        let points = (0..count).map(|k| start + part(k) * span).collect();
        Ok(Box::new(Probe { points, range, bounds }))
    },
};

/// The maximum number of points: each is a row of every output.
const MOST: u64 = 100_000;

/// Half of the shortest period; infinite where there is none.
fn half_period(bounds: &Bounds) -> f64 {
    0.5 * bounds.period().to_array().into_iter().filter(|period| *period > 0.0).fold(f64::INFINITY, f64::min)
}

/// Points at which states are measured.
#[derive(Debug)]
struct Probe {
    points: Vec<DVec3>,
    range: f64,
    bounds: Bounds,
}

/// Sums at a point.
#[derive(Default)]
struct Sum {
    particles: u64,
    density: f64,
    weight: f64,
    velocity: DVec3,
}

impl Series for Probe {
    fn take(&mut self, moment: &Moment<'_>) -> Result<Vec<Row>, Error> {
        let (state, bounds) = (moment.state, moment.bounds(&self.bounds));
        let half = half_period(&bounds);
        if self.range > half {
            return Err(Error::Scene(format!(
                "the measure `probe` has range = {}, and the box has shrunk so that half of its shortest period is {half}: choose a shorter range",
                self.range
            )));
        }
        let active: Vec<usize> = (0..state.len()).filter(|i| state.is_active(*i)).collect();
        let places: Vec<DVec3> = active.iter().map(|i| state.position()[*i]).chain(self.points.iter().copied()).collect();
        let cells = Cells::new(&places, bounds, self.range)?;
        let volume = self.range.powi(if self.bounds.dimensions == 2 { 2 } else { 3 });
        let constant = Smoothing::Wendland.constant(self.bounds.dimensions) / volume;
        let at = |point: usize| {
            let (here, mut sum) = (active.len() + point, Sum::default());
            cells.around(here, |j| {
                let Some(id) = active.get(j) else { return };
                let r = bounds.shortest(places[j] - places[here]).length();
                let weight = constant * Smoothing::Wendland.profile(r / self.range);
                sum.particles += 1;
                sum.density += state.mass()[*id] * weight;
                sum.weight += weight;
                sum.velocity += weight * state.velocity()[*id];
            });
            let point = self.points[point].to_array().map(Cell::from);
            let mean = (sum.velocity / sum.weight).to_array();
            let mean = mean.map(|v| if sum.weight > 0.0 { v.into() } else { Cell::Empty });
            point.into_iter().chain([sum.particles.into(), sum.density.into()]).chain(mean).collect()
        };
        Ok((0..self.points.len()).into_par_iter().map(at).collect())
    }
    fn recall(&mut self, _: u64, _: &[&str]) {}
}
