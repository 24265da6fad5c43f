// Particles move with the box: x ← x + (x − low) c, where its sides have changed by the parts c, 0 where there is no period; and where it is
// asked for, v ← v / (1 + c).
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> position: array<vec4f>; // xyz, mass
@group(1) @binding(1) var<storage, read_write> velocity: array<vec4f>; // xyz, radius
@group(1) @binding(2) var<storage, read> box_change: array<vec4f>;

override VELOCITIES: bool = false;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn box_scale(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let change = box_change[0].xyz;
        let x = position[i];
        let moved = x.xyz + (x.xyz - world.low) * change;
        // What rounds to the far side is at the near one.
        let beyond = (moved >= world.high) & (world.period > vec3f());
        position[i] = vec4f(select(moved, world.low, beyond), x.w);
        if VELOCITIES { velocity[i] -= vec4f(velocity[i].xyz * (change / (1.0 + change)), 0.0); }
    }
}
