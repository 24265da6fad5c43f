// A column of numbers that lies in one component of a buffer of vectors.
@group(1) @binding(0) var<storage, read> column_buffer: array<vec4f>;

override COMPONENT: u32;

fn value(i: u32) -> f32 { return column_buffer[i][COMPONENT]; }
