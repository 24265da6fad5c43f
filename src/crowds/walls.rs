//! Walls of a plan: their table for shaders, and the forces of all of them on a pedestrian.

use glam::{DVec2, DVec3};

use super::Press;
use crate::floor_plan::{FloorPlan, Segment};
use crate::kernel::Table;

/// The name of the table in WGSL.
pub(crate) const WALLS: &str = "walls";

/// The table of walls, each six words: its ends, bits for corners that stick out and for the end of a wall, and one that is not used.
pub(crate) fn table(plan: &FloorPlan) -> Table {
    #[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is what the device does")]
    let bits = |x: f64| (x as f32).to_bits();
    let all = plan.segments();
    let row = |(k, one): (usize, &Segment)| {
        let ends = all.get(k + 1).is_none_or(|next| next.wall != one.wall);
        let word = u32::from(one.out[0]) | u32::from(one.out[1]) << 1 | u32::from(ends) << 2;
        [bits(one.a.x), bits(one.a.y), bits(one.b.x), bits(one.b.y), word, 0]
    };
    let words: Vec<u32> = all.iter().enumerate().flat_map(row).collect();
    (WALLS.into(), words.into())
}

/// A plan as the device holds it: its walls rounded to single precision.
pub(crate) fn rounded(plan: &FloorPlan) -> Vec<Segment> {
    let single = |x: DVec2| x.as_vec2().as_dvec2();
    plan.segments().iter().map(|one| Segment { a: single(one.a), b: single(one.b), ..*one }).collect()
}

/// The force of walls in range on a pedestrian: of each the nearest point, if it is on its free side.
pub(crate) fn pushed(walls: &[Segment], press: &Press, range: f64, (x, v, radius): (DVec3, DVec3, f64)) -> DVec3 {
    let of_wall = |pieces: &[Segment]| {
        let mut nearest = (range, None);
        for piece in pieces {
            let found = piece.nearest(x.truncate());
            if found.way.length() < nearest.0 {
                nearest = (found.way.length(), Some(found));
            }
        }
        match nearest {
            (distance, Some(found)) if found.seen && distance > 0.0 => {
                press.force(radius - distance, (found.way / distance).extend(0.0), -v, 1.0)
            }
            _ => DVec3::ZERO,
        }
    };
    walls.chunk_by(|a, b| a.wall == b.wall).map(of_wall).sum()
}
