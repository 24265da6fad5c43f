// Eight lanes test the nodes that their group may open: the eight nodes three levels below one, and the six between. Far groups
// go into one list, leaves go into another.
const WORKGROUP: u32 = 8u;
// Entries of the lists that are evaluated together. Powers of two: the lists are rings.
const FAR: u32 = 128u;
const NEAR: u32 = 64u;
// Far groups of a lane, with room for what a look at eight nodes adds.
const ROWS: u32 = 2u * FAR / WORKGROUP;

// The lists stand in memory of each lane, which needs no barrier: between barriers, an adapter that runs lanes as vectors keeps
// nothing in registers. A far group stands on the lane that loads it, the k-th of them on lane k % 8.
// Leaves stand on every lane, those below one look as one entry: the first of the eight, and a bit for each.
struct Lists { far: array<u32, ROWS>, near: array<u32, NEAR> }

// Nodes that are still to be looked at are bits of `waits`: eight children of a node are a byte, those of the lowest come
// last. Of 25 levels at most, the lowest three are leaves' and wait for nothing: that leaves eight bytes. Next are those so
// many levels below `node`, which stands on the level of `depth`, if there are more. So many have been listed, far groups
// and entries of leaves; so many leaves are listed and not evaluated, and so many iterations are spent.
struct Search { waits: vec2u, node: u32, depth: u32, levels: u32, more: bool, listed: vec2u, leaves: u32, spent: u32 }

// The level of those that are looked at first: from there on it is three levels at once down to the leaves.
fn highest() -> u32 { return (tree.height + 2u) % 3u + 1u; }

// The only group there is has no far group.
fn begun() -> Search { return Search(vec2u(), 1u, 0u, highest(), all_leaves() > GROUP / LEAF, vec2u(), 0u, 0u); }

// Where a search stands: the node, 0 where it is done, and what waits.
fn stands(s: Search) -> vec3u { return vec3u(select(0u, s.node, s.more), s.waits); }
fn resumed(at: vec3u) -> Search { return Search(at.yz, at.x, firstLeadingBit(at.x), 3u, at.x > 0u, vec2u(), 0u, 0u); }

// Whether there is a node to look at, and room in the lists for what is below it.
fn goes_on(s: Search, met: vec2u) -> bool {
    return s.more && s.listed.x - met.x < FAR && s.leaves < NEAR && s.spent <= MOST;
}

fn without_lowest(bits: u32) -> u32 { return bits & (bits - 1u); }

// The place of a bit of a byte, after so many lower ones.
fn bit_after(byte: u32, lower: u32) -> u32 {
    let few = countOneBits(byte & 15u);
    let beyond = lower >= few;
    // Up to three of four bits.
    let more = lower - select(0u, few, beyond);
    let a = select(byte, byte & 240u, beyond);
    let b = select(a, without_lowest(a), more > 0u);
    let c = select(b, without_lowest(b), more > 1u);
    let d = select(c, without_lowest(c), more > 2u);
    return countTrailingZeros(d);
}

// A node between stands on a lane that is below it: of the level above on the even ones, of the next on 1 and 5.
fn is_upper(place: u32) -> bool { return (place & 3u) == 1u; }
fn between(n: u32, place: u32) -> u32 { return select(n >> 1u, n >> 2u, is_upper(place)); }

// Looks at the nodes below one. Where a node is doubtful targets have to be asked: without `asks` nothing is done then, and the
// answer is true. An adapter that runs lanes as vectors takes every way of every branch, and only a loop that is not entered costs
// nothing; a loop in here costs a fifth of the whole walk.
fn look(search: ptr<function, Search>, lists: ptr<function, Lists>, here: Place, own: u32, place: u32, asks: bool) -> bool {
    var s = *search;
    let below = s.depth + s.levels;
    let n = (s.node << s.levels) + place;
    let real = exists(n, below);
    let holds = own >> (tree.height - below) == n;
    let itself = holds && below + 3u == tree.height;
    let upper = is_upper(place);
    let m = between(n, place);
    let level = select(below - 1u, s.depth + 1u, upper);
    let some = select((place & 1u) == 0u, s.levels == 3u, upper);
    let also = some && exists(m, level) && own >> (tree.height - level) != m;
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
    let first = n - place;
    if asks || !doubtful {
        // Which of those found comes to this lane.
        let turn = (place - s.listed.x) % WORKGROUP;
        if turn < countOneBits(fars) {
            let found = bit_after(fars, turn);
            let q = first + found;
            let wider = ((above >> found) & 1u) == 1u;
            (*lists).far[(s.listed.x + turn) / WORKGROUP % ROWS] = select(q, between(q, found), wider);
        }
        if leaf && rest != 0u { (*lists).near[s.listed.y % NEAR] = ((first - (1u << tree.height)) << 5u) | rest; }
    }
    s.listed += vec2u(countOneBits(fars), select(0u, 1u, leaf && rest != 0u));
    s.leaves += select(0u, countOneBits(rest), leaf);
    let open = select(rest << select(0u, 1u << s.levels, s.levels < 3u), 0u, leaf);
    if open != 0u {
        s.waits = (s.waits << vec2u(8u)) | vec2u(open, s.waits.x >> 24u);
        s.node = first;
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
    s.waits.x = without_lowest(s.waits.x);
    s.levels = 3u;
    // Loops with nothing to do take an iteration each to detect that.
    s.spent += 4u;
    if asks || !doubtful { *search = s; }
    return doubtful;
}

// The next leaf of the list, of which there is one; `open` is what is left of an entry.
fn next_leaf(search: ptr<function, Search>, lists: ptr<function, Lists>, met: ptr<function, vec2u>, open: ptr<function, u32>) -> u32 {
    if (*open & 255u) == 0u {
        *open = (*lists).near[(*met).y % NEAR];
        (*met).y += 1u;
    }
    let leaf = (*open >> 8u) * 8u + countTrailingZeros(*open & 255u);
    *open = without_lowest(*open);
    (*search).leaves -= 1u;
    return leaf;
}
