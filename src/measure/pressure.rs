//! Pressure, from kinetic energies and the virial.

use glam::DVec3;

use super::series::number;
use super::thermo::moving;
use super::{Measure, Moment, Needs, Row, Series, Times};
use crate::error::Error;
use crate::kernel::{Bounds, Side};

/// `pressure.csv`.
pub const MEASURE: Measure = Measure {
    name: "pressure",
    about: "the pressure tensor of a closed box, (Σ m v ⊗ v − Σ r ⊗ F) / V over particles that are not fixed and pairs in range, links and joints (Allen & Tildesley 2017, 2.4)",
    keys: &[],
    cells: &[
        ("pressure", "a third of xx + yy + zz; half of xx + yy in the plane [mass / length / time²]"),
        ("ideal", "its part of kinetic energies relative to the centre of mass, (N − 1) k T / V [mass / length / time²; mass / time² in the plane, as the others]"),
        ("xx", "the momentum along x that passes an area across x [mass / length / time²]"),
        ("yy", "along y"),
        ("zz", "along z"),
        ("yz", "along y, across z"),
        ("xz", "along x, across z"),
        ("xy", "along x, across y"),
    ],
    times: Times::Chosen,
    usual: |_| Ok(None),
    begin: |setup, _| {
        let bounds = setup.bounds;
        let axes = bounds.dimensions as usize;
        if (0..axes).any(|axis| bounds.sides[axis] == Side::Open) {
            return Err(Error::Scene(
                "the measure `pressure` needs the volume of a box, and this box is open: set [box] boundary = \"periodic\", or leave it out"
                    .to_owned(),
            ));
        }
        setup.has_virial()?;
        Ok(Box::new(Pressures { held: setup.state.fixed(), bounds, axes, rows: Vec::new() }))
    },
};

/// Pressures of a run.
#[derive(Debug)]
pub struct Pressures {
    held: Vec<bool>,
    bounds: Bounds,
    axes: usize,
    rows: Vec<f64>,
}

impl Pressures {
    /// The pressure of each row.
    #[must_use]
    pub fn rows(&self) -> &[f64] {
        &self.rows
    }
}

impl Series for Pressures {
    fn needs(&self) -> Needs {
        Needs { virial: true, ..Needs::default() }
    }
    fn take(&mut self, moment: &Moment<'_>) -> Result<Vec<Row>, Error> {
        let Some(virial) = moment.virial else {
            return Err(Error::Scene("the measure `pressure` needs the virial of the state".to_owned()));
        };
        let state = moment.state;
        let bounds = moment.bounds(&self.bounds);
        let volume: f64 = (0..self.axes).map(|axis| (bounds.high - bounds.low)[axis]).product();
        let (all, mean) = moving(state, &self.held);
        let (mut normal, mut shear) = (DVec3::ZERO, DVec3::ZERO);
        for i in all {
            let (m, v) = (state.mass()[i], state.velocity()[i] - mean);
            normal += m * v * v;
            shear += m * DVec3::new(v.y * v.z, v.x * v.z, v.x * v.y);
        }
        let trace = |x: &[f64]| x[..self.axes].iter().sum::<f64>() / self.axes as f64 / volume;
        let kinetic = [normal.to_array(), shear.to_array()].concat();
        let ideal = trace(&kinetic);
        let whole: Vec<f64> = kinetic.iter().zip(virial).map(|(k, w)| k + w).collect();
        let pressure = trace(&whole);
        self.rows.push(pressure);
        let parts = whole.iter().map(|part| part / volume);
        Ok(vec![[pressure, ideal].into_iter().chain(parts).map(Into::into).collect()])
    }
    fn recall(&mut self, _: u64, cells: &[&str]) {
        self.rows.push(number(cells, 1));
    }
    fn summary(&self) -> Option<String> {
        let (first, last) = (self.rows.first()?, self.rows.last()?);
        Some(format!("pressure {first:.4} → {last:.4}"))
    }
}
