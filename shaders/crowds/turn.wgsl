// The direction of a pedestrian (Tordeux, Chraibi & Seyfried 2015): with n from the other to me, at the distance d,
//   e = unit(way + Σ a exp((R + R' − d) / D) n).
struct Params { unused_word: u32, repulsion: f32, decay: f32 }
struct Sum { push: vec2f }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<storage, read> wish: array<vec4f>;         // way, radius, speed
@group(3) @binding(2) var<storage, read_write> course: array<vec4f>; // direction, speed, distance to the nearest wall

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let yours = wish[you.index];
    let distance = length(r);
    // Two at the same place have no direction between them.
    if yours.w >= 0.0 && distance > 0.0 && !is_hidden(me.position.xy, r.xy, course[me.index].w) {
        let overlap = wish[me.index].z + yours.z - distance;
        (*sum).push -= params.repulsion * exp(overlap / params.decay) / distance * r.xy;
    }
}

fn merge(total: ptr<function, Sum>, part: Sum) {
    (*total).push += part.push;
}

fn finish(me: Particle, sum: Sum) {
    if wish[me.index].w >= 0.0 {
        let e = unit(vec3f(wish[me.index].xy + sum.push, 0.0));
        course[me.index] = vec4f(e.xy, 0.0, course[me.index].w);
    }
}
