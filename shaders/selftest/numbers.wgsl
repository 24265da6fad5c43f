// Numbers beyond and below the normal ones, a · b + c with one rounding or two, and the error of a sine.
@group(0) @binding(0) var<storage, read> probe: array<u32>;       // large, small, a, b, c, an angle as bits
@group(0) @binding(1) var<storage, read_write> answer: array<u32>;

@compute @workgroup_size(1)
fn numbers() {
    let large = bitcast<f32>(probe[0]);
    answer[0] = bitcast<u32>(large + large);
    answer[1] = u32(large + large > large);
    answer[2] = bitcast<u32>(bitcast<f32>(probe[1]) * 0.5);
    answer[3] = bitcast<u32>(bitcast<f32>(probe[2]) * bitcast<f32>(probe[3]) + bitcast<f32>(probe[4]));
    answer[4] = bitcast<u32>(sin(bitcast<f32>(probe[5])));
}
