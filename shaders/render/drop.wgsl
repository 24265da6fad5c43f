// The depth of a drop of fluid at each pixel: a ball that is flatter towards its edge.
fn bulge(p: vec4f, x: i32, y: i32) -> f32 {
    let d = (middle(x, y) - p.xy) / p.w;
    return sqrt(max(1.0 - dot(d, d), 0.0));
}

// Of its front. With a pinhole  z = depth − r / s  and  s = d S / depth,  which gives  s = (d S − r) / z.
fn depth_at(p: vec4f, bulge: f32) -> f32 {
    var scale = frame.scale;
    if frame.distance > 0.0 { scale = (frame.scale * frame.distance - p.w) / p.z; }
    return p.z + frame.oblate * p.w * (1.0 - bulge) / scale;
}
