// Adds what all invocations of a workgroup hold, by a fixed tree. The first of them has the result.
const WORKGROUP: u32 = 256u;

var<workgroup> shares: array<f32, WORKGROUP>;

fn total(lane: u32, mine: f32) -> f32 {
    shares[lane] = mine;
    for (var width = WORKGROUP / 2u; width > 0u; width /= 2u) {
        workgroupBarrier();
        if lane < width { shares[lane] += shares[lane + width]; }
    }
    return shares[0];
}
