// Weak coupling to a heat bath (Berendsen et al. 1984): the temperature T of N degrees of freedom relaxes to T₀ as
//   T ← T₀ + (T − T₀) exp(−dt / τ),  by one factor for all velocities.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> thermostat_total: array<vec4f>; // 2 K, how many particles
@group(1) @binding(1) var<storage, read_write> thermostat_heat: array<f32>;
@group(1) @binding(2) var<storage, read_write> thermostat_change: array<f32>;

override DIMENSIONS: f32 = 3.0;
override REMOVED: f32 = 0.0;
override TEMPERATURE: f32 = 1.0;
override TIME: f32 = 1.0;

@compute @workgroup_size(1)
fn berendsen() {
    let twice = thermostat_total[0].x;
    let freedoms = DIMENSIONS * thermostat_total[0].y - REMOVED;
    var change = 0.0;
    // What rests has no velocities to scale.
    if freedoms > 0.0 && twice > 0.0 {
        let part = decayed(world.dt / TIME) * (freedoms * TEMPERATURE / twice - 1.0);
        change = part / (1.0 + sqrt(1.0 + part));
        thermostat_heat[0] += 0.5 * twice * part;
    }
    thermostat_change[0] = change;
}
