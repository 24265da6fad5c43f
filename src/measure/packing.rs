//! How densely grains are packed: volume fraction and contacts, of the whole of a region or in slabs.

use super::region::{AXIS, BINS, HIGH, LOW, Region, Slabs, axes};
use super::{Cell, Measure, Moment, Row, Series, Times};
use crate::error::Error;
use crate::grains::{Pair, touching};
use crate::settings::{Key, Kind, Value};

/// `packing.csv`.
pub const MEASURE: Measure = Measure {
    name: "packing",
    about: "the volume fraction of grains and their coordination numbers in a region, or in slabs: several rows for each output; contacts are with other grains, not with walls, and means are those of grains that are not fixed with centres in the region",
    keys: &[
        LOW,
        HIGH,
        AXIS,
        BINS,
        Key::new("least", Kind::Whole, Value::Number(0.0), "how many contacts a grain needs that is no rattler; 0: 4, or 3 in two dimensions"),
    ],
    cells: &[
        ("low", "where a slab begins along the axis; empty without one [length]"),
        ("high", "where it ends"),
        ("grains", "grains that are not fixed with centres in it"),
        ("fraction", "the part of the volume inside of grains, fixed ones too; faces cut spheres, and overlaps count twice"),
        ("coordination", "contacts per grain, as all below empty without grains"),
        ("mechanical", "(2 C − N₁) / (N − N₀ − N₁), without grains of no contact or one (Thornton 2000)"),
        ("rattlers", "the part of the grains with fewer contacts than least, those with rattlers not counted"),
        ("backbone", "contacts per grain among those that are no rattlers"),
    ],
    times: Times::Chosen,
    usual: |_| Ok(None),
    begin: |setup, settings| {
        let usual = if axes(&setup.bounds) == 2 { 3 } else { 4 };
        let least = match settings.whole("least") {
            0 => usual,
            least => u32::try_from(least).unwrap_or(u32::MAX),
        };
        Ok(Box::new(Packing { region: Region::of(MEASURE.name, setup, settings)?, least }))
    },
};

/// Packings of a run.
#[derive(Debug)]
struct Packing {
    region: Region,
    least: u32,
}

/// The sums of a slab.
#[derive(Debug, Clone, Copy, Default)]
struct Sum {
    volume: f64,
    grains: u64,
    contacts: u64,
    /// Grains without a contact, and with one.
    loose: [u64; 2],
    rattlers: u64,
    held: u64,
}

impl Sum {
    fn row(&self, slabs: &Slabs, number: usize) -> Row {
        let ratio = |a: u64, b: u64| if b > 0 { Cell::from(a as f64 / b as f64) } else { Cell::Empty };
        let [none, one] = self.loose;
        let cells = [
            self.grains.into(),
            (self.volume / slabs.volume()).into(),
            ratio(self.contacts, self.grains),
            ratio(self.contacts - one, self.grains - none - one),
            ratio(self.rattlers, self.grains),
            ratio(self.held, self.grains - self.rattlers),
        ];
        slabs.ends(number).into_iter().chain(cells).collect()
    }
}

/// The grains that have fewer contacts than `least`, when those with such grains do not count; fixed grains are none of them. Also the
/// contacts of all with grains that are not.
fn rattlers(pairs: &[Pair], least: u32, fixed: &[bool]) -> (Vec<bool>, Vec<u32>) {
    let mut around = vec![Vec::new(); fixed.len()];
    for pair in pairs {
        let [a, b] = pair.grains;
        around[a].push(b);
        around[b].push(a);
    }
    let mut contacts: Vec<u32> = around.iter().map(|near| u32::try_from(near.len()).unwrap_or(u32::MAX)).collect();
    let mut rattles = vec![false; fixed.len()];
    let mut open: Vec<usize> = (0..fixed.len()).collect();
    while let Some(grain) = open.pop() {
        if rattles[grain] || fixed[grain] || contacts[grain] >= least {
            continue;
        }
        rattles[grain] = true;
        for near in &around[grain] {
            contacts[*near] -= 1;
            open.push(*near);
        }
    }
    (rattles, contacts)
}

impl Series for Packing {
    fn take(&mut self, moment: &Moment<'_>) -> Result<Vec<Row>, Error> {
        let (state, slabs) = (moment.state, self.region.at(moment)?);
        let (grains, radii) = (self.region.grains(state), state.scalar("radius").unwrap_or_default());
        let bounds = moment.bounds(self.region.bounds());
        let pairs = touching(state.position(), radii, &bounds, |i| state.is_active(i) && radii[i] > 0.0);
        let mut contacts = vec![0_u64; state.len()];
        pairs.iter().flat_map(|pair| pair.grains).for_each(|grain| contacts[grain] += 1);
        let (rattles, held) = rattlers(&pairs, self.least, &grains.fixed);
        let mut sums = vec![Sum::default(); slabs.count()];
        for i in grains.all {
            let x = state.position()[i];
            slabs.share(x, radii[i], |slab, volume| sums[slab].volume += volume);
            let Some(sum) = slabs.slab(x).filter(|_| !grains.fixed[i]).map(|slab| &mut sums[slab]) else { continue };
            sum.grains += 1;
            sum.contacts += contacts[i];
            if let Some(count) = usize::try_from(contacts[i]).ok().and_then(|count| sum.loose.get_mut(count)) {
                *count += 1;
            }
            sum.rattlers += u64::from(rattles[i]);
            sum.held += if rattles[i] { 0 } else { u64::from(held[i]) };
        }
        Ok(sums.iter().enumerate().map(|(number, sum)| sum.row(&slabs, number)).collect())
    }
    fn recall(&mut self, _: u64, _: &[&str]) {}
}
