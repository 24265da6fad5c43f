//! Outlines within each other: a hole is in a floor, and a floor in a hole, or neither is in the other.

use super::ring::Ring;

/// Refuses outlines of floors within floors, and of holes within holes. No two cross or touch.
pub fn check(rings: &[Ring]) -> Result<(), String> {
    for (ring, place) in rings.iter().zip(0..) {
        let Some(at) = ring.points.first().copied() else { continue };
        let around = rings.iter().enumerate().filter(|(other, around)| *other != place && around.holds(at));
        let around: Vec<&Ring> = around.map(|(_, around)| around).collect();
        if (around.len() % 2 == 1) == ring.hole {
            continue;
        }
        let next = around.iter().min_by(|a, b| a.area().total_cmp(&b.area()));
        let (Some(next), name) = (next, &ring.name) else { continue };
        let way = if ring.hole {
            "remove the inner one; a floor inside of a hole is a POLYGON of its own"
        } else {
            "make it a hole of that, or remove it"
        };
        return Err(format!("{name} is within {} at {} {}: {way}", next.name, at.x, at.y));
    }
    Ok(())
}
