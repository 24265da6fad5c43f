//! Mutants that no test of pictures can notice, because they do the same; each with its reason.

use crate::support::equivalents::{Equivalent, same};

const ANY_SIZE: &str = "the host reads it by reflection, and any size will do";
const ALWAYS_SET: &str = "the host sets every override";
const NOT_IN_FRONT: &str = "what `cover` has not drawn is at the front of no pixel";
const TIE: &str = "no place is known so well that it is exactly there";
const WIDER: &str = "it looks at more pixels, which the line does not touch";
const LONGER: &str = "pixels of other layers are drawn again, and the brightest wins as before";
const ZERO: &str = "0 and −0 are one depth";
const ONE_PLACE: &str = "a line of no length is at one place, whatever part of it";
const FAINT: &str = "it ends a quarter of a pixel aside, where the rim is fainter than a unit of light";
const WHITE: &str = "more than white is white, also under another light";
const CLAMPED: &str = "what follows cuts it off at the same end";
const UNREAD: &str = "the fourth number is read by nobody, and written again before the end";

pub const EQUIVALENT: &[Equivalent] = &[
    same("", "const WORKGROUP: u32 = 64u;", "64u", "65u", ANY_SIZE),
    same("streak.wgsl", "const WALK: u32 = 1024u;", "1024u", "1025u", ANY_SIZE),
    same("disc.wgsl", "override ROWS: i32 = 64;", "64", "65", ALWAYS_SET),
    same("blur.wgsl", "weights += weight;", "+=", "-=", "along rows it turns the sign, and along columns again"),
    same("blur.wgsl", "spread[i] = vec4f(sum / weights, 0.0);", "0.0", "1.0", UNREAD),
    same("shrink.wgsl", "halo[i] = vec4f(", "0.0", "1.0", UNREAD),
    same("claim.wgsl", "if i < world.count {", "<", "<=", NOT_IN_FRONT),
    same("claim.wgsl", "y < rows.high.y", "<", "<=", NOT_IN_FRONT),
    same("claim.wgsl", "x < rows.high.x", "<", "<=", NOT_IN_FRONT),
    same(
        "disc.wgsl",
        "let all = box(p.xy, p.w + 0.5);",
        "0.5",
        "0.75",
        "a larger box has no more pixels that are touched",
    ),
    same("disc.wgsl", "< p.w + 0.5;", "<", "<=", TIE),
    same("frame.wgsl", "visible = depth > NEAR * frame.distance;", ">", ">=", TIE),
    same("frame.wgsl", "abs(place.x) < FAR_OUT && abs(place.y) < FAR_OUT;", "<", "<=", TIE),
    same("project.wgsl", "let ball = size >= frame.solid;", ">=", ">", TIE),
    same("frame.wgsl", "let negative = bits >= 0x80000000u;", ">=", ">", ZERO),
    same("frame.wgsl", "let negative = bits >= 0x80000000u;", "0x80000000u", "0x80000001u", ZERO),
    same("look.wgsl", "return min(mix(light * (t / brightest)", "1.0", "1.5", WHITE),
    same("look.wgsl", "if line != 0u {", "0u", "1u", "a line of no brightness adds nothing"),
    same(
        "meter.wgsl",
        "if light > 0u {",
        ">",
        ">=",
        "what has no first bit is counted far behind the last bin: nowhere",
    ),
    same("meter.wgsl", "let wide = octave >= 3u;", ">=", ">", "at the third octave nothing is shifted either way"),
    same("meter.wgsl", "let wide = octave >= 3u;", "3u", "4u", "at the third octave nothing is shifted either way"),
    same("paint.wgsl", "let last = clamp(t - 3.0, 0.0, 1.0);", "1.0", "1.5", "t is 4 at most"),
    same("paint.wgsl", "let part = clamp(", "1.0", "1.5", "behind the last colour there is no other"),
    same("paint.wgsl", "pack4x8unorm(vec4f(map(part), 1.0));", "1.0", "1.5", CLAMPED),
    same("heading.wgsl", "color[i] = pack4x8unorm(", "1.0", "1.5", CLAMPED),
    same("splat.wgsl", "if q > 0.0 &&", ">", ">=", "where q is 0 the light is nothing"),
    same("streak.wgsl", "let steep = abs(way.y) > abs(way.x);", ">", ">=", "a diagonal can be walked either way"),
    same("streak.wgsl", "let low = i32(clamp(", "0.5", "0.75", WIDER),
    same("streak.wgsl", "let high = i32(clamp(", "0.5", "0.75", WIDER),
    same("streak.wgsl", "let high = i32(clamp(", "0.0", "1.0", WIDER),
    same("streak.wgsl", "let across = ", "1.4143", "2.12145", WIDER),
    same("streak.wgsl", "let across = ", "0.5", "0.75", WIDER),
    same("streak.wgsl", "let across = ", "-", "+", WIDER),
    same("streak.wgsl", "let end = first + 2 * across + 1;", "2", "3", WIDER),
    same("streak.wgsl", "let end = first + 2 * across + 1;", "1", "2", WIDER),
    same("streak.wgsl", "let squared = ", "1e-12", "1.5e-12", "a line is much longer, or of no length"),
    same("streak.wgsl", "let first_step = max(low, i32(layer * WALK));", "max", "min", LONGER),
    same("streak.wgsl", "let first_step = max(low, i32(layer * WALK));", "*", "/", LONGER),
    same("streak.wgsl", "i32((layer + 1u) * WALK)", "1u", "2u", LONGER),
    same("streak.wgsl", "var part = 0.0;", "0.0", "1.0", ONE_PLACE),
    same("streak.wgsl", "if along.x != 0.0 {", "0.0", "1.0", ONE_PLACE),
    same(
        "streak.wgsl",
        "part = clamp((f32(u) + 0.5 - start.x) / along.x, 0.0, 1.0);",
        "1.0",
        "1.5",
        "beyond the end its own direction leads to the pixels of its round end too: `across` reaches √2 as far",
    ),
    same("streak.wgsl", "< front[pixel(x, y)]", "<", "<=", "no line is exactly as deep as a ball"),
    same("sky.wgsl", "clamp(2.0 * dot(off, off), 0.0, 1.0)", "1.0", "1.5", "in a corner it is 1, and nowhere more"),
    same("stroke.wgsl", "override WALK: i32 = 64;", "64", "65", ALWAYS_SET),
    same("stroke.wgsl", "let steep = abs(way.y) > abs(way.x);", ">", ">=", "a diagonal can be walked either way"),
    same("stroke.wgsl", "let high = i32(clamp(", "0.0", "1.0", WIDER),
    same("stroke.wgsl", "let across = 1.4143 * frame.glow;", "1.4143", "2.12145", WIDER),
    same("stroke.wgsl", "let squared = ", "1e-12", "1.5e-12", "a stroke is much longer, or of no length"),
    same("stroke.wgsl", "var part = 0.0;", "0.0", "1.0", ONE_PLACE),
    same("stroke.wgsl", "if along.x != 0.0 {", "0.0", "1.0", ONE_PLACE),
    same("stroke.wgsl", "part = clamp((", "1.0", "1.5", "the far end, beyond which it looks elsewhere, has no light"),
    same("stroke.wgsl", "part = clamp((", "0.5", "0.75", FAINT),
    same("stroke.wgsl", "let row = ", "0.5", "0.75", FAINT),
    same("stroke.wgsl", "let row = ", "-", "+", "rounded down, the first row has a pixel to spare"),
    same("stroke.wgsl", "let last = i32(clamp(", "0.0", "1.0", WIDER),
    same("stroke.wgsl", "let s = clamp(dot(off, way) / squared", "1.0", "1.5", "beyond the far end there is no light"),
    same("stroke.wgsl", "if q > 0.0 &&", ">", ">=", "where q is 0 the light is nothing"),
    same("stroke.wgsl", "< front[at] {", "<", "<=", "no stroke is exactly as deep as a ball"),
    same(
        "tone.wgsl",
        "return f32((h ^ (h >> 16u)) >> 8u)",
        "16u",
        "17u",
        "it changes the last bits of the noise, far below a level",
    ),
    same("tone.wgsl", "let bytes = vec3u(clamp(c,", "1.0", "1.5", CLAMPED),
    same("tone.wgsl", "pixels[i] = ", "255u", "256u", "only in white, and with noise above 1 − 2⁻¹⁷, is there a 256"),
];
