// Raises the alarm where the driver folds guarded sums: 1 + 2⁻²⁵ is 1, with the error 2⁻²⁵, in either order.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> summands: array<vec4f>; // 1 and 2⁻²⁵, twice each, and others way round
@group(1) @binding(1) var<storage, read_write> alarm: array<atomic<u32>>; // 10: 1 where sums are folded

@compute @workgroup_size(1)
fn prove_sums() {
    let a = summands[0].xyz;
    let b = summands[1].xyz;
    let sum = two_sum(a, b);
    let larger = abs(a) > abs(b);
    let fast = fast_two_sum(select(b, a, larger), select(a, b, larger));
    let right = all(sum.high == summands[2].xyz) && all(sum.low == summands[3].xyz)
        && all(fast.high == summands[2].xyz)
        && all(fast.low == summands[3].xyz);
    if !right { atomicStore(&alarm[10], 1u); }
}
