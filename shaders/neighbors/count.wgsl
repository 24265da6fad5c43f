// The cell of each particle, and how many are in each. The order of arrival in a cell is a race; it is only a temporary slot.
@group(2) @binding(1) var<storage, read_write> starts: array<atomic<u32>>;
@group(2) @binding(2) var<storage, read_write> keys: array<u32>;
@group(2) @binding(3) var<storage, read_write> arrivals: array<u32>;

const WORKGROUP: u32 = 64u;
const NOWHERE: u32 = 0xffffffffu;

@compute @workgroup_size(WORKGROUP)
fn count(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        var k = NOWHERE;
        if chosen(i) && is_active(i) {
            k = key(cell(wrapped(position[i].xyz)));
            // Fixed particles come after all others, where the grid keeps them separate.
            if is_held(i) { k += grid.cells.x * grid.cells.y * grid.cells.z; }
            arrivals[i] = atomicAdd(&starts[k], 1u);
        }
        keys[i] = k;
    }
}
