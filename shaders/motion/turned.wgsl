// R r − r, of the unit quaternion q of the turn R: exactly zero without rotation.
fn turned(q: vec4f, r: vec3f) -> vec3f { return 2.0 * cross(q.xyz, cross(q.xyz, r) + q.w * r); }
