// Iterations end where the last difference changes by no more than the last place, or by what rounding may do and not less than before.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> radau_largest: array<vec4f>; // change, acceleration, last difference
@group(1) @binding(1) var<storage, read_write> radau_iteration: array<Iteration>;

override ROUNDING: f32 = 0.0;
override NOISE: f32 = 0.0;

@compute @workgroup_size(1)
fn radau_settle() {
    let all = radau_largest[0];
    let change = all.x / all.y;
    let count = radau_iteration[0].count + 1.0;
    let small = all.x <= ROUNDING * all.y;
    let idle = count > 1.0 && change >= radau_iteration[0].change && change <= NOISE;
    radau_iteration[0] = Iteration(select(0.0, 1.0, small || idle || world.dt == 0.0), count, change);
}
