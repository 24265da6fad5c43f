//! Reductions and histograms.

use motes::kernel::{Array, Backend, Kernel, Machine, Name};
use motes::primitives::{Items, MOST, Operation, histogram, reduce};

use crate::primitives::{MACHINES, agree, awkward, device, random};
use crate::support::machines::alone;
use crate::support::{self};

const OPERATIONS: [Operation; 3] = [Operation::Sum, Operation::Min, Operation::Max];
/// Around a workgroup, a tree's levels, and the blocks of both variants.
const SIZES: [u32; 14] = [0, 1, 2, 3, 255, 256, 257, 4095, 4096, 4097, 32_767, 32_769, 65_537, 300_000];

fn reduction(operation: Operation, items: Items, elements: u32, machine: &Machine) -> Kernel {
    let (field, into) = (Name::Borrowed("masses"), Name::Borrowed("total"));
    reduce(operation, items, &field, &into, elements, machine).expect("a reduction")
}

/// Floats in (−1, 1), by their bits; four for each vector.
fn floats(vectors: u32, seed: u64) -> Vec<u32> {
    let mut random = support::Random::new(seed);
    (0..4 * vectors).map(|_| random.narrow().to_bits()).collect()
}

#[test]
fn whole_numbers_reduce_exactly() {
    let shared = support::device();
    for (name, machine) in MACHINES {
        for elements in SIZES {
            for operation in OPERATIONS {
                let kernel = reduction(operation, Items::Uint, elements, &machine);
                let mut gpu = device(&shared, machine);
                for (case, mut words) in awkward(elements as usize) {
                    // The one that counts is at the end, where a cut would lose it.
                    if case == "equal" && elements > 1 {
                        words[elements as usize - 1] = if operation == Operation::Min { 2 } else { 9 };
                    }
                    let of = format!("{operation:?}, {name}, {elements} {case}");
                    let inputs = [("masses", words.as_slice()), ("total", &[123])];
                    assert!(agree(&mut gpu, &kernel, &inputs, &of), "{of}");
                }
            }
        }
    }
}

#[test]
fn vectors_reduce_the_same_on_every_run() {
    let shared = support::device();
    for (name, machine) in MACHINES {
        for elements in SIZES {
            for operation in OPERATIONS {
                let of = format!("{operation:?}, {name}, {elements}");
                let kernel = reduction(operation, Items::Vec4, elements, &machine);
                let mut gpu = device(&shared, machine);
                let (words, mut results) = (floats(elements, 3), Vec::new());
                for _ in 0..2 {
                    let before = [2.5f32.to_bits(); 4];
                    if elements > 0 {
                        agree(&mut gpu, &kernel, &[("masses", &words), ("total", &before)], &of);
                    } else {
                        let program = gpu.compile(&alone(kernel.clone())).expect("a program");
                        gpu.run(&program, 1).expect("a run");
                    }
                    results.push(pollster::block_on(gpu.bytes("total", 0, 16)).expect("a vector"));
                }
                assert_eq!(results[0], results[1], "{of}: not the same bits");
                // Of nothing, what changes nothing.
                let neutral = [0.0, f32::INFINITY, f32::NEG_INFINITY][operation as usize].to_le_bytes().repeat(4);
                assert_eq!(results[0] == neutral, elements == 0, "{of}");
            }
        }
    }
}

#[test]
fn what_is_not_a_number_stays_so_and_infinities_count() {
    let shared = support::device();
    for (name, machine) in MACHINES {
        for operation in OPERATIONS {
            let kernel = reduction(operation, Items::Vec4, 70_000, &machine);
            for place in [0, 4, 255 * 4, 4 * 69_999] {
                let mut gpu = device(&shared, machine);
                let program = gpu.compile(&alone(kernel.clone())).expect("a program");
                let mut words = floats(70_000, 5);
                words[place] = 0xffc0_0001;
                words[place + 1] = f32::INFINITY.to_bits();
                words[place + 2] = f32::NEG_INFINITY.to_bits();
                gpu.write_bytes("masses", 0, bytemuck::cast_slice(&words)).expect("vectors");
                gpu.run(&program, 1).expect("a run");
                let read = pollster::block_on(gpu.read("total", &Array::Vec4(Vec::new()), 1)).expect("a vector");
                let Array::Vec4(read) = read else { panic!("no vector: {read:?}") };
                let of = format!("{operation:?}, {name}, {place}: {read:?}");
                assert!(read[0].x.is_nan() && read[0].w.is_finite(), "{of}");
                let infinite = read[0].y.is_infinite() == (operation != Operation::Min)
                    && read[0].z.is_infinite() == (operation != Operation::Max);
                assert!(infinite, "{of}");
            }
        }
    }
}

#[test]
fn a_histogram_counts_every_key_once() {
    let shared = support::device();
    for (name, machine) in MACHINES {
        // Around what a workgroup's memory holds, and more.
        for bins in [0, 1, 2, 255, 2047, 2048, 2049, 70_000] {
            for elements in [0, 1, 63, 65, 8191, 8192, 8193, 65_537] {
                let (keys, counts) = (Name::Borrowed("cells"), Name::Borrowed("members"));
                let kernel = histogram(&keys, &counts, elements, bins, &machine).expect("a histogram");
                let mut gpu = device(&shared, machine);
                let spread: Vec<u32> =
                    random(elements as usize, 7).iter().map(|key| key % (bins + bins / 8 + 2)).collect();
                for (case, words) in [
                    ("spread", spread),
                    ("single", vec![bins / 2; elements as usize]),
                    ("beyond", vec![u32::MAX; elements as usize]),
                ] {
                    let of = format!("{name}, {elements} {case} in {bins}");
                    // What was there before must not count.
                    let before = random(bins as usize + 1, 11);
                    assert!(agree(&mut gpu, &kernel, &[("cells", &words), ("members", &before)], &of), "{of}");
                }
            }
        }
    }
}

#[test]
fn plans_for_the_most_stay_within_the_limits() {
    for (name, machine) in MACHINES {
        for elements in [1, 1 << 20, (1 << 26) + 1, MOST] {
            let kernel = reduction(Operation::Sum, Items::Vec4, elements, &machine);
            // Every invocation takes a 256th of its block; in the last pass of all parts.
            let parts = kernel.size("total_parts").expect("parts");
            let turns = (u64::from(elements).div_ceil(parts)).max(parts).div_ceil(256) + 8;
            assert!(turns < 65_535 && parts <= 65_535, "{name}, {elements}: {turns} turns");
        }
        let (one, two) = (Name::Borrowed("one"), Name::Borrowed("two"));
        assert!(reduce(Operation::Max, Items::Uint, &one, &two, MOST + 1, &machine).is_err());
        assert!(histogram(&one, &two, MOST + 1, 5, &machine).is_err());
        assert!(histogram(&one, &two, 5, MOST, &machine).is_err());
        assert!(histogram(&one, &two, 5, u32::MAX, &machine).is_err());
    }
}
