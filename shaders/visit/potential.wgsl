// Central forces of a pair potential. A law defines: fn energy(me, you, distance: f32, inverse: f32) -> Energy, of which inverse = 1 / distance.
struct Energy { value: f32, slope: f32 }
struct Sum { force: vec3f, energy: f32 }

// Two at one place have no direction between them: where the energy is finite there, so is the inverse, and the force is 0.
const SMALLEST: f32 = 1e-36;

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let square = dot(r, r);
    let inverse = inverseSqrt(max(square, SMALLEST));
    let pair = energy(me, you, square * inverse, inverse);
    (*sum).force += (pair.slope * inverse) * r;
    (*sum).energy += pair.value;
}

fn merge(total: ptr<function, Sum>, part: Sum) {
    (*total).force += part.force;
    (*total).energy += part.energy;
}
