// To a part h of the step:  x = x₀ + h dt v₀ + dt² (h² a₀ / 2 + Σ X g),  v = v₀ + dt (h a₀ + Σ V g), with integrals X and V of the terms of the
// polynomial.
override H: f32 = 1.0;
override X0: f32;
override X1: f32;
override X2: f32;
override X3: f32;
override X4: f32;
override X5: f32;
override X6: f32;
override V0: f32;
override V1: f32;
override V2: f32;
override V3: f32;
override V4: f32;
override V5: f32;
override V6: f32;

struct Change { velocity: vec3f, curve: vec3f } // Δv, and Δx without that by v₀

fn change(i: u32) -> Change {
    let x = array<f32, 7>(X0, X1, X2, X3, X4, X5, X6);
    let v = array<f32, 7>(V0, V1, V2, V3, V4, V5, V6);
    let a = step_start[i * SLOTS + START_ACCELERATION].xyz;
    var drift = 0.5 * H * H * a;
    var kick = H * a;
    for (var k = 0u; k < DIFFERENCES; k += 1u) {
        let g = acceleration_differences[i * DIFFERENCES + k].xyz;
        drift += x[k] * g;
        kick += v[k] * g;
    }
    return Change(world.dt * kick, world.dt * (world.dt * drift));
}
