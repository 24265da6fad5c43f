// Eight lanes test the nodes that their group may open: the eight nodes three levels below one, and the six between. Far groups
// go into one list, leaves go into another.
const WORKGROUP: u32 = 8u;
// Entries of the lists that are evaluated together, and room for what a look at eight nodes adds. Powers of two: they are rings.
const FAR: u32 = 128u;
const NEAR: u32 = 64u;

// First the far groups, then the leaves.
var<workgroup> list: array<u32, 2u * FAR + 2u * NEAR>;

// Nodes that are still to be looked at are bits of `waits`: eight children of a node are a byte, those of the lowest come
// last. Of 25 levels at most, the lowest three are leaves' and wait for nothing: that leaves eight bytes. Next are those so
// many levels below `node`, which stands on the level of `depth`, if there are more. So many have been listed, far groups
// and leaves, and so many iterations are spent.
struct Search { waits: vec2u, node: u32, depth: u32, levels: u32, more: bool, listed: vec2u, spent: u32 }

// The level of those that are looked at first: from there on it is three levels at once down to the leaves.
fn highest() -> u32 { return (tree.height + 2u) % 3u + 1u; }

// The only group there is has no far group.
fn begun() -> Search { return Search(vec2u(), 1u, 0u, highest(), all_leaves() > GROUP / LEAF, vec2u(), 0u); }

// Where a search stands: the node, 0 where it is done, and what waits.
fn stands(s: Search) -> vec3u { return vec3u(select(0u, s.node, s.more), s.waits); }
fn resumed(at: vec3u) -> Search { return Search(at.yz, at.x, firstLeadingBit(at.x), 3u, at.x > 0u, vec2u(), 0u); }

// Whether there is a node to look at, and room in the lists for what is below it.
fn goes_on(s: Search, met: vec2u) -> bool {
    return s.more && s.listed.x - met.x < FAR && s.listed.y - met.y < NEAR && s.spent <= MOST;
}

// Looks at the nodes below one. Where a node is doubtful targets have to be asked: without `asks` nothing is done then, and the
// answer is true. An adapter that runs lanes as vectors takes every way of every branch, and only a loop that is not entered costs nothing.
fn look(search: ptr<function, Search>, here: Place, own: u32, place: u32, asks: bool) -> bool {
    var s = *search;
    let lower = (1u << place) - 1u;
    let below = s.depth + s.levels;
    let n = (s.node << s.levels) + place;
    let real = exists(n, below);
    let holds = own >> (tree.height - below) == n;
    let itself = holds && below + 3u == tree.height;
    // A node between stands on a lane that is below it: of the level above on the even ones, of the next on 1 and 5.
    let upper = (place & 3u) == 1u;
    let m = select(n >> 1u, n >> 2u, upper);
    let between = select(below - 1u, s.depth + 1u, upper);
    let some = select((place & 1u) == 0u, s.levels == 3u, upper);
    let also = some && exists(m, between) && own >> (tree.height - between) != m;
    let node_m = node_at(select(1u, m, also));
    let node_n = node_at(select(1u, n, real));
    var open_m = reaches_box(node_m, here);
    var open_n = reaches_box(node_n, here);
    let ask_m = open_m && also && is_doubtful(node_m, here);
    let ask_n = open_n && real && !holds && is_doubtful(node_n, here);
    let doubtful = subgroupAny(ask_m || ask_n);
    if asks {
        open_m = open_m && (!ask_m || reaches_target(node_m, here));
        open_n = open_n && (!ask_n || reaches_target(node_n, here));
        // The first look, which changed nothing, had its iterations, too.
        s.spent += 2u * GROUP + 16u;
    }
    let wide = also && !open_m;
    let above = subgroupBallot(wide).x;
    let over = (above >> ((place & 4u) + 1u)) & 1u;
    let taken = (over | (above >> (place & 6u))) & 1u;
    let shut = real && taken == 0u && !holds && !open_n;
    let far = shut || (wide && (upper || over == 0u));
    let others = real && taken == 0u && !shut && !itself;
    let leaf = below == tree.height;

    let fars = subgroupBallot(far).x;
    let rest = subgroupBallot(others).x;
    let at_far = (s.listed.x + countOneBits(fars & lower)) % (2u * FAR);
    let at_near = 2u * FAR + (s.listed.y + countOneBits(rest & lower)) % (2u * NEAR);
    if (asks || !doubtful) && (far || (others && leaf)) { list[select(at_near, at_far, far)] = select(n, m, wide); }
    s.listed.x += countOneBits(fars);
    s.listed.y += select(0u, countOneBits(rest), leaf);
    let open = select(rest << select(0u, 1u << s.levels, s.levels < 3u), 0u, leaf);
    if open != 0u {
        s.waits = (s.waits << vec2u(8u)) | vec2u(open, s.waits.x >> 24u);
        s.node = n - place;
        s.depth = below;
    }
    while (s.waits.x & 255u) == 0u && s.depth > highest() {
        s.waits = (s.waits >> vec2u(8u)) | vec2u(s.waits.y << 24u, 0u);
        s.node = s.node / 8u;
        s.depth -= 3u;
        s.spent += 1u;
    }
    s.more = (s.waits.x & 255u) != 0u;
    s.node = (s.node & ~7u) + countTrailingZeros(s.waits.x & 255u);
    s.waits.x &= s.waits.x - 1u;
    s.levels = 3u;
    // Loops with nothing to do take an iteration each to detect that.
    s.spent += 4u;
    if asks || !doubtful { *search = s; }
    return doubtful;
}
