// No pedestrian passes a wall: one whose way since its last allowed position crosses a wall is put back there, loses its velocity along that way, and
// is counted.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> position: array<vec4f>;         // xyz, mass
@group(1) @binding(1) var<storage, read_write> velocity: array<vec4f>;         // xyz, radius
@group(1) @binding(2) var<storage, read> species: array<u32>;
@group(1) @binding(3) var<storage, read_write> allowed_position: array<vec4f>; // xyz, how often it was put back
@group(1) @binding(4) var<storage, read> walls: array<Wall>;

override COUNT: u32 = 1u;
override SPECIES: u32 = 1u;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn keep(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let x = position[i];
        let last = allowed_position[i];
        var passed = false;
        if is_active(i) && !is_held(i) && is_of(i, SPECIES) {
            for (var k = 0u; k < COUNT; k += 1u) { passed = passed || crosses(walls[k], last.xy, x.xy); }
        }
        if passed {
            let v = velocity[i];
            let way = x.xyz - last.xyz;
            position[i] = vec4f(last.xyz, x.w);
            velocity[i] = vec4f(v.xyz - max(dot(v.xyz, way) / dot(way, way), 0.0) * way, v.w);
            allowed_position[i].w = last.w + 1.0;
        } else {
            allowed_position[i] = vec4f(x.xyz, last.w);
        }
    }
}
