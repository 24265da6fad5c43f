//! Rods as chains: open sequences of particles. Fixed particles cannot be moved, so that chains end at them.

use super::Rod;
use crate::error::Error;

/// The maximum number of rods in one chain: one invocation iterates over it 24 times, and some drivers end loops after 65 535 iterations.
pub const MOST_RODS: u32 = 2_700;

/// A particle in a chain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Node {
    /// Its id.
    pub id: u32,
    /// Whether it is fixed or kinematic.
    pub held: bool,
    /// The length of the rod from the previous particle; 0 for the first one \[length\].
    pub length: f64,
}

/// Chains of rods, each by its particles in order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Chains(pub Vec<Vec<Node>>);

impl Chains {
    /// Sorts rods into chains. A rod without a mobile end belongs to no chain.
    ///
    /// # Errors
    /// [`Error::Scene`] with the particle where they branch or close, with the rod that cannot move, or with the length of a chain that is
    /// too long.
    pub fn new(rods: &[Rod], held: &[u32]) -> Result<Self, Error> {
        let mut held = held.to_vec();
        held.sort_unstable();
        let held = |id: u32| held.binary_search(&id).is_ok();
        let both = |(n, rod): (usize, &Rod)| [(rod.ends[0], n), (rod.ends[1], n)];
        let mut ends: Vec<(u32, usize)> = rods.iter().enumerate().flat_map(both).collect();
        ends.sort_unstable();
        if let Some(n) = rods.iter().position(|rod| rod.ends.iter().all(|id| held(*id))) {
            return Err(Error::Scene(format!("rod {n} connects two fixed particles, and has no effect: remove it")));
        }
        let of = |id: u32| {
            let from = ends.partition_point(|(other, _)| *other < id);
            &ends[from..from + ends[from..].partition_point(|(other, _)| *other == id)]
        };
        let mut walked = vec![false; rods.len()];
        let mut chains = Vec::new();
        for (id, n) in &ends {
            let degree = of(*id).len();
            if degree > 2 && !held(*id) {
                return Err(Error::Scene(format!(
                    "particle {id} has {degree} rods: rods make open chains, in which a particle has one or two, unless it is \
                     fixed; make one of them a stiff spring"
                )));
            }
            if walked[*n] || degree == 2 && !held(*id) {
                continue;
            }
            let mut chain = vec![Node { id: *id, held: held(*id), length: 0.0 }];
            let (mut id, mut next) = (*id, Some(*n));
            while let Some(n) = next {
                walked[n] = true;
                let [a, b] = rods[n].ends;
                id = if a == id { b } else { a };
                chain.push(Node { id, held: held(id), length: rods[n].length });
                next = of(id).iter().map(|(_, other)| *other).find(|other| *other != n && !held(id));
            }
            if chain.len() > MOST_RODS as usize + 1 {
                return Err(Error::Scene(format!(
                    "a chain from particle {} to particle {id} has {} rods: {MOST_RODS} are the most that one invocation \
                     solves; fix a particle of the chain, or make a rod a stiff spring",
                    chain[0].id,
                    chain.len() - 1
                )));
            }
            chains.push(chain);
        }
        if let Some(n) = walked.iter().position(|walked| !walked) {
            return Err(Error::Scene(format!(
                "the rods through particle {} make a closed loop: rods make open chains; fix a particle of it, or make one \
                 of its rods a stiff spring",
                rods[n].ends[0]
            )));
        }
        Ok(Self(chains))
    }
    /// The number of chains.
    #[must_use]
    pub fn len(&self) -> usize {
        self.0.len()
    }
    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
    /// The index of the first node of each chain, and the number of nodes.
    #[must_use]
    pub fn starts(&self) -> Vec<u32> {
        let mut starts = vec![0];
        for chain in &self.0 {
            let last = starts.last().copied().unwrap_or(0);
            starts.push(last + u32::try_from(chain.len()).unwrap_or(u32::MAX));
        }
        starts
    }
    /// Three words for each node: the id, whether it is fixed, and as `f32` the length.
    #[must_use]
    pub fn words(&self) -> Vec<u32> {
        let words = |node: &Node| [node.id, u32::from(node.held), super::network::bits(node.length)];
        self.0.iter().flatten().flat_map(words).collect()
    }
}
