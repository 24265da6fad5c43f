// A far group is evaluated as one particle, at its centre of mass.
fn distant(me: Particle, you: Group, r: vec3f, sum: ptr<function, Sum>) {
    gather(me, Particle(0xffffffffu, me.position + r, you.mass), r, sum);
}
