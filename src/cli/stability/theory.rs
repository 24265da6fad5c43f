//! The theory of one step (Hairer & Wanner 1996, chapter IV; Hairer, Lubich & Wanner 2006, chapter I).

/// The factor of the energy of x″ = −ω² x in a step, for y = hω.
pub fn energy(name: &str, y: f64) -> Option<f64> {
    let square = y * y;
    Some(match name {
        "forward_euler" => 1.0 + square,
        "midpoint" | "heun" => 1.0 + square * square / 4.0,
        "rk4" => 1.0 - y.powi(6) / 72.0 + y.powi(8) / 576.0,
        "symplectic_euler" | "leapfrog" => {
            // The trace of the step matrix is 2 − y²; its eigenvalues leave the unit circle at y = 2.
            let half = (square / 2.0 - 1.0).max(1.0);
            (half + (half * half - 1.0).sqrt()).powi(2)
        }
        "forest_ruth" if y < 1.573 => 1.0,
        "pefrl" if y < 2.989 => 1.0,
        "backward_euler" | "linear_backward_euler" => 1.0 / (1.0 + square),
        "implicit_midpoint" | "linear_implicit_midpoint" | "trapezoid" | "linear_trapezoid" => 1.0,
        _ => return None,
    })
}

/// The factor of |u| of u′ = −a u in a step, for z = ha.
pub fn decay(name: &str, z: f64) -> Option<f64> {
    let two = 1.0 - z + z * z / 2.0;
    Some(match name {
        // The kicks of leapfrog use the velocity of half a step before: they are Euler steps, half a step apart.
        "forward_euler" | "symplectic_euler" | "leapfrog" => (1.0 - z).abs(),
        "midpoint" | "heun" => two,
        "rk4" => (two - z.powi(3) / 6.0 + z.powi(4) / 24.0).abs(),
        // Each kick uses the present velocity. θ of Forest & Ruth (1990), λ of Omelyan, Mryglod & Folk (2002).
        "forest_ruth" => {
            let theta = 1.0 / (2.0 - 2f64.cbrt());
            ((1.0 - theta * z).powi(2) * (1.0 - (1.0 - 2.0 * theta) * z)).abs()
        }
        "pefrl" => {
            let lambda = -0.212_341_831_062_605_4;
            ((1.0 - (0.5 - lambda) * z) * (1.0 - lambda * z)).powi(2)
        }
        "backward_euler" | "linear_backward_euler" => 1.0 / (1.0 + z),
        "implicit_midpoint" | "linear_implicit_midpoint" | "trapezoid" | "linear_trapezoid" => {
            ((1.0 - z / 2.0) / (1.0 + z / 2.0)).abs()
        }
        _ => return None,
    })
}
