//! The structure factor of a periodic box, by direct summation over the wave vectors k = 2 π (n_x / L_x, n_y / L_y, n_z / L_z) that it admits:
//!   S(k) = ⟨|ρ_k|²⟩ / N,  ρ_k = Σ exp(i k · x)   (Hansen & McDonald, Theory of Simple Liquids, 4.1; Allen & Tildesley 2017, 8.2);
//! of two species  S_ab(k) = ⟨Re ρ_a ρ_b*⟩ / √(N_a N_b)   (Ashcroft & Langreth, Phys. Rev. 156, 685, 1967).

use std::borrow::Cow;
use std::f64::consts::TAU;

use glam::{DVec3, DVec4};
use rayon::prelude::*;

use super::rdf::periodic_axes;
use super::series::number;
use super::{Cell, Measure, Moment, Row, Series, Times};
use crate::error::Error;
use crate::kernel::Bounds;
use crate::settings::{Key, Kind, Value};
use crate::simulation::Setup;

/// `structure_factor.csv`.
pub const MEASURE: Measure = Measure {
    name: "structure_factor",
    about: "the structure factor S(k) = |Σ exp(i k · x)|² / N of a periodic box over the wave vectors that it admits (Hansen & McDonald, Theory of Simple Liquids, 4.1), or that of two species, Re ρ_a ρ_b* / √(N_a N_b) (Ashcroft & Langreth 1967): several rows for each output",
    keys: &[
        Key::required("largest", Kind::Positive, "the largest wave number |k| [1 / length]"),
        Key::new("bins", Kind::Count, Value::Number(100.0), "how many intervals of |k| there are, from 0 on"),
        Key::new("vectors", Kind::Count, Value::Number(100.0), "the maximum number of wave vectors in an interval: of more, so many are taken, evenly spaced in the order of their components, the same ones for the whole run; k and −k are one"),
        Key::new("species", ALL.0, ALL.1, "a species, or \"all\""),
        Key::new("others", ALL.0, ALL.1, "the other species of a pair, or \"all\""),
        Key::new("after", Kind::NotNegative, Value::Number(0.0), "the time before which states do not count in the mean [time]"),
    ],
    cells: &[
        ("k", "the mean of |k| in an interval; one without wave vectors has no row [1 / length]"),
        ("s", "S(k) of this state, the mean over wave vectors; empty without particles"),
        ("mean", "the mean of s over the states so far; empty before the first that counts"),
        ("vectors", "how many wave vectors these are: of a disordered state s is off by about s / √vectors"),
    ],
    times: Times::Chosen,
    usual: |_| Ok(None),
    begin: |setup, settings| {
        let bounds = setup.bounds;
        periodic_axes(&bounds, "the measure `structure_factor` sums over the wave vectors of a periodic box")?;
        let pair = [of_species(setup, "species", settings.species("species"))?, of_species(setup, "others", settings.species("others"))?];
        let [bins, vectors] = ["bins", "vectors"].map(|key| settings.whole(key));
        if bins > MOST_BINS {
            return Err(Error::Setting { key: "bins", why: format!("`structure_factor` has bins = {bins}: set {MOST_BINS} at most") });
        }
        let groups = waves(&bounds, settings.number("largest"), bins, vectors)?;
        let count: usize = groups.iter().map(Vec::len).sum();
        if count > MOST {
            let why = format!("`structure_factor` has {count} wave vectors in {} intervals, more than {MOST}: choose fewer `vectors`, or fewer `bins`", groups.len());
            return Err(Error::Setting { key: "vectors", why });
        }
        let means = vec![Mean::default(); groups.len()];
        Ok(Box::new(Structure { bounds, groups, pair, after: settings.number("after"), means, recalled: None }))
    },
};

const ALL: (Kind, Value) = (Kind::Species, Value::Text(Cow::Borrowed("all")));
/// The maximum number of intervals: each is a row of every output.
const MOST_BINS: u64 = 100_000;
/// The maximum number of wave vectors of which sums are kept.
const MOST: usize = 1_000_000;
/// The maximum number of waves along a side, and the maximum number of wave vectors that are counted.
const MOST_ALONG: f64 = 4096.0;
const MOST_COUNTED: f64 = 1e8;
/// A wave number on the edge of an interval belongs to the interval above it, whatever rounding did to it.
const EDGE: f64 = 1e-9;
/// Particles whose phases are tabulated at once, four to a row.
const ROWS: usize = 64;

/// How many waves a wave vector has along each side: the first that is not 0 is positive.
type Waves = [i32; 3];

/// A species that is there.
fn of_species(setup: &Setup, key: &'static str, species: Option<u32>) -> Result<Option<u32>, Error> {
    match species {
        Some(one) if !setup.state.species().contains(&one) => {
            let why = format!("`structure_factor` has {key} = {one}, and no particle is of it: choose another, or \"all\"");
            Err(Error::Setting { key, why })
        }
        _ => Ok(species),
    }
}

