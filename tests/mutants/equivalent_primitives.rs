//! Mutants of the primitives that no test can notice, because they do the same; each with its reason.

use crate::support::equivalents::{Equivalent, same};

const BY_REFLECTION: &str = "the host reads it by reflection, and any will do";
const ROOMIER: &str = "memory that is not used";
const FIRST_DOES_ALL: &str = "the first in line takes everything, and the others nothing";
const NOTHING_LEFT: &str = "one more turn, with nothing to do";
const ZEROED: &str = "a stranger's workgroup memory starts at zero";
const NOT_READ: &str = "it writes what is never read";
const REST: &str = "the loop behind it does what this one leaves";
/// Lanes of lavapipe run in order up to each barrier.
const CLEARED_BEFORE: &str = "the last column is cleared once more, before its owner counts";

pub const EQUIVALENT: &[Equivalent] = &[
    same("primitives/fill", "const EACH: u32 = 4u;", "4u", "5u", BY_REFLECTION),
    same("primitives/fill", "k < EACH", "<", "<=", "one more row, of the next workgroup's, gets the same value"),
    same("histogram_few", "const BLOCK: u32 = 8192u;", "8192u", "8193u", BY_REFLECTION),
    same("histogram_few", "const MOST: u32 = 2048u;", "2048u", "2049u", BY_REFLECTION),
    same("histogram_few", "atomicStore(&own[bin], 0u)", "<=", "<", ZEROED),
    same("histogram_few", "atomicStore(&own[bin], 0u)", "<=", ">=", ZEROED),
    same("histogram_few", "atomicStore(&own[bin], 0u)", "+=", "-=", ZEROED),
    same("histogram_few", "let end = min(first + BLOCK,", "+", "-", FIRST_DOES_ALL),
    same("histogram_few", "if count > 0u {", ">", ">=", "nothing is added"),
    same("radix_chunk_", "const WORKGROUP: u32 = 8u;", "8u", "9u", BY_REFLECTION),
    // Noticed since `bounded.rs` ends loops: the first in line has more turns than that where it does all.
    same("radix_chunk_scatter", "let end = min(first + extent.block,", "+", "-", FIRST_DOES_ALL).sometimes(),
    same("radix_scatter", "let end = min(first + extent.block,", "+", "-", FIRST_DOES_ALL),
    same("radix_scatter", "start < end; start += TILE", "<", "<=", NOTHING_LEFT),
    same(
        "radix_scatter",
        "var own = 255u;",
        "255u",
        "256u",
        "what is put nowhere may stand in front as well as behind",
    ),
    same("radix_scatter", "if start + at < end {", "<", "<=", "one more key is looked at, and put nowhere"),
    same("radix_scatter", "shift <= 20u;", "20u", "21u", "the next would be 24"),
    same("radix_scatter", "at < TILE; at += WORKGROUP", "<", "<=", "behind the tile stands its last item again"),
    same("radix_tile", "array<u32, 2048>", "2048", "2049", ROOMIER),
    same("_tile", "array<u32, 512>", "512", "513", ROOMIER),
    same("radix_tile", "row < 8u", "<", "<=", CLEARED_BEFORE),
    same("radix_tile", "row < 8u", "8u", "9u", CLEARED_BEFORE),
    same("_tile", "reach < WORKGROUP", "<", "<=", "no element has 256 before it"),
    same("primitives/reduce_", "min(block + extent.block,", "+", "-", FIRST_DOES_ALL),
    same("primitives/", "width > 1u", ">", ">=", NOTHING_LEFT),
    same("primitives/", "if lane < width {", "<", "<=", NOT_READ),
    same("primitives/", "if lane < half {", "<", "<=", NOT_READ),
    same("scan_line", "start < extent.elements", "<", "<=", NOTHING_LEFT),
    same("scan_sums", "if i < extent.elements", "<", "<=", "no element comes behind the last tile"),
    same("scan_tile", "array<u32, 2304>", "2304", "2305", ROOMIER),
    same("scan_tile", "at < TILE; at += WORKGROUP", "<", "<=", "the last gap is not read"),
    same("scan_tile", "var item = 0u;", "0u", "1u", "no element comes behind the last tile"),
    same("scan_tile", "if start + at < extent.elements { item = ", "<", "<=", "no element comes behind the last tile"),
    same("sort_scatter", "if i < extent.elements", "<", "<=", "behind the last rank stands one that leads nowhere"),
    same("sort_settle", "override LARGEST: u32 = 16384u;", "16384u", "16385u", "the host sets every override"),
    same("sort_settle", "at + 8u <= end", "8u", "9u", REST),
    same("sort_settle", "at + 8u <= end", "<=", "<", REST),
];
