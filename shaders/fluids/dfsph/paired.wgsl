// Everybody meets whom it is paired with, whose push is known.
@group(3) @binding(16) var<storage, read> pairs: array<vec4f>;
@group(3) @binding(17) var<storage, read> neighbors: array<u32>;

override STRIDE: u32 = 1u;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn near(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let k = folded(group, groups) * WORKGROUP + lane;
    if k < STRIDE {
        let me = candidate(k);
        if acts_on(me) {
            var sum = Sum();
            let end = neighbors[k];
            for (var n = 0u; n < end; n += 1u) {
                let pair = pairs[n * STRIDE + k];
                meet(me, candidate(u32(pair.w)), pair.xyz, &sum);
            }
            deliver(k, me, sum);
        }
    }
}
