// Tait's equation of state:  p = B ((ρ/ρ₀)^γ − 1), and the energy ∫ p / ρ² dρ (Monaghan 1994).
@group(3) @binding(2) var<storage, read> density: array<f32>;
@group(3) @binding(3) var<storage, read_write> flow: array<vec4f>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn state(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let k = folded(group, groups) * WORKGROUP + lane;
    if k >= occupied() { return; }
    let id = occupant(k);
    if !has_state(id) {
        flow[k] = vec4f();
        return;
    }
    let rho = density[id];
    let excess = (rho - REST_DENSITY) / REST_DENSITY;
    let e = select(max(excess, 0.0), excess, NEGATIVE);
    let x = 1.0 + e;
    // x^γ − 1 = e (1 + x + … + x^(γ−1)): no digits are lost where e is small.
    var sum = 1.0;
    var energy = 0.0;
    for (var n = 1u; n < EXPONENT; n += 1u) {
        sum = sum * x + 1.0;
        energy = energy * x + f32(n);
    }
    let share = (f32(EXPONENT) - 1.0) * REST_DENSITY * x;
    flow[k] = vec4f(rho, STIFFNESS * e * sum / (rho * rho), STIFFNESS * e * e * energy / share, 0.0);
}
