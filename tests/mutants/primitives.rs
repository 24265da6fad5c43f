//! Stages of the primitives: as few elements as show every loop, block and fold.

use std::sync::Arc;

use motes::kernel::{Backend, Host, Kernel, Machine, Name};
use motes::primitives::{Items, Operation, counting_sort, fill, histogram, radix_sort, reduce, scan};

use crate::stages::{Device, Stage, moving};
use crate::support::machines::alone;

const GPU: Machine = Machine { software: false, subgroup: 0, invocations: 1 << 18, ..Machine::HOST };
const SOFTWARE: Machine = Machine { software: true, subgroup: 0, invocations: 256, ..Machine::HOST };
/// Fields of other names than the shaders give them.
const CELLS: Name = Name::Borrowed("cells");
const IDS: Name = Name::Borrowed("ids");

/// Words over all 32 bits.
fn random(count: u32) -> impl Iterator<Item = u32> {
    let mut state = 0x2545_F491_4F6C_DD1D_u64;
    (0..count).map(move |_| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        u32::try_from(state >> 32).expect("half of the bits")
    })
}

fn stage(device: &Device, kernel: Kernel, inputs: &[(&Name, Vec<u32>)]) -> Stage {
    // A handful of particles, since every simulation has some.
    let mut simulation = moving(device, 2, None);
    let gpu = simulation.backend();
    gpu.compile(&alone(kernel.clone())).expect("a good kernel");
    for (name, words) in inputs {
        gpu.write_bytes(name, 0, bytemuck::cast_slice(words)).expect("a field");
    }
    Stage::new(&kernel.name.clone(), simulation, kernel)
}

/// All of them, on a device of four workgroups in a row.
pub fn all(device: &Device, stages: &mut Vec<Stage>) {
    let words = |count| random(count).collect::<Vec<_>>();
    // Eight workgroups in rows of four, one element short.
    stages.push(stage(device, fill(&CELLS, 2047, 0x1234_5678).expect("a fill"), &[(&CELLS, words(2047))]));
    // Alone, three tiles or one invocation; five tiles in rows of three, one too many; seventy chunks in two workgroups.
    for (elements, machine) in [(5000, GPU), (500, SOFTWARE), (5 * 2048, GPU), (70 * 1024, SOFTWARE)] {
        let kernel = scan::scan(&CELLS, elements, &machine).expect("a scan");
        stages.push(stage(device, kernel, &[(&CELLS, words(elements))]));
    }
    reductions(device, stages);
    // Eight workgroups; five blocks in six workgroups. Some keys lie beyond the last bin, and some are alone in theirs.
    for (elements, bins, machine) in [(511, 40, SOFTWARE), (35_000, 300, GPU)] {
        let kernel = histogram(&CELLS, &IDS, elements, bins, &machine).expect("a histogram");
        let mut keys: Vec<u32> = random(elements).map(|key| key % (bins - 9)).collect();
        (0..12).for_each(|i| keys[40 * i as usize] = bins - 9 + i);
        stages.push(stage(device, kernel, &[(&CELLS, keys), (&IDS, words(bins + 1))]));
    }
    sorts(device, stages);
}

fn reductions(device: &Device, stages: &mut Vec<Stage>) {
    // Five blocks in six workgroups.
    let count = 5 * 4096;
    for operation in [Operation::Sum, Operation::Min, Operation::Max] {
        let kernel = |items, count| reduce(operation, items, &CELLS, &IDS, count, &GPU).expect("a reduction");
        // Not near the ends of what there is, so that what changes nothing is seen to do so.
        let words = random(count).map(|word| (word >> 2) + (1 << 29)).collect();
        stages.push(stage(device, kernel(Items::Uint, count), &[(&CELLS, words)]));
        stages.push(stage(device, kernel(Items::Uint, 0), &[(&IDS, vec![123])]));
        // What is not a number stays so, on either side; and only that.
        let mut floats: Vec<f32> = random(4 * 5000).map(|word| f32::from_bits(0x3f80_0000 | word >> 9)).collect();
        floats[4 * 77] = f32::NAN;
        floats[4 * 2000 + 1] = f32::from_bits(0xff80_0001);
        let infinite = if operation == Operation::Min { f32::INFINITY } else { f32::NEG_INFINITY };
        (0..5000).for_each(|i| floats[4 * i + 2] = infinite);
        let w = floats.iter().skip(3).step_by(4).copied();
        let w = match operation {
            Operation::Sum => continue,
            Operation::Min => w.fold(f32::INFINITY, f32::min),
            Operation::Max => w.fold(f32::NEG_INFINITY, f32::max),
        };
        let bits = floats.iter().map(|x| x.to_bits()).collect();
        let stage = stage(device, kernel(Items::Vec4, 5000), &[(&CELLS, bits)]);
        stages.push(stage.expected("ids", vec![f32::NAN, f32::NAN, infinite, w]));
    }
}

