// The solution is applied: v ← v + Δv.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> velocity: array<vec4f>;
@group(2) @binding(3) var<storage, read> directions: array<Direction>;
@group(2) @binding(5) var<storage, read> solve_state: array<State>;

override START: bool = true;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn solve_update(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count && (START || solve_state[0].settled == 0.0) {
        velocity[i] += vec4f(directions[i].y.xyz, 0.0);
    }
}
