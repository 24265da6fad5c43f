// A Runge–Kutta step of a column begins: save its start, and start the weighted sum of its slopes.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> value: array<Value>;
@group(1) @binding(1) var<storage, read_write> start: array<Value>;
@group(1) @binding(2) var<storage, read_write> slope: array<Value>; // Σ bᵢ y'ᵢ

override ELEMENTS: u32 = 1u;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn save(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < ELEMENTS {
        start[i] = value[i];
        slope[i] = Value();
    }
}
