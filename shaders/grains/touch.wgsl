// A contact of two spheres, or of one with a wall, that overlap by δ: n leads out of the sphere, v and ω are its velocity at the contact and its
// angular velocity relative to the other, R = R₁ R₂ / (R₁ + R₂), m = m₁ m₂ / (m₁ + m₂).
//   stiffness   linear: S = k, N = S δ (Cundall & Strack 1979);  Hertz: S = 2 E √(R δ), N = 2/3 S δ (Hertz 1882)
//   normal      F = −(N + γ v·n) n,  γ = c √(S m),  c = 2 ζ, by Hertz 2 √(5/6) ζ (Tsuji et al. 1992),  ζ = −ln e / √(π² + ln² e)
//   tangential  F = −kₜ ξ − γₜ vₜ,  ξ' = vₜ,  kₜ ∝ S,  γₜ ∝ γ,  |F| ≤ μ (N + γ v·n): at the limit it slides, and ξ is set to give that force
//   rolling     τ = −kᵣ ψ − γᵣ ωᵣ,  ψ' = ωᵣ,  kᵣ = 2.25 N / δ (μᵣ R)²,  |τ| ≤ μᵣ R (N + γ v·n), where ψ is set to give that torque
//               (Ai et al. 2011);  or of constant size, τ = −μᵣ R (N + γ v·n) ωᵣ / |ωᵣ|
//   torsion     the same about n, with μₜ and 2/7 of the moment, always by a spring
//   energy      of the springs, ∫ N dδ + kₜ ξ² / 2 + kᵣ ψ² / 2, as they are at the start of the step
//   heat        the power of all these against the motion, less what springs gain; the speed of the middle of the kick is v − F dt / 2 m
struct Pair {
    @size(12) unused_word: u32,
    stiffness: f32, damping: f32, friction: f32, shear: f32, drag: f32,
    rolling: f32, rolling_damping: f32, torsion: f32, hertz: u32, elastic: u32,
    pull: f32, spread: f32, reach: f32,
}
// `rest` is the moment about the contact of what rolls there.
struct Meeting { n: vec3f, overlap: f32, v: vec3f, radius: f32, spin: vec3f, mass: f32, rest: f32, smaller: f32 }
// What a contact keeps from step to step: ξ, ψ across n, ψ about n, and whether liquid bridges it.
struct Wound { slide: vec3f, roll: vec3f, twist: f32, wet: f32 }
// `turn` is the torque beside that of the tangential force.
struct Touch { push: vec3f, turn: vec3f, wound: Wound, energy: f32, heat: f32 }

// What a spring of stiffness k gains in a step in which it is wound from one length to another, and was softer by a part of k, as a power.
// Written by differences, which lose fewer digits than that of two squares.
fn gain(k: f32, softer: f32, last: vec3f, next: vec3f) -> f32 {
    return 0.5 * k * (dot(next - last, next + last) + softer * dot(last, last)) / world.dt;
}

