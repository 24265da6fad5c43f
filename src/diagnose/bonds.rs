//! Bonds that are too long at the start.

use super::Remark;
use crate::simulation::Setup;
use crate::visit::Law;

/// The first bond that is as long as its law admits, or longer.
pub fn overlong(setup: &Setup, laws: &[Law]) -> Option<Remark> {
    let longest = laws.iter().filter_map(|law| law.longest).fold(f64::INFINITY, f64::min);
    let state = &setup.state;
    let length = |ends: [u32; 2]| {
        let [a, b] = ends.map(|id| state.position().get(id as usize).copied().unwrap_or_default());
        setup.bounds.shortest(b - a).length()
    };
    let long = |ends: [u32; 2]| length(ends) >= longest;
    let mut bonds = state.links.springs.iter().filter(|link| link.stiffness > 0.0 && long(link.ends));
    let (first, more) = (bonds.next()?, bonds.count());
    let ids = state.ids();
    let [a, b] = first.ends.map(|row| ids.get(row as usize).copied().unwrap_or(row));
    let others = if more > 0 { format!(", and {more} others are too long as well") } else { String::new() };
    let text = format!(
        "the bond of particles {a} and {b} is {:.4} long at the start, and its energy is infinite at {longest}{others}: the run will end at step 0",
        length(first.ends)
    );
    let remark = Remark::warning("overlong-bond", text).with("length", length(first.ends)).with("max_length", longest);
    Some(remark.advice("start with shorter bonds, or set a larger max_length"))
}
