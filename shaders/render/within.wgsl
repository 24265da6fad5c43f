// The part of a pixel within the box of a fluid in a plane.
fn within(place: vec2f) -> f32 {
    let low = clamp(place - vec2f(frame.left, frame.top) + 0.5, vec2f(0.0), vec2f(1.0));
    let high = clamp(vec2f(frame.right_end, frame.bottom) - place + 0.5, vec2f(0.0), vec2f(1.0));
    return low.x * low.y * high.x * high.y;
}
