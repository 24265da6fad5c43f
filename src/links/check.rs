//! Validation of links.

use std::collections::BTreeSet;
use std::f64::consts::{PI, TAU};

use super::{Dihedral, Joint, Link, Links, MOST_LINKS, Rod};
use crate::error::Error;

impl Links {
    /// Checks that links connect existing particles, each pair once, with valid numbers.
    ///
    /// # Errors
    /// [`Error::Scene`] with the kind and the number of the first invalid link, counted from 0.
    pub fn check(&self, masses: &[f64]) -> Result<(), Error> {
        let mut pairs = BTreeSet::new();
        let mut degrees = vec![0u32; masses.len()];
        for (n, link) in self.springs.iter().enumerate() {
            let what = format!("spring {n}");
            apart(&what, &link.ends, masses)?;
            link.check(&what)?;
            twice(&what, link.ends, &mut pairs)?;
            for id in link.ends {
                degrees[id as usize] += 1;
            }
        }
        if let Some(id) = degrees.iter().position(|degree| *degree > MOST_LINKS) {
            let degree = degrees[id];
            return Err(Error::Scene(format!(
                "particle {id} has {degree} springs: {MOST_LINKS} are the most that one invocation sums"
            )));
        }
        let mut pairs = BTreeSet::new();
        for (n, rod) in self.rods.iter().enumerate() {
            let what = format!("rod {n}");
            apart(&what, &rod.ends, masses)?;
            rod.check(&what)?;
            twice(&what, rod.ends, &mut pairs)?;
        }
        let (mut bent, mut turned) = (BTreeSet::new(), BTreeSet::new());
        for (n, joint) in self.joints.iter().enumerate() {
            let what = format!("joint {n}");
            apart(&what, &joint.ids, masses)?;
            joint.check(&what)?;
            let [a, b, c] = joint.ids;
            if !bent.insert([a.min(c), b, a.max(c)]) {
                return Err(Error::Scene(format!(
                    "{what} bends particles {a}, {b} and {c}, as another one does: add up their stiffness"
                )));
            }
        }
        for (n, dihedral) in self.dihedrals.iter().enumerate() {
            let what = format!("dihedral {n}");
            apart(&what, &dihedral.ids, masses)?;
            dihedral.check(&what)?;
            let Dihedral { ids: [a, b, c, d], multiplicity, phase, .. } = *dihedral;
            let ends = if a < d { [a, b, c, d] } else { [d, c, b, a] };
            if !turned.insert((ends, multiplicity, phase.to_bits())) {
                return Err(Error::Scene(format!(
                    "{what} is the same term of particles {a}, {b}, {c} and {d} as another one: add up their stiffness"
                )));
            }
        }
        for (n, triangle) in self.triangles.iter().enumerate() {
            apart(&format!("triangle {n}"), triangle, masses)?;
        }
        Ok(())
    }
}

impl Link {
    /// Checks its numbers; `what` names it.
    ///
    /// # Errors
    /// [`Error::Scene`] where they are invalid.
    pub fn check(&self, what: &str) -> Result<(), Error> {
        let numbers = [("rest length", self.rest), ("stiffness", self.stiffness), ("damping", self.damping)];
        numbers.iter().try_for_each(|(name, x)| not_negative(what, name, *x))?;
        if self.stiffness == 0.0 && self.damping == 0.0 {
            let text = format!("{what} has neither stiffness nor damping, and has no effect: remove it");
            return Err(Error::Scene(text));
        }
        if self.rope && self.rest == 0.0 {
            return Err(Error::Scene(format!("{what} is a rope of length 0, which is never slack: make it a spring")));
        }
        Ok(())
    }
}

impl Rod {
    /// Checks its length; `what` names it.
    ///
    /// # Errors
    /// [`Error::Scene`] where it is invalid.
    pub fn check(&self, what: &str) -> Result<(), Error> {
        not_negative(what, "length", self.length)?;
        if self.length == 0.0 {
            return Err(Error::Scene(format!("{what} has length 0: merge its two particles")));
        }
        Ok(())
    }
}

impl Joint {
    /// Checks its numbers; `what` names it.
    ///
    /// # Errors
    /// [`Error::Scene`] where they are invalid.
    pub fn check(&self, what: &str) -> Result<(), Error> {
        not_negative(what, "stiffness", self.stiffness)?;
        if (0.0..=PI).contains(&self.rest) {
            return Ok(());
        }
        let angle = shown(180.0 - self.rest.to_degrees());
        Err(Error::Scene(format!("{what} has an angle of {angle}° at rest, and it is from 0° to 180° (straight)")))
    }
}

impl Dihedral {
    /// Checks its numbers; `what` names it.
    ///
    /// # Errors
    /// [`Error::Scene`] where they are invalid.
    pub fn check(&self, what: &str) -> Result<(), Error> {
        let Self { multiplicity, phase, .. } = self;
        not_negative(what, "stiffness", self.stiffness.abs())?;
        if !(1..=Self::MOST).contains(multiplicity) {
            let most = Self::MOST;
            let text = format!("{what} has the multiplicity {multiplicity}, and a turn has from 1 to {most} maxima");
            return Err(Error::Scene(text));
        }
        if phase.abs() <= TAU {
            return Ok(());
        }
        let phase = shown(phase.to_degrees());
        let text = format!("{what} has the phase {phase}°, and phases are from −360° to 360°: leave out whole turns");
        Err(Error::Scene(text))
    }
}

/// Checks that particles are distinct, exist and have mass.
fn apart(what: &str, ids: &[u32], masses: &[f64]) -> Result<(), Error> {
    for (place, id) in ids.iter().enumerate() {
        let Some(mass) = masses.get(*id as usize) else {
            let text =
                format!("{what} connects particle {id}, but there are {} particles: ids start at 0", masses.len());
            return Err(Error::Scene(text));
        };
        if ids[..place].contains(id) {
            return Err(Error::Scene(format!("{what} connects particle {id} to itself")));
        }
        if *mass == 0.0 {
            return Err(Error::Scene(format!(
                "{what} connects particle {id}, which has mass 0: give it a mass, or fix it"
            )));
        }
    }
    Ok(())
}

fn twice(what: &str, [a, b]: [u32; 2], pairs: &mut BTreeSet<[u32; 2]>) -> Result<(), Error> {
    if pairs.insert([a.min(b), a.max(b)]) {
        return Ok(());
    }
    Err(Error::Scene(format!("{what} connects particles {a} and {b}, which another link connects already: merge them")))
}

/// An angle without the digits that a unit has rounded.
fn shown(degrees: f64) -> f64 {
    (degrees * 1e9).round() / 1e9
}

fn not_negative(what: &str, name: &str, x: f64) -> Result<(), Error> {
    if x > 0.0 && x < f64::from(f32::MIN_POSITIVE) {
        return Err(Error::Scene(format!(
            "{what} has the {name} {x:e}, which is 0 in single precision: give 0, or a larger number"
        )));
    }
    if (0.0..=f64::from(f32::MAX)).contains(&x) {
        return Ok(());
    }
    Err(Error::Scene(format!("{what} has the {name} {x:e}, not a finite number, zero or above")))
}
