// The first half of an iteration of conjugate gradients (Chronopoulos & Gear 1989): A z, and its partial sums.
// Each workgroup processes a block of particles and writes its partial sums.
@group(1) @binding(4) var<storage, read_write> rows: array<Row>;
@group(2) @binding(2) var<storage, read> residuals: array<Residual>;
@group(2) @binding(4) var<storage, read_write> dots: array<Dots>;
@group(2) @binding(5) var<storage, read> solve_state: array<State>;
@group(2) @binding(7) var<uniform> extent: Extent;

override FACTOR: f32 = 1.0;

fn direction(i: u32) -> vec3f { return residuals[i].z.xyz; }

@compute @workgroup_size(WORKGROUP)
fn solve_product(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    // All lanes or none: a solve that is done stays done.
    if solve_state[0].code > 0.0 { return; }
    let block = folded(group, groups);
    let first = block * extent.chunk;
    let end = min(first + extent.chunk, world.count);
    var sum = vec4f();
    for (var i = first + lane; i < end; i += WORKGROUP) {
        let row = rows[i];
        let z = residuals[i].z.xyz;
        let r = residuals[i].r.xyz;
        let own = row.diagonal.xyz * z + row.across.xyz * z.yzx + row.across.zxy * z.zxy;
        let image = own - pull(particle(i), FACTOR * world.dt);
        rows[i].image = vec4f(image, 0.0);
        let alone = row.diagonal.w == ALONE;
        sum += vec4f(dot(r, z), dot(image, z), select(dot(r, r), 0.0, alone), select(0.0, dot(r, r), alone));
    }
    sum = total(lane, sum);
    if lane == 0u && block < extent.groups { dots[block] = Dots(sum.x, sum.y, sum.z, sum.w); }
}
