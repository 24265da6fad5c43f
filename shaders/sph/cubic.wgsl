// The cubic spline (Monaghan & Lattanzio 1985), of q = r / h with h its support, without the constant in front.
fn profile(q: f32) -> f32 {
    let p = 1.0 - q;
    return select(2.0 * p * p * p, 1.0 - 6.0 * q * q * p, q <= 0.5);
}

// Its derivative by q, over q.
fn profile_slope(q: f32) -> f32 {
    let p = 1.0 - q;
    return select(-6.0 * p * p / max(q, 0.5), 18.0 * q - 12.0, q <= 0.5);
}
