// The scale factor a at the time of the world, with which gravity grows in supercomoving coordinates (Martel & Shapiro 1998). LEFT is the time at
// which a is infinite, and a⁻¹ᐟ² / y a sum of Chebyshev polynomials of 2 y − 1, with y = (1 − t / LEFT)¹ᐟ⁴.
override LEFT: f32;
override A_0: f32;
override A_1: f32;
override A_2: f32;
override A_3: f32;
override A_4: f32;
override A_5: f32;
override A_6: f32;
override A_7: f32;
override A_8: f32;
override A_9: f32;
override A_10: f32;
override A_11: f32;
override A_12: f32;
override A_13: f32;
override A_14: f32;
override A_15: f32;
override A_16: f32;
override A_17: f32;
override A_18: f32;
override A_19: f32;
override A_20: f32;
override A_21: f32;
override A_22: f32;
override A_23: f32;
override A_24: f32;
override A_25: f32;
override A_26: f32;
override A_27: f32;

fn expansion() -> f32 {
    var terms = array<f32, 28>(
        A_0, A_1, A_2, A_3, A_4, A_5, A_6, A_7, A_8, A_9, A_10, A_11, A_12, A_13,
        A_14, A_15, A_16, A_17, A_18, A_19, A_20, A_21, A_22, A_23, A_24, A_25, A_26, A_27,
    );
    let y = sqrt(sqrt(1.0 - world.time / LEFT));
    let x = 2.0 * y - 1.0;
    // Clenshaw's recurrence.
    var one = 0.0;
    var two = 0.0;
    for (var n = 27u; n > 0u; n -= 1u) {
        let next = terms[n] + (2.0 * x * one - two);
        two = one;
        one = next;
    }
    let u = y * (terms[0] + (x * one - two));
    return 1.0 / (u * u);
}
