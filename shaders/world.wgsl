// Parameters of every kernel: the time at which forces are evaluated, the step size, the steps done, the rows that are in use and
// all that there are, and the box. `sides` has a byte for each axis: 0 open, 1 periodic, 2 reflecting. `period` is 0 along axes
// that have none, and so is `frequency`, one over it. `zero` is 0, which a compiler cannot know.
struct World {
    unused_word: u32,
    time: f32, dt: f32, step: u32, count: u32, capacity: u32,
    low: vec3f, dimensions: u32,
    high: vec3f, sides: u32,
    period: vec3f, zero: u32,
    frequency: vec3f,
}

// A dispatch of more than 65 535 workgroups is folded over two dimensions; this is the linear index of the workgroup.
fn folded(group: vec3u, groups: vec3u) -> u32 { return group.y * groups.x + group.x; }
