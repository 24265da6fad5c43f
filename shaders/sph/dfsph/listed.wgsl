// Each particle visits its listed neighbours, and records their coefficients V g r.
@group(3) @binding(16) var<storage, read_write> pairs: array<vec4f>;

override STRIDE: u32 = 1u;
// The cells of the fluid: after the last of them come walls, and empty slots.
override CELLS: u32 = 1u;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn near(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let k = folded(group, groups) * WORKGROUP + lane;
    if k < starts[CELLS] {
        let me = candidate(k);
        if acts_on(me) {
            var sum = Sum();
            let end = u32(pairs[k].w);
            for (var n = 1u; n <= end; n += 1u) {
                let place = n * STRIDE + k;
                let slot = pairs[place].w;
                let you = candidate(u32(slot));
                let r = shortest(you.position - me.position);
                gather(me, you, r, &sum);
                pairs[place] = vec4f((you.mass / REST_DENSITY * gradient(r)) * r, slot);
            }
            finish(me, sum);
        }
    }
}
