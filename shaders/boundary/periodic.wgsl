// Periodic boundaries: x ← x − L ⌊(x − low) / L⌋ along each axis with a period L, so that low ≤ x < high.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> position: array<vec4f>; // xyz, mass

const WORKGROUP: u32 = 64u;

fn wrapped(x: f32, low: f32, high: f32, period: f32, frequency: f32) -> f32 {
    // A particle inside stays there bit for bit.
    if period == 0.0 || (x >= low && x < high) { return x; }
    let inside = x - period * floor((x - low) * frequency);
    if inside >= low && inside < high { return inside; }
    // A position that rounds to the far side, or beyond the near one, is at the near one.
    return low;
}

@compute @workgroup_size(WORKGROUP)
fn periodic(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let x = position[i];
        // Positions that are not finite are kept: the watch names the particle.
        if !broken(x) {
            position[i] = vec4f(
                wrapped(x.x, world.low.x, world.high.x, world.period.x, world.frequency.x),
                wrapped(x.y, world.low.y, world.high.y, world.period.y, world.frequency.y),
                wrapped(x.z, world.low.z, world.high.z, world.period.z, world.frequency.z),
                x.w,
            );
        }
    }
}
