// A floor without walls, for pedestrians of models that set velocities.
struct Walls { push: vec2f, clearance: f32 }

fn before_walls(x: vec2f, radius: f32, repulsion: f32, decay: f32) -> Walls { return Walls(); }

fn is_hidden(x: vec2f, r: vec2f, clearance: f32) -> bool { return false; }

fn before_contact(x: vec2f, e: vec2f, radius: f32, most: f32) -> f32 { return most; }
