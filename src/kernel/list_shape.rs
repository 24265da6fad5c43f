//! The shape of the neighbour list of a problem: the numbers that kernels which build it and kernels which read it share.

/// The neighbour list that all laws over it share.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ListShape {
    /// The longest range of a law \[length\].
    pub range: f64,
    /// The distance by which the list exceeds the range \[length\].
    pub skin: f64,
    /// Words of history of each pair.
    pub words: u32,
    /// Pairs up to so many bonds apart are left out; 0: none.
    pub exclude: u32,
    /// Whether no law names a skin, so that a simulation chooses one while it runs.
    pub tuned: bool,
    /// The number of neighbours of one particle that there is room for: a multiple of four.
    pub capacity: u32,
}

impl ListShape {
    /// The range and the skin \[length\].
    #[must_use]
    pub fn reach(&self) -> f64 {
        self.range + self.skin
    }
    /// The same with room for more than `neighbors` neighbours of each of `particles` particles.
    #[must_use]
    pub fn with_room(self, neighbors: u32, particles: u32) -> Self {
        let others = particles.saturating_sub(1).max(1);
        // One and a half times as many, plus 8 for particles with few.
        let wanted = neighbors.saturating_add(neighbors / 2).saturating_add(8);
        Self { capacity: wanted.min(others).div_ceil(4) * 4, ..self }
    }
}
