// Walls that pedestrians keep away from, press and rub on (Helbing, Farkas & Vicsek 2000): from the nearest point of each wall on whose free
// side a pedestrian of radius R and mass m is, at the distance d along n, with o = R − d and g = max(o, 0),
//   m a = Σ [A exp(o / B) + k g] n − κ g (v − (v·n) n).
struct Params {
    unused_word: u32,
    count: u32, range: f32, repulsion: f32, decay: f32, stiffness: f32, friction: f32, species: u32,
}
// A piece of a wall, with the floor at its left. Bits of `ends`: 1 and 2 where its start and its end stick out into the floor, 4 at the end of a wall.
struct Wall { a: vec2f, b: vec2f, ends: u32 }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<storage, read> radius: array<f32>;
@group(3) @binding(2) var<storage, read> walls: array<Wall>;

fn pressed(me: Particle, way: vec2f, distance: f32) -> vec3f {
    let n = vec3f(way / distance, 0.0);
    let overlap = radius[me.index] - distance;
    let touch = max(overlap, 0.0);
    let v = velocity_of(me);
    let push = params.repulsion * exp(overlap / params.decay) + params.stiffness * touch;
    return push * n - params.friction * touch * (v - dot(v, n) * n);
}

fn force(me: Particle) -> vec4f {
    if me.mass <= 0.0 || !is_of(me.index, params.species) { return vec4f(); }
    var sum = vec3f();
    var nearest = params.range;
    var way = vec2f();
    var seen = false;
    for (var k = 0u; k < params.count; k += 1u) {
        let wall = walls[k];
        let along = wall.b - wall.a;
        let start = me.position.xy - wall.a;
        let s = clamp(dot(start, along) / dot(along, along), 0.0, 1.0);
        let here = start - s * along;
        let distance = length(here);
        if distance < nearest {
            nearest = distance;
            way = here;
            let left = along.x * start.y - along.y * start.x > 0.0;
            seen = left || (s <= 0.0 && (wall.ends & 1u) > 0u) || (s >= 1.0 && (wall.ends & 2u) > 0u);
        }
        if (wall.ends & 4u) > 0u {
            if seen && nearest > 0.0 { sum += pressed(me, way, nearest); }
            nearest = params.range;
            seen = false;
        }
    }
    return vec4f(sum / me.mass, 0.0);
}