/// The wave vectors of one wave along each side; 0 along an axis that is none.
fn steps(bounds: &Bounds) -> DVec3 {
    let axis = |k: usize| if k < bounds.dimensions as usize { TAU / bounds.period()[k] } else { 0.0 };
    DVec3::new(axis(0), axis(1), axis(2))
}

/// The number of waves along an axis, at most.
fn along(square: f64, step: f64) -> i32 {
    #[expect(clippy::cast_possible_truncation, reason = "at most some thousands")]
    let most = (square.max(0.0).sqrt() / step + EDGE) as i32;
    if step > 0.0 { most } else { 0 }
}

/// Visits all wave vectors up to this wave number, of k and −k one, in the order of their components.
fn admitted(step: DVec3, largest: f64, mut visit: impl FnMut(Waves, f64)) {
    let most = largest * largest;
    for x in 0..=along(most, step.x) {
        let square = (f64::from(x) * step.x).powi(2);
        let high = along(most - square, step.y);
        for y in if x == 0 { 0 } else { -high }..=high {
            let square = square + (f64::from(y) * step.y).powi(2);
            let high = along(most - square, step.z);
            for z in if x == 0 && y == 0 { 1 } else { -high }..=high {
                visit([x, y, z], (square + (f64::from(z) * step.z).powi(2)).sqrt());
            }
        }
    }
}

