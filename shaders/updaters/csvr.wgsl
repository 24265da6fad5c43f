// Canonical sampling by velocity rescaling (Bussi, Donadio & Parrinello 2007): one factor α for all velocities, to the kinetic energy that
// friction and noise would give them,  α² = c + (1 − c) T S / 2 K + 2 R √(c (1 − c) T / 2 K),  c = exp(−dt / τ),
// with S the sum of the squares of normal numbers, one for each degree of freedom, and R the one along the velocities.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> thermostat_total: array<vec4f>; // 2 K, how many particles
@group(1) @binding(1) var<storage, read> thermostat_noise_total: array<vec4f>; // Σ √m n, Σ m
@group(1) @binding(2) var<storage, read> thermostat_work_total: array<vec4f>; // Σ √m n · v, Σ n²
@group(1) @binding(3) var<storage, read_write> thermostat_heat: array<f32>;
@group(1) @binding(4) var<storage, read_write> thermostat_change: array<f32>;

override REMOVED: f32 = 0.0;
override TEMPERATURE: f32 = 1.0;
override TIME: f32 = 1.0;

@compute @workgroup_size(1)
fn csvr() {
    let twice = thermostat_total[0].x;
    var change = 0.0;
    // What rests has no velocities to scale.
    if twice > 0.0 {
        let noise = thermostat_noise_total[0];
        var squares = thermostat_work_total[0].y;
        // The momentum is no degree of freedom: the noise has none.
        if REMOVED > 0.0 { squares -= dot(noise.xyz, noise.xyz) / noise.w; }
        let lost = decayed(world.dt / TIME);
        let along = sqrt(lost * TEMPERATURE) * thermostat_work_total[0].x / twice;
        let part = lost * (TEMPERATURE * squares / twice - 1.0) + 2.0 * sqrt(1.0 - lost) * along;
        let factor = sqrt(max(1.0 + part, 0.0));
        change = part / (1.0 + factor);
        // The noise along the velocities may turn them.
        if sqrt(1.0 - lost) + along < 0.0 { change = -1.0 - factor; }
        thermostat_heat[0] += 0.5 * twice * part;
    }
    thermostat_change[0] = change;
}
