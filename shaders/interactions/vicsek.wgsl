// Vicsek's model (Vicsek et al. 1995) in the plane, as an acceleration:  a = (v' − v) / dt,  |v'| constant,  v' along
//   angular noise:    Arg Σ e^(iθ) + η ξ, with ξ between −1/2 and 1/2
//   vectorial noise:  Arg (Σ e^(iθ) + η n e^(2πi ξ))   (Grégoire & Chaté 2004)
// The sum is over the n in range, including the particle itself. Headings are summed as unit vectors, not as angles.
struct Params { unused_word: u32, speed: f32, eta: f32, vectorial: u32, seed_low: u32, seed_high: u32 }
struct Sum { heading: vec2f, neighbors: u32 }

@group(3) @binding(0) var<uniform> params: Params;

const TAU: f32 = 6.283185307;

fn heading(v: vec3f) -> vec2f { return unit(vec3f(v.xy, 0.0)).xy; }

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    (*sum).heading += heading(velocity_of(you));
    (*sum).neighbors += 1u;
}

fn merge(total: ptr<function, Sum>, part: Sum) {
    (*total).heading += part.heading;
    (*total).neighbors += part.neighbors;
}

fn finish(me: Particle, sum: Sum) -> vec4f {
    let v = velocity_of(me);
    let own = heading(v);
    let xi = fraction(pcg4d(vec4u(id_of(me.index), world.step, params.seed_low, params.seed_high)).x) - 0.5;
    var way = sum.heading + own;
    if params.vectorial == 1u {
        way += (params.eta * f32(sum.neighbors + 1u)) * circle(xi);
    } else {
        let turned = circle(params.eta * xi / TAU);
        way = vec2f(turned.x * way.x - turned.y * way.y, turned.y * way.x + turned.x * way.y);
    }
    // Headings that cancel out leave each particle its own; a particle without heading goes along x.
    if dot(way, way) == 0.0 { way = own; }
    if dot(way, way) == 0.0 { way = vec2f(1.0, 0.0); }
    return vec4f((params.speed * unit(vec3f(way, 0.0)) - v) / world.dt, 0.0);
}
