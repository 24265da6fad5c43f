// Where there are up to four kinds of links, those of one kind follow each other, by the ids of the partners, and a link is no more
// than its partner. Otherwise as in shaders/visit/link_table.wgsl.
struct Link { partner: u32, rest: f32, stiffness: f32, damping: f32 }

@group(2) @binding(0) var<storage, read> partner_start: array<vec4u>; // of each kind, for each particle, and the end
@group(2) @binding(1) var<storage, read> partner: array<u32>;
@group(2) @binding(8) var<storage, read> link_kind: array<Link>;

// The links of a particle: k from `first` to before `end`, those of the second kind to the fourth from `others` on.
struct Links { first: u32, end: u32, others: vec3u, a: Link, b: Link, c: Link, d: Link }

fn links_of(i: u32) -> Links {
    let start = partner_start[i];
    let end = partner_start[i + 1u].x;
    return Links(start.x, end, start.yzw, link_kind[0], link_kind[1], link_kind[2], link_kind[3]);
}

// To choose among four kinds costs less than four loops.
fn link_at(links: Links, k: u32) -> Link {
    var one = links.a;
    if k >= links.others.x { one = links.b; }
    if k >= links.others.y { one = links.c; }
    if k >= links.others.z { one = links.d; }
    one.partner = partner[k];
    return one;
}
