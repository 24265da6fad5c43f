// The Fourier modes of a periodic cube of side L at a position: exp(2πi k·x / L), cosine and sine. Built-in functions may be wrong by
// 2^-11 here; polynomials of half the angle, within a quarter of a turn, are as good as f32 is (minimax, 5e-8).
@group(3) @binding(0) var<storage, read> gravity_wave: array<vec4f>; // k; how much of it there is

override WAVES: u32 = 126u;

fn wave_at(k: vec3f, x: vec3f) -> vec2f {
    let all = dot(k, x * world.frequency);
    let turn = all - round(all);
    let w = turn * turn;
    let sine = turn * (3.1415926 + w * (-5.1677101 + w * (2.5500775 + w * (-0.5982913 + w * 0.0776577))));
    let cosine = 0.99999995 + w * (-4.9347928 + w * (4.0584114 + w * (-1.3318766 + w * 0.2196896)));
    return vec2f(1.0 - 2.0 * sine * sine, 2.0 * sine * cosine);
}
