// The lengths of a column of vectors.
@group(1) @binding(0) var<storage, read> column_buffer: array<vec4f>;

fn value(i: u32) -> f32 { return length(column_buffer[i].xyz); }