fn touch(pair: Pair, at: Meeting, last: Wound) -> Touch {
    let n = at.n;
    let hertz = pair.hertz > 0u;
    let stiffness = pair.stiffness * select(1.0, sqrt(at.radius * at.overlap), hertz);
    let secant = select(1.0, 0.6666667, hertz) * stiffness;
    let damping = pair.damping * sqrt(stiffness * at.mass);
    let approach = dot(at.v, n);
    let slide = at.v - approach * n;
    let normal = secant * at.overlap + damping * approach;
    // By Hertz all springs were softer by this where the overlap was smaller.
    let deeper = world.dt * approach / at.overlap;
    let softer = select(0.0, min(deeper / (1.0 + sqrt(max(1.0 - deeper, 0.0))), 1.0), hertz);
    var impulse = 0.0;
    if at.mass > 0.0 { impulse = 0.5 * world.dt / at.mass; }
    var energy = select(0.5, 0.4, hertz) * secant * at.overlap * at.overlap;
    var heat = damping * approach * (approach - impulse * normal);
    // Where damping pulls, there is nothing to rub on.
    let pressed = max(normal, 0.0);

    let limit = pair.friction * pressed;
    let spring = pair.shear * stiffness;
    let drag = (pair.drag * damping) * slide;
    var wound = last.slide - dot(last.slide, n) * n + world.dt * slide;
    var tangential = -spring * wound - drag;
    let size = length(tangential);
    if size > limit {
        tangential *= limit / size;
        if spring > 0.0 { wound = -(tangential + drag) / spring; }
    }
    energy += 0.5 * spring * dot(last.slide, last.slide);
    // Where two spheres touch they are 2/7 as heavy across.
    heat -= dot(tangential, slide + 3.5 * impulse * tangential) + gain(spring, softer, last.slide, wound);

    let about = dot(at.spin, n);
    let rolls = at.spin - about * n;
    var roll = vec3f();
    var turn = vec3f();
    let rolling_limit = pair.rolling * at.radius * pressed;
    let sprung = pair.elastic > 0u;
    if sprung && pair.rolling > 0.0 {
        let arm = 1.5 * pair.rolling * at.radius;
        let back = secant * arm * arm;
        roll = last.roll - dot(last.roll, n) * n + world.dt * rolls;
        let slowed = (2.0 * pair.rolling_damping * sqrt(back * at.rest)) * rolls;
        turn = -back * roll - slowed;
        let most = length(turn);
        if most > rolling_limit {
            turn *= rolling_limit / most;
            roll = -(turn + slowed) / back;
        }
        energy += 0.5 * back * dot(last.roll, last.roll);
        heat -= gain(back, softer, last.roll, roll);
    } else {
        let speed = length(rolls);
        if speed > 0.0 { turn = (-rolling_limit / speed) * rolls; }
    }
    heat -= dot(turn, rolls);

    var twist = 0.0;
    if pair.torsion > 0.0 {
        let arm = 1.5 * pair.torsion * at.radius;
        let back = secant * arm * arm;
        let most = pair.torsion * at.radius * pressed;
        twist = last.twist + world.dt * about;
        // About its own axis a sphere has 2/5 m R².
        let slowed = (2.0 * pair.rolling_damping * sqrt(back * (0.2857143 * at.rest))) * about;
        let against = -back * twist - slowed;
        var torsion = against;
        if abs(against) > most {
            torsion = sign(against) * most;
            twist = -(torsion + slowed) / back;
        }
        turn += torsion * n;
        energy += 0.5 * back * last.twist * last.twist;
        heat -= torsion * about + gain(back, softer, vec3f(last.twist), vec3f(twist)) / 3.0;
    }
    return Touch(tangential - normal * n, turn, Wound(wound, roll, twist, last.wet), energy, heat);
}

// Whether spheres touch, or a contact may have ended in the last step: it parts them by less than a sixteenth of the reduced radius.
fn may_touch(overlap: f32, radius: f32) -> bool { return overlap > -0.0625 * radius; }

// The power of what springs still held a step before where spheres do not touch any more; 0 where they did not then.
fn left(pair: Pair, at: Meeting, last: Wound) -> f32 {
    let hertz = pair.hertz > 0u;
    let overlap = max(at.overlap - world.dt * dot(at.v, at.n), 0.0);
    let stiffness = pair.stiffness * select(1.0, sqrt(at.radius * overlap), hertz);
    let secant = select(1.0, 0.6666667, hertz) * stiffness;
    let roll = 1.5 * pair.rolling * at.radius;
    let twist = 1.5 * pair.torsion * at.radius;
    let turned = roll * roll * dot(last.roll, last.roll) + twist * twist * last.twist * last.twist;
    return 0.5 * (pair.shear * stiffness * dot(last.slide, last.slide) + secant * turned) / world.dt;
}
