// The collision-free speed model (Tordeux, Chraibi & Seyfried 2015):  v = V e,  V = min(v₀, max(0, s / T)),  with s the least d − R − R' to those in front,
// which are where a disc that goes along e would touch them:  e · r ≥ 0  and  |e × r| ≤ R + R'.
struct Params { unused_word: u32, time_gap: f32 }
struct Sum { spacing: f32, others: u32 }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<storage, read> wish: array<vec4f>;         // way, radius, speed
@group(3) @binding(2) var<storage, read_write> course: array<vec4f>; // direction, speed, distance to the nearest wall

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let own = course[me.index];
    let yours = wish[you.index];
    let both = wish[me.index].z + yours.z;
    let distance = length(r);
    let is_in_front = dot(own.xy, r.xy) >= 0.0 && abs(own.x * r.y - own.y * r.x) <= both;
    let spacing = distance - both;
    let is_nearest = (*sum).others == 0u || spacing < (*sum).spacing;
    if yours.w >= 0.0 && distance > 0.0 && is_in_front && is_nearest && !is_hidden(me.position.xy, r.xy, own.w) {
        *sum = Sum(spacing, 1u);
    }
}

fn merge(total: ptr<function, Sum>, part: Sum) {
    if part.others > 0u && ((*total).others == 0u || part.spacing < (*total).spacing) { *total = part; }
}

fn finish(me: Particle, sum: Sum) {
    // Of none of its pedestrians the speed stays 0.
    var speed = max(wish[me.index].w, 0.0);
    if sum.others > 0u { speed = clamp(sum.spacing / params.time_gap, 0.0, speed); }
    course[me.index].z = speed;
}
