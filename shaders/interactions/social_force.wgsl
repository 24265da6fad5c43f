// Pedestrians (Helbing, Farkas & Vicsek 2000), of radii R and masses m, n from the other to me, o = R + R' − d, g = max(o, 0):
//   m a = Σ [w A exp(o / B) + k g] n + κ g u,  u = (v' − v) − ((v' − v)·n) n,  the sliding velocity of the other relative to me.
// Anisotropy (Helbing et al. 2002): w = λ + (1 − λ) (1 + cos φ) / 2, with φ between my velocity and the way to the other; at rest w = 1.
struct Params {
    unused_word: u32,
    repulsion: f32, decay: f32, stiffness: f32, friction: f32, anisotropy: f32, species: u32,
}
struct Sum { force: vec3f }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<storage, read> radius: array<f32>;

fn acts_on(me: Particle) -> bool { return is_of(me.index, params.species); }

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let distance = length(r);
    let both = is_of(me.index, params.species) && is_of(you.index, params.species);
    // Two particles at the same position have no direction between them; one without mass is none.
    if both && distance > 0.0 && you.mass > 0.0 {
        let n = -r / distance;
        let overlap = radius[me.index] + radius[you.index] - distance;
        let touch = max(overlap, 0.0);
        let v = velocity_of(me);
        let speed = length(v);
        var weight = 1.0;
        if speed > 0.0 {
            weight = params.anisotropy + (1.0 - params.anisotropy) * 0.5 * (1.0 - dot(v, n) / speed);
        }
        let between = velocity_of(you) - v;
        let slide = between - dot(between, n) * n;
        let push = weight * params.repulsion * exp(overlap / params.decay) + params.stiffness * touch;
        (*sum).force += push * n + params.friction * touch * slide;
    }
}

fn merge(total: ptr<function, Sum>, part: Sum) {
    (*total).force += part.force;
}

fn finish(me: Particle, sum: Sum) -> vec4f {
    // A particle without mass is moved by nothing.
    if me.mass > 0.0 { return vec4f(sum.force / me.mass, 0.0); }
    return vec4f();
}
