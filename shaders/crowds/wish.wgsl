// What a pedestrian would do without the others, in models that set velocities: with e₀ its desired direction, and n from the nearest point of each wall on whose
// free side it is, at the distance d,
//   way = e₀ + Σ a' exp((R − d) / D') n,
// at the desired speed; 0 where it desires no direction, and −1 for a particle that is no pedestrian of the model.
struct Params { unused_word: u32, wall_repulsion: f32, wall_decay: f32, species: u32 }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<storage, read> radius: array<f32>;
@group(3) @binding(2) var<storage, read> desired_speed: array<f32>;
@group(3) @binding(3) var<storage, read> desired_direction: array<vec4f>;
@group(3) @binding(4) var<storage, read_write> wish: array<vec4f>;   // way, radius, speed
@group(3) @binding(5) var<storage, read_write> course: array<vec4f>; // direction, speed, distance to the nearest wall

fn update(me: Particle) {
    let e = desired_direction[me.index].xy;
    let size = radius[me.index];
    let walls = before_walls(me.position.xy, size, params.wall_repulsion, params.wall_decay);
    var speed = -1.0;
    if me.mass > 0.0 && is_of(me.index, params.species) {
        speed = 0.0;
        if dot(e, e) > 0.0 { speed = max(desired_speed[me.index], 0.0); }
    }
    wish[me.index] = vec4f(e + walls.push, size, speed);
    course[me.index] = vec4f(0.0, 0.0, 0.0, walls.clearance);
}
