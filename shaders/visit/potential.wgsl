// The sum of a law that is a pair potential: force and energy. The file beside it has `gather`, by the distance or by its square.
struct Energy { value: f32, slope: f32 }
struct Sum { force: vec3f, energy: f32 }

// Two at one place have no direction between them: where the energy is finite there, so is the inverse, and the force is 0.
const SMALLEST: f32 = 1e-36;

fn merge(total: ptr<function, Sum>, part: Sum) {
    (*total).force += part.force;
    (*total).energy += part.energy;
}
