// Surface tension (Akinci, Akinci & Teschner 2013), with r from me to you and q = |r| / h:
//   a = γ Σ 2 ρ₀ / (ρ + ρ') [m' C(q) r / |r| − (n − n')],  C = 32 / (π h^D) · { 2 (1 − q)³ q³ − 1/64,  q ≤ 1/2;  (1 − q)³ q³ }
// and towards walls  a = β Σ m' A(q) r / |r|,  A = 0.007 / h^D · (6 q − 4 q² − 2)^(1/4) for q > 1/2.
struct Params { unused_word: u32, cohesion: f32, curvature: f32, adhesion: f32 }
struct Sum { acceleration: vec3f }

@group(3) @binding(0) var<uniform> params: Params;

// Below the square of any distance; at one place there is no way from one to the other, and no particle pulls.
const NOTHING: f32 = 1e-30;

fn acts_on(me: Particle) -> bool { return me.density > 0.0; }

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let d2 = r.x * r.x + r.y * r.y + r.z * r.z;
    let inverse = inverseSqrt(max(d2, NOTHING));
    let q = d2 * inverse * PER_SUPPORT;
    let p = 1.0 - q;
    if you.density > 0.0 {
        let hump = p * p * p * q * q * q;
        let pull = params.cohesion * you.mass * select(hump, 2.0 * hump - 0.015625, q <= 0.5);
        let share = 2.0 * REST_DENSITY / (me.density + you.density);
        (*sum).acceleration += share * (pull * inverse * r - params.curvature * (me.normal - you.normal));
    } else {
        let hump = max(6.0 * q - 4.0 * q * q - 2.0, 0.0);
        (*sum).acceleration += (params.adhesion * you.mass * sqrt(sqrt(hump)) * inverse) * r;
    }
}

fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, 0.0); }
