// Convergence of the solve, by the mean error of the fluid's particles.
struct Extent { unused_word: u32, elements: u32, chunk: u32 }

@group(3) @binding(6) var<storage, read> errors: array<f32>;
@group(3) @binding(7) var<storage, read_write> dfsph_state: array<State>;
@group(3) @binding(11) var<uniform> extent: Extent;

override SOLVE: u32 = 0u;
// The number of cells of the fluid, after which it ends.
override CELLS: u32 = 1u;
override TOLERANCE: f32 = 0.0;
override LEAST: f32 = 0.0;
override MOST: f32 = 0.0;

@compute @workgroup_size(WORKGROUP)
fn decide(@builtin(local_invocation_index) lane: u32) {
    var sum = 0.0;
    for (var k = lane; k < extent.elements; k += WORKGROUP) { sum += errors[k]; }
    sum = total(lane, vec4f(sum)).x;
    if lane == 0u {
        var state = dfsph_state[SOLVE];
        state.error = sum / max(f32(starts[CELLS]), 1.0);
        state.iterations += 1.0;
        if broken(vec4f(sum)) {
            state.code = 2.0;
        } else if state.error <= TOLERANCE && state.iterations >= LEAST {
            state.code = 1.0;
        } else if state.iterations >= MOST {
            state.code = 3.0;
        }
        dfsph_state[SOLVE] = state;
    }
}
