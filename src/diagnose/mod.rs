//! Remarks on a setup before it runs: forces out of the plane, conserved quantities, steps that springs and fluids do
//! not allow, particles that overlap, numbers that single precision loses.

mod advice;
mod baths;
mod births;
mod bonds;
mod collisions;
mod contradictions;
mod cosmology;
mod crowds;
mod far;
mod flow;
mod fluid;
mod grains;
mod images;
mod jumps;
mod rounding;
mod softenings;
mod solves;
mod steps;

use std::fmt;

#[doc(hidden)]
pub use advice::advice;
pub use advice::{Conserved, conserved};
#[doc(hidden)]
pub use births::forecast;
#[cfg(feature = "scene")]
pub(crate) use crowds::ways as have_ways;
#[doc(hidden)]
pub use flow::{flows, hurry};
#[doc(hidden)]
pub use steps::{culprit, digits, limit, others, unsafe_steps, way_out};

use crate::error::Error;
use crate::kernel::Machine;
use crate::simulation::Setup;
use crate::sph::Start;
use crate::stability::{Flow, Verdict};

/// The severity of a remark. A setup that cannot run is an error, not a remark.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// For information.
    Note,
    /// The run may fail, or its result may be wrong.
    Warning,
}

/// A remark on a setup. As text it is `text; advice`.
#[derive(Debug, Clone, PartialEq)]
pub struct Remark {
    /// A stable identifier of its subject, such as `rounded-motion` or `long-step`.
    pub id: &'static str,
    /// Its severity.
    pub severity: Severity,
    /// The subject, the number and the consequence.
    pub text: String,
    /// Its numbers by name, in units of the setup: `particle` (an id), `particles` (how many), `dt`, `largest_dt`, ….
    pub numbers: Vec<(&'static str, f64)>,
    /// A remedy, if there is one.
    pub advice: Option<String>,
}

impl Remark {
    fn note(id: &'static str, text: impl Into<String>) -> Self {
        Self { id, severity: Severity::Note, text: text.into(), numbers: Vec::new(), advice: None }
    }
    fn warning(id: &'static str, text: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, ..Self::note(id, text) }
    }
    fn with(mut self, name: &'static str, number: f64) -> Self {
        self.numbers.push((name, number));
        self
    }
    fn advice(self, way: impl Into<String>) -> Self {
        Self { advice: Some(way.into()), ..self }
    }
    /// One of its numbers.
    #[must_use]
    pub fn number(&self, name: &str) -> Option<f64> {
        self.numbers.iter().find(|(is, _)| *is == name).map(|(_, number)| *number)
    }
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)?;
        self.advice.as_ref().map_or(Ok(()), |way| write!(f, "; {way}"))
    }
}

/// The assumed number of steps where the length of a run is not given: modes that grow tenfold in these are unstable.
const STEPS: u64 = 10_000;

/// Validates a setup before it runs: the remarks of the command `motes check`, without those on its device.
///
/// # Errors
/// [`Error::Scene`] when it makes no sense, or could not but be lost: forces that lead out of the plane of a flat box, a fluid in steps
/// that are far too long, one that starts under a pressure that blows it apart, or a crowd whose contacts are unstable.
pub async fn diagnose(setup: &Setup) -> Result<Vec<Remark>, Error> {
    let setup = &*setup.in_its_box()?;
    let Judged { verdict, mut remarks, .. } = Judged::of(setup, STEPS).await?;
    remarks.extend(verdict.and_then(|verdict| unsafe_steps(&verdict, setup)));
    remarks.extend(advice(setup, None)?);
    Ok(remarks)
}

/// The stability of springs and fluids of a setup.
#[doc(hidden)]
pub struct Judged {
    /// The stability limit by springs, if there are any.
    pub verdict: Option<Verdict>,
    /// The initial state of its fluid, if there is one.
    pub start: Option<Start>,
    /// Lines about it.
    pub lines: Vec<String>,
    /// The remarks.
    pub remarks: Vec<Remark>,
}

impl Judged {
    /// For a setup that runs for `steps` steps.
    ///
    /// # Errors
    /// As of [`diagnose`].
    pub async fn of(setup: &Setup, steps: u64) -> Result<Self, Error> {
        let setup = &*setup.in_its_box()?;
        let build = || setup.integrator.in_fixed_steps();
        let (start, mut lines, mut remarks) = (setup.start()?, Vec::new(), Vec::new());
        if let Some(start) = &start {
            let (said, notes) = fluid::remarks(setup, start)?;
            lines = said;
            remarks.extend(notes);
        }
        if let Some(flow) = Flow::of(setup, &build).await? {
            lines.extend(flow::line(&flow, setup.dt));
            remarks.extend(flow::warning(&flow, setup)?);
        }
        remarks.extend(grains::remarks(setup));
        remarks.extend(crowds::remarks(setup)?);
        remarks.extend(softenings::all_zero(setup));
        remarks.extend(collisions::remarks(setup));
        remarks.extend(cosmology::remarks(setup, steps));
        let verdict = Verdict::of(setup, &build, steps).await?;
        Ok(Self { verdict, start, lines, remarks })
    }
}

/// Remarks that depend on a machine: trees or direct sums, and, in single precision, the rounding of motions and softenings.
///
/// # Errors
/// When the setup is invalid.
pub fn of_machine(setup: &Setup, machine: Machine, single: bool) -> Result<Vec<Remark>, Error> {
    let setup = &*setup.in_its_box()?;
    let rounded = if single { rounding::remarks(setup) } else { Vec::new() };
    Ok(far::remarks(setup, machine)?.into_iter().chain(rounded).collect())
}
