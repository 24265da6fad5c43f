// A rigid motion by keyframes:  x = c + s + R (x₀ − c).  Between two keys s goes straight, and R turns about one axis
// (Shoemake 1985), at constant speed or by u² (3 − 2 u). Times are whole steps and a rest, so that late ones are as exact as early
// ones; half angles are reduced to ±π/2 and their sine and cosine come from polynomials (Abramowitz & Stegun 1964, 4.3.97 and
// 4.3.99, to 2e-9), because what a device takes for a sine may be wrong by 5e-4.
struct Motion { about: vec3f, start: u32, rest: f32, first: u32, keys: u32, eased: u32, period: u32, period_rest: f32 }
struct Keyframe { facing: vec4f, shift: vec3f, length: f32, way: vec3f, rest: f32, axis: vec3f, turns: f32, step: u32 }
struct Pose { shift: vec3f, turn: vec4f, velocity: vec3f, spin: vec3f }

@group(2) @binding(0) var<storage, read> motions: array<Motion>;
@group(2) @binding(1) var<storage, read> keyframes: array<Keyframe>;

const PI: f32 = 3.14159265;

fn half_turn(half_angle: f32, axis: vec3f) -> vec4f {
    let h2 = half_angle * half_angle;
    let sine_end = 0.0000027526 + h2 * -0.0000000239;
    let cosine_end = 0.0000247609 + h2 * -0.0000002605;
    let sine = 1.0 + h2 * (-0.1666666664 + h2 * (0.0083333315 + h2 * (-0.0001984090 + h2 * sine_end)));
    let cosine = 1.0 + h2 * (-0.4999999963 + h2 * (0.0416666418 + h2 * (-0.0013888397 + h2 * cosine_end)));
    return vec4f(half_angle * sine * axis, cosine);
}

// Quaternions: first b, then a.
fn product(a: vec4f, b: vec4f) -> vec4f {
    return vec4f(a.w * b.xyz + b.w * a.xyz + cross(a.xyz, b.xyz), a.w * b.w - dot(a.xyz, b.xyz));
}

// Steps since a key.
fn since(key: u32, whole: u32, rest: f32) -> f32 {
    return f32(i32(whole - keyframes[key].step)) + (rest - keyframes[key].rest);
}

// The pose after a part of the step.
fn pose(motion: u32, part: f32) -> Pose {
    let m = motions[motion];
    let now = now(part);
    var whole = now.whole - m.start;
    var rest = now.rest - m.rest;
    if m.period > 0u {
        let times = max(floor((f32(i32(whole)) + rest) / (f32(m.period) + m.period_rest)), 0.0);
        whole -= u32(times) * m.period;
        rest -= times * m.period_rest;
    }
    // The last key whose time has come; before all of them the first.
    var low = m.first;
    var high = m.first + m.keys;
    for (var k = 0u; k < 32u; k += 1u) {
        let middle = (low + high) / 2u;
        if middle > low {
            if since(middle, whole, rest) >= 0.0 { low = middle; } else { high = middle; }
        }
    }
    let key = keyframes[low];
    let u = since(low, whole, rest) / key.length;
    var s = clamp(u, 0.0, 1.0);
    var rate = select(0.0, 1.0, u >= 0.0);
    if m.eased > 0u {
        rate = 6.0 * s * (1.0 - s);
        s *= s * (3.0 - 2.0 * s);
    }
    rate /= key.length * now.unit;
    let turns = s * key.turns;
    let turn = product(half_turn(PI * (turns - round(turns)), key.axis), key.facing);
    return Pose(key.shift + s * key.way, turn, rate * key.way, (2.0 * PI * rate * key.turns) * key.axis);
}
