//! The two sorts.

use motes::kernel::{Backend, Kernel, Machine, Name};
use motes::primitives::{MOST, counting_sort, radix_sort};

use crate::primitives::{MACHINES, agree, awkward, device, random};
use crate::support::machines::alone;
use crate::support::{self, Shared};

const KEYS: Name = Name::Borrowed("cells");
const VALUES: Name = Name::Borrowed("ids");

fn fields() -> counting_sort::Fields {
    counting_sort::Fields { keys: KEYS, starts: "starts".into(), order: "order".into(), largest: "largest".into() }
}

fn counted(elements: u32, bins: u32, machine: &Machine) -> Kernel {
    counting_sort::counting_sort(&fields(), elements, bins, machine).expect("a sort")
}

fn radix(elements: u32, bits: u32, machine: &Machine) -> Kernel {
    radix_sort(&KEYS, &VALUES, elements, bits, machine).expect("a sort")
}

#[test]
fn a_counting_sort_ends_the_race() {
    let shared = support::device();
    for (name, machine) in MACHINES {
        for (elements, bins) in
            [(0, 0), (0, 5), (1, 1), (2, 1), (63, 9), (64, 0), (65, 64), (2000, 1), (8193, 8191), (65_537, 30_011)]
        {
            let kernel = counted(elements, bins, &machine);
            let mut gpu = device(&shared, machine);
            let n = elements as usize;
            // Some lie beyond the last bin.
            let spread = random(n, 3).iter().map(|key| key % (bins + bins / 8 + 2)).collect();
            let rising = (0..elements).map(|i| i * bins / elements).collect();
            let falling = (0..elements).rev().map(|i| i * bins / elements).collect();
            for (case, keys) in [("spread", spread), ("rising", rising), ("falling", falling)] as [(_, Vec<u32>); 3] {
                let of = format!("{name}, {elements} {case} in {bins} bins");
                let before = [0xffff_ffff];
                assert!(agree(&mut gpu, &kernel, &[("cells", &keys), ("largest", &before)], &of), "{of}");
            }
        }
    }
}

/// All in one bin, at most as many as may be, or one more: that is reported, and no key is lost.
#[test]
fn a_bin_that_is_too_full_is_reported() {
    let shared = support::device();
    let elements = counting_sort::LARGEST + 1;
    let machine = MACHINES[1].1;
    let mut gpu = device(&shared, machine);
    let program = gpu.compile(&alone(counted(elements, 3, &machine))).expect("a program");
    gpu.write_bytes("cells", 0, bytemuck::cast_slice(&vec![1u32; elements as usize])).expect("keys");
    gpu.run(&program, 1).expect("a run");
    let mut read = |name: &str, words: u32| {
        let bytes = pollster::block_on(gpu.bytes(name, 0, 4 * u64::from(words))).expect("a field");
        bytemuck::pod_collect_to_vec::<u8, u32>(&bytes)
    };
    assert_eq!(read("largest", 1), [elements], "the fullest bin");
    assert_eq!(read("starts", 4), [0, 0, elements, elements]);
    let mut order = read("order", elements);
    order.sort_unstable();
    assert!(order.iter().copied().eq(0..elements), "not every key is there once");
}

#[test]
fn the_fullest_bin_that_may_be_still_ascends() {
    let shared = support::device();
    let elements = counting_sort::LARGEST;
    for (name, machine) in MACHINES {
        let keys = vec![1; elements as usize];
        assert!(agree(&mut device(&shared, machine), &counted(elements, 3, &machine), &[("cells", &keys)], name));
    }
}

fn sorted(shared: &Shared, (name, machine): (&str, Machine), elements: u32, bits: u32, cases: &[(&str, Vec<u32>)]) {
    let kernel = radix(elements, bits, &machine);
    let mut gpu = device(shared, machine);
    for (case, keys) in cases {
        let of = format!("{name}, {elements} {case} by {bits} bits");
        // Payloads in no order: equal keys must keep theirs.
        agree(&mut gpu, &kernel, &[("cells", keys), ("ids", &random(elements as usize, 23))], &of);
    }
}

