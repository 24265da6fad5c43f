// A joint or a triangle as seen from one of its corners; `place` is my index among the three: 0, 1, 2. `rest` is the angle at rest.
struct Corner { first: u32, second: u32, third: u32, place: u32, stiffness: f32, rest: f32 }

const CORNERS: f32 = 3.0;

// The way to the second corner along the bonds.
fn way_to_second(me: Particle, corner: Corner) -> vec3f { return shortest(particle(corner.second).position - me.position); }
