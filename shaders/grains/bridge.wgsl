// A bridge of liquid between two spheres a distance s apart, or a sphere and a wall. It forms where they touch, and breaks where s = s_c:
//   force   F = 2 π R γ cos θ / (1 + 1.05 x + 2.5 x²) n,  x = s √(R / V), as at s = 0 where they overlap (Willett et al. 2000)
//   R       2 R₁ R₂ / (R₁ + R₂), at a wall 2 R₁ (Derjaguin 1934)
//   s_c     (1 + θ / 2) V^(1/3) (Lian, Thornton & Adams 1993)
//   energy  −∫ F ds from s to s_c, so that it is 0 where the bridge breaks
//   heat    what is set free where it forms, as a power: its energy, less what the kick of half a step gains by the force
struct Bridge { pull: f32, energy: f32, heat: f32, wet: f32 }

// For 0 to 0.705, to 2e-7 of the value: drivers' functions differ.
fn arctangent(u: f32) -> f32 {
    let y = u * u;
    return u * (0.9999998 + y * (-0.3333062 + y * (0.1993429 + y * (-0.1368555 + y * (0.0848825 - y * 0.0307553)))));
}

// ∫ dx / (1 + 1.05 x + 2.5 x²), from x to the end, by half of the angle.
fn stretched(x: f32, end: f32) -> f32 {
    let t = 2.9828677 * 5.0 * (end - x) / (8.8975 + (5.0 * x + 1.05) * (5.0 * end + 1.05));
    return 1.3409914 * arctangent(t / (1.0 + sqrt(1.0 + t * t)));
}

fn bridged(pair: Pair, at: Meeting, wet: f32) -> Bridge {
    let reach = pair.reach * at.smaller;
    let s = max(-at.overlap, 0.0);
    let touches = at.overlap > 0.0;
    let holds = touches || (wet > 0.0 && s < reach);
    if pair.pull > 0.0 && holds {
        let radius = 2.0 * at.radius;
        let length = pair.spread * at.smaller * sqrt(at.smaller / radius); // √(V / R)
        let x = s / length;
        let force = pair.pull * radius / (1.0 + 1.05 * x + 2.5 * x * x);
        let energy = -pair.pull * radius * length * stretched(x, reach / length) - force * max(at.overlap, 0.0);
        var heat = 0.0;
        if wet <= 0.0 { heat = -energy / world.dt - 0.5 * force * dot(at.v, at.n); }
        return Bridge(force, energy, heat, 1.0);
    }
    return Bridge();
}
