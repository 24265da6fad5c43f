//! Ranges beyond half of a periodic box.

use super::Remark;
use crate::kernel::Side;
use crate::simulation::Setup;
use crate::visit::Law;

/// Laws of pairs that reach farther than half of the box: of each particle only the nearest image is a neighbour.
pub fn beyond(setup: &Setup, laws: &[Law]) -> Vec<Remark> {
    let (period, sides) = (setup.bounds.period(), setup.bounds.sides);
    let periodic = (0..3).filter(|axis| sides[*axis] == Side::Periodic && period[*axis] > 0.0);
    let Some((axis, half)) = periodic.map(|axis| (axis, 0.5 * period[axis])).min_by(|a, b| a.1.total_cmp(&b.1)) else {
        return Vec::new();
    };
    let of = |law: &Law| {
        let range = law.over.range().filter(|range| *range > half)?;
        let text = format!(
            "`{}` has a range of {range}, and half of the periodic box is {half} along {}: beyond it a particle has one image at most, the nearest",
            law.name,
            ["x", "y", "z"][axis]
        );
        let remark = Remark::warning("half-box", text).with("range", range).with("half", half);
        Some(remark.advice("choose a shorter range or a larger box"))
    };
    laws.iter().filter_map(of).collect()
}
