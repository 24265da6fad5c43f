// Wendland's C2 kernel (Wendland 1995; Dehnen & Aly 2012), of q = r / h with h its support, without the constant in front.
fn profile(q: f32) -> f32 {
    let p = 1.0 - q;
    return p * p * p * p * (4.0 * q + 1.0);
}

// Its derivative by q, over q.
fn profile_slope(q: f32) -> f32 {
    let p = 1.0 - q;
    return -20.0 * p * p * p;
}
