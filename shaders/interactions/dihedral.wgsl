// A torsion about the bond b → c of four particles a, b, c, d:  E = k (1 + cos(n φ − δ)),  with the angle φ between the planes of
// a, b, c and of b, c, d and its gradient by Blondel & Karplus 1996, which is finite at every φ.
struct Sum { force: vec3f, energy: f32 }

fn gather(me: Particle, corner: Corner, sum: ptr<function, Sum>) {
    let second = particle(corner.second).position;
    let third = particle(corner.third).position;
    let f = shortest(particle(corner.first).position - second);
    let g = shortest(second - third);
    let h = shortest(particle(corner.fourth).position - third);
    let axis = length(g);
    let a = cross(f, g);
    let b = cross(h, g);
    let a_size = length(a);
    let b_size = length(b);
    // Three particles in a line are in no plane.
    if a_size == 0.0 || b_size == 0.0 { return; }
    let p = a / a_size;
    let q = b / b_size;
    let turn = vec2f(dot(p, q), dot(cross(q, p), g) / axis);
    // Cosine and sine of n φ, and of n φ − δ.
    var many = vec2f(1.0, 0.0);
    for (var n = 0u; n < corner.multiplicity; n += 1u) {
        many = vec2f(many.x * turn.x - many.y * turn.y, many.x * turn.y + many.y * turn.x);
    }
    let cosine = many.x * corner.cosine + many.y * corner.sine;
    let sine = many.y * corner.cosine - many.x * corner.sine;
    // The gradient of φ at both ends, and what they leave to the two between.
    let from_first = p * (-axis / a_size);
    let from_fourth = q * (axis / b_size);
    let between = p * (dot(f, g) / (a_size * axis)) - q * (dot(h, g) / (b_size * axis));
    var slope = from_first;
    if corner.place == 1u { slope = between - from_first; }
    if corner.place == 2u { slope = -between - from_fourth; }
    if corner.place == 3u { slope = from_fourth; }
    (*sum).force += (corner.stiffness * f32(corner.multiplicity) * sine) * slope;
    (*sum).energy += corner.stiffness * (1.0 + cosine);
}

fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.force, sum.energy) / me.mass; }
