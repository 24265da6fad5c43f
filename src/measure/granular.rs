//! Grains: contacts, overlaps and energies.

use glam::DVec3;

use super::{Measure, Moment, Row, Series, Times};
use crate::error::Error;
use crate::grains::touching;
use crate::kernel::{Array, Bounds};
use crate::rotation;

/// `granular.csv`.
pub const MEASURE: Measure = Measure {
    name: "granular",
    about: "contacts, overlaps and energies of grains, which have a radius: contacts with each other, not with walls",
    keys: &[],
    cells: &[
        ("grains", "active grains"),
        ("contacts", "contacts per grain: each contact counts for both"),
        ("free", "the part of the grains that touches no other"),
        ("overlap", "the largest overlap, relative to the smaller of the two radii"),
        ("kinetic", "½ Σ m v² [mass length² / time²]"),
        ("rotational", "½ Σ I ω² [mass length² / time²]"),
        ("potential", "the potential energy, that of the springs of contacts too [mass length² / time²]"),
        ("dissipated", "what contacts have dissipated, those with walls too [mass length² / time²]"),
        ("total", "the sum of the four: constant, but for the work of moving walls, what a drain removes, and the order of the step [mass length² / time²]"),
        ("top", "the highest point of any, along z [length]"),
        ("reach", "the largest distance of the centre of a grain that touches another from the z axis [length]"),
    ],
    times: Times::Chosen,
    usual: |_| Ok(None),
    begin: |setup, _| {
        if setup.columns()?.get("radius").is_none() {
            let text = "the measure `granular` is one of grains, and no particle has a radius: add a force of kind `contact`";
            return Err(Error::Scene(text.to_owned()));
        }
        Ok(Box::new(Granular { bounds: setup.bounds }))
    },
};

/// Contacts and energies of a run.
#[derive(Debug)]
pub struct Granular {
    bounds: Bounds,
}

impl Series for Granular {
    fn take(&mut self, moment: &Moment<'_>) -> Result<Vec<Row>, Error> {
        let state = moment.state;
        let radii = state.scalar("radius").unwrap_or_default();
        let there = |i: usize| state.is_active(i);
        let pairs = touching(state.position(), radii, &moment.bounds(&self.bounds), there);
        let mut contacts = vec![0_u32; state.len()];
        let mut overlap = 0.0_f64;
        for pair in &pairs {
            pair.grains.into_iter().for_each(|grain| contacts[grain] += 1);
            let [a, b] = pair.grains.map(|grain| radii[grain]);
            overlap = overlap.max(pair.overlap / a.min(b));
        }
        let all: Vec<usize> = (0..state.len()).filter(|i| there(*i)).collect();
        let count = all.len().max(1) as f64;
        let free = all.iter().filter(|i| contacts[**i] == 0).count() as f64;
        let kinetic: f64 = all.iter().map(|i| 0.5 * state.mass()[*i] * state.velocity()[*i].length_squared()).sum();
        let (spins, moments) = (state.vector("angular_velocity"), state.vector("inertia"));
        let turning = |i: &usize| {
            let of = |list: Option<&[DVec3]>| list.and_then(|list| list.get(*i).copied()).unwrap_or_default();
            let facing = match state.get("orientation") {
                Some(Array::Vec4(all)) => all.get(*i).copied(),
                _ => None,
            };
            rotation::energy(facing.unwrap_or(glam::DVec4::W), of(spins), of(moments))
        };
        let rotational: f64 = all.iter().map(turning).sum();
        let top = all.iter().map(|i| state.position()[*i].z + radii.get(*i).copied().unwrap_or(0.0));
        let top = top.fold(f64::NEG_INFINITY, f64::max);
        let reach = all.iter().filter(|i| contacts[**i] > 0).map(|i| state.position()[*i].truncate().length());
        let reach = reach.fold(0.0, f64::max);
        let potential: f64 = state.energies()?.iter().sum();
        let dissipated: f64 = state.scalar("dissipated").unwrap_or_default().iter().sum();
        let total = kinetic + rotational + potential + dissipated;
        let [touches, free] = [2.0 * pairs.len() as f64 / count, free / count];
        let numbers = [touches, free, overlap, kinetic, rotational, potential, dissipated, total];
        let ends = [if all.is_empty() { 0.0 } else { top }, reach];
        let cells = numbers.into_iter().chain(ends).map(Into::into);
        Ok(vec![std::iter::once((all.len() as u64).into()).chain(cells).collect()])
    }
    fn recall(&mut self, _: u64, _: &[&str]) {}
}
