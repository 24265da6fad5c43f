//! Central forces of pairs from an energy U(r): coefficients by pair of species, mixing rules, and the end at the cut-off radius.

use std::borrow::Cow;
use std::sync::Arc;

use glam::{DVec3, DVec4};

use crate::component::Tail;
use crate::kernel::{Scalar, Source, World};
use crate::settings::{Key, Kind, Pair, Settings, Value};
use crate::visit::{Law, MOST_SPECIES, Over, PairRow, PairTable, Particle};

/// The cut-off radius.
pub(super) const RANGE: Key = Key::required("range", Kind::Positive, "the cut-off radius [length]");
/// How the energy ends there.
pub(super) const TRUNCATION: Key = Key::new(
    "truncation",
    Kind::Choice(&["cut", "shift", "force_shift", "xplor"]),
    Value::Text(Cow::Borrowed("shift")),
    "how U ends at the range R: not at all, less U(R), less U(R) and its slope there, or smoothed by a polynomial from `onset` on (Brooks et al. 1983)",
);
/// Where smoothing begins.
pub(super) const ONSET: Key = Key::new(
    "onset",
    Kind::Fraction,
    Value::Number(0.9),
    "truncation = \"xplor\": the distance at which smoothing begins, as a part of the range",
);
/// What every pair of species has beside the coefficients of all.
pub(super) const PAIRS: &str = "factors for pairs of species, as in [{ species = [0, 1], epsilon = 0.5 }], by which the values above are multiplied; none: all species are alike";

/// A factor of a row: 1 unless said otherwise.
pub(super) const fn factor(name: &'static str, about: &'static str) -> Key {
    Key::new(name, Kind::NotNegative, Value::Number(1.0), about)
}
/// The same of a length.
pub(super) const fn length(name: &'static str, about: &'static str) -> Key {
    Key::new(name, Kind::Positive, Value::Number(1.0), about)
}

/// Species that a law without pairs serves, as many as the table of its shader holds.
const SPECIES: u32 = 8;

/// An energy, and its slope along the distance.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Energy {
    pub value: f64,
    pub slope: f64,
}

/// The coefficients of a pair of species, in the order of their names.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    pub species: [u32; 2],
    pub values: Vec<f64>,
}

/// Of two like pairs the coefficients of the unlike one, where it is not given.
pub(super) type Mixing = fn(&[f64], &[f64]) -> Vec<f64>;

/// The coefficients of all pairs of species that settings speak of.
pub(super) fn rows(settings: &Settings, names: &[&str], mixing: Option<Mixing>) -> Vec<Row> {
    let whole: Vec<f64> = names.iter().map(|name| settings.number(name)).collect();
    let given = settings.pairs("pairs");
    if given.is_empty() {
        let pairs = (0..SPECIES).flat_map(|a| (a..SPECIES).map(move |b| [a, b]));
        return pairs.map(|species| Row { species, values: whole.clone() }).collect();
    }
    let of = |pair: &Pair| names.iter().zip(&whole).map(|(name, x)| x * pair.number(name)).collect();
    let mut rows: Vec<Row> = given.iter().map(|pair| Row { species: pair.species, values: of(pair) }).collect();
    if let Some(mix) = mixing {
        let like: Vec<Row> = rows.iter().filter(|row| row.species[0] == row.species[1]).cloned().collect();
        for (place, one) in like.iter().enumerate() {
            for other in &like[..place] {
                let species = [other.species[0], one.species[0]];
                if find(&rows, species).is_none() {
                    rows.push(Row { species, values: mix(&other.values, &one.values) });
                }
            }
        }
    }
    rows
}

fn find(rows: &[Row], [a, b]: [u32; 2]) -> Option<&Row> {
    rows.iter().find(|row| row.species == [a, b] || row.species == [b, a])
}

/// The integrals of an energy beyond the range, where nothing else ends it; by Simpson's rule over t = R / r. An integral that twice as many
/// steps change is infinite, as that of 1 / r.
pub(super) fn tails(settings: &Settings, rows: &[Row], energy: fn(&[f64], f64) -> Energy) -> Vec<Tail> {
    const STEPS: u32 = 1000;
    if settings.text("truncation") != "cut" {
        return Vec::new();
    }
    let range = settings.number("range");
    let simpson = |of: &dyn Fn(f64) -> f64, steps: u32| {
        let h = 1.0 / f64::from(steps);
        // At t = 0 there is nothing left.
        let term = |k: u32| {
            let t = h * f64::from(k);
            let weight = if k == steps { 1.0 } else { f64::from(2 + 2 * (k % 2)) };
            weight * of(range / t) * range / (t * t)
        };
        (1..=steps).map(term).sum::<f64>() * h / 3.0
    };
    let integral = |of: &dyn Fn(f64) -> f64| {
        let [coarse, fine] = [STEPS, 2 * STEPS].map(|steps| simpson(of, steps));
        // Or the energy ends within few steps, and nothing is left of it.
        let size = fine.abs().mul_add(1e-6, 1e-3 * of(range).abs() * range);
        if (fine - coarse).abs() <= size { fine } else { f64::INFINITY }
    };
    let of = |row: &Row| Tail {
        species: row.species,
        energy: integral(&|r| energy(&row.values, r).value * r * r),
        slope: integral(&|r| energy(&row.values, r).slope * r.powi(3)),
    };
    rows.iter().map(of).collect()
}

