// The surface normal; its length grows towards the surface: n = h Σ m/ρ ∇W, over the fluid, which points inwards (Akinci, Akinci & Teschner 2013).
struct Sum { normal: vec3f }

@group(3) @binding(4) var<storage, read_write> normal: array<vec4f>;

fn acts_on(me: Particle) -> bool { return me.density > 0.0; }

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    if you.density > 0.0 { (*sum).normal -= (you.mass / you.density * gradient(r)) * r; }
}

fn finish(me: Particle, sum: Sum) { normal[me.slot] = vec4f(sum.normal / PER_SUPPORT, 0.0); }
