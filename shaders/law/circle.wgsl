// The point of the unit circle after so many turns t: cos 2πt, sin 2πt. Built-in functions may be wrong by 2^-11; polynomials of half
// the angle, within a quarter of a turn, are right to 1e-6 (minimax).
fn circle(turns: f32) -> vec2f {
    let turn = turns - round(turns);
    let w = turn * turn;
    let sine = turn * (3.1415926 + w * (-5.1677101 + w * (2.5500775 + w * (-0.5982913 + w * 0.0776577))));
    let cosine = 0.99999995 + w * (-4.9347928 + w * (4.0584114 + w * (-1.3318766 + w * 0.2196896)));
    return vec2f(1.0 - 2.0 * sine * sine, 2.0 * sine * cosine);
}
