//! Where grains are measured: the box or a part of it, whole or in slabs.

mod path;

use std::borrow::Cow;
use std::collections::BTreeSet;

use glam::DVec3;

use super::{Cell, Moment};
use crate::error::Error;
use crate::grains::{inside, volume};
use crate::kernel::{Bounds, Side};
use crate::settings::{Key, Kind, Settings, Value};
use crate::simulation::Setup;
use crate::state::State;

pub const LOW: Key = Key::new(
    "low",
    Kind::Vector,
    Value::Vector(DVec3::ZERO),
    "the lowest corner of the region; along an axis on which it is equal to high, the sides of the box [length]",
);
pub const HIGH: Key = Key::new("high", Kind::Vector, Value::Vector(DVec3::ZERO), "its highest corner [length]");
pub const AXIS: Key = Key::new(
    "axis",
    Kind::Choice(&["none", "x", "y", "z"]),
    Value::Text(Cow::Borrowed("none")),
    "the axis along which the region is divided into slabs; none: a row for the whole of it",
);
pub const BINS: Key = Key::new("bins", Kind::Count, Value::Number(1.0), "how many slabs of equal thickness there are");

/// The maximum number of slabs: each is a row of every output.
const MOST: u64 = 100_000;

/// Grains of a region in the course of a run.
#[derive(Debug)]
pub struct Region {
    /// The measure, for messages.
    name: &'static str,
    bounds: Bounds,
    low: DVec3,
    high: DVec3,
    axis: Option<usize>,
    bins: usize,
    /// Ids of particles that forces do not move.
    held: BTreeSet<u32>,
}

/// A region at a time.
#[derive(Debug, Clone, Copy)]
pub struct Slabs {
    bounds: Bounds,
    low: DVec3,
    high: DVec3,
    axis: Option<usize>,
    bins: usize,
}

/// Grains at a time.
#[derive(Debug)]
pub struct Grains {
    /// Their rows: active ones with a radius.
    pub all: Vec<usize>,
    /// Whether forces do not move them, by row.
    pub fixed: Vec<bool>,
}

impl Region {
    /// The region of a measure of grains.
    ///
    /// # Errors
    /// [`Error::Scene`] where no particle has a radius or the box is open where no corners are given; [`Error::Setting`] where these are
    /// wrong.
    pub fn of(name: &'static str, setup: &Setup, settings: &Settings) -> Result<Self, Error> {
        if setup.columns()?.get("radius").is_none() {
            return Err(Error::Scene(format!(
                "the measure `{name}` is one of grains, and no particle has a radius: add a force of kind `contact`"
            )));
        }
        let axis = ["x", "y", "z"].iter().position(|word| *word == settings.text("axis"));
        let refuse = |key: &'static str, why: String| Err(Error::Setting { key, why });
        let count = settings.whole("bins");
        if count > MOST {
            return refuse("bins", format!("`{name}` has bins = {count}: set {MOST} at most"));
        }
        if count > 1 && axis.is_none() {
            return refuse(
                "bins",
                format!("`{name}` has bins = {count} and no axis to divide: set axis = \"z\", or another"),
            );
        }
        if axis.is_some_and(|axis| axis >= axes(&setup.bounds)) {
            return refuse(
                "axis",
                format!("`{name}` has axis = \"z\" in two dimensions, where all is at z = 0: choose \"x\" or \"y\""),
            );
        }
        let region = Self {
            name,
            bounds: setup.bounds,
            low: settings.vector("low"),
            high: settings.vector("high"),
            axis,
            bins: usize::try_from(count).unwrap_or(1),
            held: setup
                .state
                .ids()
                .iter()
                .zip(setup.state.fixed())
                .filter(|(_, fixed)| *fixed)
                .map(|(id, _)| *id)
                .collect(),
        };
        region.within(setup.bounds)?;
        Ok(region)
    }
    /// It in the box of a state.
    ///
    /// # Errors
    /// [`Error::Scene`] where the box has become smaller than the region.
    pub fn at(&self, moment: &Moment<'_>) -> Result<Slabs, Error> {
        self.within(moment.bounds(&self.bounds))
    }
    fn within(&self, bounds: Bounds) -> Result<Slabs, Error> {
        let (mut low, mut high) = (self.low, self.high);
        for axis in 0..axes(&bounds) {
            let (side, name) = (bounds.sides[axis], ["x", "y", "z"][axis]);
            if low[axis] > high[axis] {
                return Err(Error::Setting {
                    key: "low",
                    why: format!(
                        "`{}` has low = {} above high = {} along {name}: exchange them",
                        self.name, low[axis], high[axis]
                    ),
                });
            }
            let given = low[axis] < high[axis];
            if !given && side == Side::Open {
                return Err(Error::Scene(format!(
                    "the measure `{}` needs a volume, and the box is open along {name}: set low and high there",
                    self.name
                )));
            }
            if !given {
                (low[axis], high[axis]) = (bounds.low[axis], bounds.high[axis]);
            } else if side == Side::Periodic && (low[axis] < bounds.low[axis] || high[axis] > bounds.high[axis]) {
                return Err(Error::Setting {
                    key: "low",
                    why: format!(
                        "`{}` is between {} and {} along {name}, beyond the sides of the periodic box at {} and {}: stay between these",
                        self.name, low[axis], high[axis], bounds.low[axis], bounds.high[axis]
                    ),
                });
            }
        }
        Ok(Slabs { bounds, low, high, axis: self.axis, bins: self.bins })
    }
    /// The box of the setup.
    #[must_use]
    pub fn bounds(&self) -> &Bounds {
        &self.bounds
    }
    /// The grains of a state.
    #[must_use]
    pub fn grains(&self, state: &State) -> Grains {
        let radii = state.scalar("radius").unwrap_or_default();
        let there = |i: &usize| state.is_active(*i) && radii.get(*i).is_some_and(|radius| *radius > 0.0);
        let fixed = state.ids().iter().map(|id| self.held.contains(id)).collect();
        Grains { all: (0..state.len()).filter(there).collect(), fixed }
    }
}

