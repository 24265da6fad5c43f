//! The parts of a straight path that lie in slabs.

use glam::DVec3;

use super::{Slabs, axes};

impl Slabs {
    /// Calls `add` with each slab that a path reaches, at any of its images, and the part of it that lies there.
    pub fn path(&self, from: DVec3, way: DVec3, mut add: impl FnMut(usize, f64)) {
        let (from, period) = (self.place(from), self.bounds.period());
        let mut starts = vec![from];
        for axis in (0..axes(&self.bounds)).filter(|axis| period[*axis] > 0.0) {
            let shift = DVec3::AXES[axis] * period[axis];
            let end = from[axis] + way[axis];
            // What leaves on one side comes in on the other.
            let back = if end < self.bounds.low[axis] { shift } else { -shift };
            if end < self.bounds.low[axis] || end >= self.bounds.high[axis] {
                starts.extend(starts.clone().into_iter().map(|start| start + back));
            }
        }
        for start in starts {
            self.pieces(start, way, &mut add);
        }
    }
    fn pieces(&self, from: DVec3, way: DVec3, add: &mut impl FnMut(usize, f64)) {
        let whole = (0..axes(&self.bounds))
            .fold([0.0, 1.0], |part, axis| cut(part, [self.low[axis], self.high[axis]], from[axis], way[axis]));
        let Some(axis) = self.axis else {
            if whole[1] > whole[0] {
                add(0, whole[1] - whole[0]);
            }
            return;
        };
        let ends = whole.map(|t| self.number(axis, from[axis] + t * way[axis]));
        for slab in ends[0].min(ends[1])..=ends[0].max(ends[1]) {
            let [first, last] = cut(whole, [self.end(axis, slab), self.end(axis, slab + 1)], from[axis], way[axis]);
            if last > first {
                add(slab, last - first);
            }
        }
    }
}

/// The part of x + t v between two values, within a part.
fn cut([first, last]: [f64; 2], [low, high]: [f64; 2], x: f64, v: f64) -> [f64; 2] {
    if v == 0.0 {
        return if x >= low && x < high { [first, last] } else { [0.0, 0.0] };
    }
    let (a, b) = ((low - x) / v, (high - x) / v);
    [first.max(a.min(b)), last.min(a.max(b))]
}
