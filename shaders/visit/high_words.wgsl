// Positions have one word, or forces are those of the first words: nothing is missing from their difference.
fn refined(r: vec3f, me: Particle, you: Particle) -> vec3f { return r; }
