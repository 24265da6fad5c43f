// The drive of pedestrians to the nearest exit of a plan (Helbing & Molnár 1995):  a = (v₀ e − v) / τ,  e = −∇T / |∇T|, with T the distance to the exit round
// walls. In each cell ∇T is of one-sided differences, to the smaller neighbours that no wall is before; e is interpolated between the four
// cells around a pedestrian that are in the open from the nearest of them.
struct Params {
    unused_word: u32,
    low: vec3f, side: f32, relaxation_time: f32, width: u32, height: u32, species: u32,
}

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<storage, read> desired_speed: array<f32>;
@group(3) @binding(2) var<storage, read> cell_open: array<u32>;
@group(3) @binding(3) var<storage, read> exit_distance: array<f32>;

const FAR: f32 = 1e9;

// The distance at a neighbour that no wall is before.
fn beyond(k: u32, open: u32, bit: u32, next: u32) -> f32 {
    if (open & bit) > 0u { return exit_distance[next]; }
    return FAR;
}

// −∂T / ∂x of one-sided differences times h, of a cell whose neighbours to −x and +x are so far.
fn slope(here: f32, below: f32, above: f32) -> f32 {
    if below < above { return -max(here - below, 0.0); }
    return max(here - above, 0.0);
}

// The direction in a cell.
fn heading(k: u32) -> vec2f {
    let open = cell_open[k];
    let here = exit_distance[k];
    let way = vec2f(
        slope(here, beyond(k, open, 1u, k - 1u), beyond(k, open, 2u, k + 1u)),
        slope(here, beyond(k, open, 4u, k - params.width), beyond(k, open, 8u, k + params.width)),
    );
    let size = length(way);
    if size > 0.0 { return way / size; }
    return vec2f();
}

// Whether no wall is between two of the cells around a point, counted 0 to 3 by bits of x and y, with the first one at `corner`.
fn is_open(corner: u32, one: u32, other: u32) -> bool {
    let apart = one ^ other;
    if apart == 0u { return true; }
    let open = cell_open[at(corner, one)];
    let along_x = (open & select(2u, 1u, (one & 1u) > 0u)) > 0u;
    let along_y = (open & select(8u, 4u, (one & 2u) > 0u)) > 0u;
    if apart == 1u { return along_x; }
    if apart == 2u { return along_y; }
    // Round both corners of the square.
    let by_x = (cell_open[at(corner, one ^ 1u)] & select(8u, 4u, (one & 2u) > 0u)) > 0u;
    let by_y = (cell_open[at(corner, one ^ 2u)] & select(2u, 1u, (one & 1u) > 0u)) > 0u;
    return along_x && along_y && by_x && by_y;
}

// Whether a cell is on the floor, and has a way to an exit.
fn is_known(k: u32) -> bool { return (cell_open[k] & 16u) > 0u && exit_distance[k] < FAR; }

fn at(corner: u32, n: u32) -> u32 { return corner + (n & 1u) + (n >> 1u) * params.width; }

fn force(me: Particle) -> vec4f {
    if !is_of(me.index, params.species) { return vec4f(); }
    let place = (me.position.xy - params.low.xy) / params.side - 0.5;
    let most = vec2f(f32(params.width) - 2.0, f32(params.height) - 2.0);
    let first = clamp(floor(place), vec2f(), most);
    let part = clamp(place - first, vec2f(), vec2f(1.0));
    let corner = u32(first.y) * params.width + u32(first.x);
    var weights = vec4f((1.0 - part.x) * (1.0 - part.y), part.x * (1.0 - part.y), (1.0 - part.x) * part.y, part.x * part.y);

    // The nearest cell with a way to an exit.
    var nearest = 0u;
    var largest = -1.0;
    for (var n = 0u; n < 4u; n += 1u) {
        let k = at(corner, n);
        if is_known(k) && weights[n] > largest {
            nearest = n;
            largest = weights[n];
        }
    }
    var way = vec2f();
    for (var n = 0u; n < 4u; n += 1u) {
        let k = at(corner, n);
        if is_known(k) && is_open(corner, nearest, n) { way += weights[n] * heading(k); }
    }
    let e = unit(vec3f(way, 0.0));
    desire(me.index, e);
    return vec4f((desired_speed[me.index] * e - velocity_of(me)) / params.relaxation_time, 0.0);
}
