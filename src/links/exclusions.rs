//! Pairs that are bonded, or a few bonds apart, and are left out of the interactions of pairs: in the terms of molecular dynamics 1–2,
//! 1–3 and 1–4 pairs.

use std::sync::Arc;

use super::{Network, WORDS};
use crate::error::Error;

/// The maximum number of bonds between the two of a pair that is left out.
const MOST_BONDS: u32 = 8;

/// The maximum number of particles that one does not interact with; a table of more takes more memory than the list itself.
const MOST_OTHERS: usize = 1024;

/// Why pairs up to so many bonds apart cannot be left out, if they cannot.
#[must_use]
pub fn too_many_bonds(bonds: f64) -> Option<String> {
    let why = || format!("exclude = {bonds}: pairs up to {MOST_BONDS} bonds apart can be left out; 3 is usual");
    (bonds > f64::from(MOST_BONDS)).then(why)
}

/// For each particle those that are at most so many bonds away, in the order of their ids; springs, ropes and rods are bonds.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Exclusions {
    /// The start of each particle's row, and the end.
    pub start: Arc<Vec<u32>>,
    /// The others.
    pub others: Arc<Vec<u32>>,
}

impl Exclusions {
    /// Those of `count` particles, of pairs up to `bonds` bonds apart.
    ///
    /// # Errors
    /// [`Error::Scene`] when a particle has more than 1024 of them.
    pub fn new(network: &Network, bonds: u32, count: u32) -> Result<Self, Error> {
        let mut partners: Vec<Vec<u32>> = vec![Vec::new(); count as usize];
        let mut join = |a: u32, b: u32| {
            if let Some(row) = partners.get_mut(a as usize).filter(|_| b < count) {
                row.push(b);
            }
        };
        let ends = network.link_start.windows(2).zip(0..);
        for (rows, id) in ends {
            let words = network.link.get(rows[0] as usize * WORDS..rows[1] as usize * WORDS).unwrap_or_default();
            words.chunks_exact(WORDS).for_each(|link| join(id, link[0]));
        }
        for rod in network.rods.iter() {
            let [a, b] = rod.ends;
            join(a, b);
            join(b, a);
        }
        let mut start = vec![0];
        let mut others = Vec::new();
        // The row that each particle was put into last.
        let mut row_of = vec![u32::MAX; count as usize];
        for id in 0..count {
            row_of[id as usize] = id;
            let first = others.len();
            others.push(id);
            let mut reached = first;
            for _ in 0..bonds {
                let end = others.len();
                for n in reached..end {
                    for other in &partners[others[n] as usize] {
                        if std::mem::replace(&mut row_of[*other as usize], id) != id {
                            others.push(*other);
                        }
                    }
                    if others.len() - first > MOST_OTHERS + 1 {
                        return Err(Error::Scene(format!(
                            "exclude = {bonds}: particle {id} has more than {MOST_OTHERS} others up to {bonds} bonds away: lower `exclude`, or give \
                             particles fewer bonds"
                        )));
                    }
                }
                reached = end;
            }
            // A particle is not its own neighbour.
            others.swap_remove(first);
            others[first..].sort_unstable();
            let Ok(end) = u32::try_from(others.len()) else {
                return Err(Error::Scene(format!(
                    "exclude = {bonds} leaves out more than {} pairs: lower `exclude`",
                    u32::MAX
                )));
            };
            start.push(end);
        }
        Ok(Self { start: Arc::new(start), others: Arc::new(others) })
    }
    /// Whether a pair is left out, by both indices.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "an index fits 32 bits")]
    pub fn has(&self, id: usize, other: usize) -> bool {
        !self.others.is_empty() && self.of(id as u32).binary_search(&(other as u32)).is_ok()
    }
    /// Those that a particle does not interact with.
    #[must_use]
    pub fn of(&self, id: u32) -> &[u32] {
        let at = |id: usize| self.start.get(id).map_or(0, |n| *n as usize);
        self.others.get(at(id as usize)..at(id as usize + 1)).unwrap_or_default()
    }
}
