// A column of numbers, one by one.
@group(1) @binding(0) var<storage, read> column_buffer: array<f32>;

fn value(i: u32) -> f32 { return column_buffer[i]; }