/// How many axes there are.
pub fn axes(bounds: &Bounds) -> usize {
    if bounds.dimensions == 2 { 2 } else { 3 }
}

impl Slabs {
    /// How many there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.bins
    }
    /// The axis along which they are.
    #[must_use]
    pub fn axis(&self) -> Option<usize> {
        self.axis
    }
    /// The box.
    #[must_use]
    pub fn bounds(&self) -> &Bounds {
        &self.bounds
    }
    /// The coordinate along the axis; 0 without one.
    #[must_use]
    pub fn along(&self, x: DVec3) -> f64 {
        self.axis.map_or(0.0, |axis| self.place(x)[axis])
    }
    /// The volume of each \[length³, or length² in two dimensions\].
    #[must_use]
    pub fn volume(&self) -> f64 {
        (0..axes(&self.bounds)).map(|axis| (self.high - self.low)[axis]).product::<f64>() / self.bins as f64
    }
    /// The ends of one, along the axis.
    #[must_use]
    pub fn ends(&self, slab: usize) -> [Cell; 2] {
        let Some(axis) = self.axis else { return [Cell::Empty, Cell::Empty] };
        [0, 1].map(|side| self.end(axis, slab + side).into())
    }
    fn end(&self, axis: usize, slab: usize) -> f64 {
        self.low[axis] + (self.high - self.low)[axis] * (slab as f64 / self.bins as f64)
    }
    /// The image of a position in the box.
    #[must_use]
    pub fn place(&self, x: DVec3) -> DVec3 {
        let (mut x, period) = (x, self.bounds.period());
        for axis in (0..axes(&self.bounds)).filter(|axis| period[*axis] > 0.0) {
            x[axis] = self.bounds.low[axis] + (x[axis] - self.bounds.low[axis]).rem_euclid(period[axis]);
        }
        x
    }
    /// The slab of a centre; `None` outside of the region.
    #[must_use]
    pub fn slab(&self, x: DVec3) -> Option<usize> {
        let x = self.place(x);
        let inside = |axis: usize| x[axis] >= self.low[axis] && x[axis] < self.high[axis];
        if !(0..axes(&self.bounds)).all(inside) {
            return None;
        }
        let Some(axis) = self.axis else { return Some(0) };
        Some(self.number(axis, x[axis]))
    }
    /// The slab of a coordinate; of one outside the nearest.
    fn number(&self, axis: usize, x: f64) -> usize {
        let part = (x - self.low[axis]) / (self.high - self.low)[axis] * self.bins as f64;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "between 0 and the number of slabs"
        )]
        let slab = part.max(0.0) as usize;
        slab.min(self.bins - 1)
    }
    /// Calls `add` with each slab that a sphere reaches, at any of its images, and the volume of it there.
    pub fn share(&self, x: DVec3, radius: f64, mut add: impl FnMut(usize, f64)) {
        let (x, dimensions) = (self.place(x), self.bounds.dimensions);
        let reach = DVec3::splat(radius);
        for image in self.images(x, radius) {
            let (low, high) = (self.low - image, self.high - image);
            if (0..axes(&self.bounds)).any(|axis| low[axis] >= radius || high[axis] <= -radius) {
                continue;
            }
            let Some(axis) = self.axis else {
                let whole = low.cmple(-reach).all() && high.cmpge(reach).all();
                add(0, if whole { volume(radius, dimensions) } else { inside(radius, low, high, dimensions) });
                continue;
            };
            for slab in self.number(axis, image[axis] - radius)..=self.number(axis, image[axis] + radius) {
                let (mut low, mut high) = (low, high);
                (low[axis], high[axis]) = (self.end(axis, slab) - image[axis], self.end(axis, slab + 1) - image[axis]);
                add(slab, inside(radius, low, high, dimensions));
            }
        }
    }
    /// A position in the box, and its images whose spheres reach into it.
    fn images(&self, x: DVec3, radius: f64) -> Vec<DVec3> {
        let (bounds, period) = (&self.bounds, self.bounds.period());
        let mut all = vec![x];
        for axis in (0..axes(bounds)).filter(|axis| period[*axis] > 0.0) {
            let shift = DVec3::AXES[axis] * period[axis];
            let shifts = [(x[axis] - radius < bounds.low[axis], shift), (x[axis] + radius > bounds.high[axis], -shift)];
            let more: Vec<DVec3> = shifts
                .into_iter()
                .filter(|(reaches, _)| *reaches)
                .flat_map(|(_, shift)| all.iter().map(move |x| *x + shift).collect::<Vec<_>>())
                .collect();
            all.extend(more);
        }
        all
    }
}
