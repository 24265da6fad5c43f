// The first of two passes of an embedded-atom potential (Sutton & Chen, Phil. Mag. Lett. 61, 139, 1990): the electron density at each atom,
//   ρᵢ = Σⱼ (a / r)⁶,
// smoothed to 0 between onset and range.
struct Params { spacing: f32, range: f32, onset: f32 }
// A value and its slope along the distance, as `ended` smooths them.
struct Energy { value: f32, slope: f32 }
struct Sum { density: f32 }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<storage, read_write> electron_density: array<f32>;

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let distance = length(r);
    let x = params.spacing / distance;
    let cube = x * x * x;
    (*sum).density += ended(Energy(cube * cube, 0.0), Energy(), distance, params.range, params.onset).value;
}

fn finish(me: Particle, sum: Sum) {
    electron_density[me.index] = sum.density;
}
