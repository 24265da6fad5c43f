// The circles model of FLAME GPU 2 (Richmond et al. 2023): an agent nearer than the radius pushes or pulls by a sine of
// the distance, so that agents come to stand on circles around each other.
const RADIUS: f32 = 2.0;
const REPULSE: f32 = 0.05;

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let separation = length(r);
    let k = sin(separation / RADIUS * -6.283185307) * REPULSE;
    (*sum).acceleration += (k / max(separation, 1e-12)) * r;
}

fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, 0.0); }
