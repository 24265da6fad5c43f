// The structure factor of charges, times how much of each Fourier mode there is: 4π k w(κ R) / (V κ²), of κ and −κ together, where κ is the wave
// vector, R the range and w the Fourier transform of the window √(1 − t²) I₁(β √(1 − t²)), which is i₁(z) / z with z² = β² − (κ R)².
@group(3) @binding(3) var<storage, read> charge: array<f32>;

// 8π k / w₀ with w₀ = 3 i₁(β) / β; the neutralizing background times the volume; β²; R; the largest κ² of a wave that is part of the sum.
override AMOUNT: f32 = 1.0;
override BACKGROUND: f32 = 1.0;
override SHARPNESS: f32 = 1.0;
override RANGE: f32 = 1.0;
override LAST: f32 = 1.0;
// Terms of a series: the largest β is below 27.
const TERMS: f32 = 48.0;
const TURN: f32 = 6.2831855;

// The modified spherical Bessel function i₁(z) / z over its value at 0, by z², below 0 too; of the order 5, i₂(z) / z².
fn bessel(square: f32, order: f32) -> f32 {
    var sum = 1.0;
    for (var n = TERMS; n > 0.5; n -= 1.0) { sum = 1.0 + sum * square / (2.0 * n * (2.0 * n + order)); }
    return sum;
}

// κ²
fn wave_square(k: vec3f) -> f32 {
    let turns = TURN * k * world.frequency;
    return dot(turns, turns);
}

fn amount(k: vec3f) -> f32 {
    let square = wave_square(k);
    let density = world.frequency.x * world.frequency.y * world.frequency.z;
    if square == 0.0 { return BACKGROUND * density; }
    // A box that grows needs them, and no sum changes by that they are there before.
    if square > LAST { return 0.0; }
    return AMOUNT * density / square * bessel(SHARPNESS - square * RANGE * RANGE, 3.0);
}

fn strength(i: u32) -> f32 {
    if is_active(i) { return charge[i]; }
    return 0.0;
}

fn kept(wave: u32, sum: vec2f) -> vec2f { return amount(wave_vector[wave].xyz) * sum; }
