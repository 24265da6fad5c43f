// Pairs that bonds leave out: the sum over waves has their smooth part, which is taken off: E = −k q q' P(1 − (r / R)²) / R, and −k q q' / r
// beyond R. The file beside it is that of the law between two.
struct Taken { force: vec3f, energy: f32, normal: vec3f, size: f32, shear: vec3f }

@group(3) @binding(2) var<storage, read> excluded_start: array<u32>; // one for each particle, and the end
@group(3) @binding(3) var<storage, read> excluded: array<u32>;

fn taken_off(i: u32) -> Taken {
    var all = Taken();
    let end = excluded_start[i + 1u];
    for (var n = excluded_start[i]; n < end; n += 1u) {
        let other = excluded[n];
        let r = shortest(position[other].xyz - position[i].xyz);
        let square = dot(r, r);
        let part = square * params.inverse_range * params.inverse_range;
        let p = taper(1.0 - part);
        let cube = params.inverse_range * params.inverse_range * params.inverse_range;
        var value = params.inverse_range * p.x;
        var slope = -2.0 * cube * p.y;
        if part >= 1.0 {
            value = inverseSqrt(square);
            slope = -value * value * value;
        }
        let charges = params.coulomb * charge[i] * charge[other];
        let force = (-charges * slope) * r;
        all.force += force;
        all.energy -= charges * value;
        // Each of a pair has half of its virial.
        all.normal -= 0.5 * r * force;
        all.shear -= 0.5 * r.yxx * force.zzy;
        all.size += length(force);
    }
    return all;
}
