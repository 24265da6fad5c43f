//! Mutants that no test can notice, because they do the same; each with its reason.

use crate::support::equivalents::{Equivalent, same};

const ANY_SIZE: &str = "the host reads the size of a workgroup by reflection, and any will do";
const ALWAYS_SET: &str = "the host sets every override";
const SLOW_WAY: &str = "it takes the way for blocks that are not apart, or not full: slower, and the same sum";
const ENOUGH: &str = "more halvings than there are keys";
const LAST_DIGITS: &str = "a part in a million, where `tests/pins` holds places to two units in the last place";
const SINE: &str = "let sine_end";
const COSINE: &str = "let cosine_end";
const STORES_NOTHING: &str = "lanes behind the last particle store nothing of theirs";
const EDGE: &str = "nobody stands at the very edge";
const AT_THE_SIDE: &str = "who is at the side stays at the side, by one way or the other";
const SOON: &str = "it says when to stop, and the last of Newton's steps doubles digits that are enough";
const LOST: &str = "what is lost is lost either way";
const NOTHING_BEFORE: &str = "before the first rod, and behind the last, it is a factor of nothing";
const NOT_ASKED: &str = "it is not asked for any more";
const ALL_KNOW: &str = "all know the same, and whoever says it says the same";
const APART: &str = "let apart = start + BLOCK <= mine || start >= mine + WORKGROUP * TARGETS;";

