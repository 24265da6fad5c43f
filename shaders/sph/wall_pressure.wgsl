// Walls have the pressure of the fluid around them, with the hydrostatic difference (Adami, Hu & Adams 2012), with r from me to you:
//   p = (Σ p' W − w·Σ ρ' r W) / Σ W
struct Params { unused_word: u32, weight: vec3f }
struct Sum { pressure: f32, number: f32 }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(2) var<storage, read_write> wall_pressure: array<f32>;

fn acts_on(me: Particle) -> bool { return me.density == 0.0; }

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    if you.density > 0.0 {
        let w = kernel(r);
        let weighs = params.weight.x * r.x + params.weight.y * r.y + params.weight.z * r.z;
        (*sum).pressure += (you.pressure * you.density - weighs) * you.density * w;
        (*sum).number += w;
    }
}

fn finish(me: Particle, sum: Sum) {
    // Without fluid nearby, both are 0.
    let p = sum.pressure / max(sum.number, 1e-30);
    wall_pressure[me.slot] = select(max(p, 0.0), p, NEGATIVE) / (REST_DENSITY * REST_DENSITY);
}
