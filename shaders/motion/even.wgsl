// The time with a fixed step: the number of steps, and a fraction of one.
struct Now { whole: u32, rest: f32, unit: f32 }

fn now(part: f32) -> Now { return Now(world.step, part, world.dt); }

// The time at which the step began.
fn begun() -> f32 { return f32(world.step) * world.dt; }
