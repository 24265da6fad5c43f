// The next step is limited by the error of the last one.
@group(1) @binding(0) var<storage, read> radau_step: array<f32>; // 2 steps in a longest one
@group(1) @binding(1) var<storage, read_write> largest_criterion: array<vec4f>;

@compute @workgroup_size(1)
fn radau_criterion() { largest_criterion[0] = vec4f(0.0, 0.0, 0.0, radau_step[2]); }
