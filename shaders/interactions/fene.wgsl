// Bonds of finite extension, damped along them:  U(r) = −½ K R² ln(1 − (r / R)²),  F = (K / (1 − r² / R²) + c (v_you − v_me) · r / r²) r,
// with r from me to you (Kremer & Grest, J. Chem. Phys. 92, 5057, 1990). At R the energy is infinite; beyond it there is none, and the alarm is raised.
override DAMPED: bool = true; // whether any bond is

struct Params { unused_word: u32, max_length: f32 }
struct Sum { force: vec3f, energy: f32 }

@group(3) @binding(0) var<uniform> params: Params;

// −ln(1 − x) / x: of a small x a logarithm would have few digits. At 1/8 what is left of the series is 3e-8.
fn spread(x: f32) -> f32 {
    if x < 0.125 {
        let last = x * (0.16666667 + x * (0.14285715 + x * 0.125));
        let fifth = 0.2 + last;
        return 1.0 + x * (0.5 + x * (0.33333334 + x * (0.25 + x * fifth)));
    }
    return -log(1.0 - x) / x;
}

fn gather(me: Particle, you: Particle, r: vec3f, link: Link, sum: ptr<function, Sum>) {
    let square = dot(r, r);
    let longest = params.max_length * params.max_length;
    let left = 1.0 - square / longest;
    // A broken bond has no stiffness, at any length.
    if link.stiffness > 0.0 {
        if left > 0.0 {
            (*sum).force += (link.stiffness / left) * r;
            (*sum).energy += 0.5 * link.stiffness * square * spread(square / longest);
        }
        // What is no number is none of these: the watch finds it.
        if left <= 0.0 { overlong(me, you); }
    }
    // Two particles at the same position have no direction between them.
    if DAMPED && square > 0.0 { (*sum).force += (link.damping * dot(velocity_of(you) - velocity_of(me), r) / square) * r; }
}

fn finish(me: Particle, sum: Sum) -> vec4f {
    // A particle without mass has no bonds.
    if me.mass > 0.0 { return vec4f(sum.force, sum.energy) / me.mass; }
    return vec4f();
}

// K / w (dx + (2 / w − 2) (u · dx) u) + c (u · dv) u with w = 1 − r² / R²: positive at any length below R.
fn jvp(me: Particle, you: Particle, r: vec3f, link: Link, dx: vec3f, dv: vec3f) -> vec3f {
    let square = dot(r, r);
    let u = r * select(0.0, inverseSqrt(square), square > 0.0);
    let left = 1.0 - square / (params.max_length * params.max_length);
    let damped = (link.damping * dot(u, dv)) * u;
    if left <= 0.0 { return damped; }
    return (link.stiffness / left) * (dx + ((2.0 / left - 2.0) * dot(u, dx)) * u) + damped;
}
