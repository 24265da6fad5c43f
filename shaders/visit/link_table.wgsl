// A link from one of its ends: the particle at the other, the length at rest (below zero: a rope), stiffness and damping.
struct Link { partner: u32, rest: f32, stiffness: f32, damping: f32 }

@group(2) @binding(0) var<storage, read> link_start: array<u32>; // one for each particle, and the end
@group(2) @binding(1) var<storage, read> link: array<Link>;

// The links of a particle: k from `first` to before `end`.
struct Links { first: u32, end: u32 }

fn links_of(i: u32) -> Links { return Links(link_start[i], link_start[i + 1u]); }
fn link_at(links: Links, k: u32) -> Link { return link[k]; }
