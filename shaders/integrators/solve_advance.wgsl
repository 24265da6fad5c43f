// The second half: every workgroup adds the same parts in the same order, so that all of them compute the same step lengths
// (Chronopoulos & Gear 1989):  β = γ / γ₋,  α = γ / (δ − β γ / α₋),  p ← z + β p,  s ← A z + β s,  y ← y + α p,  r ← r − α s,  z ← P r.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(4) var<storage, read> rows: array<Row>;
@group(2) @binding(2) var<storage, read_write> residuals: array<Residual>;
@group(2) @binding(3) var<storage, read_write> directions: array<Direction>;
@group(2) @binding(4) var<storage, read> dots: array<Dots>;
@group(2) @binding(5) var<storage, read> solve_state: array<State>;
@group(2) @binding(6) var<storage, read_write> solve_next: array<State>;
@group(2) @binding(7) var<uniform> extent: Extent;

override TOLERANCE: f32 = 1.0;
override LIMIT: f32 = 1.0;
override PART: f32 = 1.0;

@compute @workgroup_size(WORKGROUP)
fn solve_advance(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let block = folded(group, groups);
    let before = solve_state[0];
    if before.code > 0.0 {
        if block == 0u && lane == 0u { solve_next[0] = before; }
        return;
    }
    var sum = vec4f();
    for (var k = lane; k < extent.groups; k += WORKGROUP) {
        let part = dots[k];
        sum += vec4f(part.gamma, part.delta, part.tied, part.alone);
    }
    sum = total(lane, sum);
    let fresh = before.iterations == 0.0;
    var after = before;
    if before.first == 0.0 { after.first = sum.z + sum.w; }
    after.residual = select(sum.z, sum.z + sum.w, fresh);
    let goal = TOLERANCE * TOLERANCE * after.first;
    let enough = PART * PART * goal;
    if fresh && !broken(sum) && after.residual <= goal { after.settled = 1.0; }
    var beta = 0.0;
    var bend = sum.y;
    if !fresh {
        beta = sum.x / before.gamma;
        bend = sum.y - beta * sum.x / before.alpha;
    }
    if broken(sum) {
        after.code = 2.0;
    } else if sum.z <= enough || after.settled > 0.0 {
        after.code = 1.0;
    } else if before.iterations >= LIMIT {
        after.code = 3.0;
    } else if sum.x <= 0.0 || bend <= 0.0 {
        // The matrix is not positive along the direction.
        after.code = 2.0;
    }
    if after.code == 2.0 { after.broken = 1.0; }
    if after.code == 0.0 {
        let alpha = sum.x / bend;
        after.gamma = sum.x;
        after.alpha = alpha;
        after.iterations += 1.0;
        after.total += 1.0;
        let first = block * extent.chunk;
        let end = min(first + extent.chunk, world.count);
        for (var i = first + lane; i < end; i += WORKGROUP) {
            let inverse = rows[i].inverse;
            // Particles without links take no part.
            if inverse.x != 0.0 {
                let p = residuals[i].z + beta * directions[i].p;
                let s = rows[i].image + beta * directions[i].s;
                let r = residuals[i].r - alpha * s;
                directions[i].p = p;
                directions[i].s = s;
                directions[i].y += alpha * p;
                residuals[i] = Residual(inverse * r, r);
            }
        }
    }
    if block == 0u && lane == 0u { solve_next[0] = after; }
}
