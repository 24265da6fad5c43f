// What every kernel knows: the time at which forces are evaluated, the step size, the steps done, the particles.
struct World { time: f32, dt: f32, step: u32, count: u32 }

// A dispatch of more than 65 535 workgroups is folded over two dimensions; this is the workgroup's place in line.
fn folded(group: vec3u, groups: vec3u) -> u32 { return group.y * groups.x + group.x; }
