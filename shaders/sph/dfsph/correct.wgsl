// An iteration of Jacobi:  κ ← max(κ − ω α / dt² (s − dt² D(a)), 0), for pressure is not negative; with momentum in the direction in which
// κ changes (Nesterov 1983): the hydrostatic pressure of n layers of particles converges in about n iterations, not n². The error is
// the remaining compression, or expansion where pressure is too high: the change of κ, as a density.
@group(3) @binding(4) var<storage, read_write> unknowns: array<Unknown>;
@group(3) @binding(6) var<storage, read_write> errors: array<f32>;
@group(3) @binding(7) var<storage, read> dfsph_state: array<State>;

override SOLVE: u32 = 0u;

fn acts_on(me: Particle) -> bool { return me.solved > 0.0; }

fn finish(me: Particle, sum: Sum) {
    let unknown = unknowns[me.slot];
    let turn = dfsph_state[SOLVE].iterations;
    let residual = unknown.source - world.dt * world.dt * sum.change;
    let next = max(unknown.stiffness - unknown.relaxation * residual, 0.0);
    unknowns[me.slot].stiffness = max(next + turn / (turn + 3.0) * (next - unknown.reached), 0.0);
    unknowns[me.slot].reached = next;
    errors[me.slot] = max(-residual, 0.0);
    if unknown.relaxation > 0.0 { errors[me.slot] = abs(next - unknown.stiffness) / unknown.relaxation; }
}
