// The divergence solve begins: the velocity may compress by  s = −dt D  in the step, where D is the rate at which the density
// grows. At the surface, where neighbours are few, there is no limit.
@group(2) @binding(5) var<storage, read> sorted_id: array<u32>;
@group(3) @binding(3) var<storage, read> responses: array<Response>;
@group(3) @binding(4) var<storage, read_write> unknowns: array<Unknown>;
@group(3) @binding(5) var<storage, read_write> pushes: array<vec4f>;
@group(3) @binding(6) var<storage, read_write> errors: array<f32>;
@group(3) @binding(7) var<storage, read_write> dfsph_state: array<State>;
@group(3) @binding(9) var<storage, read> warm_start: array<Stiffness>;

// The cells of the fluid: after the last of them come walls, and empty slots.
override CELLS: u32 = 1u;
override FEWEST: f32 = 0.0;
override WARM: f32 = 0.0;
override RELAXATION: f32 = 0.0;
const ANYTHING: f32 = 1000.0;
const WALL: f32 = -1.0;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn begin(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let k = folded(group, groups) * WORKGROUP + lane;
    if k >= world.count { return; }
    if k == 0u { dfsph_state[0] = State(); }
    let id = sorted_id[k];
    errors[k] = 0.0;
    if k >= starts[CELLS] {
        unknowns[k] = Unknown(WALL, 0.0, 0.0, 0.0);
        pushes[k] = vec4f();
        return;
    }
    let response = responses[id];
    let enough = response.neighbors >= FEWEST;
    let relaxation = select(0.0, RELAXATION * response.alpha / (world.dt * world.dt), enough);
    let stiffness = select(0.0, WARM * warm_start[id].divergence, relaxation > 0.0);
    unknowns[k] = Unknown(stiffness, stiffness, relaxation, select(ANYTHING, -world.dt * response.change, enough));
    pushes[k] = vec4f(0.0, 0.0, 0.0, 1.0);
}
