// Spheres that overlap by δ push, rub and roll on each other, by the contact of grains/touch; bridges of liquid pull, by grains/bridge. With n from
// me to you:
//   torque  (R − δ / 2) n × F,  and what resists rolling and torsion
struct Sum { force: vec3f, torque: vec3f, energy: f32, heat: f32 }

@group(3) @binding(0) var<uniform> pair_table: array<Pair, 64>; // of 8 species
@group(3) @binding(1) var<storage, read> angular_velocity: array<vec4f>; // xyz, radius
@group(3) @binding(2) var<storage, read_write> torque: array<vec4f>; // xyz, dissipation

// 7/5 m R², the moment about the contact of a sphere.
fn moment(mass: f32, radius: f32) -> f32 { return 1.4 * mass * radius * radius; }

// Where one is 0 the other: what has no mass is moved by nothing, as if it had an infinite one.
fn reduced(a: f32, b: f32) -> f32 {
    if a > 0.0 && b > 0.0 { return a * b / (a + b); }
    return max(a, b);
}

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let mine = angular_velocity[me.index];
    let yours = angular_velocity[you.index];
    let distance = length(r);
    let overlap = mine.w + yours.w - distance;
    let radius = reduced(mine.w, yours.w);
    let smaller = min(mine.w, yours.w);
    let pair = pair_table[pair_index(species[me.index], species[you.index])];
    let meets = may_touch(overlap, radius) || -overlap < pair.reach * smaller;
    // Two particles at the same position have no direction between them.
    if distance > 0.0 && mine.w > 0.0 && yours.w > 0.0 && meets {
        let n = r / distance;
        // From the centres to the middle of the overlap.
        let my_arm = mine.w - 0.5 * overlap;
        let your_arm = yours.w - 0.5 * overlap;
        let v = velocity_of(me) - velocity_of(you) + cross(my_arm * mine.xyz + your_arm * yours.xyz, n);
        let rest = reduced(moment(me.mass, mine.w), moment(you.mass, yours.w));
        let at = Meeting(n, overlap, v, radius, mine.xyz - yours.xyz, reduced(me.mass, you.mass), rest, smaller);

        let slide = vec3f(recall(you, 0u), recall(you, 1u), recall(you, 2u));
        let roll = vec3f(recall(you, 3u), recall(you, 4u), recall(you, 5u));
        let last = Wound(slide, roll, recall(you, 6u), recall(you, 7u));
        // Each has half of what a pair has, and all of it where the other has no mass. The visit halves energies.
        var share = select(1.0, 0.5, you.mass > 0.0);
        if me.mass <= 0.0 { share = 0.0; }
        let liquid = bridged(pair, at, last.wet);
        remember(you, 7u, liquid.wet);
        (*sum).force += liquid.pull * n;
        (*sum).energy += 2.0 * share * liquid.energy;
        (*sum).heat += share * liquid.heat;
        if overlap > 0.0 {
            let contact = touch(pair, at, last);
            remember(you, 0u, contact.wound.slide.x);
            remember(you, 1u, contact.wound.slide.y);
            remember(you, 2u, contact.wound.slide.z);
            remember(you, 3u, contact.wound.roll.x);
            remember(you, 4u, contact.wound.roll.y);
            remember(you, 5u, contact.wound.roll.z);
            remember(you, 6u, contact.wound.twist);
            (*sum).force += contact.push;
            (*sum).torque += my_arm * cross(n, contact.push) + contact.turn;
            (*sum).energy += 2.0 * share * contact.energy;
            (*sum).heat += share * contact.heat;
        } else {
            (*sum).heat += share * left(pair, at, last);
        }
    }
}

fn finish(me: Particle, sum: Sum) -> vec4f {
    torque[me.index] += vec4f(sum.torque, sum.heat);
    // A particle without mass is moved by nothing.
    if me.mass > 0.0 { return vec4f(sum.force, sum.energy) / me.mass; }
    return vec4f();
}
