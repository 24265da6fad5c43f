// Places from the lowest corner of all positions, by both of their words: what is rounded is the distance from there.
@group(1) @binding(7) var<storage, read> position_low: array<vec4f>; // xyz
@group(2) @binding(0) var<storage, read> tree_origin: array<vec4f>;
@group(2) @binding(1) var<storage, read_write> tree_place: array<vec4f>; // xyz, mass

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn place(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let x = position[i];
        // Through a zero that compilers cannot know: they might add the words of the position before.
        let away = bitcast<vec3f>(bitcast<vec3u>(x.xyz - tree_origin[0].xyz) ^ vec3u(world.zero));
        tree_place[i] = vec4f(away + position_low[i].xyz, x.w);
    }
}
