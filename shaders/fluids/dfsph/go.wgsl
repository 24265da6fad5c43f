// Both solves begin: all workgroups of their iterations go, until a solve is done.
@group(3) @binding(15) var<storage, read_write> dfsph_go: array<u32>;
@group(3) @binding(18) var<storage, read> dfsph_all: array<u32>;

const WORKGROUP: u32 = 64u;
// Of two solves, two kernels, and three dimensions.
const WORDS: u32 = 12u;

@compute @workgroup_size(WORKGROUP)
fn go(@builtin(local_invocation_index) lane: u32) {
    if lane < WORDS { dfsph_go[lane] = dfsph_all[lane]; }
}
