// Indirect arguments of the dispatches that build the list: all their workgroups, or none.
@group(2) @binding(13) var<storage, read_write> list_go: array<u32>;
@group(2) @binding(14) var<storage, read> list_all: array<u32>;

override WORDS: u32 = 0u;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn decide(@builtin(local_invocation_index) lane: u32) {
    let builds = atomicLoad(&list_state[0].builds);
    let build = builds == 0u || atomicLoad(&list_state[0].moved) > 0u;
    for (var n = lane; n < WORDS; n += WORKGROUP) { list_go[n] = select(0u, list_all[n], build); }
    storageBarrier();
    if lane == 0u {
        atomicStore(&list_state[0].moved, 0u);
        atomicStore(&list_state[0].builds, builds + u32(build));
    }
}
