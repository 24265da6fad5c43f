// The list as it was, with the history of its pairs, before it is rebuilt.
@group(2) @binding(8) var<storage, read> list: array<vec4u>;
@group(2) @binding(9) var<storage, read> history: array<f32>;
@group(2) @binding(12) var<storage, read> list_origin: array<vec4f>;
@group(2) @binding(15) var<storage, read_write> list_before: array<vec4u>;
@group(2) @binding(16) var<storage, read_write> row_before: array<u32>;
@group(2) @binding(17) var<storage, read_write> history_before: array<f32>;

const WORKGROUP: u32 = 64u;
const NONE: u32 = 0xffffffffu;

@compute @workgroup_size(WORKGROUP)
fn save(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    // Layer n of the dispatch has the n-th four of each row.
    let k = folded(group, groups) * WORKGROUP + lane;
    if k < world.count {
        let head = list[k];
        if group.z == 0u {
            list_before[k] = head;
            // A row that got another particle since has no row before.
            if head.y != NONE { row_before[head.y] = select(k, NONE, list_origin[head.y].w == 0.0); }
            // Which particle of that id, not row, had none.
            if list_origin[k].w == 0.0 { row_before[k] = NONE; }
        }
        let first = 4u * group.z;
        if first < head.x { list_before[(1u + group.z) * world.capacity + k] = list[(1u + group.z) * world.capacity + k]; }
        for (var n = first; n < min(first + 4u, head.x); n += 1u) {
            for (var word = 0u; word < SLOTS; word += 1u) {
                history_before[(n * SLOTS + word) * world.capacity + k] = history[word_of(pair_at(k, n), world.step, word)];
            }
        }
    }
}
