// 1 − exp(−x), x ≥ 0, without cancellation where x is small (Padé).
fn decayed(x: f32) -> f32 {
    if x > 0.5 { return 1.0 - exp(-x); }
    return x * (1.0 + x * x / 60.0) / (1.0 + x * (0.5 + x * (0.1 + x / 120.0)));
}
