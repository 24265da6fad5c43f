// Soft spheres (Groot & Warren 1997), with a of the pair of species:  U(r) = a R (1 − r / R)² / 2 up to the range R.
struct Params { unused_word: u32, range: f32 }
struct Pair { @size(12) unused_word: u32, strength: f32 }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<uniform> pair_table: array<Pair, 64>; // of 8 species

fn energy(me: Particle, you: Particle, distance: f32, inverse: f32) -> Energy {
    let strength = pair_table[pair_index(species[me.index], species[you.index])].strength;
    let left = 1.0 - distance / params.range;
    return Energy(0.5 * strength * params.range * left * left, -strength * left);
}
