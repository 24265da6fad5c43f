//! Images of a periodic box: ranges beyond half of it, and charges of it as a whole.

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

/// A column that a uniform background neutralizes, and that does not add up to nothing by itself.
pub fn neutralized(setup: &Setup) -> Option<Remark> {
    let (force, name) = setup.forces.iter().find_map(|force| Some((force, force.properties().neutralized?)))?;
    let values = setup.state.scalar(name)?;
    let active = || values.iter().enumerate().filter(|(i, _)| setup.state.is_active(*i)).map(|(_, value)| *value);
    let (sum, size) = (active().sum::<f64>(), active().map(f64::abs).sum::<f64>());
    // Values of a file have six digits or so.
    let text = || {
        format!(
            "the column `{name}` adds up to {sum:.6}: the sums of `{}` over all images have a uniform background that neutralizes it, with an energy and a \
             pressure of its own",
            force.name()
        )
    };
    (sum.abs() > 1e-5 * size)
        .then(|| Remark::note("net-charge", text()).with("sum", sum).advice("see whether it is meant"))
}
