// A smooth outline: weighted means along rows, or along columns, of the covered parts of pixels, with w = (1 − k² / K²)². What does
// not count has no weight in the end: a fluid goes on behind a solid.
@group(3) @binding(28) var<storage, read> cover: array<f32>;
@group(3) @binding(29) var<storage, read_write> next_cover: array<f32>;

override DOWN: bool = false;

const WORKGROUP: u32 = 64u;

fn cover_of(i: i32) -> vec3f { return vec3f(cover[3 * i], cover[3 * i + 1], cover[3 * i + 2]); }

@compute @workgroup_size(WORKGROUP)
fn soften(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < frame.width * frame.height {
        let stride = i32(select(1u, frame.width, DOWN));
        let at = i32(select(i % frame.width, i / frame.width, DOWN));
        let last = i32(select(frame.width, frame.height, DOWN)) - 1;
        let reach = vec3u(frame.soft, select(frame.soft, frame.softer, frame.turn > 0.0), frame.soft);
        let farthest = i32(max(reach.x, reach.y));
        var sum = cover_of(i32(i));
        var weights = vec3f(1.0);
        for (var k = 1; k <= farthest; k += 1) {
            let part = min(vec3f(f32(k)) / vec3f(reach + 1u), vec3f(1.0));
            let weight = (1.0 - part * part) * (1.0 - part * part);
            let before = i32(i) - min(k, at) * stride;
            let after = i32(i) + min(k, last - at) * stride;
            sum += weight * (cover_of(before) + cover_of(after));
            weights += 2.0 * weight;
        }
        sum /= weights;
        next_cover[3u * i] = sum.x;
        next_cover[3u * i + 1u] = sum.y;
        next_cover[3u * i + 2u] = sum.z;
    }
}
