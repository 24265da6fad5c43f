//! How fast they are here: `cargo test --release --test engine -- --ignored --nocapture speed`

use std::time::Instant;

use motes::Gpu;
use motes::kernel::{Backend, Kernel, Machine, Name};
use motes::primitives::{Items, Operation, counting_sort, histogram, radix_sort, reduce, scan};

use crate::primitives::{MACHINES, device, random};
use crate::support::{self, Shared, machines::alone};

const MILLION: u32 = 1 << 20;

/// Seconds of one run, the best of some, each from the same inputs.
fn seconds(gpu: &mut Gpu, kernel: &Kernel, inputs: &[(&str, &[u32])]) -> f64 {
    let program = gpu.compile(&alone(kernel.clone())).expect("a program");
    let mut best = f64::INFINITY;
    for _ in 0..9 {
        for (name, words) in inputs {
            gpu.write_bytes(name, 0, bytemuck::cast_slice(words)).expect("a field");
        }
        // A read waits for all that was written.
        pollster::block_on(gpu.bytes(inputs[0].0, 0, 4)).expect("a word");
        let start = Instant::now();
        gpu.run(&program, 1).expect("a run");
        gpu.wait().expect("an end");
        best = best.min(start.elapsed().as_secs_f64());
    }
    best
}

fn report(shared: &Shared, what: &str, elements: u32, make: impl Fn(&Machine) -> Kernel, inputs: &[(&str, &[u32])]) {
    for (name, machine) in MACHINES {
        let took = seconds(&mut device(shared, machine), &make(&machine), inputs);
        println!("{what}, {name}: {elements} in {:.2} ms, {:.1} M/s", took * 1e3, f64::from(elements) / took * 1e-6);
    }
}

#[test]
#[ignore = "a measurement"]
fn speed() {
    let shared = support::device();
    println!("{}", shared.found.describe());
    for elements in [1024, 8192, 1 << 16, MILLION, 4 * MILLION] {
        let words = random(elements as usize, 1);
        let make = |machine: &Machine| scan::scan(&"items".into(), elements, machine).expect("a scan");
        report(&shared, "scan", elements, make, &[("items", &words)]);
    }
    let words = random(4 * MILLION as usize, 1);
    let (keys, ids) = (Name::Borrowed("keys"), Name::Borrowed("ids"));
    let make = |m: &Machine| reduce(Operation::Sum, Items::Vec4, &keys, &ids, MILLION, m).expect("a reduction");
    let floats: Vec<u32> = words.iter().map(|word| word >> 2).collect();
    report(&shared, "sum of vec4", MILLION, make, &[("keys", &floats)]);
    for bins in [256, 32_768] {
        let keys_below: Vec<u32> = words[..MILLION as usize].iter().map(|word| word % bins).collect();
        let make = |m: &Machine| histogram(&keys, &ids, MILLION, bins, m).expect("a histogram");
        report(&shared, &format!("histogram of {bins}"), MILLION, make, &[("keys", &keys_below)]);
        if bins > 256 {
            let name = Name::Borrowed;
            let fields = counting_sort::Fields {
                keys: keys.clone(),
                starts: name("starts"),
                order: name("order"),
                largest: name("largest"),
            };
            let make = |m: &Machine| counting_sort::counting_sort(&fields, MILLION, bins, m).expect("a sort");
            report(&shared, "counting sort into 32768", MILLION, make, &[("keys", &keys_below)]);
        }
    }
    for bits in [32, 24] {
        let make = |m: &Machine| radix_sort(&keys, &ids, MILLION, bits, m).expect("a sort");
        report(&shared, &format!("radix sort by {bits} bits"), MILLION, make, &[("keys", &words[..MILLION as usize])]);
    }
}
