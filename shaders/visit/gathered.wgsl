// A sum as its law gathers it.
fn gathered(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) { gather(me, you, r, sum); }

fn settled(sum: Sum) -> Sum { return sum; }
