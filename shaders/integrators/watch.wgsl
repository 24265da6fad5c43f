// Raises the alarm when a number is no number any more: keeps after how many steps that is first seen,
// and the lowest id there.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> position: array<vec4f>;
@group(1) @binding(1) var<storage, read> velocity: array<vec4f>;
@group(1) @binding(2) var<storage, read> acceleration: array<vec4f>;
@group(1) @binding(3) var<storage, read_write> alarm: array<atomic<u32>>; // steps done, id

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn watch(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        if broken(position[i]) || broken(velocity[i]) || broken(acceleration[i]) {
            // Later looks find fewer steps already there, and leave the id alone.
            if atomicMin(&alarm[0], world.step) >= world.step { atomicMin(&alarm[1], i); }
        }
    }
}
