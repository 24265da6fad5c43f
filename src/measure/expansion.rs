//! The energy equation of an expanding space (Layzer 1963; Irvine 1961), in supercomoving coordinates: with the kinetic energy K = Σ ½ m v² of
//! v = a² dx/dT, and the potential energy W = a Σ ½ m φ of comoving positions without the mean density,
//!   d(K + W) / dt = W d ln a / dt.
//! The integral of W d ln a is that of the trapezoids between rows.

use std::sync::Arc;

use super::series::number;
use super::{Measure, Moment, Row, Series, Times};
use crate::cosmology::Expansion;
use crate::error::Error;
use crate::settings::Settings;
use crate::simulation::Setup;

/// The expansion of the forces of a setup.
fn of(setup: &Setup) -> Option<Arc<Expansion>> {
    setup.forces.iter().find_map(|force| force.properties().expands).map(|expands| expands.expansion)
}

/// `expansion.csv`.
pub const MEASURE: Measure = Measure {
    name: "expansion",
    about: "the scale factor of an expanding space, and the cosmic energy, which is constant (Layzer 1963; Irvine 1961)",
    keys: &[],
    cells: &[
        ("scale_factor", "a, 1 today"),
        ("redshift", "z = 1 / a - 1"),
        ("rate", "H, the rate of expansion [1 / physical time]"),
        ("growth", "the growth D of small waves of the density, relative to that today"),
        ("kinetic", "K = 1/2 sum m v^2, of v = a^2 dx/dT [mass length^2 / time^2]"),
        ("potential", "W = a times the potential energy of comoving positions, without the mean density [mass length^2 / time^2]"),
        ("work", "the integral of W d ln a since the start, by the trapezoids of the rows [mass length^2 / time^2]"),
        ("cosmic_energy", "K + W - work, which is constant [mass length^2 / time^2]"),
    ],
    times: Times::Chosen,
    usual: |setup| Ok(of(setup).map(|_| Settings::default())),
    begin: |setup, _| {
        let Some(expansion) = of(setup) else {
            return Err(Error::Scene(
                "the measure `expansion` is of a space that expands: give the force gravity a `hubble` above 0, or leave it out".to_owned(),
            ));
        };
        Ok(Box::new(Expanding { expansion, before: None, work: 0.0 }))
    },
};

/// The expansion in the course of a run.
#[derive(Debug)]
struct Expanding {
    expansion: Arc<Expansion>,
    /// ln a and W of the row before.
    before: Option<[f64; 2]>,
    /// The integral of W d ln a.
    work: f64,
}

impl Series for Expanding {
    fn take(&mut self, moment: &Moment<'_>) -> Result<Vec<Row>, Error> {
        let (state, energies) = (moment.state, moment.state.energies()?);
        let a = self.expansion.scale_factor(state.time);
        let active: Vec<usize> = (0..state.len()).filter(|i| state.is_active(*i)).collect();
        let kinetic: f64 = active.iter().map(|i| 0.5 * state.mass()[*i] * state.velocity()[*i].length_squared()).sum();
        let potential: f64 = active.iter().map(|i| energies[*i]).sum();
        if let Some([ln_a, before]) = self.before {
            self.work += 0.5 * (before + potential) * (a.ln() - ln_a);
        }
        self.before = Some([a.ln(), potential]);
        let cosmology = &self.expansion.cosmology;
        let growth = cosmology.growth(a) / cosmology.growth(1.0);
        let numbers = [a, 1.0 / a - 1.0, cosmology.rate(a), growth, kinetic, potential, self.work, kinetic + potential - self.work];
        Ok(vec![numbers.map(Into::into).to_vec()])
    }
    fn recall(&mut self, _: u64, cells: &[&str]) {
        let [a, potential, work] = [1, 6, 7].map(|place| number(cells, place));
        self.before = Some([a.ln(), potential]);
        self.work = work;
    }
}
