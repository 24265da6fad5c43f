// A dihedral as seen from one of its corners; `place` is my index among the four: 0, 1, 2, 3. The phase is there as its cosine and sine.
struct Corner { first: u32, second: u32, third: u32, fourth: u32, place: u32, multiplicity: u32, stiffness: f32, cosine: f32, sine: f32 }

const CORNERS: f32 = 4.0;

// The way to the second corner along the bonds.
fn way_to_second(me: Particle, corner: Corner) -> vec3f {
    let second = particle(corner.second).position;
    let third = particle(corner.third).position;
    let last = shortest(second - third) + shortest(third - me.position);
    return select(shortest(second - me.position), last, corner.place == 3u);
}
