// The thermostat of Nosé (1984) and Hoover (1985) with a chain (Martyna et al. 1992) over a part h of the step (Martyna et al. 1996), with N
// degrees of freedom:
//   ξᵢ ← (ξᵢ e + h/2 Gᵢ) e,  e = exp(−h/4 ξᵢ₊₁),  from the last to the first;  v ← v exp(−h ξ₁),  ηᵢ ← ηᵢ + h ξᵢ;  ξᵢ from the first to the last
//   G₁ = (2 K / N k T − 1) / τ²,  G₂ = N ξ₁² − 1 / τ²,  Gᵢ = ξᵢ₋₁² − 1 / τ²
// exp(−x) is replaced by (1 − x/2 + x²/12) / (1 + x/2 + x²/12), which is reversible too, and gives the relative change of velocities
// without cancellation: −x / (1 + x/2 + x²/12).
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> thermostat_total: array<vec4f>; // 2 K, how many particles
@group(1) @binding(1) var<storage, read_write> thermostat_rate: array<f32>;
@group(1) @binding(2) var<storage, read_write> thermostat_phase: array<f32>;
@group(1) @binding(3) var<storage, read_write> thermostat_change: array<f32>;

override FACTOR: f32 = 1.0;
override DIMENSIONS: f32 = 3.0;
override REMOVED: f32 = 0.0;
override TEMPERATURE: f32 = 1.0;
override TIME: f32 = 1.0;
override CHAIN: u32 = 3u;

fn change(x: f32) -> f32 { return -x / (1.0 + x * (0.5 + x / 12.0)); }

// Gᵢ, where the temperature is `hotter` times that of the bath.
fn push(link: u32, hotter: f32, freedoms: f32) -> f32 {
    let one = 1.0 / (TIME * TIME);
    if link == 0u { return (hotter - 1.0) * one; }
    let before = thermostat_rate[link - 1u];
    return select(1.0, freedoms, link == 1u) * before * before - one;
}

// ξ over half of the part.
fn turn(link: u32, h: f32, hotter: f32, freedoms: f32) {
    var braked = 1.0;
    if link + 1u < CHAIN { braked += change(0.25 * h * thermostat_rate[link + 1u]); }
    thermostat_rate[link] = (thermostat_rate[link] * braked + 0.5 * h * push(link, hotter, freedoms)) * braked;
}

@compute @workgroup_size(1)
fn nose_hoover() {
    let h = FACTOR * world.dt;
    let freedoms = DIMENSIONS * thermostat_total[0].y - REMOVED;
    var part = 0.0;
    if freedoms > 0.0 {
        let hotter = thermostat_total[0].x / (freedoms * TEMPERATURE);
        for (var n = 0u; n < CHAIN; n += 1u) { turn(CHAIN - 1u - n, h, hotter, freedoms); }
        part = change(h * thermostat_rate[0]);
        for (var n = 0u; n < CHAIN; n += 1u) { thermostat_phase[n] += h * thermostat_rate[n]; }
        for (var n = 0u; n < CHAIN; n += 1u) { turn(n, h, hotter * (1.0 + part) * (1.0 + part), freedoms); }
    }
    thermostat_change[0] = part;
}
