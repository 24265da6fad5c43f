//! The files that a law is joined with.

use super::{Law, Over};
use crate::error::Error;
use crate::kernel::{Problem, Source};

/// Files that are joined with a law that calls a function of theirs and does not define it.
const ON_CALL: [(&str, Source); 13] = [
    ("is_of", crate::shader!("law/species.wgsl")),
    ("unit", crate::shader!("law/steering.wgsl")),
    ("truncated", crate::shader!("law/steering.wgsl")),
    ("signed_distance", crate::shader!("solids/distance.wgsl")),
    ("pcg4d", crate::shader!("law/random.wgsl")),
    ("fraction", crate::shader!("law/random.wgsl")),
    ("circle", crate::shader!("law/circle.wgsl")),
    ("pair_index", crate::shader!("law/pair_index.wgsl")),
    ("even_ended", crate::shader!("law/truncation_square.wgsl")),
    ("even_ended", crate::shader!("law/truncation.wgsl")),
    ("ended", crate::shader!("law/truncation.wgsl")),
    ("touch", crate::shader!("grains/touch.wgsl")),
    ("bridged", crate::shader!("grains/bridge.wgsl")),
];

/// The function that adds two sums of a law.
pub(super) const MERGE: &str = "fn merge(total: ptr<function, Sum>, part: Sum)";

impl Law {
    /// Checks that a law with a `Sum` of its own adds two of them, for visits that evaluate parts of a sum.
    pub(super) fn requires_merge(&self) -> Result<(), Error> {
        if self.wgsl.law && self.wgsl.declares("Sum") {
            self.requires(&[("merge", MERGE)])?;
        }
        Ok(())
    }
    /// The file that stores its result.
    pub(super) fn result(&self) -> Source {
        match (self.accelerates(), self.over) {
            (false, _) => crate::shader!("slots/result/columns.wgsl"),
            (true, Over::Links) => crate::shader!("slots/result/first.wgsl"),
            (true, _) => crate::shader!("slots/result/added.wgsl"),
        }
    }
    /// The default `acts_on`, which includes all particles, for a law without one of its own.
    pub(super) fn choice(&self) -> Option<Source> {
        (!self.defines("acts_on")).then_some(crate::shader!("visit/acts_on_all.wgsl"))
    }
    /// Whether its file has the energy of a pair, from which its force follows: by the distance, or by its square.
    pub(super) fn is_potential(&self) -> bool {
        (self.wgsl.defines("energy") || self.is_even()) && !self.defines("gather")
    }
    /// Whether its file has the energy of a pair by the square of the distance.
    pub(super) fn is_even(&self) -> bool {
        self.wgsl.defines("even_energy")
    }
    /// The files with its sum over pairs, unless its own has one: that of a pair potential, or one of accelerations.
    pub(super) fn sums(&self) -> Vec<Source> {
        let mut files = Vec::new();
        if self.is_potential() {
            files.push(crate::shader!("visit/potential.wgsl"));
            files.push(if self.is_even() {
                crate::shader!("visit/potential_square.wgsl")
            } else {
                crate::shader!("visit/potential_distance.wgsl")
            });
            if !self.wgsl.defines("finish") {
                files.push(crate::shader!("visit/potential_finish.wgsl"));
            }
        } else if !self.own_files().any(|file| file.declares("Sum")) {
            files.push(crate::shader!("visit/sum.wgsl"));
        }
        files
    }
    /// The files with its sum over all pairs: compensated, where positions have two words and the sum is the usual one.
    pub(super) fn sums_over_all(&self, problem: &Problem) -> Vec<Source> {
        let usual = crate::shader!("visit/sum.wgsl");
        let sums = self.sums();
        if problem.precision.is_double() && sums.contains(&usual) {
            return vec![crate::shader!("integrators/two_sum.wgsl"), crate::shader!("visit/sum_compensated.wgsl")];
        }
        [sums, vec![crate::shader!("visit/gathered.wgsl")]].concat()
    }
    /// The law's own file and those that it relies on: a sum of accelerations, unless it has one, and the functions that it calls.
    pub(super) fn files(&self, problem: &Problem) -> Vec<Source> {
        self.files_with(if self.over == Over::Each { Vec::new() } else { self.sums() }, problem)
    }
    /// The same with these files for its sum.
    pub(super) fn files_with(&self, sums: Vec<Source>, problem: &Problem) -> Vec<Source> {
        let mut files = vec![self.turns()];
        files.extend(sums);
        for (function, file) in ON_CALL {
            if self.wgsl.needs(function) && !files.contains(&file) {
                files.push(file);
            }
        }
        if self.wgsl.needs("id_of") {
            files.push(problem.naming());
        }
        files.push(self.wgsl.clone());
        files.extend(self.beside.iter().cloned());
        files
    }
}
