// Wall particles have the mass of the fluid that they displace:  m = ρ₀ / Σ W, over the walls (Akinci et al. 2012),
// or the mass that is given.
struct Params { unused_word: u32, mass: f32 }
struct Sum { number: f32 }

@group(3) @binding(0) var<uniform> params: Params;
// The positions, with masses in w.
@group(3) @binding(2) var<storage, read_write> weighed: array<vec4f>;

fn acts_on(me: Particle) -> bool { return is_held(me.index); }

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    if is_held(you.index) { (*sum).number += kernel(r); }
}

fn finish(me: Particle, sum: Sum) {
    weighed[me.index].w = select(REST_DENSITY / (sum.number + kernel(vec3f())), params.mass, params.mass > 0.0);
}
