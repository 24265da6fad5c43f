// Spheres that overlap by δ (Cundall & Strack 1979; Luding 2008), with n from me to you, and v my velocity relative to yours at the contact:
//   normal      F = −(k δ + γ v·n) n,  γ = 2 ζ √(k m),  m = m₁ m₂ / (m₁ + m₂),  ζ = −ln e / √(π² + ln² e)
//   tangential  F = −kₜ ξ − γₜ vₜ,  ξ' = vₜ,  |F| ≤ μ (k δ + γ v·n): at the limit it slides, and ξ is set to give that force
//   torque      (R − δ / 2) n × F
struct Params {
    unused_word: u32, stiffness: f32, damping: f32, friction: f32, tangential_stiffness: f32, tangential_damping: f32,
}
struct Sum { force: vec3f, torque: vec3f }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<storage, read> radius: array<f32>;
@group(3) @binding(2) var<storage, read> angular_velocity: array<vec4f>;
@group(3) @binding(3) var<storage, read_write> torque: array<vec4f>;

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let distance = length(r);
    let overlap = radius[me.index] + radius[you.index] - distance;
    let touches = overlap > 0.0;
    // Two particles at the same position have no direction between them.
    if touches && distance > 0.0 {
        let n = r / distance;
        // From the centres to the middle of the overlap.
        let my_arm = radius[me.index] - 0.5 * overlap;
        let your_arm = radius[you.index] - 0.5 * overlap;
        let spin = my_arm * angular_velocity[me.index].xyz + your_arm * angular_velocity[you.index].xyz;
        let v = velocity_of(me) - velocity_of(you) + cross(spin, n);
        let approach = dot(v, n);
        let slide = v - approach * n;

        let both = me.mass + you.mass;
        let mass = select(0.0, me.mass * you.mass / both, both > 0.0);
        let damping = 2.0 * params.damping * sqrt(params.stiffness * mass);
        let normal = params.stiffness * overlap + damping * approach;

        let limit = params.friction * max(normal, 0.0);
        let spring = params.tangential_stiffness * params.stiffness;
        let drag = (params.tangential_damping * damping) * slide;
        let last = vec3f(recall(you, 0u), recall(you, 1u), recall(you, 2u));
        var wound = last - dot(last, n) * n + world.dt * slide;
        var tangential = -spring * wound - drag;
        let size = length(tangential);
        if size > limit {
            tangential *= limit / size;
            if spring > 0.0 { wound = -(tangential + drag) / spring; }
        }
        remember(you, 0u, wound.x);
        remember(you, 1u, wound.y);
        remember(you, 2u, wound.z);
        (*sum).force += tangential - normal * n;
        (*sum).torque += my_arm * cross(n, tangential);
    }
}

fn finish(me: Particle, sum: Sum) -> vec4f {
    torque[me.index] += vec4f(sum.torque, 0.0);
    // A particle without mass is moved by nothing.
    if me.mass > 0.0 { return vec4f(sum.force / me.mass, 0.0); }
    return vec4f();
}
