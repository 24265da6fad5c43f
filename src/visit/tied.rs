//! The tables of links as a twin reads them.

use crate::error::Error;
use crate::kernel::{Host, Reading};
use crate::links::{Half, WORDS};

/// The tables of links, whichever there are.
pub(crate) enum Tied<'a> {
    /// Every link with all that it is.
    Each { start: Reading<'a, u32>, link: Reading<'a, u32> },
    /// Nobody is tied: a host of a few particles that somebody asks about.
    None,
    /// Partners, kind by kind.
    Alike { start: Reading<'a, u32>, partner: Reading<'a, u32>, kinds: Vec<Half> },
}

impl<'a> Tied<'a> {
    /// Those of a host.
    pub fn of(host: &'a Host) -> Result<Self, Error> {
        if host.contains("link") {
            return Ok(Self::Each { start: host.reading("link_start")?, link: host.reading("link")? });
        }
        if !host.contains("link_kind") {
            return Ok(Self::None);
        }
        let kinds = host.reading::<u32>("link_kind")?.chunks_exact(WORDS).map(Half::new).collect();
        Ok(Self::Alike { start: host.reading("partner_start")?, partner: host.reading("partner")?, kinds })
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
