// A particle's row of the linear system (M − h² K − h D) Δv = b, with K and D the derivatives of forces by position and by
// velocity (Baraff & Witkin 1998), and the state of its solution.
struct Row {
    diagonal: vec4f, // xx, yy, zz of its own block; how it is solved: 0 not at all, 1 with others, 2 alone
    across: vec4f,   // xy, yz, zx of its own block; its weight: the mass, or 1 without mass
    inverse: vec4f,  // one over the diagonal, with what ties it to others
    image: vec4f,    // the matrix times a direction; before there is one, h² K v, and the distance from the origin
}

const HELD: f32 = 0.0;
const TIED: f32 = 1.0;
const ALONE: f32 = 2.0;

// z = P r, the preconditioned residual, and r, the residual.
struct Residual { z: vec4f, r: vec4f }

// The direction of search p, its image s, and the solution y, which is Δv.
struct Direction { p: vec4f, s: vec4f, y: vec4f }

// Sums over particles: r · z, z · A z, r · r of those that are linked and of those that are alone.
struct Dots { gamma: f32, delta: f32, tied: f32, alone: f32 }

// first: |b|² of the step's first solve; iterations of this solve, and of all in the step; code: 0 on its way, 1 converged,
// 2 broken down, 3 out of iterations; settled: b met the tolerance; broken: a solve of the step broke down.
struct State {
    first: f32, gamma: f32, alpha: f32, residual: f32,
    iterations: f32, total: f32, code: f32, settled: f32, broken: f32,
}

struct Extent { unused_word: u32, chunk: u32, groups: u32 }