/// Of implicit solves.
pub const SOLVES: &[Equivalent] = &[
    same("", "override START: bool = true;", "true", "false", ALWAYS_SET),
    same("solve_report.wgsl", "override NEWTON: bool = false;", "false", "true", ALWAYS_SET),
    same("solve_advance.wgsl", "override TOLERANCE: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("solve_advance.wgsl", "override LIMIT: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("solve_advance.wgsl", "override PART: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("solve_total.wgsl", "width > 1u;", ">", ">=", "one more round, of no lanes"),
    same("solve_total.wgsl", "if lane < width", "<", "<=", NOT_ASKED),
    same("solve_total.wgsl", "if lane < half", "<", "<=", NOT_ASKED),
    same("solve_product.wgsl", "if lane == 0u && block", "==", "!=", ALL_KNOW),
    same("solve_product.wgsl", "if lane == 0u && block", "0u", "1u", ALL_KNOW),
    same("solve_begin.wgsl", "if i == 0u {", "==", "!=", ALL_KNOW),
    same("solve_begin.wgsl", "if i == 0u {", "0u", "1u", ALL_KNOW),
    same("solve_begin.wgsl", "let lost = ", "<=", "<", EDGE),
    same("solve_advance.wgsl", "if block == 0u && lane == 0u {", "==", "!=", ALL_KNOW),
    same("solve_advance.wgsl", "if block == 0u && lane == 0u {", "0u", "1u", ALL_KNOW),
    same("solve_advance.wgsl", "if block == 0u && lane == 0u {", "&&", "||", ALL_KNOW),
    same("solve_advance.wgsl", "after.residual <= goal", "<=", "<", EDGE),
    same("solve_advance.wgsl", "} else if sum.z <= enough", "<=", "<", EDGE),
    same("solve_advance.wgsl", "} else if sum.x <= 0.0", "<=", "<", EDGE),
    same(
        "solve_advance.wgsl",
        "let end = min(first + extent.chunk",
        "+",
        "-",
        "the first workgroup does what the others leave to it: slower, and the same",
    ),
];

pub const EQUIVALENT: &[Equivalent] = &[
    same("", "const WORKGROUP: u32 = 64u;", "64u", "65u", ANY_SIZE),
    same("", "override FACTOR: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("", "override WEIGHT: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("lead.wgsl", "override FIRST: u32 = 0u;", "0u", "1u", ALWAYS_SET),
    same("", "override END: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("hold.wgsl", "if i < END {", "<", "<=", "behind the last one stands the id of nobody"),
    same("pose.wgsl", SINE, "-", " ", LAST_DIGITS),
    same("pose.wgsl", SINE, "0.0000000239", "3.585e-8", LAST_DIGITS),
    same("pose.wgsl", SINE, "+", "-", LAST_DIGITS),
    same("pose.wgsl", COSINE, "-", " ", LAST_DIGITS),
    same("pose.wgsl", COSINE, "0.0000002605", "3.9075e-7", LAST_DIGITS),
    same("pose.wgsl", COSINE, "+", "-", LAST_DIGITS),
    same("pose.wgsl", "for (var k", "0u", "1u", ENOUGH),
    same("pose.wgsl", "for (var k", "<", "<=", ENOUGH),
    same("pose.wgsl", "for (var k", "32u", "33u", ENOUGH),
    same("pose.wgsl", "for (var k", "1u", "2u", ENOUGH),
    same("pose.wgsl", "if middle > low {", ">", ">=", "it finds the same key again"),
    same("pose.wgsl", "if since(middle", ">=", ">", EDGE),
    same("pose.wgsl", "u >= 0.0);", ">=", ">", EDGE),
    same("pose.wgsl", "var s = clamp(u, 0.0, 1.0);", "1.0", "1.5", "behind the last key nothing moves"),
    same("solid.wgsl", "if hit.depth > 0.0 {", ">", ">=", EDGE),
    same("solid.wgsl", "if speed > grip {", ">", ">=", "at the limit both are the same number"),
    same("distance.wgsl", "if square > 0.0 {", ">", ">=", "whatever a driver makes of 0 / 0, times no axis"),
    same("still.wgsl", "vec4f(0.0, 0.0, 0.0, 1.0)", "1.0", "1.5", "about no axis nothing turns"),
    same("moving.wgsl", "override REACHED: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("at.wgsl", "override FACTOR: f32 = 0.0;", "0.0", "1.0", ALWAYS_SET),
    same("pairs_finish.wgsl", "override LAYERS: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("fields.wgsl", "override PERIODIC: bool = false;", "false", "true", ALWAYS_SET),
    same("span.wgsl", "override WHOLE: bool = true;", "true", "false", ALWAYS_SET),
    same("gravity_spline.wgsl", "if distance2 >= h * h {", ">=", ">", "at u = 1 both formulas are the same number"),
    same("gravity_spline.wgsl", "if u < 0.5 {", "<", "<=", "at u = 1/2 both formulas are the same number"),
    same(
        "wind.wgsl",
        "var along = 0.0;",
        "0.0",
        "1.0",
        "a wind of no speed has gusts of no speed, whatever their phase",
    ),
    same(
        "watch.wgsl",
        "if i < world.count {",
        "<",
        "<=",
        "behind the last element stands a finite number, or the last one again",
    ),
    same("watch.wgsl", "if bitcast<u32>(speed) > atomicLoad", ">", ">=", "the largest stays the largest"),
    same(
        "boids.wgsl",
        "const COINCIDENT: f32 = 1e-30;",
        "1e-30",
        "1.5000000000000001e-30",
        "as good as nothing as well",
    ),
    same("boids.wgsl", "if d2 < params.separation_range", "<", "<=", EDGE),
    same("boids.wgsl", "&& d2 > COINCIDENT {", ">", ">=", EDGE),
    same("rod.wgsl", "override FACTOR: f32 = 0.0;", "0.0", "1.0", ALWAYS_SET),
    same("rod.wgsl", "override CHAINS: u32 = 0u;", "0u", "1u", ALWAYS_SET),
    same("rod.wgsl", "override SETTLES: bool = false;", "false", "true", ALWAYS_SET),
    same("rod.wgsl", "const TURNS: u32 = 6u;", "6u", "7u", SOON),
    same("rod.wgsl", "const STRETCHES: u32 = 4u;", "4u", "5u", SOON),
    same("rod.wgsl", "const CLOSE: f32 = 3e-7;", "3e-7", "4.5e-7", SOON),
    same("rod.wgsl", "const FAR: f32 = 1e-3;", "1e-3", "0.0015", EDGE),
    same("rod.wgsl", "select(1.0 / x.w,", "1.0", "1.5", "what all weights have in common takes no part"),
    same("rod.wgsl", "var pivot = 1.0;", "1.0", "1.5", NOTHING_BEFORE),
    same("rod.wgsl", "var known = 0.0;", "0.0", "1.0", NOTHING_BEFORE),
    same("rod.wgsl", "var multiplier = 0.0;", "0.0", "1.0", NOTHING_BEFORE),
    same("rod.wgsl", "var upper = 0.0;", "0.0", "1.0", NOTHING_BEFORE),
    same("rod.wgsl", "worst = max(worst, abs(", "1.0", "1.5", SOON),
    same("rod.wgsl", "worst = max(worst, abs(", "/", "*", SOON),
    same("rod.wgsl", "let square = length * length;", "*", "/", SOON),
    same("rod.wgsl", "for (var n = 0u; n <", "0u", "1u", SOON),
    same("rod.wgsl", "for (var n = 0u; n <", "<", "<=", SOON),
    same("rod.wgsl", "for (var n = 0u; n < TURNS", "&&", "||", SOON),
    same("rod.wgsl", "for (var n = 0u; n <", ">", ">=", SOON),
    same("rod.wgsl", "if max(turn, stretch) > FAR {", ">", ">=", EDGE),
    same("rod.wgsl", "var nan = 0x7fc00000u;", "0x7fc00000u", "0x7fc00001u", LOST),
    same("rod.wgsl", "vec3f(bitcast<f32>(nan)), h, true);", "true", "false", LOST),
    same("goal.wgsl", "if distance < params.free_radius", "<", "<=", EDGE),
    same("goal.wgsl", "if distance < params.slow_radius", "<", "<=", "at the edge both are the same number"),
    same("distance.wgsl", "if depth.", ">=", ">", "nobody is as near to two faces"),
    same("obstacle.wgsl", "if s >= ahead {", ">=", ">", "so far ahead the push is nothing"),
    same("speed_limit.wgsl", "if speed > params.most {", ">", ">=", "at the limit both are the same number"),
    same("speed_limit.wgsl", "if speed < params.least {", "<", "<=", "at the limit both are the same number"),
    same("steering.wgsl", "if size > most {", ">", ">=", "at the limit both are the same number"),
    same("vicsek.wgsl", "way = vec2f(1.0, 0.0);", "1.0", "1.5", "it has a direction alone"),
    same("wander.wgsl", "(fraction(words.x) - 0.5)", "-", "+", "a whole turn further"),
    same("boundary/", "(x >= low && x <", ">=", ">", AT_THE_SIDE),
    same("reflecting.wgsl", "x <= high)", "<=", "<", AT_THE_SIDE),
    same("periodic.wgsl", "if inside >= low", ">=", ">", AT_THE_SIDE),
    same("reflecting.wgsl", "velocity[i] = v * vec4f(", "*", "/", "1 and -1 are their own inverses"),
    same("particle.wgsl", "let index = min(i, world.count - 1u);", "-", "+", STORES_NOTHING),
    same("span.wgsl", "i >= world.count { return Sum(); }", ">=", ">", STORES_NOTHING),
    same(
        "pairs_tile.wgsl",
        "position[min(start + lane, world.count - 1u)]",
        "-",
        "+",
        "what is loaded behind the last source is met by nobody",
    ),
    same(
        "visit/pairs_",
        "for (var start = first; start < end; start += BLOCK) {",
        "<",
        "<=",
        "one more block, of no sources",
    ),
    same("visit/pairs_", APART, "<=", "<", SLOW_WAY),
    same("visit/pairs_", APART, "||", "&&", SLOW_WAY),
    same("visit/pairs_", APART, ">=", ">", SLOW_WAY),
    same("visit/pairs_", "if apart && start + BLOCK <= end {", "<=", "<", SLOW_WAY),
    same("pairs_subgroup.wgsl", "let full = start + BLOCK <= end;", "<=", "<", SLOW_WAY),
    same(
        "pairs_subgroup.wgsl",
        APART,
        "*",
        "/",
        "blocks and targets begin at multiples of 128: behind mine + 8 is behind mine + 128",
    ),
];
