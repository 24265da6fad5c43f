//! Links as kernels see them: compressed adjacency, each element stored with each of its particles, in the order of the
//! partners' ids, so that sums have one order and nothing is written twice.

use std::sync::Arc;

use super::{Joint, Link, Links, Rod};

/// Links that one particle may have: one invocation loops over them, and 65 535 trips are the most that every driver does.
pub const MOST_LINKS: u32 = 60_000;

/// The tables of some links. A table of starts has one word for each particle, and one behind the last.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Network {
    /// How many particles.
    pub count: u32,
    /// Where each particle's springs begin.
    pub link_start: Arc<Vec<u32>>,
    /// Four words for each end of a spring: partner, and as `f32` the rest length (negative: a rope), stiffness, damping.
    pub link: Arc<Vec<u32>>,
    /// Where each particle's joints begin.
    pub joint_start: Arc<Vec<u32>>,
    /// Five words for each corner: the three ids, which of them one is, and as `f32` the stiffness.
    pub joint: Arc<Vec<u32>>,
    /// Where each particle's triangles begin.
    pub triangle_start: Arc<Vec<u32>>,
    /// Five words for each corner, as for joints; the last is zero.
    pub triangle: Arc<Vec<u32>>,
    /// The rods. How they make chains depends on who is held.
    pub rods: Arc<Vec<Rod>>,
}

#[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is what the device does")]
pub(super) fn bits(x: f64) -> u32 {
    (x as f32).to_bits()
}

impl Network {
    /// The tables of links among `count` particles.
    #[must_use]
    pub fn new(count: u32, links: &Links) -> Self {
        let ends = links.springs.iter().flat_map(|link| [(link.ends[0], half(link, 1)), (link.ends[1], half(link, 0))]);
        let (link_start, link) = rows(count, ends.collect());
        let corners = |ids: [u32; 3], stiffness: f64| {
            [0u32, 1, 2].map(|place| (ids[place as usize], [ids[0], ids[1], ids[2], place, bits(stiffness)]))
        };
        let joints = links.joints.iter().flat_map(|Joint { ids, stiffness }| corners(*ids, *stiffness));
        let (joint_start, joint) = rows(count, joints.collect());
        let triangles = links.triangles.iter().flat_map(|ids| corners(*ids, 0.0));
        let (triangle_start, triangle) = rows(count, triangles.collect());
        Self {
            count,
            link_start,
            link,
            joint_start,
            joint,
            triangle_start,
            triangle,
            rods: Arc::new(links.rods.clone()),
        }
    }
    /// How many springs there are, each counted from both ends.
    #[must_use]
    pub fn ends(&self) -> u32 {
        self.link_start.last().copied().unwrap_or(0)
    }
}

/// A spring from one of its ends.
fn half(link: &Link, partner: usize) -> [u32; 4] {
    let rest = if link.rope { -link.rest } else { link.rest };
    [link.ends[partner], bits(rest), bits(link.stiffness), bits(link.damping)]
}

/// Sorts elements by their particle, and within one by their words, of which the first are ids.
fn rows<const N: usize>(count: u32, mut elements: Vec<(u32, [u32; N])>) -> (Arc<Vec<u32>>, Arc<Vec<u32>>) {
    elements.sort_unstable();
    let mut start = vec![0; count as usize + 1];
    for (id, _) in &elements {
        if let Some(n) = start.get_mut(*id as usize + 1) {
            *n += 1;
        }
    }
    let mut sum = 0;
    for n in &mut start {
        sum += *n;
        *n = sum;
    }
    (Arc::new(start), Arc::new(elements.into_iter().flat_map(|(_, words)| words).collect()))
}
