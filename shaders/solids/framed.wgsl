// A wall with a prescribed motion: its pose, found once for all particles.
@group(3) @binding(4) var<storage, read> wall_frame: array<vec4f>;

fn frame() -> Frame {
    return Frame(wall_frame[0].xyz, wall_frame[1].xyz, wall_frame[2], wall_frame[3].xyz, wall_frame[4].xyz);
}
