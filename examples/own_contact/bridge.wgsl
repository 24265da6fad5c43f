// Wet grains: where two spheres overlap by δ they push with a spring and a dashpot and rub by a spring that sliding winds up (Cundall &
// Strack 1979). Where they have touched, liquid bridges them: it pulls with a constant force until they are `rupture` apart, and breaks.
//   normal      F = −(k δ + 2 ζ √(k m) v·n) n,  of a bridge + f n
//   tangential  F = −kₜ ξ − γₜ vₜ,  ξ' = vₜ,  |F| ≤ μ times the normal force
//   energy      k δ² / 2 + kₜ ξ² / 2 − f (rupture + δ), as at the start of the step; what is not kept of it is heat
struct Params { stiffness: f32, restitution: f32, friction: f32, shear: f32, drag: f32, bridge: f32, rupture: f32 }
// What a pair keeps from step to step: ξ, and whether it is wet.
struct History { slide: vec3f, wet: f32 }
struct Sum { force: vec3f, torque: vec3f, energy: f32, heat: f32 }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<storage, read> angular_velocity: array<vec4f>; // xyz, radius
@group(3) @binding(2) var<storage, read_write> torque: array<vec4f>; // xyz, dissipation

fn last(you: Particle) -> History {
    return History(vec3f(recall(you, 0u), recall(you, 1u), recall(you, 2u)), recall(you, 3u));
}

fn keep(you: Particle, history: History) {
    remember(you, 0u, history.slide.x);
    remember(you, 1u, history.slide.y);
    remember(you, 2u, history.slide.z);
    remember(you, 3u, history.wet);
}

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let mine = angular_velocity[me.index];
    let yours = angular_velocity[you.index];
    let distance = length(r);
    let overlap = mine.w + yours.w - distance;
    let before = last(you);
    let touches = overlap > 0.0;
    // A pair that keeps nothing begins with zeros: dry.
    if distance > 0.0 && (touches || before.wet > 0.0 && -overlap < params.rupture) {
        let n = r / distance;
        var force = params.bridge * n;
        var history = History(vec3f(), 1.0);
        let wound = 0.5 * params.shear * params.stiffness;
        // A bridge that forms gives its energy away; what a spring still holds as spheres part is heat.
        var energy = -params.bridge * (params.rupture + overlap) + wound * dot(before.slide, before.slide);
        var heat = select(params.bridge * (params.rupture + overlap) / world.dt, 0.0, before.wet > 0.0);
        let arm = mine.w - 0.5 * overlap;
        if touches {
            let v = velocity_of(me) - velocity_of(you) + cross(arm * mine.xyz + (yours.w - 0.5 * overlap) * yours.xyz, n);
            let mass = me.mass * you.mass / (me.mass + you.mass);
            let loss = log(params.restitution);
            let damping = 2.0 * sqrt(loss * loss / (9.8696044 + loss * loss) * params.stiffness * mass);
            let approach = dot(v, n);
            let slide = v - approach * n;
            let normal = params.stiffness * overlap + damping * approach;

            let spring = params.shear * params.stiffness;
            let drag = params.drag * damping * slide;
            let limit = params.friction * max(normal, 0.0);
            history.slide = before.slide - dot(before.slide, n) * n + world.dt * slide;
            var tangential = -spring * history.slide - drag;
            let size = length(tangential);
            if size > limit {
                tangential *= limit / size;
                history.slide = -(tangential + drag) / spring;
            }
            force += tangential - normal * n;
            energy += 0.5 * params.stiffness * overlap * overlap;
            // Forces do their work at the speed of the middle of the kick, v − F dt / 2 m, of spheres that are 2/7 as heavy across.
            let kick = 0.5 * world.dt / mass;
            heat += damping * approach * (approach - kick * normal) - dot(tangential, slide + 3.5 * kick * tangential);
        }
        heat -= wound * (dot(history.slide, history.slide) - dot(before.slide, before.slide)) / world.dt;
        keep(you, history);
        (*sum).energy += energy;
        (*sum).heat += 0.5 * heat;
        (*sum).force += force;
        (*sum).torque += arm * cross(n, force);
    }
}

fn finish(me: Particle, sum: Sum) -> vec4f {
    torque[me.index] += vec4f(sum.torque, sum.heat);
    return vec4f(sum.force, sum.energy) / me.mass;
}
