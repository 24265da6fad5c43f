// The parts of each pixel that drops and walls cover, and the part that counts: within the box of a fluid, and not behind a
// solid.
@group(3) @binding(16) var<storage, read> crest: array<u32>;
@group(3) @binding(18) var<storage, read> rim: array<u32>;
@group(3) @binding(27) var<storage, read> wall: array<u32>;
@group(3) @binding(28) var<storage, read_write> cover: array<f32>;

const WORKGROUP: u32 = 64u;

// What fluid and walls cover of a pixel, in parts of 255, if it is in the picture.
fn drawn(x: i32, y: i32) -> vec2u {
    if u32(x) >= frame.width || u32(y) >= frame.height { return vec2u(); }
    return vec2u(rim[pixel(x, y)], wall[pixel(x, y)]);
}

// The same with what sticks out at the other side of a periodic box.
fn all_drawn(x: i32, y: i32) -> vec2u {
    var most = drawn(x, y);
    let across = i32(frame.wrap_across);
    let down = i32(frame.wrap_down);
    if across > 0 { most = max(most, max(drawn(x - across, y), drawn(x + across, y))); }
    if down > 0 { most = max(most, max(drawn(x, y - down), drawn(x, y + down))); }
    return most;
}

@compute @workgroup_size(WORKGROUP)
fn covers(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < frame.width * frame.height {
        let x = i32(i % frame.width);
        let y = i32(i / frame.width);
        let hidden = crest[i] == NONE && rim[i] > 0u;
        let part = select(within(middle(x, y)), 0.0, hidden);
        let both = vec2f(all_drawn(x, y)) / 255.0;
        cover[3u * i] = part * both.x;
        // In space nothing is a wall: drops again, which are made smooth farther.
        cover[3u * i + 1u] = part * select(both.y, both.x, frame.turn > 0.0);
        cover[3u * i + 2u] = part;
    }
}
