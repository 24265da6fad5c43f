// The acceleration along a step by its divided differences at the nodes h of Radau's quadrature of order 15 (Newton's form):
// a(h) = a₀ + h (g₁ + (h − h₁) (g₂ + (h − h₂) (g₃ + …)))
const NODE = array<f32, 8>(
    0.0, 0.05626256053692215, 0.18024069173689236, 0.35262471711316964, 0.5471536263305554, 0.7342101772154105, 0.8853209468390958,
    0.9775206135612875
);
const DIFFERENCES: u32 = 7u;

@group(2) @binding(0) var<storage, read_write> acceleration_differences: array<vec4f>; // seven for each particle: xyz
// Six for each particle: position and mass, velocity and radius, acceleration at the start of the step; the low words of the first two; the
// last difference of the iteration before.
@group(2) @binding(1) var<storage, read_write> step_start: array<vec4f>;

const SLOTS: u32 = 6u;
const START_VELOCITY: u32 = 1u;
const START_ACCELERATION: u32 = 2u;
const LOW_POSITION: u32 = 3u;
const LOW_VELOCITY: u32 = 4u;
const BEFORE: u32 = 5u;
