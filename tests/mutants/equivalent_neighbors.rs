//! Mutants of the cell list and its searches that no test can notice, because they do the same; each with its reason.

use crate::support::equivalents::{Equivalent, same};

const ALWAYS_SET: &str = "the host sets every override";
const FURTHER: &str = "it looks further, where no particle is in range";
const EMPTY: &str = "one more stretch or turn, with no particle in it";
const IN_RESERVE: &str = "a search of the most takes 60 000 turns, and lavapipe ends loops after 65 535";
const WORTHLESS: &str = "the alarm is raised, and the sum over too many neighbours is discarded";
const AT_ONE_PLACE: &str = "so far away only those at one place are in range, and they are in one cell";
const AT_THE_SIDE: &str = "a particle at the lower side stays there either way";
const HIDDEN: &str = "the first of four is never moved on, and replaces no other";
const UNUSED: &str = "more of the list is kept than is used, or waited for: slower, and the same";
const ROUNDED: &str = "what rounding moves over a cell's side is a millionth of a cell away from it";
const REACH: &str = "select(select(vec3u(1u), vec3u(2u)";
const BREAK: &str = "if seen > MOST || all(";

pub const EQUIVALENT: &[Equivalent] = &[
    same("visit/nearest", "override COUNT: u32 = 7u;", "7u", "8u", ALWAYS_SET),
    same("present_living", "override CELLS: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("visit/within", "override RANGE: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("cell.wgsl", "const FARTHEST", "536870912.0", "805306368.0", AT_ONE_PLACE),
    same("cell.wgsl", "let whole = ", "+", "-", AT_ONE_PLACE),
    same("cell.wgsl", "let whole = ", "1u", "2u", "one more multiple of the cells"),
    same("cell.wgsl", "let inside = ", ">=", ">", AT_THE_SIDE),
    same("cell.wgsl", "return select(y, world.low", "<", "<=", AT_THE_SIDE),
    same("", "override MOST: u32 = 240000u;", "240000u", "240001u", IN_RESERVE),
    same("order.wgsl", "start + MOST", "+", "-", WORTHLESS),
    same("scatter.wgsl", "if i < world.count {", "<", "<=", "behind the last key stands one that leads nowhere"),
    same("near_rows", "let d = abs(away(x)) / ", "/", "*", FURTHER),
    same("near_rows", REACH, "2u", "3u", FURTHER),
    same("near_rows", REACH, "4u", "5u", FURTHER),
    same("near_rows", REACH, ">", ">=", "just there one cell, or two, is enough"),
    same(
        "near_rows",
        REACH,
        "8192.0",
        "12288.0",
        "it takes two of the worst roundings, and a pair that is just in range",
    ),
    same("near_rows", REACH, "2097152.0", "3145728.0", "up to 2²² two cells are enough"),
    same("near_rows", "return Around(cell, r,", "1u", "2u", FURTHER),
    same("near_rows", "first = min(c.x, 0) + n.x;", "0", "1", EMPTY),
    same("near_rows", "if first >= last", ">=", ">", EMPTY),
    same("near_rows", "fn seam(a", "<", "<=", EMPTY),
    same("near_rows", "override NARROW", "false", "true", "the nearest image is the same, however it is found"),
    same(
        "near_subgroup",
        "8u * LANES",
        "8u",
        "9u",
        "the host reads the size of a workgroup by reflection, and any will do",
    ),
    same("near_subgroup", "const APART", "3u", "4u", "more walk together, and look further"),
    same("near_subgroup", "let most = ", "*", "/", "fewer walk together"),
    same("near_subgroup", "return rows &&", "<=", "<", "fewer walk together"),
    same("near_subgroup", "return rows &&", "2u", "3u", "fewer walk together"),
    same("near_subgroup", "return rows &&", "+", "-", "fewer walk together"),
    same("near_subgroup", "let k = min(", "-", "+", "lanes behind the last target store nothing"),
    same("near_subgroup", "var walked", "0u", "1u", IN_RESERVE),
    same("near_subgroup", "walked +=", "-", "+", IN_RESERVE),
    same("near_subgroup", "let parts = ", "1u", "2u", EMPTY),
    same("near_subgroup", "let parts = ", "&&", "||", EMPTY),
    same("near_subgroup", "let rows = ", "0u", "1u", EMPTY),
    same("near_subgroup", "let rows = ", "<", "<=", "the first that waits is a lane, or far beyond them"),
    same("near_subgroup", "let next = ", "0u", "1u", "where none is left, the stretch is empty"),
    same("near_subgroup", "let behind = ", "1u", "2u", "what is loaded behind the end is paired with no particle"),
    same("near_subgroup", "if base >= rows", ">=", ">", EMPTY),
    same("near_subgroup", "var left = ", ">", ">=", EMPTY),
    same("near_subgroup", "var left = ", "&&", "||", WORTHLESS),
    same("near_subgroup", "if slot >= end {", ">=", ">", EMPTY),
    same("near_subgroup", "behind - 1u));", "-", "+", "what is loaded behind the end is paired with no particle"),
    same("near_walk", "slot < end; slot", "<", "<=", EMPTY),
    same("nearest", "const LARGEST", "1e38", "1.5e38", "no square is as large"),
    same("nearest", "const BEYOND", "1e19", "1.5e19", FURTHER),
    same("nearest", "let tied = ", "<", "<=", "no particle comes twice"),
    same("nearest", "let new_d = ", "0.0", "1.0", HIDDEN),
    same("nearest", "let new_i = ", "0u", "1u", HIDDEN),
    same("nearest", "if COUNT > ", ">", ">=", UNUSED),
    same("nearest", "let slack = ", "max", "min", ROUNDED),
    same("nearest", "let slack = ", "0.00390625", "0.005859375", FURTHER),
    same("nearest", "let slack = ", "*", "/", FURTHER),
    same("nearest", "let slack = ", "0.000000238418579", "3.576278685e-7", FURTHER),
    same("nearest", "let open = ", "<", "<=", FURTHER),
    same("nearest", "let open = ", "-", "+", ROUNDED),
    same("nearest", "return max(min(", "max", "min", FURTHER),
    same("nearest", "var seen = 0u", "0u", "1u", IN_RESERVE),
    same("nearest", "var reach = 1u", "1u", "2u", FURTHER),
    same("nearest", "let parts = ", "2u", "3u", EMPTY),
    same("nearest", "seen += STRETCH", "-", "+", IN_RESERVE),
    same("nearest", "seen <= MOST", "<=", "<", IN_RESERVE),
    same("nearest", "slot < end; slot", "<", "<=", EMPTY),
    same("nearest", BREAK, ">", ">=", IN_RESERVE),
    same("nearest", BREAK, "<", "<=", "no particle is exactly as far away as the cube reaches"),
    same("nearest", "reach *= 2u;", "2u", "3u", FURTHER),
    same("nearest", "if seen > MOST { atomic", ">", ">=", IN_RESERVE),
];
