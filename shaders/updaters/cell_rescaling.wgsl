// Stochastic cell rescaling (Bernetti & Bussi 2020): dε = −κ (P₀ − P) dt / τ + √(2 k T κ / V τ) dW, with ε the logarithm of the volume.
override PRESSURE: f32 = 1.0;
override TEMPERATURE: f32 = 1.0;
// κ / τ
override RATE: f32 = 1.0;
override SEED_LOW: u32 = 1u;
override SEED_HIGH: u32 = 0u;

@compute @workgroup_size(1)
fn cell_rescaling() {
    if due() {
        let noise = normals(pcg4d(vec4u(0u, world.step, SEED_LOW, SEED_HIGH)), 2u).x;
        let width = sqrt(2.0 * TEMPERATURE * RATE * span() / volume());
        strain(RATE * span() * (pressure() - PRESSURE) + width * noise);
    }
}
