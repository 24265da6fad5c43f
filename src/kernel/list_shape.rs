//! The list of neighbours of a problem, as numbers: what kernels that build it and kernels that read it agree on.

/// The list of neighbours that all laws over it share.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ListShape {
    /// The longest range of a law \[length\].
    pub range: f64,
    /// How much farther the list reaches \[length\].
    pub skin: f64,
    /// Words of history that are kept for each pair.
    pub words: u32,
    /// Neighbours of one particle that there is room for: a multiple of four.
    pub capacity: u32,
}

impl ListShape {
    /// The range and the skin \[length\].
    #[must_use]
    pub fn reach(&self) -> f64 {
        self.range + self.skin
    }
    /// The same with room for some more than so many neighbours, of so many particles.
    #[must_use]
    pub fn with_room(self, neighbors: u32, particles: u32) -> Self {
        let others = particles.saturating_sub(1).max(1);
        // Half as many more, and some for particles that have few.
        let wanted = neighbors.saturating_add(neighbors / 2).saturating_add(8);
        Self { capacity: wanted.min(others).div_ceil(4) * 4, ..self }
    }
}
