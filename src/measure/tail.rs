//! Corrections for pairs beyond the cut-off radius.

use std::f64::consts::PI;

use super::{Measure, Moment, Row, Series, Times};
use crate::component::Tail;
use crate::error::Error;
use crate::kernel::{Bounds, Side};
use crate::simulation::Setup;

/// `tail.csv`.
pub const MEASURE: Measure = Measure {
    name: "tail",
    about: "what pairs beyond the cut-off radius would add, if neighbours were uniformly distributed there: the long-range corrections of pair laws with truncation = \"cut\" (Allen & Tildesley 2017, 2.8)",
    keys: &[],
    cells: &[
        ("energy", "2 π / V Σ Nₐ Nᵦ ∫ U r² dr over pairs of species, to be added to the potential energy [energy]"),
        ("per_particle", "the same for each active particle [energy]"),
        ("pressure", "−2 π / 3 V² Σ Nₐ Nᵦ ∫ U′ r³ dr, to be added to the measure `pressure` [mass / length / time²]"),
    ],
    times: Times::Chosen,
    usual: |_| Ok(None),
    begin: |setup, _| {
        let bounds = setup.bounds;
        if bounds.sides != [Side::Periodic; 3] || bounds.dimensions != 3 {
            return refuse("is for a box that is periodic on all sides in 3 dimensions: set [box] boundary = \"periodic\"");
        }
        Ok(Box::new(Tails { bounds, tails: tails(setup)? }))
    },
};

fn refuse<T>(why: &str) -> Result<T, Error> {
    Err(Error::Scene(format!("the measure `tail` {why}, or leave it out")))
}

/// What the pairs of a setup lack.
fn tails(setup: &Setup) -> Result<Vec<Tail>, Error> {
    let tails: Vec<Tail> = setup.forces.iter().flat_map(|force| force.tails()).collect();
    if tails.is_empty() {
        return refuse("needs a pair law that ends at its cut-off radius, as lennard_jones with truncation = \"cut\"");
    }
    if let Some(tail) = tails.iter().find(|tail| !(tail.energy.is_finite() && tail.slope.is_finite())) {
        let [a, b] = tail.species;
        return refuse(&format!(
            "has no finite sum over pairs of the species {a} and {b}: their energy falls as slowly as 1 / r; give them a screening"
        ));
    }
    Ok(tails)
}

/// Corrections of a run.
#[derive(Debug)]
struct Tails {
    bounds: Bounds,
    tails: Vec<Tail>,
}

impl Series for Tails {
    fn take(&mut self, moment: &Moment<'_>) -> Result<Vec<Row>, Error> {
        let state = moment.state;
        let volume = moment.bounds(&self.bounds).period().element_product();
        let active: Vec<u32> = (0..state.len()).filter(|i| state.is_active(*i)).map(|i| state.species()[i]).collect();
        let count = |species: u32| active.iter().filter(|one| **one == species).count() as f64;
        let (mut energy, mut pressure) = (0.0, 0.0);
        for tail in &self.tails {
            let [a, b] = tail.species;
            // Pairs of unlike species are there in both orders.
            let pairs = count(a) * count(b) * if a == b { 1.0 } else { 2.0 };
            energy += 2.0 * PI / volume * pairs * tail.energy;
            pressure -= 2.0 * PI / (3.0 * volume * volume) * pairs * tail.slope;
        }
        let each = energy / active.len().max(1) as f64;
        Ok(vec![[energy, each, pressure].map(Into::into).to_vec()])
    }
    fn recall(&mut self, _: u64, _: &[&str]) {}
    fn follow(&mut self, setup: &Setup) -> Result<(), Error> {
        self.tails = tails(setup)?;
        Ok(())
    }
}
