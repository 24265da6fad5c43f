//! Mutants that no test can notice, because they do the same: a list with reasons, and what is held to it.

use std::fmt::Write as _;

use super::mutants::Mutant;

/// A change in certain lines of certain files.
#[derive(Debug, Clone, Copy)]
pub struct Equivalent {
    /// What the file's path contains.
    pub file: &'static str,
    /// What the line contains.
    pub line: &'static str,
    /// The token.
    pub old: &'static str,
    /// What it becomes.
    pub new: &'static str,
    /// Why it does the same.
    pub why: &'static str,
}

impl Equivalent {
    pub fn is(&self, file: &str, mutant: &Mutant) -> bool {
        let place = file.contains(self.file) && mutant.line.contains(self.line);
        place && mutant.old == self.old && mutant.new == self.new
    }
}

pub const fn same(
    file: &'static str,
    line: &'static str,
    old: &'static str,
    new: &'static str,
    why: &'static str,
) -> Equivalent {
    Equivalent { file, line, old, new, why }
}

/// What became of every mutant, held to a list.
pub struct Ledger<'a> {
    list: &'a [Equivalent],
    used: Vec<bool>,
    wrong: String,
    killed: usize,
    lived: usize,
}

impl<'a> Ledger<'a> {
    pub fn new(list: &'a [Equivalent]) -> Self {
        Self { list, used: vec![false; list.len()], wrong: String::new(), killed: 0, lived: 0 }
    }
    /// Whether a mutant is on the list.
    pub fn expects(&self, file: &str, mutant: &Mutant) -> bool {
        self.list.iter().any(|e| e.is(file, mutant))
    }
    /// A mutant that lives must be on the list, and one that is noticed must not.
    pub fn enter(&mut self, file: &str, mutant: &Mutant, noticed: bool) {
        let known = self.list.iter().position(|e| e.is(file, mutant));
        if let Some(known) = known {
            self.used[known] = true;
        }
        let what = match (noticed, known) {
            (true, None) | (false, Some(_)) => None,
            (false, None) => Some("no test notices it".to_owned()),
            (true, Some(k)) => Some(format!("it is noticed, although {}", self.list[k].why)),
        };
        let Mutant { line, column, old, new, .. } = mutant;
        if let Some(what) = what {
            let _ = writeln!(self.wrong, "{file}: column {column}: `{old}` → `{new}` in `{line}`: {what}");
        }
        if noticed { self.killed += 1 } else { self.lived += 1 }
    }
    /// Fails unless all was as the list says. `due` are the entries that this device could bring about, `least` is how
    /// many mutants must have been noticed.
    pub fn close(mut self, due: impl Fn(&Equivalent) -> bool, least: usize) {
        for (equivalent, _) in self.list.iter().zip(&self.used).filter(|(_, used)| !**used) {
            if due(equivalent) {
                let _ = writeln!(self.wrong, "{equivalent:?}: there is no such mutant any more");
            }
        }
        println!("{} mutants noticed, {} equivalent", self.killed, self.lived);
        assert!(self.wrong.is_empty(), "\n{}", self.wrong);
        assert!(self.killed > least, "{} mutants are too few to be all", self.killed);
    }
}
