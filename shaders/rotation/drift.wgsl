// Free rotation of a rigid body. With L = R π along its axes, H = Σ πₖ² / 2 Iₖ is split into its three terms (Dullweber, Leimkuhler &
// McLachlan 1997; by quaternions Miller et al. 2002), each of which turns the body about one axis by the angle φ = dt πₖ / Iₖ:
//   half about the first, half about the second, all about the third, half about the second, half about the first.
// tan(φ/2) is replaced by φ/2, which is as accurate as the splitting: each turn is still that of a Hamiltonian of πₖ alone, so that
// the whole is symplectic and reversible, and R π is conserved.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> orientation: array<vec4f>;      // x, y, z | w
@group(1) @binding(1) var<storage, read_write> angular_velocity: array<vec4f>; // in space

// How far it has turned from where it was, its angular momentum there, and the change of that.
struct Turning { turn: vec4f, momentum: vec3f, change: vec3f }

override FACTOR: f32 = 1.0;
const WORKGROUP: u32 = 64u;

fn about(axis: vec3f, rate: f32, body: Turning) -> Turning {
    let momentum = body.momentum + body.change;
    let half = 0.5 * rate * dot(axis, momentum);
    let across = cross(axis, momentum);
    let change = (2.0 * half / (1.0 + half * half)) * (half * cross(axis, across) - across);
    return Turning(product(body.turn, vec4f(half * axis, 1.0)), body.momentum, body.change + change);
}

@compute @workgroup_size(WORKGROUP)
fn drift_rotation(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count && !is_held(i) && is_active(i) {
        let rates = (FACTOR * world.dt) * lightness(i);
        let q = orientation[i];
        let x = vec3f(1.0, 0.0, 0.0);
        let y = vec3f(0.0, 1.0, 0.0);
        let z = vec3f(0.0, 0.0, 1.0);
        let spin = inward(q, angular_velocity[i].xyz);
        var body = Turning(vec4f(0.0, 0.0, 0.0, 1.0), inertia[i].xyz * spin, vec3f());
        body = about(x, 0.5 * rates.x, body);
        body = about(y, 0.5 * rates.y, body);
        body = about(z, rates.z, body);
        body = about(y, 0.5 * rates.y, body);
        body = about(x, 0.5 * rates.x, body);
        let turn = body.turn / sqrt(dot(body.turn, body.turn));
        // What changes is added, so that what does not loses no digit:  R P (ω + I⁻¹ Δπ) − R ω.
        let change = turned(turn, spin) + outward(turn, lightness(i) * body.change);
        angular_velocity[i] += vec4f(outward(q, change), 0.0);
        let facing = product(q, turn);
        orientation[i] = facing / sqrt(dot(facing, facing));
    }
}
