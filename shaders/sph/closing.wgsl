// The maximum rate at which neighbours approach or separate:  |μ| = s |v·r| / (r² + 0.01 s²), with s the smoothing length (Monaghan 1992). It is
// added to the speed of sound in the criterion of adaptive steps.
struct Sum { most: f32 }

@group(3) @binding(2) var<storage, read_write> closing: array<f32>;

fn acts_on(me: Particle) -> bool { return !is_held(me.index); }

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let v = velocity[you.index].xyz - velocity[me.index].xyz;
    let near = r.x * r.x + r.y * r.y + r.z * r.z + 0.01 * SMOOTHING * SMOOTHING;
    (*sum).most = max((*sum).most, abs(v.x * r.x + v.y * r.y + v.z * r.z) * SMOOTHING / near);
}

fn finish(me: Particle, sum: Sum) { closing[me.index] = sum.most; }
