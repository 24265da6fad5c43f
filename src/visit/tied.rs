//! The tables of links as a reference reads them.

use super::{LINK, LINK_START};
use crate::error::Error;
use crate::kernel::{Host, Problem, Reading, Source};
use crate::links::{Half, WORDS};

/// The tables of links that a kernel binds, and its reference reads. They are determined by the problem, since the host also has the tables
/// of pictures and solvers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tables {
    /// None: a law is evaluated for a few particles, outside any problem.
    None,
    /// One row for each link.
    Each,
    /// Partners, by kind, where there are few kinds of springs and none of them breaks.
    Alike,
}

impl Tables {
    /// The tables of a visit over links.
    #[must_use]
    pub fn of(problem: &Problem) -> Self {
        if !problem.breaks && problem.network.alike() { Self::Alike } else { Self::Each }
    }
    /// The shader that reads them.
    #[must_use]
    pub fn file(self) -> Source {
        match self {
            Self::Alike => crate::shader!("visit/link_partners.wgsl"),
            Self::Each | Self::None => crate::shader!("visit/link_table.wgsl"),
        }
    }
}

/// The tables of links on a host.
pub(crate) enum Tied<'a> {
    /// No links.
    None,
    /// Every link with all its parameters.
    Each { start: Reading<'a, u32>, link: Reading<'a, u32> },
    /// Partners, by kind.
    Alike { start: Reading<'a, u32>, partner: Reading<'a, u32>, kinds: Vec<Half> },
}

impl<'a> Tied<'a> {
    /// The tables of a host.
    ///
    /// # Errors
    /// When the host does not have them.
    pub fn of(host: &'a Host, tables: Tables) -> Result<Self, Error> {
        Ok(match tables {
            Tables::None => Self::None,
            Tables::Each => Self::Each { start: host.reading(LINK_START)?, link: host.reading(LINK)? },
            Tables::Alike => {
                let kinds = host.reading::<u32>("link_kind")?.chunks_exact(WORDS).map(Half::new).collect();
                Self::Alike { start: host.reading("partner_start")?, partner: host.reading("partner")?, kinds }
            }
        })
    }
    /// The links of a particle.
    pub fn halves(&self, id: usize) -> Vec<Half> {
        match self {
            Self::None => Vec::new(),
            Self::Each { start, link } => row(start, link, id, WORDS).map(Half::new).collect(),
            Self::Alike { start, partner, kinds } => {
                let of = |(kind, half): (usize, &Half)| {
                    let partners = row(start, partner, id * kinds.len() + kind, 1);
                    let half = *half;
                    partners.map(move |words| Half { partner: words[0] as usize, ..half }).collect::<Vec<_>>()
                };
                kinds.iter().enumerate().flat_map(of).collect()
            }
        }
    }
}

/// The elements of a row of a table.
pub fn row<'a>(start: &[u32], table: &'a [u32], row: usize, words: usize) -> impl Iterator<Item = &'a [u32]> {
    let [from, to] = [row, row + 1].map(|place| start.get(place).map_or(0, |n| *n as usize) * words);
    table.get(from..to).unwrap_or_default().chunks_exact(words)
}
