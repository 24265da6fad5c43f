//! Links as tables for kernels: compressed adjacency, each element stored with each of its particles, in the order of the partners' ids, so
//! that sums have one order and no value is written by two invocations.

use std::sync::Arc;

use super::{Dihedral, Half, Joint, Link, Links, Rod, WORDS};

/// The maximum number of links of a particle: one invocation loops over them, and some drivers end loops after 65 535 iterations.
pub const MOST_LINKS: u32 = 60_000;

/// The maximum number of kinds of springs stored by kind; see `shaders/visit/link_partners.wgsl`.
const MOST_KINDS: usize = 4;

/// The tables of some links. A table of starts has one word for each particle, and one more for the end.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Network {
    /// The number of particles.
    pub count: u32,
    /// The start of each particle's springs.
    pub link_start: Arc<Vec<u32>>,
    /// Four words for each end of a spring: partner, and as `f32` the rest length (negative: a rope), stiffness, damping.
    pub link: Arc<Vec<u32>>,
    /// The start of each particle's springs of each of four kinds, if there are no more; otherwise empty.
    pub partner_start: Arc<Vec<u32>>,
    /// The partners, in the same order.
    pub partner: Arc<Vec<u32>>,
    /// The kinds: four words as in `link`, the first of which is unused.
    pub kind: Arc<Vec<u32>>,
    /// The start of each particle's joints.
    pub joint_start: Arc<Vec<u32>>,
    /// Six words for each corner: the three ids, the index of the particle among them, and as `f32` the stiffness and the angle at rest.
    pub joint: Arc<Vec<u32>>,
    /// The start of each particle's dihedrals.
    pub dihedral_start: Arc<Vec<u32>>,
    /// Nine words for each corner: the four ids, the index of the particle among them, the multiplicity, and as `f32` the stiffness,
    /// and cosine and sine of the phase.
    pub dihedral: Arc<Vec<u32>>,
    /// The start of each particle's triangles.
    pub triangle_start: Arc<Vec<u32>>,
    /// Six words for each corner, as for joints; the last two are zero.
    pub triangle: Arc<Vec<u32>>,
    /// The rods. Their division into chains depends on which particles are fixed.
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
        let ends: Vec<_> = ends.collect();
        let [partner_start, partner, kind] = alike(count, &ends);
        let (link_start, link) = rows(count, ends);
        let corners = |ids: [u32; 3], stiffness: f64, rest: f64| {
            [0u32, 1, 2]
                .map(|place| (ids[place as usize], [ids[0], ids[1], ids[2], place, bits(stiffness), bits(rest)]))
        };
        let joints = links.joints.iter().flat_map(|Joint { ids, stiffness, rest }| corners(*ids, *stiffness, *rest));
        let (joint_start, joint) = rows(count, joints.collect());
        let (dihedral_start, dihedral) = rows(count, links.dihedrals.iter().flat_map(twisted).collect());
        let triangles = links.triangles.iter().flat_map(|ids| corners(*ids, 0.0, 0.0));
        let (triangle_start, triangle) = rows(count, triangles.collect());
        let rods = Arc::new(links.rods.clone());
        Self {
            count,
            link_start,
            link,
            partner_start,
            partner,
            kind,
            joint_start,
            joint,
            dihedral_start,
            dihedral,
            triangle_start,
            triangle,
            rods,
        }
    }
    /// Whether there are few kinds of springs.
    #[must_use]
    pub fn alike(&self) -> bool {
        !self.partner.is_empty()
    }
    /// Whether any spring is damped.
    #[must_use]
    pub fn damped(&self) -> bool {
        self.link.chunks_exact(WORDS).any(|words| words[3] != 0)
    }
    /// The number of springs, each counted from both ends.
    #[must_use]
    pub fn ends(&self) -> u32 {
        self.link_start.last().copied().unwrap_or(0)
    }
}

impl Links {
    /// The same links without broken springs, by the words of the table of their network.
    #[must_use]
    pub fn intact(&self, network: &Network, table: &[u32]) -> Self {
        let holds = |link: &&Link| {
            let [a, b] = link.ends;
            let row = |id: u32| network.link_start.get(id as usize).map_or(0, |n| *n as usize);
            let words = table.get(row(a) * WORDS..row(a + 1) * WORDS).unwrap_or_default().chunks_exact(WORDS);
            words.map(Half::new).any(|half| half.partner == b as usize && !half.is_broken())
        };
        Self { springs: self.springs.iter().filter(holds).copied().collect(), ..self.clone() }
    }
}

/// A spring as seen from one of its ends.
fn half(link: &Link, partner: usize) -> [u32; 4] {
    let rest = if link.rope { -link.rest } else { link.rest };
    [link.ends[partner], bits(rest), bits(link.stiffness), bits(link.damping)]
}

/// A dihedral as seen from each of its corners.
fn twisted(of: &Dihedral) -> [(u32, [u32; 9]); 4] {
    let [a, b, c, d] = of.ids;
    let [cosine, sine] = [libm::cos(of.phase), libm::sin(of.phase)].map(bits);
    [0u32, 1, 2, 3]
        .map(|place| (of.ids[place as usize], [a, b, c, d, place, of.multiplicity, bits(of.stiffness), cosine, sine]))
}

/// The tables of springs by their kind, if there are few.
fn alike(count: u32, ends: &[(u32, [u32; WORDS])]) -> [Arc<Vec<u32>>; 3] {
    if ends.is_empty() {
        return Default::default();
    }
    let mut kinds: Vec<[u32; 3]> = Vec::new();
    let mut sorted = Vec::with_capacity(ends.len());
    for (id, [partner, rest, stiffness, damping]) in ends {
        let own = [*rest, *stiffness, *damping];
        let kind = kinds.iter().position(|known| *known == own).unwrap_or_else(|| {
            kinds.push(own);
            kinds.len() - 1
        });
        if kind == MOST_KINDS {
            return Default::default();
        }
        sorted.push((u64::from(*id) * MOST_KINDS as u64 + kind as u64, *partner));
    }
    sorted.sort_unstable();
    // Unused kinds have no springs.
    kinds.resize(MOST_KINDS, [0; 3]);
    let mut start = vec![0; (count as usize + 1) * MOST_KINDS + 1];
    for (key, _) in &sorted {
        let [id, kind] = [key / MOST_KINDS as u64, key % MOST_KINDS as u64].map(|k| usize::try_from(k).unwrap_or(0));
        start[id * MOST_KINDS + kind + 1] += 1;
    }
    accumulate(&mut start);
    start.pop();
    let words = kinds.into_iter().flat_map(|[rest, stiffness, damping]| [0, rest, stiffness, damping]).collect();
    [start, sorted.into_iter().map(|(_, partner)| partner).collect(), words].map(Arc::new)
}

fn accumulate(start: &mut [u32]) {
    let mut sum = 0;
    for n in start {
        sum += *n;
        *n = sum;
    }
}

/// Sorts elements by their particle, and for each particle by their words, the first of which are ids.
fn rows<const N: usize>(count: u32, mut elements: Vec<(u32, [u32; N])>) -> (Arc<Vec<u32>>, Arc<Vec<u32>>) {
    let mut start = vec![0; count as usize + 1];
    if elements.is_empty() {
        // Zeros that are never written take no memory.
        return (Arc::new(start), Arc::default());
    }
    elements.sort_unstable();
    for (id, _) in &elements {
        if let Some(n) = start.get_mut(*id as usize + 1) {
            *n += 1;
        }
    }
    accumulate(&mut start);
    (Arc::new(start), Arc::new(elements.into_iter().flat_map(|(_, words)| words).collect()))
}
