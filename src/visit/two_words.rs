//! Differences of positions of two words, in place of those of the first words alone.

use std::sync::Arc;

use glam::DVec4;

use super::{Law, Over};
use crate::error::Error;
use crate::kernel::{Host, Kernel, POSITION, POSITION_LOW, Precision, Problem, Reference};

/// Refuses visits that form differences from the first words alone, where the precision promises those of both.
pub(super) fn check(law: &Law, over: Over, problem: &Problem) -> Result<(), Error> {
    let refines = matches!(over, Over::Each | Over::Pairs | Over::Within { .. } | Over::Tree { .. } | Over::Links);
    if problem.precision != Precision::DoubleSingle || refines {
        return Ok(());
    }
    Err(Error::Scene(format!(
        "precision = \"{}\" forms differences of positions from both of their words over \"pairs\", \"within\", \"tree\" and \"links\", and `{}` is over \
         \"{}\": choose one of those for it, or precision = \"{}\", with forces of the first words",
        problem.precision.name(),
        law.name,
        over.name(),
        Precision::Compensated.name()
    )))
}

/// The kernel of a law with its reference for positions of both words, where it forms differences from both.
pub(super) fn refined(kernel: Kernel, over: Over, problem: &Problem) -> Kernel {
    // The tree has places of its own, and a law of each particle alone reads the first words.
    let both = matches!(over, Over::Pairs | Over::Within { .. } | Over::Links);
    if problem.precision != Precision::DoubleSingle || !both {
        return kernel;
    }
    Kernel { reference: kernel.reference.map(of_both_words), ..kernel }
}

/// A reference that reads positions with their low words added: an f64 holds both.
fn of_both_words(reference: Reference) -> Reference {
    Arc::new(move |host: &Host| {
        let first: Vec<DVec4> = host.read(POSITION)?.to_vec();
        let low: Vec<DVec4> = host.read(POSITION_LOW)?.to_vec();
        host.write(POSITION)?.iter_mut().zip(low).for_each(|(x, rest)| *x += rest.with_w(0.0));
        let result = reference(host);
        host.write(POSITION)?.copy_from_slice(&first);
        result
    })
}
