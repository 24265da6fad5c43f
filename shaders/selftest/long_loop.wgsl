// Turns a generator as often as `probe` says: xₙ₊₁ = 1664525 xₙ + 1013904223 (Numerical Recipes). A driver that stops loops early shows.
@group(0) @binding(0) var<storage, read> probe: array<u32>;       // turns, x₀
@group(0) @binding(1) var<storage, read_write> answer: array<u32>; // x after all turns

@compute @workgroup_size(1)
fn long_loop() {
    var x = probe[1];
    for (var turn = 0u; turn < probe[0]; turn += 1u) { x = x * 1664525u + 1013904223u; }
    answer[0] = x;
}
