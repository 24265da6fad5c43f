// Signed distances φ of simple solids, and ∇φ (Hart 1996), at a displacement d from the centre: sphere 0, box 1, plane 2, capsule 3, and the
// surface of a cone 4, which has no inside, with the radius of its other end in `size.x`.
// `axis` is the normal of a plane, or the vector from one end of a capsule's or a cone's axis to the other. Where all directions outwards are equally long,
// the one along x is used; on the axis of a capsule the one perpendicular to it and to z.
fn signed_distance(shape: u32, d: vec3f, radius: f32, size: vec3f, axis: vec3f) -> vec4f {
    if shape == 2u { return vec4f(axis, dot(axis, d)); }
    if shape == 1u { return to_box(d, size); }
    if shape == 4u { return to_cone(d, radius, size.x, axis); }
    var r = d;
    var middle = vec3f(1.0, 0.0, 0.0);
    if shape == 3u {
        let square = dot(axis, axis);
        if square > 0.0 { r -= clamp(dot(d, axis) / square, -0.5, 0.5) * axis; }
        let across = vec3f(axis.y, -axis.x, 0.0);
        if dot(across, across) > 0.0 { middle = normalize(across); }
    }
    let distance = length(r);
    if distance > 0.0 { return vec4f(r / distance, distance - radius); }
    return vec4f(middle, -radius);
}

fn to_box(d: vec3f, size: vec3f) -> vec4f {
    let side = select(vec3f(-1.0), vec3f(1.0), d >= vec3f());
    var depth = abs(d) - 0.5 * size;
    // In the plane there is no way out above it.
    if world.dimensions == 2u { depth.z = -3e38; }
    let outside = max(depth, vec3f());
    let distance = length(outside);
    if distance > 0.0 { return vec4f(side * outside / distance, distance); }
    // Inside: to the nearest face.
    if depth.x >= max(depth.y, depth.z) { return vec4f(side.x, 0.0, 0.0, depth.x); }
    if depth.y >= depth.z { return vec4f(0.0, side.y, 0.0, depth.y); }
    return vec4f(0.0, 0.0, side.z, depth.z);
}

// In the plane of the axis and the point, the surface is a segment.
fn to_cone(d: vec3f, radius: f32, end: f32, axis: vec3f) -> vec4f {
    let height = length(axis);
    let along = axis / height;
    let z = dot(d, along);
    let across = d - z * along;
    let distance = length(across);
    let start = vec2f(distance - radius, z + 0.5 * height);
    let way = vec2f(end - radius, height);
    let left = start - clamp(dot(start, way) / dot(way, way), 0.0, 1.0) * way;
    let gap = length(left);
    // On the axis no direction is nearer than another.
    var out = vec3f();
    if distance > 0.0 { out = across / distance; }
    if gap > 0.0 { return vec4f((left.x * out + left.y * along) / gap, gap); }
    return vec4f(out, 0.0);
}
