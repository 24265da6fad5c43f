// The radius of a sphere with the volume of two:  R³ = a³ + b³, from the larger one times the root of a number from 1 to 2.
fn of_both(a: f32, b: f32) -> f32 {
    let large = max(a, b);
    if large <= 0.0 { return 0.0; }
    let part = min(a, b) / large;
    return large * pow(1.0 + part * part * part, 1.0 / 3.0);
}
