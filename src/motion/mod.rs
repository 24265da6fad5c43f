//! What moves by itself, whatever forces say: particles that are held, and the motions that lead them.

/// A particle that forces do not move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Held {
    /// Its id.
    pub id: u32,
    /// What it does instead.
    pub by: Hold,
}

/// What a particle does that forces do not move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hold {
    /// It stays where it is.
    Fixed,
    /// It goes where the field `target` says.
    Target,
    /// It goes along with a motion, by the motion's number.
    Motion(u32),
}
