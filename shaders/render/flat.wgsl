// What is linear in the picture: 1 / depth with perspective, depth with parallel projection. And its inverse.
fn flat_depth(depth: f32) -> f32 {
    if frame.distance > 0.0 { return 1.0 / depth; }
    return depth;
}
