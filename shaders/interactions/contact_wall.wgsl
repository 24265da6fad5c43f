// A grain of radius R that overlaps a wall by δ = R − φ pushes, rubs and rolls on it, by the contact of grains/touch; bridges of liquid pull, by
// grains/bridge. With n into the wall:
//   v = v₁ + (R − δ / 2) ω₁ × n − u(x),  u the velocity of the wall there;  reduced mass and radius are those of the grain
//   torque  (R − δ / 2) n × F,  and what resists rolling and torsion
// The history of each contact is kept twice: one half holds the values at the start of the step, and the other those it writes.
struct Params {
    unused_word: u32,
    position: vec3f, radius: f32, size: vec3f, shape: u32, axis: vec3f, side: f32, species: u32, contacts: u32,
    stiffness: f32, damping: f32, friction: f32, shear: f32, drag: f32,
    rolling: f32, rolling_damping: f32, torsion: f32, hertz: u32, elastic: u32,
    pull: f32, spread: f32, reach: f32,
}
struct Frame { centre: vec3f, pivot: vec3f, turn: vec4f, velocity: vec3f, spin: vec3f }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<storage, read> angular_velocity: array<vec4f>; // xyz, radius
@group(3) @binding(2) var<storage, read_write> torque: array<vec4f>; // xyz, dissipation
@group(3) @binding(3) var<storage, read_write> wall_history: array<f32>;

override WORDS: u32 = 3u;

// ∇φ and φ of a face that a grain may touch: of a container each axis has its nearest one.
fn surface(contact: u32, r: vec3f, frame: Frame) -> vec4f {
    let own = r + turned(vec4f(-frame.turn.xyz, frame.turn.w), r);
    var s = params.side * signed_distance(params.shape, own, params.radius, params.size, params.axis);
    if params.contacts > 1u {
        let out = select(1.0, -1.0, own[contact] >= 0.0);
        var normal = vec3f();
        normal[contact] = out;
        s = vec4f(normal, 0.5 * params.size[contact] + out * own[contact]);
    }
    return vec4f(s.xyz + turned(frame.turn, s.xyz), s.w);
}

fn place(i: u32, half: u32, contact: u32) -> u32 {
    return ((2u * i + (half & 1u)) * params.contacts + contact) * WORDS;
}

// Words beyond those that are kept are 0.
fn recall(first: u32, word: u32) -> f32 {
    if word < WORDS { return wall_history[first + word]; }
    return 0.0;
}

fn remember(first: u32, word: u32, value: f32) {
    if word < WORDS { wall_history[first + word] = value; }
}

fn force(me: Particle) -> vec4f {
    let mine = angular_velocity[me.index];
    let frame = frame();
    let pair = Pair(
        0u, params.stiffness, params.damping, params.friction, params.shear, params.drag,
        params.rolling, params.rolling_damping, params.torsion, params.hertz, params.elastic,
        params.pull, params.spread, params.reach,
    );
    var push = vec3f();
    var turn = vec3f();
    var energy = 0.0;
    var heat = 0.0;
    // A particle without mass is moved by nothing.
    let meets = me.mass > 0.0 && mine.w > 0.0 && is_of(me.index, params.species);
    // Planes have no end; all others have images in a periodic box.
    var r = me.position - frame.centre;
    if params.shape != 2u { r = shortest(r); }
    for (var contact = 0u; contact < params.contacts; contact += 1u) {
        let next = place(me.index, world.step + 1u, contact);
        let s = surface(contact, r, frame);
        let overlap = mine.w - s.w;
        var kept = Wound();
        let n = -s.xyz;
        let arm = mine.w - 0.5 * overlap;
        let moving = frame.velocity + cross(frame.spin, frame.centre + r + arm * n - frame.pivot);
        let v = velocity_of(me) + arm * cross(mine.xyz, n) - moving;
        if meets && (may_touch(overlap, mine.w) || -overlap < params.reach * mine.w) {
            let rest = 1.4 * me.mass * mine.w * mine.w;
            let last = place(me.index, world.step, contact);
            let slide = vec3f(recall(last, 0u), recall(last, 1u), recall(last, 2u));
            let roll = vec3f(recall(last, 3u), recall(last, 4u), recall(last, 5u));
            let at = Meeting(n, overlap, v, mine.w, mine.xyz - frame.spin, me.mass, rest, mine.w);
            let wound = Wound(slide, roll, recall(last, 6u), recall(last, 7u));
            let liquid = bridged(pair, at, wound.wet);
            push += liquid.pull * n;
            energy += liquid.energy;
            heat += liquid.heat;
            if overlap > 0.0 {
                let contact_force = touch(pair, at, wound);
                push += contact_force.push;
                turn += arm * cross(n, contact_force.push) + contact_force.turn;
                energy += contact_force.energy;
                heat += contact_force.heat;
                kept = contact_force.wound;
            } else {
                heat += left(pair, at, wound);
            }
            kept.wet = liquid.wet;
        }
        remember(next, 0u, kept.slide.x);
        remember(next, 1u, kept.slide.y);
        remember(next, 2u, kept.slide.z);
        remember(next, 3u, kept.roll.x);
        remember(next, 4u, kept.roll.y);
        remember(next, 5u, kept.roll.z);
        remember(next, 6u, kept.twist);
        remember(next, 7u, kept.wet);
    }
    torque[me.index] += vec4f(turn, heat);
    if meets { return vec4f(push, energy) / me.mass; }
    return vec4f();
}
