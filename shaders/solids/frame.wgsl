// The pose of a moving wall where forces are evaluated: its centre, the pivot of its motion, its turn, and its rates.
struct Params { unused_word: u32, position: vec3f, motion: u32 }
struct Frame { centre: vec3f, pivot: vec3f, turn: vec4f, velocity: vec3f, spin: vec3f }

@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> wall_frame: array<vec4f>;
@group(3) @binding(0) var<uniform> params: Params;

@compute @workgroup_size(1)
fn place_wall() {
    let at = frame();
    wall_frame[0] = vec4f(at.centre, 0.0);
    wall_frame[1] = vec4f(at.pivot, 0.0);
    wall_frame[2] = at.turn;
    wall_frame[3] = vec4f(at.velocity, 0.0);
    wall_frame[4] = vec4f(at.spin, 0.0);
}
