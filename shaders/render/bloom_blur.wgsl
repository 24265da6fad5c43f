// A bloom: light spreads along the rows, or along the columns, with weights w = (1 − k² / K²)⁴, nearly as round as Gauss's.
@group(3) @binding(9) var<storage, read_write> bloom: array<vec4f>;
@group(3) @binding(10) var<storage, read_write> blurred: array<vec4f>;

// From `bloom` to `blurred` along the rows, or back along the columns.
override DOWN: bool = false;

const WORKGROUP: u32 = 64u;
const SHRINK: u32 = 4u;

@compute @workgroup_size(WORKGROUP)
fn blur(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    let columns = (frame.width + SHRINK - 1u) / SHRINK;
    let rows = (frame.height + SHRINK - 1u) / SHRINK;
    if i < columns * rows {
        let stride = i32(select(1u, columns, DOWN));
        let at = i32(select(i % columns, i / columns, DOWN));
        let last = i32(select(columns, rows, DOWN)) - 1;
        let reach = i32(frame.reach);
        var sum = vec3f();
        var weights = 0.0;
        for (var k = -reach; k <= reach; k += 1) {
            let part = f32(k) / f32(reach + 1);
            let square = (1.0 - part * part) * (1.0 - part * part);
            let weight = square * square;
            weights += weight;
            // Beyond the edge it is dark.
            if at + k >= 0 && at + k <= last {
                let there = i32(i) + k * stride;
                if DOWN { sum += weight * blurred[there].rgb; } else { sum += weight * bloom[there].rgb; }
            }
        }
        if DOWN {
            bloom[i] = vec4f(sum / weights, 0.0);
        } else {
            blurred[i] = vec4f(sum / weights, 0.0);
        }
    }
}