/// The end of an energy at the cut-off radius.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Truncation {
    range: f64,
    /// Where smoothing begins; the range where there is none.
    onset: f64,
    value: bool,
    slope: bool,
}

impl Truncation {
    fn of(settings: &Settings) -> Self {
        let (range, text) = (settings.number("range"), settings.text("truncation"));
        let part = if text == "xplor" { settings.number("onset") } else { 1.0 };
        let slope = text == "force_shift";
        Self { range, onset: part * range, value: slope || text == "shift", slope }
    }
    /// What is taken off, of what a pair has at the range.
    fn taken(self, end: Energy) -> Energy {
        let part = |some: bool, x: f64| if some { x } else { 0.0 };
        Energy { value: part(self.value, end.value), slope: part(self.slope, end.slope) }
    }
    fn ended(self, here: Energy, end: Energy, r: f64) -> Energy {
        let value = here.value - end.value - (r - self.range) * end.slope;
        let slope = here.slope - end.slope;
        // A pair in range by single precision may be beyond it by double precision.
        if r <= self.onset || self.onset >= self.range {
            return Energy { value, slope };
        }
        let [range, onset, square] = [self.range, self.onset, r].map(|x| x * x);
        let (left, width) = (range - square, (range - onset).powi(3));
        let smooth = left * left * (range + 2.0 * square - 3.0 * onset) / width;
        let fall = 12.0 * r * left * (onset - square) / width;
        Energy { value: smooth * value, slope: smooth * slope + fall * value }
    }
}

/// A law of central forces: `energy` of the coefficients of a pair at a distance.
pub(super) fn law(
    (name, wgsl): (&str, Source),
    settings: &Settings,
    over: Over,
    names: &[&'static str],
    rows: &[Row],
    energy: fn(&[f64], f64) -> Energy,
) -> Law {
    let truncation = Truncation::of(settings);
    let mut table = PairTable::default();
    for row in rows {
        let end = truncation.taken(energy(&row.values, truncation.range));
        let ends = [("end_value", end.value), ("end_slope", end.slope)];
        let all = names.iter().copied().zip(row.values.iter().copied()).chain(ends);
        let values = all.map(|(name, x)| (name.to_owned(), Scalar::Float(x))).collect();
        table.rows.push(PairRow { species: row.species, values });
    }
    let params = [("range", truncation.range), ("onset", truncation.onset)];
    let params = params.map(|(name, x)| (name.to_owned(), Scalar::Float(x))).to_vec();
    let pair = move |row: &Row, distance: f64| {
        let end = truncation.taken(energy(&row.values, truncation.range));
        truncation.ended(energy(&row.values, distance), end, distance)
    };
    let smoothed = truncation.onset < truncation.range;
    let constants = vec![
        ("SMOOTHED", f64::from(u8::from(smoothed))),
        ("SHIFTED", f64::from(u8::from(!smoothed && !truncation.slope))),
    ];
    Law { pairs: Some(table), constants, ..central((name, wgsl), over, params, rows, pair) }
}

/// The same of an energy that ends by itself.
pub(super) fn central(
    (name, wgsl): (&str, Source),
    over: Over,
    params: Vec<(String, Scalar)>,
    rows: &[Row],
    energy: impl Fn(&Row, f64) -> Energy + Send + Sync + 'static,
) -> Law {
    // A table of more species is refused where it is packed.
    let side = rows.iter().flat_map(|row| row.species).max().map_or(0, |last| last.saturating_add(1)).min(MOST_SPECIES);
    let mut table: Vec<Option<Row>> = vec![None; (side * side) as usize];
    // Of two rows for one pair the first counts.
    for row in rows.iter().rev() {
        let [a, b] = row.species;
        if a.max(b) < side {
            table[(a * side + b) as usize] = Some(row.clone());
            table[(b * side + a) as usize] = Some(row.clone());
        }
    }
    let table: Arc<[Option<Row>]> = table.into();
    let gather = move |me: &Particle, you: &Particle, r: DVec3, sum: &mut DVec4| {
        let [a, b] = [me.species(), you.species()];
        let row = if a.max(b) < side { table.get((a * side + b) as usize) } else { None };
        if let Some(Some(row)) = row {
            let distance = r.length();
            let here = energy(row, distance);
            // Two at one place have no direction between them.
            let force = if distance > 0.0 { r * (here.slope / distance) } else { DVec3::ZERO };
            *sum += force.extend(here.value);
        }
    };
    let finish = |me: &Particle, sum: &DVec4, _: &World| if me.mass > 0.0 { *sum / me.mass } else { DVec4::ZERO };
    Law { reciprocal: true, ..Law::gathering(name, over, wgsl, params, gather, finish) }
}