fn sorts(device: &Device, stages: &mut Vec<Stage>) {
    let (elements, bins) = (511, 40);
    let fields = counting_sort::Fields {
        keys: CELLS,
        starts: "starts".into(),
        order: "order".into(),
        largest: "largest".into(),
    };
    let keys: Vec<u32> = random(elements).map(|key| key % (bins + 5)).collect();
    let whole = counting_sort::counting_sort(&fields, elements, bins, &GPU).expect("a sort");
    stages.push(stage(device, whole.clone(), &[(&CELLS, keys.clone()), (&fields.largest, vec![1 << 30])]));

    // Each particle alone in a bin.
    let alone = counting_sort::counting_sort(&fields, 3, bins, &GPU).expect("a sort");
    stages.push(stage(device, alone, &[(&CELLS, vec![5, 3, 2])]));

    // The race may be over in order by chance: here it was not. In the second case the fullest bin is too full.
    let bin = |id: u32| keys[id as usize].min(bins);
    let mut arrivals: Vec<u32> = (0..elements).rev().collect();
    arrivals.sort_by_key(|id| bin(*id));
    let starts: Vec<u32> =
        (0..=bins).map(|b| u32::try_from((0..elements).filter(|id| bin(*id) < b).count()).expect("few")).collect();
    let fullest = (0..=bins).map(|b| (0..elements).filter(|id| bin(*id) == b).count()).max().expect("bins");
    for most in [fullest, fullest - 1] {
        let mut settle = whole.clone();
        settle.passes.retain(|pass| pass.shader.reflection().entry == "sort_settle");
        settle.passes[0].constants = vec![("LARGEST", most as f64)];
        settle.scratch.clear();
        settle.reference = Some(Arc::new(move |host: &Host| {
            let (keys, arrivals) = (host.reading::<u32>("cells")?, host.reading::<u32>("order_arrivals")?);
            let mut order = host.writing::<u32>("order")?;
            order.copy_from_slice(&arrivals);
            let bin = |id: &u32| keys[*id as usize].min(bins);
            for bin in order.chunk_by_mut(|a, b| bin(a) == bin(b)).filter(|bin| bin.len() <= most) {
                bin.sort_unstable();
            }
            host.writing::<u32>("largest")?[0] = u32::try_from(fullest).expect("few");
            Ok(())
        }));
        let inputs = [(&CELLS, keys.clone()), (&fields.starts, starts.clone())];
        let behind: Name = "order_arrivals".into();
        let inputs = [inputs.to_vec(), vec![(&behind, arrivals.clone()), (&fields.largest, vec![3])]].concat();
        stages.push(stage(device, settle, &inputs));
    }

    // A copy, and a move by six bits. Then by eight and by four: five blocks in six workgroups; three blocks of two tiles,
    // the last not full; ten chunks in two workgroups.
    let few = Machine { invocations: 512, ..GPU };
    for (elements, bits, machine) in [(511, 6, GPU), (5 * 1024, 12, GPU), (5000, 12, few), (20_000, 12, SOFTWARE)] {
        let kernel = radix_sort(&CELLS, &IDS, elements, bits, &machine).expect("a sort");
        stages.push(stage(device, kernel, &[(&CELLS, random(elements).collect()), (&IDS, (0..elements).collect())]));
    }
}
