// A sum and its rounding error: s = fl(a + b) and e = a + b − s, exactly (Knuth 1969, §4.2.2; Dekker 1971). Compilers fold (a + b) − a to b:
// intermediate results pass through a zero that they cannot know.
struct Words { high: vec3f, low: vec3f }

fn hidden(x: vec3f) -> vec3f { return bitcast<vec3f>(bitcast<vec3u>(x) ^ vec3u(world.zero)); }

fn two_sum(a: vec3f, b: vec3f) -> Words {
    let s = hidden(a + b);
    let t = hidden(s - a);
    return Words(s, hidden(a - hidden(s - t)) + hidden(b - t));
}

// Where |a| ≥ |b|, or a = 0.
fn fast_two_sum(a: vec3f, b: vec3f) -> Words {
    let s = hidden(a + b);
    return Words(s, b - hidden(s - a));
}

// x + h y, where `rest` is what h lacks in single precision.
fn advanced(x: Words, y: Words, h: f32, rest: f32) -> Words {
    let sum = two_sum(x.high, hidden(h * y.high));
    return fast_two_sum(sum.high, sum.low + (x.low + (h * y.low + rest * y.high)));
}
