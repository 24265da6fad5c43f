// Weak coupling to a pressure bath (Berendsen et al. 1984): dε = −κ (P₀ − P) dt / τ, with ε the logarithm of the volume.
override PRESSURE: f32 = 1.0;
// κ / τ
override RATE: f32 = 1.0;

@compute @workgroup_size(1)
fn berendsen_pressure() {
    if due() { strain(RATE * span() * (pressure() - PRESSURE)); }
}
