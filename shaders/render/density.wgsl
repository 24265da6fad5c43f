// Mass along the line of sight:  Σ = Σ m w,  w = q²,  q = 1 − d²/R², in whole parts of the light of the mean mass.
// Integers add up to the same bits in any order, and all mass on one pixel does not overflow. Where nothing has mass, particles are counted.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> position: array<vec4f>;  // xyz, mass
@group(1) @binding(2) var<storage, read> projected: array<vec4f>; // pixels right and down, depth, radius
@group(3) @binding(2) var<storage, read_write> canvas: array<atomic<u32>>; // red has it all

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn density(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let p = projected[i];
        if p.w == 0.0 {
            // Half of it: rounding up does not overflow either.
            var light = 0.5 * frame.unit;
            if frame.mean > 0.0 { light *= position[i].w / frame.mean; }
            let touched = box(p.xy, frame.glow);
            for (var y = touched.low.y; y < touched.high.y; y += 1) {
                for (var x = touched.low.x; x < touched.high.x; x += 1) {
                    let d = (middle(x, y) - p.xy) / frame.glow;
                    let q = 1.0 - dot(d, d);
                    if q > 0.0 { atomicAdd(&canvas[3u * pixel(x, y)], u32(light * q * q + 0.5)); }
                }
            }
        }
    }
}
