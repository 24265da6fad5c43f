// Each particle interacts with its recorded pairs, by their coefficients.
@group(3) @binding(16) var<storage, read> pairs: array<vec4f>;

override STRIDE: u32 = 1u;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn near(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let k = folded(group, groups) * WORKGROUP + lane;
    if k < STRIDE {
        let me = candidate(k);
        if acts_on(me) {
            var sum = Sum();
            let end = u32(pairs[k].w);
            for (var n = 1u; n <= end; n += 1u) {
                let pair = pairs[n * STRIDE + k];
                meet(me, candidate(u32(pair.w)), pair.xyz, &sum);
            }
            finish(me, sum);
        }
    }
}
