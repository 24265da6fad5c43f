// Continuity (Monaghan 1994), with r from me to you, v = v_you − v_me, g r the gradient of W at you:  dρ/dt = Σ m g r·v
// Diffusion (Molteni & Colagrossi 2009) of the deviation from the hydrostatic density (Fourtakas et al. 2019), s the smoothing length:
//   dρ/dt −= 2 δ s c Σ m/ρ' (ρ' − ρ − (1 − (γ − 2) e) ρ₀ w·r / c²) g r² / (r² + 0.01 s²),  e = (ρ + ρ') / 2 ρ₀ − 1
// By Tait's equation sound is faster where a fluid is denser, and gravity changes its density less there: dρ = ρ w·dr / c(ρ)², to first order in e.
struct Params { unused_word: u32, diffusion: f32, weight: vec3f }
struct Sum { rate: f32 }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(3) var<storage, read_write> density_rate: array<f32>;

fn acts_on(me: Particle) -> bool { return me.density > 0.0; }

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let v = you.velocity - me.velocity;
    (*sum).rate += you.mass * gradient(r) * (r.x * v.x + r.y * v.y + r.z * v.z);
    if you.density > 0.0 {
        let d2 = r.x * r.x + r.y * r.y + r.z * r.z;
        let weighs = params.weight.x * r.x + params.weight.y * r.y + params.weight.z * r.z;
        let denser = 0.5 * (me.density + you.density) - REST_DENSITY;
        let give = REST_DENSITY - (f32(EXPONENT) - 2.0) * denser;
        let excess = you.density - me.density - give * weighs / (SOUND * SOUND);
        let near = d2 / (d2 + 0.01 * SMOOTHING * SMOOTHING);
        (*sum).rate -= params.diffusion * (you.mass / you.density) * excess * gradient(r) * near;
    }
}

fn finish(me: Particle, sum: Sum) { density_rate[me.index] = sum.rate; }
