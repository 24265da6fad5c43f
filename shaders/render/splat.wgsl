// Light of small particles on the canvas:  w = q² (¼ + ¾ q⁴),  q = 1 − d²/R², a core in a wider glow, in whole parts of `unit`.
// Integers add up to the same bits in any order. The unit is such that all lights on one pixel do not overflow.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(2) var<storage, read> projected: array<vec4f>; // pixels right and down, depth, radius
@group(1) @binding(3) var<storage, read> color: array<u32>;
@group(3) @binding(2) var<storage, read_write> canvas: array<atomic<u32>>; // red, green, blue
@group(3) @binding(3) var<storage, read> front: array<u32>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn splat(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let p = projected[i];
        if p.w == 0.0 {
            let light = frame.unit * unpack4x8unorm(color[i]).rgb;
            let touched = box(p.xy, frame.glow);
            for (var y = touched.low.y; y < touched.high.y; y += 1) {
                for (var x = touched.low.x; x < touched.high.x; x += 1) {
                    let d = (middle(x, y) - p.xy) / frame.glow;
                    let q = 1.0 - dot(d, d);
                    let at = pixel(x, y);
                    if q > 0.0 && key(p.z) < front[at] {
                        let add = vec3u(light * (q * q * (0.25 + 0.75 * q * q * q * q)) + 0.5);
                        atomicAdd(&canvas[3u * at], add.r);
                        atomicAdd(&canvas[3u * at + 1u], add.g);
                        atomicAdd(&canvas[3u * at + 2u], add.b);
                    }
                }
            }
        }
    }
}
