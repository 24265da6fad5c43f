// Compiler arithmetic: the rounding error of a + b (Knuth's two-sum), plain and with its steps hidden from the
// compiler by a zero that it cannot know; whether fma rounds once; and which tests find a NaN.
@group(0) @binding(0) var<storage, read> probe: array<u32>;       // a, b, c as bits; 0; a NaN, infinity, the NaN again
@group(0) @binding(1) var<storage, read_write> answer: array<u32>;

fn hidden(x: f32) -> f32 { return bitcast<f32>(bitcast<u32>(x) ^ probe[3]); }

fn broken(x: f32) -> u32 { return u32((bitcast<u32>(x) & 0x7fffffffu) > 0x7f800000u); }

@compute @workgroup_size(1)
fn arithmetic() {
    let a = bitcast<f32>(probe[0]);
    let b = bitcast<f32>(probe[1]);
    let s = a + b;
    let t = s - a;
    answer[0] = bitcast<u32>((a - (s - t)) + (b - t));

    let hs = hidden(a + b);
    let ht = hidden(hs - a);
    answer[1] = bitcast<u32>(hidden(a - hidden(hs - ht)) + hidden(b - ht));

    let c = bitcast<f32>(probe[2]);
    answer[2] = bitcast<u32>(fma(c, c, c));

    let nan = bitcast<f32>(probe[4]);
    answer[3] = broken(nan);
    answer[7] = broken(bitcast<f32>(probe[5]));
    answer[4] = u32(nan != nan);
    answer[5] = bitcast<u32>(a / b);
    answer[6] = bitcast<u32>(sqrt(a));
}
