// Acceleration by pressure, where walls have the pressure of the fluid particle:  a = −Σ V (κ + κ') ∇W = Σ V (κ + κ') g r, with r from me to you and g r the gradient of W at you.
struct Sum { acceleration: vec3f }

@group(3) @binding(5) var<storage, read_write> pushes: array<vec4f>;

fn acts_on(me: Particle) -> bool { return me.stiffness >= 0.0; }

fn meet(me: Particle, you: Particle, slope: vec3f, sum: ptr<function, Sum>) {
    let yours = select(you.stiffness, me.stiffness, you.stiffness < 0.0);
    (*sum).acceleration += (me.stiffness + yours) * slope;
}

fn finish(me: Particle, sum: Sum) { pushes[me.slot] = vec4f(sum.acceleration, 1.0); }
