// Statistics of a step's solves: solves, failures, the step of the first one, the maximum of iterations; iterations and
// outcome of the last: 1 converged, 2 broken down, 3 out of iterations.
@group(0) @binding(0) var<uniform> world: World;
@group(2) @binding(5) var<storage, read> solve_state: array<State>;
@group(2) @binding(6) var<storage, read_write> solve_report: array<u32>;

override NEWTON: bool = false;

@compute @workgroup_size(1)
fn report() {
    let state = solve_state[0];
    let converged = select(state.code == 1.0, state.settled > 0.0, NEWTON);
    if !converged {
        if solve_report[1] == 0u { solve_report[2] = world.step; }
        solve_report[1] += 1u;
    }
    let iterations = u32(state.total);
    solve_report[0] += 1u;
    solve_report[3] = max(solve_report[3], iterations);
    solve_report[4] = iterations;
    solve_report[5] = select(select(3u, 2u, state.broken > 0.0), 1u, converged);
}
