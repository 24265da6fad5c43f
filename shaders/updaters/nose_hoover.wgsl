// The thermostat of Nosé (1984) and Hoover (1985) over a part h of the step (Martyna et al. 1996), with N degrees of freedom:
//   ξ ← ξ + h/2 G(K),  v ← v exp(−h ξ),  η ← η + h ξ,  ξ ← ξ + h/2 G(K exp(−2 h ξ)),  G(K) = (2 K / N k T − 1) / τ²
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

@compute @workgroup_size(1)
fn nose_hoover() {
    let h = FACTOR * world.dt;
    let freedoms = DIMENSIONS * thermostat_total[0].y - REMOVED;
    var change = 0.0;
    if freedoms > 0.0 {
        let hotter = thermostat_total[0].x / (freedoms * TEMPERATURE);
        let push = 0.5 * h / (TIME * TIME);
        let middle = thermostat_rate[0] + push * (hotter - 1.0);
        let x = h * middle;
        change = -x / (1.0 + x * (0.5 + x / 12.0));
        thermostat_phase[0] += x;
        thermostat_rate[0] = middle + push * (hotter * (1.0 + change) * (1.0 + change) - 1.0);
    }
    thermostat_change[0] = change;
}
