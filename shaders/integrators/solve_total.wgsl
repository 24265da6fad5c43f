// Sum over the invocations of a workgroup, by a fixed tree. Every invocation has the result.
const WORKGROUP: u32 = 256u;

var<workgroup> shares: array<vec4f, WORKGROUP>;

fn total(lane: u32, mine: vec4f) -> vec4f {
    var sum = mine;
    for (var width = WORKGROUP; width > 1u; width /= 2u) {
        if lane < width { shares[lane] = sum; }
        workgroupBarrier();
        let half = width / 2u;
        if lane < half { sum += shares[lane + half]; }
    }
    if lane == 0u { shares[0] = sum; }
    workgroupBarrier();
    return shares[0];
}
