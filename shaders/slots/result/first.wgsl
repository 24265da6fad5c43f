// The same for visits that process every particle: the first law of an evaluation sets the sums to which the others add.
@group(1) @binding(2) var<storage, read_write> acceleration: array<vec4f>;

override FIRST: bool = false;

fn conclude(me: Particle, share: f32, sum: Sum) {
    let result = vec4f(1.0, 1.0, 1.0, share) * finish(me, sum);
    if FIRST { acceleration[me.index] = result; } else { acceleration[me.index] += result; }
}
