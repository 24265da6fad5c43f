// A number in two halves of twelve digits, whose products are exact (Veltkamp; Dekker 1971).
struct Halves { high: vec3f, low: vec3f }

fn halves(x: vec3f) -> Halves {
    let c = hidden(4097.0 * x);
    let high = hidden(c - hidden(c - x));
    return Halves(high, hidden(x - high));
}

// A product and its rounding error: p = fl(a b) and e = a b − p, exactly (Dekker 1971).
fn two_product(a: f32, b: vec3f) -> Words {
    let p = hidden(a * b);
    let x = halves(vec3f(a));
    let y = halves(b);
    let e = hidden(x.high * y.high) - p;
    return Words(p, ((e + hidden(x.high * y.low)) + hidden(x.low * y.high)) + x.low * y.low);
}
