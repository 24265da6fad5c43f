//! Parameters of pairs of species: a symmetric table that must contain every pair.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::error::Error;
use crate::kernel::{Access, Binding, Scalar, Table};
use crate::settings::Pair;

/// The name of the table in WGSL: `var<storage, read> pair_table: array<Pair>`, or, where a law has no storage buffer to spare,
/// `var<uniform> pair_table: array<Pair, 64>` for 8 species. The row of species a and b has the index `a * species + b`, with `species` the
/// number of rows on a side: `pair_index(a, b)` returns it.
pub const PAIR_TABLE: &str = "pair_table";
/// The maximum number of species of a table.
pub const MOST_SPECIES: u32 = 256;

/// Parameters of pairs of species.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PairTable {
    /// The two species, in any order, and the members of `Pair` by name.
    pub rows: Vec<PairRow>,
}

/// The parameters of one pair of species.
#[derive(Debug, Clone, PartialEq)]
pub struct PairRow {
    /// The two species, in any order.
    pub species: [u32; 2],
    /// The members of `Pair`, by name.
    pub values: Vec<(String, Scalar)>,
}

impl PairRow {
    /// The two species, the lower one first.
    #[must_use]
    pub fn pair(&self) -> [u32; 2] {
        let [a, b] = self.species;
        [a.min(b), a.max(b)]
    }
}

impl From<&[Pair]> for PairTable {
    fn from(pairs: &[Pair]) -> Self {
        let values = |pair: &Pair| pair.values.iter().map(|(name, x)| (name.clone(), Scalar::Float(*x))).collect();
        Self { rows: pairs.iter().map(|pair| PairRow { species: pair.species, values: values(pair) }).collect() }
    }
}

impl PairTable {
    /// The missing pairs of some species, each with the lower one first.
    #[must_use]
    pub fn missing(&self, present: &[u32]) -> Vec<[u32; 2]> {
        let present: BTreeSet<u32> = present.iter().copied().collect();
        let given: BTreeSet<[u32; 2]> = self.rows.iter().map(PairRow::pair).collect();
        let all = present.iter().flat_map(|a| present.range(a..).map(|b| [*a, *b]));
        all.filter(|pair| !given.contains(pair)).collect()
    }
    /// Rows on a side: one more than the highest species of the table or of the particles.
    #[must_use]
    pub fn side(&self, present: &[u32]) -> u32 {
        self.rows
            .iter()
            .flat_map(|row| row.species)
            .chain(present.iter().copied())
            .max()
            .map_or(1, |n| n.saturating_add(1))
    }
    /// Whether all pairs of all its species have the same parameters: the first row of the table serves them all.
    #[must_use]
    pub fn is_alike(&self) -> bool {
        let side = self.side(&[]) as usize;
        let same = self.rows.windows(2).all(|rows| rows[0].values == rows[1].values);
        same && self.rows.len() == side * (side + 1) / 2
    }
    /// The words of the table, for the species that particles have.
    ///
    /// # Errors
    /// [`Error::Scene`] that names a pair that is missing, given twice, or beyond the maximum species.
    pub fn words(&self, law: &str, binding: &Binding, present: &[u32]) -> Result<Table, Error> {
        let side = self.side(present);
        if side > MOST_SPECIES {
            return Err(Error::Scene(format!(
                "`{law}` has a table over pairs of {side} species: {MOST_SPECIES} are the most; number species from 0 on"
            )));
        }
        let size = binding.packed.size;
        let mut bytes = vec![0u8; size * (side * side) as usize];
        let mut given = vec![false; (side * side) as usize];
        for row in &self.rows {
            let [a, b] = row.species;
            let values: Vec<_> = row.values.iter().map(|(name, value)| (name.as_str(), *value)).collect();
            let packed = binding.packed.pack(&format!("the pair of species {a} and {b} of `{law}`"), &values)?;
            let place = (a * side + b) as usize;
            if given[place] {
                return Err(Error::Scene(format!("`{law}` has the pair of species {a} and {b} twice: remove one")));
            }
            for place in [a * side + b, b * side + a].map(|place| place as usize) {
                given[place] = true;
                bytes[place * size..(place + 1) * size].copy_from_slice(&packed);
            }
        }
        let missing = self.missing(present);
        if !missing.is_empty() {
            let rows: Vec<_> = missing.iter().map(|[a, b]| format!("{{ species = [{a}, {b}], … }}")).collect();
            let pairs: Vec<_> = missing.iter().map(|[a, b]| format!("species {a} and {b}")).collect();
            return Err(Error::Scene(format!(
                "`{law}` has no parameters for particles of {}: add {} to its pairs",
                pairs.join(", of "),
                rows.join(", ")
            )));
        }
        // A uniform block has the size declared in its shader.
        if binding.access == Access::Uniform {
            let room = usize::try_from(binding.stride).unwrap_or(0);
            if bytes.len() > room {
                return Err(Error::Scene(format!(
                    "`{law}` has a table over pairs of {side} species, and room for {}: number species from 0 on, or have fewer",
                    (room / size.max(1)).isqrt()
                )));
            }
            bytes.resize(room, 0);
        }
        let words =
            bytes.chunks_exact(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]])).collect();
        Ok((PAIR_TABLE.into(), Arc::new(words)))
    }
}
