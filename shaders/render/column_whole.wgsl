// A column of whole numbers.
@group(1) @binding(0) var<storage, read> column_buffer: array<u32>;

fn value(i: u32) -> f32 { return f32(column_buffer[i]); }
