// The second of two passes of an embedded-atom potential (Sutton & Chen, Phil. Mag. Lett. 61, 139, 1990): the energy
//   U = ε [½ Σᵢ Σⱼ (a / r)⁹ − c Σᵢ √ρᵢ],
// and with V = (a / r)⁹ and φ = (a / r)⁶, both smoothed to 0 between onset and range, the force on atom i
//   Fᵢ = ε Σⱼ [V' − ½ c (1 / √ρᵢ + 1 / √ρⱼ) φ'] r / |r|,  r from i to j.
struct Params { epsilon: f32, spacing: f32, c: f32, range: f32, onset: f32 }
// A value and its slope along the distance, as `ended` smooths them.
struct Energy { value: f32, slope: f32 }
struct Sum { force: vec3f, repulsion: f32 }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<storage, read> electron_density: array<f32>;

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let distance = length(r);
    let x = params.spacing / distance;
    let cube = x * x * x;
    let sixth = Energy(cube * cube, -6.0 * cube * cube / distance);
    let ninth = Energy(cube * cube * cube, -9.0 * cube * cube * cube / distance);
    let density = ended(sixth, Energy(), distance, params.range, params.onset);
    let repulsion = ended(ninth, Energy(), distance, params.range, params.onset);
    let embedding = inverse_root(electron_density[me.index]) + inverse_root(electron_density[you.index]);
    (*sum).force += (repulsion.slope - 0.5 * params.c * embedding * density.slope) / distance * r;
    (*sum).repulsion += repulsion.value;
}

// Of two atoms at the range ρ may be 0, and so is the slope of φ.
fn inverse_root(density: f32) -> f32 {
    return inverseSqrt(max(density, 1e-30));
}

// Of what `w` returns an atom has one half, as of the energy of a pair: the energy of embedding, which is its own, counts twice.
fn finish(me: Particle, sum: Sum) -> vec4f {
    let embedding = -2.0 * params.c * sqrt(electron_density[me.index]);
    return params.epsilon / me.mass * vec4f(sum.force, sum.repulsion + embedding);
}
