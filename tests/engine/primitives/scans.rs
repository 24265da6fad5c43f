//! Fill and scan.

use motes::Error;
use motes::kernel::{Machine, Name};
use motes::primitives::{MOST, fill, scan};

use crate::primitives::{MACHINES, agree, awkward, device, random};
use crate::support::{self, Shared};

const ITEMS: Name = Name::Borrowed("items");
const CELLS: Name = Name::Borrowed("cells");

/// Around every seam: a lane's items, a workgroup, a tile or a chunk, what one workgroup does alone, and its double.
const SIZES: [u32; 20] =
    [0, 1, 2, 7, 8, 9, 63, 64, 65, 255, 256, 257, 2047, 2048, 2049, 8192, 8193, 16_384, 65_537, 300_000];

#[test]
fn a_fill_fills_to_the_last_element_and_no_further() {
    let shared = support::device();
    for elements in SIZES {
        for value in [0, 5, u32::MAX] {
            let of = format!("{elements} of {value}");
            let kernel = fill(&CELLS, elements, value).expect("a fill");
            let changed =
                agree(&mut device(&shared, MACHINES[0].1), &kernel, &[("cells", &random(elements as usize, 3))], &of);
            assert_eq!(changed, elements > 0, "{of}");
        }
    }
}

fn scanned(shared: &Shared, elements: u32, inputs: &[(&str, Vec<u32>)]) {
    for (name, machine) in MACHINES {
        // A name of its own: the shader's is only a place for it.
        let kernel = scan::scan(&CELLS, elements, &machine).expect("a scan");
        let mut gpu = device(shared, machine);
        for (case, words) in inputs {
            let of = format!("{name}, {elements} {case}");
            assert_eq!(agree(&mut gpu, &kernel, &[("cells", words)], &of), elements > 0, "{of}");
        }
    }
}

#[test]
fn a_scan_agrees_at_every_seam() {
    let shared = support::device();
    for elements in SIZES {
        scanned(&shared, elements, &awkward(elements as usize));
    }
}

/// So many that the sums of tiles are more than one tile.
#[test]
fn a_scan_carries_from_tile_to_tile() {
    let shared = support::device();
    for elements in [(1 << 22) - 1, (1 << 22) + 1, 5_000_001] {
        scanned(&shared, elements, &[("random", random(elements as usize, 5))]);
    }
}

/// More than 2²⁴, the integers of an f32, and as many as the device binds. Lavapipe binds 128 MiB, 2²⁵ words: what is
/// past 2²⁶ can only be planned there, as below. `cargo test --test engine -- --ignored most`
#[test]
#[ignore = "half a gigabyte, and a minute"]
fn a_scan_of_the_most_that_a_device_binds() {
    let shared = support::device();
    let binds = shared.found.device.limits().max_storage_buffer_binding_size / 4;
    // Sentinels want their room too.
    let most = u32::try_from(binds).unwrap_or(MOST).min(MOST) - 32;
    for elements in [(1 << 24) + 1, most] {
        println!("{elements} elements");
        scanned(&shared, elements, &[("random", random(elements as usize, 9))]);
    }
}

/// What no device here binds can still be planned: no loop is too long, no index too large.
#[test]
fn plans_for_the_most_stay_within_the_limits() {
    for (name, machine) in MACHINES {
        for elements in [0, 1, 1 << 20, (1 << 26) + 1, MOST - 1, MOST] {
            let kernel = scan::scan(&ITEMS, elements, &machine).expect("a scan");
            assert_eq!(kernel.passes.len(), if elements <= 8192 { 1 } else { 3 }, "{name}, {elements}");
            let sums = scan::blocks(elements, &machine);
            let reflection = |pass: usize| kernel.passes[pass].shader.reflection();
            for (place, pass) in kernel.passes.iter().enumerate() {
                // Workgroups fold over two dimensions of 65 535, and invocations are counted in 32 bits.
                assert!(u64::from(pass.threads.count) < 1 << 28, "{name}, {elements}, pass {place}");
            }
            let turns = match (machine.software, kernel.passes.len()) {
                (_, 1) => u64::from(elements),
                (true, _) => sums.max(u64::from(elements).div_ceil(sums)),
                // Five loops of eight turns in each tile of sums.
                (false, _) => sums.div_ceil(u64::from(reflection(1).constant("TILE"))) * 40,
            };
            assert!(turns < 65_535, "{name}, {elements}: {turns} turns of a loop");
        }
        let refused = [scan::scan(&ITEMS, MOST + 1, &machine).err(), fill(&ITEMS, MOST + 1, 0).err()];
        for error in refused {
            assert!(matches!(&error, Some(Error::Limit(text)) if text.contains("134217729")), "{error:?}");
        }
    }
    let unused = Machine { software: false, subgroup: 8, invocations: 1, ..Machine::HOST };
    assert_eq!(scan::blocks(MOST, &unused), 65_536);
}
