// The lengths of a column of vectors.
@group(1) @binding(0) var<storage, read> column_buffer: array<vec4f>;

fn value(i: u32) -> f32 {
    let v = column_buffer[i].xyz;
    // Squares of what is very large or very small are none.
    let most = max(max(abs(v.x), abs(v.y)), abs(v.z));
    if most > 0.0 { return most * length(v / most); }
    return length(v);
}
