// A smooth surface: a mean along the rows, or along the columns, of depths in a narrow range (Truong and Yuksel 2018), with
// weights w = (1 − k² / K²)², which fade out towards the far end of the range. A depth farther than that belongs to another surface: then its mirror image is excluded too,
// so that a slope is not a step. A nearer depth counts as at the end of the range.
@group(3) @binding(20) var<storage, read> level: array<f32>;
@group(3) @binding(21) var<storage, read> thickness: array<f32>;
@group(3) @binding(22) var<storage, read> dye: array<u32>;
@group(3) @binding(23) var<storage, read_write> next_level: array<f32>;
@group(3) @binding(24) var<storage, read_write> next_thickness: array<f32>;
@group(3) @binding(25) var<storage, read_write> next_dye: array<u32>;

@group(3) @binding(3) var<storage, read> front: array<u32>;

override DOWN: bool = false;
// Whether pixels beside the drops get a surface too, where no solid hides it: outlines are rounder than drops.
override FILL: bool = false;

const WORKGROUP: u32 = 64u;
const NEVER: f32 = 1e30;

fn smooth_at(i: u32) {
    let stride = i32(select(1u, frame.width, DOWN));
    let at = i32(select(i % frame.width, i / frame.width, DOWN));
    let last = i32(select(frame.width, frame.height, DOWN)) - 1;
    let z = level[i];
    let range = frame.range * frame.drop;
    var scale = frame.scale;
    if frame.distance > 0.0 { scale *= frame.distance / z; }
    let wide = min(frame.calm * frame.drop * scale, f32(frame.farthest));
    // Pixels that are there on both sides.
    let end = min(i32(wide), min(at, last - at));
    var sum = vec2f(z, thickness[i]);
    var color = unpack4x8unorm(dye[i]);
    var weights = 1.0;
    for (var k = 1; k <= end; k += 1) {
        let a = i32(i) - k * stride;
        let b = i32(i) + k * stride;
        let room = clamp(2.0 - 2.0 * (max(level[a], level[b]) - z) / range, 0.0, 1.0);
        if room > 0.0 {
            let part = f32(k) / (wide + 1.0);
            let weight = room * (1.0 - part * part) * (1.0 - part * part);
            sum += weight * vec2f(max(level[a], z - range) + max(level[b], z - range), thickness[a] + thickness[b]);
            color += weight * (unpack4x8unorm(dye[a]) + unpack4x8unorm(dye[b]));
            weights += 2.0 * weight;
        }
    }
    next_level[i] = sum.x / weights;
    next_thickness[i] = sum.y / weights;
    next_dye[i] = pack4x8unorm(color / weights);
}

fn fill_at(i: u32) {
    let stride = i32(select(1u, frame.width, DOWN));
    let at = i32(select(i % frame.width, i / frame.width, DOWN));
    let last = i32(select(frame.width, frame.height, DOWN)) - 1;
    let reach = i32(select(frame.soft, frame.softer, frame.turn > 0.0));
    var sum = vec2f();
    var color = vec4f();
    var weights = 0.0;
    for (var k = -min(reach, at); k <= min(reach, last - at); k += 1) {
        let other = i32(i) + k * stride;
        if level[other] < NEVER {
            let part = f32(k) / f32(reach + 1);
            let weight = (1.0 - part * part) * (1.0 - part * part);
            sum += weight * vec2f(level[other], thickness[other]);
            color += weight * unpack4x8unorm(dye[other]);
            weights += weight;
        }
    }
    if weights > 0.0 && key(sum.x / weights) < front[i] {
        next_level[i] = sum.x / weights;
        next_thickness[i] = sum.y / weights;
        next_dye[i] = pack4x8unorm(color / weights);
    }
}

@compute @workgroup_size(WORKGROUP)
fn smooth_surface(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < frame.width * frame.height {
        next_level[i] = level[i];
        next_thickness[i] = thickness[i];
        next_dye[i] = dye[i];
        if level[i] < NEVER { smooth_at(i); } else if FILL { fill_at(i); }
    }
}
