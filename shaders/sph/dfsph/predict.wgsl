// The density solve begins: accelerations by pressure may compress by  s = 1 − ρ/ρ₀ − dt D(v + dt a)  in the step.
@group(3) @binding(3) var<storage, read> responses: array<Response>;
@group(3) @binding(4) var<storage, read_write> unknowns: array<Unknown>;
@group(3) @binding(9) var<storage, read> warm_start: array<Stiffness>;

override WARM: f32 = 0.0;
override RELAXATION: f32 = 0.0;

fn acts_on(me: Particle) -> bool { return me.solved > 0.0; }

fn finish(me: Particle, sum: Sum) {
    let response = responses[me.index];
    let relaxation = RELAXATION * response.alpha / (world.dt * world.dt);
    let source = -(response.excess + world.dt * (response.change + world.dt * sum.change));
    let stiffness = select(0.0, WARM * warm_start[me.index].density, relaxation > 0.0);
    unknowns[me.slot] = Unknown(stiffness, stiffness, relaxation, source);
}