#[test]
fn a_radix_sort_is_stable_at_every_seam() {
    let shared = support::device();
    for machine in MACHINES {
        for elements in [0, 1, 2, 255, 256, 257, 1023, 1024, 1025, 2047, 2048, 2049, 10_000, 65_537] {
            sorted(&shared, machine, elements, 32, &awkward(elements as usize));
        }
    }
}

/// Every number of bits, and so every number of moves to and fro; what stands above the bits does not count.
#[test]
fn a_radix_sort_looks_at_its_bits_alone() {
    let shared = support::device();
    for machine in MACHINES {
        for bits in (0..=32).chain([4, 12]) {
            let words = random(3000, u64::from(bits));
            sorted(&shared, machine, 3000, bits, &[("random", words)]);
        }
    }
}

/// Blocks of several tiles, tables of several blocks.
#[test]
fn a_radix_sort_of_many() {
    let shared = support::device();
    let slow = Machine { software: false, subgroup: 0, invocations: 256, ..Machine::HOST };
    for machine in [MACHINES[1], ("gpu in long blocks", slow), MACHINES[0]] {
        for elements in [(1 << 17) - 1, 200_001] {
            sorted(&shared, machine, elements, 20, &[("random", random(elements as usize, 2))]);
        }
    }
}

/// More than 2²⁴, the integers of an f32, and as many as the device binds; by the variant for software adapters, which takes
/// a tenth of the time on lavapipe. `cargo test --test engine -- --ignored most`
#[test]
#[ignore = "gigabytes, and minutes"]
fn sorts_of_the_most_that_a_device_binds() {
    let shared = support::device();
    let binds = shared.found.device.limits().max_storage_buffer_binding_size / 4;
    // Sentinels want their room too.
    let most = u32::try_from(binds).unwrap_or(MOST).min(MOST) - 32;
    let (name, machine) = MACHINES[1];
    for elements in [(1 << 24) + 1, most] {
        println!("{elements} elements");
        let keys = random(elements as usize, 4);
        sorted(&shared, (name, machine), elements, 27, &[("random", keys.clone())]);
        let bins = 1 << 22;
        let keys: Vec<u32> = keys.iter().map(|key| key % bins).collect();
        assert!(agree(&mut device(&shared, machine), &counted(elements, bins, &machine), &[("cells", &keys)], name));
    }
}

/// What no device here binds can still be planned: no loop is too long, no table too large.
#[test]
fn plans_for_the_most_stay_within_the_limits() {
    for (name, machine) in MACHINES.into_iter().chain([("wide", Machine { invocations: 1 << 30, ..MACHINES[0].1 })]) {
        for elements in [0, 1, 1 << 20, (1 << 26) + 1, MOST] {
            let kernel = radix(elements, 32, &machine);
            // Four moves of a count, a scan of one pass or three, and a scatter.
            assert!([12, 20].contains(&kernel.passes.len()), "{name}, {elements}: {} passes", kernel.passes.len());
            let table = kernel.size("cells_table").expect("a table");
            let blocks = table / 256;
            let block = u64::from(elements).div_ceil(blocks);
            // A software adapter's invocation goes through a block, and through its digits before; a workgroup shares its own,
            // in tiles of 1024 with about eighty turns in each.
            let turns = if machine.software { block + 256 } else { block.div_ceil(256) + block.div_ceil(1024) * 80 };
            assert!(turns < 65_535, "{name}, {elements}: {turns} turns");
            // A quarter of the keys at most, which fits where they do.
            assert!(table <= (u64::from(elements) / 4 + 256).max(1 << 19), "{name}, {elements}: a table of {table}");
        }
        assert!(radix_sort(&KEYS, &VALUES, MOST + 1, 32, &machine).is_err());
        assert!(radix_sort(&KEYS, &VALUES, 5, 33, &machine).is_err());
        assert!(counting_sort::counting_sort(&fields(), MOST + 1, 5, &machine).is_err());
        assert!(counting_sort::counting_sort(&fields(), 5, MOST, &machine).is_err());
    }
}
