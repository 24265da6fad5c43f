// The structure factor of masses, as it is.
fn strength(i: u32) -> f32 { return position[i].w; }

fn kept(wave: u32, sum: vec2f) -> vec2f { return sum; }
