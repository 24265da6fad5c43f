// Divergence-free smoothed particle hydrodynamics (Bender & Koschier 2015): the state of particles, in the order of the cell list.

// How much denser than at rest, as a part of that; α = 1 / (|Σ V ∇W|² + Σ |V ∇W|²), but for walls; D, the rate at which the density grows, as
// a part of that at rest; how many are in range.
struct Response { excess: f32, alpha: f32, change: f32, neighbors: f32 }

// κ = p / ρ, below 0 for walls; κ before it was carried on in its direction; what a residual changes it by; what accelerations by
// pressure may compress by in a step.
struct Unknown { stiffness: f32, reached: f32, relaxation: f32, source: f32 }

// The κ of both solves.
struct Stiffness { divergence: f32, density: f32 }

// Of a solve: iterations; 0 on its way, 1 converged, 2 not finite, 3 out of iterations; the mean error.
struct State { iterations: f32, code: f32, error: f32 }
