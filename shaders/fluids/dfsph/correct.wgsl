// An iteration of relaxed Jacobi:  κ ← max(κ − ω α / dt² (s − dt² D(a)), 0).  Pressure does not pull. Its error is what it would
// compress by, and where pressure is too large what that would expand by: what κ changed by, in parts of the density.
@group(3) @binding(4) var<storage, read_write> unknowns: array<Unknown>;
@group(3) @binding(6) var<storage, read_write> errors: array<f32>;
@group(3) @binding(7) var<storage, read> dfsph_state: array<State>;

override SOLVE: u32 = 0u;
override STRICT: f32 = 1.0;

fn acts_on(me: Particle) -> bool { return me.solved > 0.0 && dfsph_state[SOLVE].code == 0.0; }

fn deliver(k: u32, me: Particle, sum: Sum) {
    let unknown = unknowns[k];
    let residual = unknown.source - world.dt * world.dt * sum.change;
    let stiffness = max(unknown.stiffness - unknown.relaxation * residual, 0.0);
    unknowns[k].stiffness = stiffness;
    let changed = abs(stiffness - unknown.stiffness) / max(unknown.relaxation, 1e-30);
    errors[k] = select(max(-residual, 0.0), changed, unknown.relaxation > 0.0 && STRICT > 0.5);
}
