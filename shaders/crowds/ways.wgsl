// The distance T to the nearest exit round walls, |∇T| = 1, on cells of side h: the upwind differences of Godunov (Rouy & Tourin 1992), with a and b the
// smaller neighbours along x and y that no wall is before,
//   T = min(a, b) + h  where |a − b| ≥ h,  else  (a + b + √(2 h² − (a − b)²)) / 2,
// in Jacobi's sweeps over all cells: T only decreases, by each sweep farther from the exits.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> cell_open: array<u32>;
@group(1) @binding(1) var<storage, read> cell_known: array<f32>;
@group(1) @binding(2) var<storage, read> before: array<f32>;
@group(1) @binding(3) var<storage, read_write> after: array<f32>;

override COUNT: u32 = 1u;
override WIDTH: u32 = 1u;
override SIDE: f32 = 1.0;
const WORKGROUP: u32 = 64u;
// No distance: where no way has been found yet.
const FAR: f32 = 1e9;

@compute @workgroup_size(WORKGROUP)
fn ways(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let k = folded(group, groups) * WORKGROUP + lane;
    if k < COUNT {
        let open = cell_open[k];
        var distance = before[k];
        if cell_known[k] >= FAR {
            var a = FAR;
            var b = FAR;
            if (open & 1u) > 0u { a = before[k - 1u]; }
            if (open & 2u) > 0u { a = min(a, before[k + 1u]); }
            if (open & 4u) > 0u { b = before[k - WIDTH]; }
            if (open & 8u) > 0u { b = min(b, before[k + WIDTH]); }
            if min(a, b) < FAR {
                let apart = abs(a - b);
                var found = min(a, b) + SIDE;
                if apart < SIDE { found = 0.5 * (a + b + sqrt(2.0 * SIDE * SIDE - apart * apart)); }
                distance = min(distance, found);
            }
        }
        after[k] = distance;
    }
}
