// Momentum (Monaghan 1992, 2005), with r from me to you, v = v_you − v_me, and g r the gradient of W at you:
//   a = Σ m (p/ρ² + p'/ρ'² + Π) g r,  Π = −α c μ / ρ̄,  μ = s v·r / (r² + 0.01 s²) where they come closer, s the smoothing length
//   a −= Σ m 4 (D + 2) ν / (ρ + ρ') (v·r / r²) g r   (Monaghan & Gingold 1983; Cleary 1998; Monaghan 2005): along r, which turns nothing
// or
//   a −= Σ m ν (1/ρ + 1/ρ') g v   (Morris, Fox & Zhu 1997, with ρ ν for each of them): not along r
// g is finite, so that neither needs a regularization.
// Walls have the density of rest, the pressure of the fluid particle (Akinci et al. 2012) or their own, and a share of the viscosity.
struct Params { unused_word: u32, alpha: f32, central: f32, morris: f32, wall: f32, mirror: u32 }
struct Sum { acceleration: vec3f }

@group(3) @binding(0) var<uniform> params: Params;

fn acts_on(me: Particle) -> bool { return me.density > 0.0; }

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let d2 = r.x * r.x + r.y * r.y + r.z * r.z;
    let wall = you.density == 0.0;
    let density = select(you.density, REST_DENSITY, wall);
    let ratio = me.density / REST_DENSITY;
    let pressure = select(you.pressure, me.pressure * ratio * ratio, wall && params.mirror != 0u);
    let friction = select(1.0, params.wall, wall);
    let v = you.velocity - me.velocity;
    let near = d2 + 0.01 * SMOOTHING * SMOOTHING;
    let along = v.x * r.x + v.y * r.y + v.z * r.z;
    let closing = min(along, 0.0) * SMOOTHING / near;
    let artificial = params.alpha * SOUND * closing / (0.5 * (me.density + density));
    // Two at one place have no way from one to the other.
    let central = params.central / (me.density + density) * along / select(1.0, d2, d2 > 0.0);
    let morris = params.morris * (1.0 / me.density + 1.0 / density);
    let push = me.pressure + pressure - friction * (artificial + central);
    (*sum).acceleration += (you.mass * gradient(r)) * (push * r - (friction * morris) * v);
}

// Internal energy is all its own: twice of it, for a visit leaves each of a pair half.
fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, 2.0 * flow[me.slot].z); }
