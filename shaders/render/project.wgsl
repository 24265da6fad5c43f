// The projected position, depth and radius of each particle:  r = max(R k s, drop k s, marker (m / heaviest)^⅛), k times as large as it is; as a ball if
// that is enough pixels.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> position: array<vec4f>;             // xyz, mass
@group(1) @binding(1) var<storage, read> velocity: array<vec4f>;             // xyz, radius
@group(1) @binding(2) var<storage, read_write> projected: array<vec4f>;      // pixels right and down, depth of its front, radius
@group(3) @binding(1) var<storage, read_write> not_drawn: array<atomic<u32>>;   // out of the picture, not a number

const WORKGROUP: u32 = 64u;
const HIDDEN: f32 = -1.0;
// The radius of the lightest, relative to that of the heaviest.
const LIGHTEST: f32 = 0.5;

fn marker(mass: f32) -> f32 {
    var part = 1.0;
    if frame.heaviest > 0.0 { part = sqrt(sqrt(sqrt(clamp(mass / frame.heaviest, 0.0, 1.0)))); }
    return frame.marker * max(part, LIGHTEST);
}

@compute @workgroup_size(WORKGROUP)
fn project(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let x = position[i];
        let v = velocity[i];
        var result = vec4f(0.0, 0.0, 0.0, HIDDEN);
        if broken(x) || broken(v) {
            atomicAdd(&not_drawn[1], 1u);
        } else {
            let seen = see(x.xyz);
            let size = max(max(v.w, frame.drop) * frame.magnified * seen.scale, marker(x.w));
            let ball = size >= frame.solid;
            let radius = select(0.0, min(size, frame.largest), ball);
            let reach = select(frame.glow, radius + 0.5, ball);
            let touched = box(seen.place, reach);
            if seen.visible && all(touched.low < touched.high) {
                result = vec4f(seen.place, seen.depth - radius / seen.scale, radius);
            } else {
                atomicAdd(&not_drawn[0], 1u);
            }
        }
        projected[i] = result;
    }
}
