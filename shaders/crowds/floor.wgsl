// The walls of a plan, for pedestrians of models that set velocities.
struct Walls { push: vec2f, clearance: f32 }

@group(3) @binding(9) var<storage, read> walls: array<Wall>;

override COUNT: u32 = 1u;
const FAR: f32 = 1e9;

// From the nearest point of a wall, and where on it that is.
fn apart(wall: Wall, x: vec2f) -> vec3f {
    let along = wall.b - wall.a;
    let start = x - wall.a;
    let s = clamp(dot(start, along) / dot(along, along), 0.0, 1.0);
    return vec3f(start - s * along, s);
}

// The push of the nearest point of each wall on whose free side a pedestrian is, and the distance to the nearest of all.
fn before_walls(x: vec2f, radius: f32, repulsion: f32, decay: f32) -> Walls {
    var sum = Walls(vec2f(), FAR);
    var nearest = FAR;
    var way = vec2f();
    var seen = false;
    for (var k = 0u; k < COUNT; k += 1u) {
        let wall = walls[k];
        let here = apart(wall, x);
        let distance = length(here.xy);
        if distance < nearest {
            nearest = distance;
            way = here.xy;
            let left = side(wall.b - wall.a, x - wall.a) > 0.0;
            seen = left || (here.z <= 0.0 && (wall.ends & 1u) > 0u) || (here.z >= 1.0 && (wall.ends & 2u) > 0u);
        }
        if (wall.ends & 4u) > 0u {
            if seen && nearest > 0.0 { sum.push += repulsion * exp((radius - nearest) / decay) / nearest * way; }
            sum.clearance = min(sum.clearance, nearest);
            nearest = FAR;
            seen = false;
        }
    }
    return sum;
}

// Whether a wall is between a place and what is at r from it; none is nearer than the clearance.
fn is_hidden(x: vec2f, r: vec2f, clearance: f32) -> bool {
    var hidden = false;
    if dot(r, r) > clearance * clearance {
        // A number that a compiler does not know: within loops over neighbours it would unroll this one, and take a minute.
        let count = min(COUNT, arrayLength(&walls));
        for (var k = 0u; k < count; k += 1u) { hidden = hidden || crosses(walls[k], x, x + r); }
    }
    return hidden;
}

// The way that a disc may go along e before it touches a wall, `most` at most. The distance to a straight wall is a convex function of the place: along e it
// falls by no more than at the start, by −e · n, with n from the wall to the disc.
fn before_contact(x: vec2f, e: vec2f, radius: f32, most: f32) -> f32 {
    var way = most;
    for (var k = 0u; k < COUNT; k += 1u) {
        let here = apart(walls[k], x).xy;
        let distance = length(here);
        let into = -dot(e, here);
        if into > 0.0 { way = min(way, max(distance - radius, 0.0) * distance / into); }
    }
    return way;
}
