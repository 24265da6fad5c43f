// The usual sum of a law over pairs. A law that needs another brings its own `Sum` and `merge`.
struct Sum { acceleration: vec3f, potential: f32 }

fn merge(total: ptr<function, Sum>, part: Sum) {
    (*total).acceleration += part.acceleration;
    (*total).potential += part.potential;
}
