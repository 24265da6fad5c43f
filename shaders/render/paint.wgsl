// Colours by speed: the map "inferno" (van der Walt and Smith 2015) as a polynomial (Zucker 2019), without its black end.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> velocity: array<vec4f>;        // xyz, radius
@group(1) @binding(1) var<storage, read_write> color: array<u32>;       // red, green, blue from the lowest byte on

const WORKGROUP: u32 = 64u;
const DARK_END: f32 = 0.3;
const BRIGHT_END: f32 = 0.93;

fn inferno(t: f32) -> vec3f {
    let c0 = vec3f(0.0002189403691192265, 0.001651004631001012, -0.01948089843709184);
    let c1 = vec3f(0.1065134194856116, 0.5639564367884091, 3.932712388889277);
    let c2 = vec3f(11.60249308247187, -3.972853965665698, -15.9423941062914);
    let c3 = vec3f(-41.70399613139459, 17.43639888205313, 44.35414519872813);
    let c4 = vec3f(77.162935699427, -33.40235894210092, -81.80730925738993);
    let c5 = vec3f(-71.31942824499214, 32.62606426397723, 73.20951985803202);
    let c6 = vec3f(25.13112622477341, -12.24266895238567, -23.07032500287172);
    return c0 + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * (c5 + t * c6)))));
}

@compute @workgroup_size(WORKGROUP)
fn paint(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let part = clamp((length(velocity[i].xyz) - frame.slow) / (frame.fast - frame.slow), 0.0, 1.0);
        let rgb = clamp(inferno(mix(DARK_END, BRIGHT_END, part)), vec3f(0.0), vec3f(1.0));
        color[i] = pack4x8unorm(vec4f(rgb, 1.0));
    }
}
