// The part of the mass of two bodies that the other one has, where a fixed one has all of it.
fn weight(i: u32, j: u32) -> f32 {
    if is_held(i) { return 0.0; }
    if is_held(j) { return 1.0; }
    return position[j].w / (position[i].w + position[j].w);
}
