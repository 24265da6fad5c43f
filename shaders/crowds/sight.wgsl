// Whether no wall is between the line of an exit and a pedestrian at x, which is at r from its middle. The line may end at a wall, and be behind it by
// rounding: of the way from its nearest point the first 64th is not asked.
@group(1) @binding(9) var<storage, read> walls: array<Wall>;

override COUNT: u32 = 1u;

fn is_free(x: vec3f, r: vec3f) -> bool {
    let axis = params.axis.xy;
    let away = r.xy - clamp(dot(r.xy, axis) / dot(axis, axis), -0.5, 0.5) * axis;
    let start = x.xy - 0.984375 * away;
    var free = true;
    for (var k = 0u; k < COUNT; k += 1u) { free = free && !crosses(walls[k], start, x.xy); }
    return free;
}
