//! Mutants that no test can notice, because they do the same: a list with reasons, and what is held to it.

use std::collections::BTreeMap;
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
    /// Whether it may be noticed too: it takes longer than a driver waits, or what it reads is left to chance.
    pub sometimes: bool,
}

/// Mutants of a file that no test notices yet, at most: a number that may only fall. They are no equivalents.
#[derive(Debug, Clone, Copy)]
pub struct Open {
    /// The file.
    pub file: &'static str,
    /// How many.
    pub most: usize,
}

impl Equivalent {
    /// The same change, which may be noticed too.
    pub const fn sometimes(self) -> Self {
        Self { sometimes: true, ..self }
    }
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
    Equivalent { file, line, old, new, why, sometimes: false }
}

/// What became of every mutant, held to a list.
pub struct Ledger<'a> {
    list: &'a [Equivalent],
    open: &'a [Open],
    used: Vec<bool>,
    wrong: String,
    unnoticed: BTreeMap<String, Vec<String>>,
    killed: usize,
    lived: usize,
}

impl<'a> Ledger<'a> {
    pub fn new(list: &'a [Equivalent], open: &'a [Open]) -> Self {
        let (used, unnoticed) = (vec![false; list.len()], BTreeMap::new());
        Self { list, open, used, wrong: String::new(), unnoticed, killed: 0, lived: 0 }
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
        let Mutant { line, column, old, new, .. } = mutant;
        let change = format!("{file}: column {column}: `{old}` → `{new}` in `{line}`");
        match (noticed, known) {
            (true, None) | (false, Some(_)) => {}
            (true, Some(k)) if self.list[k].sometimes => {}
            (false, None) => self.unnoticed.entry(file.to_owned()).or_default().push(change),
            (true, Some(k)) => {
                let _ = writeln!(self.wrong, "{change}: it is noticed, although {}", self.list[k].why);
            }
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
        let mut open = 0;
        for (file, changes) in &self.unnoticed {
            let most = self.open.iter().find(|open| open.file == file).map_or(0, |open| open.most);
            open += changes.len();
            println!("{file}: no test notices {} yet, {most} at most", changes.len());
            if changes.len() > most {
                let _ = writeln!(self.wrong, "{file}: no test notices {} mutants, {most} at most:", changes.len());
                changes.iter().for_each(|change| self.wrong += &format!("  {change}\n"));
            }
        }
        println!("{} mutants noticed, {} equivalent, {open} that no test notices yet", self.killed, self.lived - open);
        assert!(self.wrong.is_empty(), "\n{}", self.wrong);
        assert!(self.killed > least, "{} mutants are too few to be all", self.killed);
    }
}
