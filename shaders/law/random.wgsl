// Counter-based random numbers (pcg4d; Jarzynski & Olano, JCGT 9(3), 2020), for laws that call `pcg4d`: four words for
// every counter, the same on every device. Count with `id_of(me.index)`: rows may be used again for other particles.
fn pcg4d(counter: vec4u) -> vec4u {
    var v = counter * 1664525u + vec4u(1013904223u);
    v = mixed(v);
    v ^= v >> vec4u(16u);
    return mixed(v);
}

fn mixed(counter: vec4u) -> vec4u {
    var v = counter;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

// A word as a number from 0 on, below 1: 24 bits, which f32 holds.
fn fraction(word: u32) -> f32 { return f32(word >> 8u) / 16777216.0; }
