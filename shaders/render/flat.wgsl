// What is linear in the picture: 1 / depth where rays meet in an eye, depth where they are parallel. And back.
fn flat_depth(depth: f32) -> f32 {
    if frame.distance > 0.0 { return 1.0 / depth; }
    return depth;
}
