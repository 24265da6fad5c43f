// History goes with its pair, by the ids of both: two rows of one particle ascend, the old and the new, and are merged.
// The first list has none before it.
@group(2) @binding(8) var<storage, read> list: array<vec4u>;
@group(2) @binding(9) var<storage, read_write> history: array<f32>;
@group(2) @binding(15) var<storage, read> list_before: array<vec4u>;
@group(2) @binding(16) var<storage, read> row_before: array<u32>;
@group(2) @binding(17) var<storage, read> history_before: array<f32>;

const WORKGROUP: u32 = 64u;
const NONE: u32 = 0xffffffffu;

@compute @workgroup_size(WORKGROUP)
fn fit(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let k = folded(group, groups) * WORKGROUP + lane;
    if k < world.count {
        let head = list[k];
        if head.y != NONE {
            let row = row_before[head.y];
            var end = 0u;
            if row != NONE && atomicLoad(&list_state[0].builds) > 1u { end = list_before[row].x; }
            var old = 0u;
            for (var n = 0u; n < head.x; n += 1u) {
                let id = list[(1u + n / 4u) * world.capacity + k][n % 4u];
                while old < end {
                    if list_before[(1u + old / 4u) * world.capacity + row][old % 4u] >= id { break; }
                    old += 1u;
                }
                let known = old < end && list_before[(1u + old / 4u) * world.capacity + row][old % 4u] == id && row_before[id] != NONE;
                for (var word = 0u; word < SLOTS; word += 1u) {
                    var value = 0.0;
                    if known { value = history_before[(old * SLOTS + word) * world.capacity + row]; }
                    history[word_of(pair_at(k, n), world.step, word)] = value;
                }
            }
        }
    }
}
