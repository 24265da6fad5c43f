// The virial of forces of pairs (Clausius 1870):  W = −½ Σ r ⊗ F,  r from me to you and F the force on me: each of a pair has half of it.
// It is joined with a law under other names of its functions. The force of a pair is that of a sum with one neighbour; such forces must add up to the
// force of all neighbours. The file beside it has the `gather` of the law's visit.
struct Sum { normal: vec3f, size: f32, shear: vec3f, force: vec3f, whole: PairSum }

// Two for each particle: xx, yy, zz, and by how much the forces do not add up; yz, xz, xy, and the sum of their sizes.
@group(1) @binding(2) var<storage, read_write> virial: array<vec4f>;

// Adds the force of a sum with one neighbour, which has this part in their virial.
fn add_virial(me: Particle, r: vec3f, pair: PairSum, part: f32, sum: ptr<function, Sum>) {
    let force = me.mass * (pair_finish(me, pair) - pair_finish(me, PairSum())).xyz;
    (*sum).normal -= part * r * force;
    (*sum).shear -= 0.5 * part * (r.yxx * force.zzy + r.zzy * force.yxx);
    (*sum).force += force;
    (*sum).size += length(force);
}

fn finish(me: Particle, sum: Sum) {
    let force = me.mass * (pair_finish(me, sum.whole) - pair_finish(me, PairSum())).xyz;
    virial[2u * me.index] += vec4f(sum.normal, length(force - sum.force));
    virial[2u * me.index + 1u] += vec4f(sum.shear, sum.size);
}
