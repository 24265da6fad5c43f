// Reflecting boundaries: x ← 2 b − x and v ← −v at a side b, as often as it takes until low ≤ x ≤ high.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> position: array<vec4f>; // xyz, mass
@group(1) @binding(1) var<storage, read_write> velocity: array<vec4f>; // xyz, radius

const WORKGROUP: u32 = 64u;
const REFLECTING: u32 = 2u;

// The new position along an axis, and the new sign of its velocity there.
fn thrown_back(x: f32, low: f32, high: f32, side: u32) -> vec2f {
    // A particle inside stays there bit for bit.
    if side != REFLECTING || (x >= low && x <= high) { return vec2f(x, 1.0); }
    // Two reflections are a shift. After as many as there are it is beyond a side by half a box at most, and where the
    // quotient rounds to one shift more or less, the last reflection leads to the same place.
    let shift = 2.0 * (high - low);
    let near = x - shift * round((x - 0.5 * (low + high)) / shift);
    // From far out what is left of the digits may lead anywhere; not beyond the other side.
    if near < low { return vec2f(min(low + (low - near), high), -1.0); }
    if near > high { return vec2f(max(high - (near - high), low), -1.0); }
    return vec2f(near, 1.0);
}

@compute @workgroup_size(WORKGROUP)
fn reflecting(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count && !is_held(i) && is_active(i) {
        let x = position[i];
        // Positions that are not finite are kept: the watch names the particle.
        if !broken(x) {
            let v = velocity[i];
            let sides = vec3u(world.sides, world.sides >> 8u, world.sides >> 16u) & vec3u(255u);
            let along_x = thrown_back(x.x, world.low.x, world.high.x, sides.x);
            let along_y = thrown_back(x.y, world.low.y, world.high.y, sides.y);
            let along_z = thrown_back(x.z, world.low.z, world.high.z, sides.z);
            position[i] = vec4f(along_x.x, along_y.x, along_z.x, x.w);
            velocity[i] = v * vec4f(along_x.y, along_y.y, along_z.y, 1.0);
        }
    }
}
