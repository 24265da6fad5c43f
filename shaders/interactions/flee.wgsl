// Fleeing:  a = −w Σ unit(r) (1 − |r| / R), over the predators within R.
struct Params { unused_word: u32, range: f32, strength: f32, species: u32, predators: u32 }

@group(3) @binding(0) var<uniform> params: Params;

fn acts_on(me: Particle) -> bool { return is_of(me.index, params.species); }

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    if is_of(me.index, params.species) && is_of(you.index, params.predators) {
        (*sum).acceleration -= (1.0 - length(r) / params.range) * unit(r);
    }
}

fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(params.strength * sum.acceleration, 0.0); }