/// The wave vectors of each interval that has any.
fn waves(bounds: &Bounds, largest: f64, bins: u64, most: u64) -> Result<Vec<Vec<Waves>>, Error> {
    let step = steps(bounds);
    let shortest = step.to_array().into_iter().filter(|step| *step > 0.0).fold(f64::INFINITY, f64::min);
    let refuse = |why: String| Err(Error::Setting { key: "largest", why });
    if largest < shortest * (1.0 - EDGE) {
        return refuse(format!("`structure_factor` has largest = {largest}, less than the wave number 2 π / L of the longest wave in the box: set it to {shortest} at least"));
    }
    let sides = |largest: f64| step.to_array().map(|step| if step > 0.0 { (largest / step).floor() } else { 0.0 });
    let counted = |largest: f64| sides(largest).iter().map(|n| 2.0 * n + 1.0).product::<f64>() / 2.0;
    let fits = |largest: f64| counted(largest) <= MOST_COUNTED && sides(largest).iter().all(|n| *n <= MOST_ALONG);
    if !fits(largest) {
        let mut less = largest;
        while !fits(1.05 * less) {
            less *= 0.95;
        }
        return refuse(format!("`structure_factor` has largest = {largest}, up to which the box admits some {:.1e} wave vectors: set it to {less:.2e} at most", counted(largest)));
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below the number of bins")]
    let bin = |k: f64| ((k / largest * bins as f64 + EDGE) as u64).min(bins - 1) as usize;
    let mut found = vec![0_u64; usize::try_from(bins).unwrap_or(usize::MAX)];
    admitted(step, largest, |_, k| found[bin(k)] += 1);
    let mut groups = vec![Vec::new(); found.len()];
    let mut seen = vec![0_u64; found.len()];
    admitted(step, largest, |wave, k| {
        let (bin, most) = (bin(k), u128::from(most));
        let (place, of) = (u128::from(seen[bin]), u128::from(found[bin]));
        // Of more than `most` those at which this part of their number is reached.
        if of <= most || (place + 1) * most / of > place * most / of {
            groups[bin].push(wave);
        }
        seen[bin] += 1;
    });
    groups.retain(|group| !group.is_empty());
    Ok(groups)
}

/// The sum of S(k) over states.
#[derive(Debug, Clone, Copy, Default)]
struct Mean {
    sum: f64,
    states: u64,
}

/// Structure factors of a run.
#[derive(Debug)]
struct Structure {
    bounds: Bounds,
    groups: Vec<Vec<Waves>>,
    pair: [Option<u32>; 2],
    after: f64,
    means: Vec<Mean>,
    /// The step of the last row that was read back, and how many rows of that step there were.
    recalled: Option<(u64, usize)>,
}

/// Real and imaginary parts of exp(i n · θ), θ the phases of one wave along an axis: four particles to an element, `rows` elements for each n.
#[derive(Default)]
struct Phases {
    real: Vec<DVec4>,
    imaginary: Vec<DVec4>,
}

impl Phases {
    /// Those of n from 0 to `most`. Particles that fill up the last element do not count.
    fn of(phases: &[f64], most: usize) -> Self {
        let rows = phases.len().div_ceil(4);
        let row = |k: usize, of: &dyn Fn(f64) -> f64| DVec4::from_array([0, 1, 2, 3].map(|lane| phases.get(4 * k + lane).map_or(0.0, |x| of(*x))));
        let table = |of: &dyn Fn(f64) -> f64| (0..rows).map(|k| row(k, of)).collect::<Vec<_>>();
        let (cosine, sine) = (table(&f64::cos), table(&f64::sin));
        let (mut real, mut imaginary) = (table(&|_| 1.0), table(&|_| 0.0));
        for k in 0..most * rows {
            let (a, b, c, s) = (real[k], imaginary[k], cosine[k % rows], sine[k % rows]);
            real.push(a * c - b * s);
            imaginary.push(a * s + b * c);
        }
        Self { real, imaginary }
    }
}

/// The phases along x, y and z.
struct Table {
    axes: [Phases; 3],
    rows: usize,
}

impl Table {
    /// Σ exp(i k · x): real and imaginary part.
    fn sum(&self, wave: Waves) -> [f64; 2] {
        let [x, y, z] = [0, 1, 2].map(|axis| {
            let from = wave[axis].unsigned_abs() as usize * self.rows;
            let phases = &self.axes[axis];
            (&phases.real[from..from + self.rows], &phases.imaginary[from..from + self.rows])
        });
        let [_, sy, sz] = wave.map(|n| f64::from(n.signum()));
        let (mut real, mut imaginary) = (DVec4::ZERO, DVec4::ZERO);
        for k in 0..self.rows {
            let (yi, zi) = (sy * y.1[k], sz * z.1[k]);
            let (a, b) = (x.0[k] * y.0[k] - x.1[k] * yi, x.0[k] * yi + x.1[k] * y.0[k]);
            real += a * z.0[k] - b * zi;
            imaginary += a * zi + b * z.0[k];
        }
        [real.element_sum(), imaginary.element_sum()]
    }
}

impl Structure {
    /// ρ_k of each wave vector. Particles are summed in their order, so that a sum has the same bits for any number of threads.
    fn densities(&self, places: &[DVec3], step: DVec3) -> Vec<[f64; 2]> {
        let waves: Vec<Waves> = self.groups.iter().flatten().copied().collect();
        let most = [0, 1, 2].map(|axis| waves.iter().map(|n| n[axis].unsigned_abs()).max().unwrap_or(0) as usize);
        let mut sums = vec![[0.0; 2]; waves.len()];
        for some in places.chunks(4 * ROWS) {
            let axis = |axis: usize| Phases::of(&some.iter().map(|x| step[axis] * x[axis]).collect::<Vec<_>>(), most[axis]);
            let table = Table { axes: [0, 1, 2].map(axis), rows: some.len().div_ceil(4) };
            sums.par_iter_mut().zip(&waves).for_each(|(sum, wave)| {
                let [real, imaginary] = table.sum(*wave);
                *sum = [sum[0] + real, sum[1] + imaginary];
            });
        }
        sums
    }
    /// Counts S(k) of a state in the mean.
    fn count(&mut self, group: usize, time: f64, s: f64) {
        if time >= self.after && s.is_finite()
            && let Some(mean) = self.means.get_mut(group)
        {
            *mean = Mean { sum: mean.sum + s, states: mean.states + 1 };
        }
    }
}

impl Series for Structure {
    fn take(&mut self, moment: &Moment<'_>) -> Result<Vec<Row>, Error> {
        let state = moment.state;
        let step = steps(&moment.bounds(&self.bounds));
        let chosen = |of: Option<u32>| -> Vec<DVec3> {
            let is = |i: &usize| state.is_active(*i) && of.is_none_or(|species| state.species().get(*i) == Some(&species));
            (0..state.len()).filter(is).map(|i| state.position()[i]).collect()
        };
        let [a, b] = self.pair;
        let places = chosen(a);
        let first = self.densities(&places, step);
        let (second, number) = if a == b {
            (first.clone(), places.len() as f64)
        } else {
            let others = chosen(b);
            (self.densities(&others, step), (places.len() as f64 * others.len() as f64).sqrt())
        };
        let mut pairs = first.iter().zip(&second);
        let groups: Vec<(f64, f64, u64)> = self.groups.iter().map(|group| {
            let count = group.len() as f64;
            let k = group.iter().map(|n| (step * DVec3::from(n.map(f64::from))).length()).sum::<f64>() / count;
            let sum: f64 = pairs.by_ref().take(group.len()).map(|(a, b)| a[0] * b[0] + a[1] * b[1]).sum();
            (k, sum / number / count, group.len() as u64)
        }).collect();
        let mut rows = Vec::new();
        for (place, (k, s, vectors)) in groups.into_iter().enumerate() {
            self.count(place, state.time, s);
            let mean = self.means[place];
            let filled = |x: f64| if x.is_finite() { x.into() } else { Cell::Empty };
            rows.push(vec![k.into(), filled(s), filled(mean.sum / mean.states as f64), vectors.into()]);
        }
        Ok(rows)
    }
    fn recall(&mut self, step: u64, cells: &[&str]) {
        let place = self.recalled.filter(|(last, _)| *last == step).map_or(0, |(_, rows)| rows);
        self.recalled = Some((step, place + 1));
        self.count(place, number(cells, 0), number(cells, 2));
    }
}
