// What the part of the step in single precision lacks.
override REST: f32 = 0.0;

fn rest() -> f32 { return REST; }
