//! Validation of links.

use std::collections::BTreeSet;

use super::{Link, Links, MOST_LINKS, Rod};
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
        for (n, joint) in self.joints.iter().enumerate() {
            let what = format!("joint {n}");
            apart(&what, &joint.ids, masses)?;
            not_negative(&what, "stiffness", joint.stiffness)?;
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
