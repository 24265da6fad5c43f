//! Lights that add up.

use super::Style;

/// `glow`
pub struct Glow;

impl Style for Glow {}
