//! Stages of the alarm: numbers that are none, and speeds that run away.

use motes::kernel::{ACCELERATION, ALARM, Backend, Kernel, Machine, POSITION, QUIET, VELOCITY, World};

use crate::stages::{Device, FEW, Stage, moving, put};

/// The kernel of a stage that is there already: every plan has one.
fn known(name: &str, stages: &[Stage]) -> Kernel {
    let stage = stages.iter().find(|s| s.name == name).unwrap_or_else(|| panic!("every plan has a {name}"));
    stage.plan.kernels[0].clone()
}

/// The watch of machines of both kinds: where invocations run one after another, and where workgroups run at once.
fn on_both(device: &Device) -> [(&'static str, Kernel); 2] {
    let watch = |name, software| {
        let simulation = moving(device, FEW, Some(Machine { software, ..Machine::HOST }));
        let found = simulation.step_plan().0.kernels.iter().find(|kernel| kernel.name == "watch").cloned();
        (name, found.expect("every step has a watch"))
    };
    [watch("each", true), watch("workgroup", false)]
}

/// What the watch must distinguish: which field, which particle, what was seen before.
pub fn watches(device: &Device, stages: &mut Vec<Stage>) {
    let odd = f32::from_bits(0x7fc0_0001);
    let none = [u32::MAX; 2];
    let cases = [
        (POSITION, 3, 0, odd, none),
        (VELOCITY, 3, 1, f32::NEG_INFINITY, none),
        (ACCELERATION, FEW - 1, 3, f32::NAN, none),
        // After fewer steps another was found: it stays. After as many: the lower id. After more: this one.
        (POSITION, 3, 2, f32::INFINITY, [1, 50]),
        (POSITION, 3, 2, f32::INFINITY, [4, 490]),
        (POSITION, 3, 2, f32::INFINITY, [9, 490]),
    ];
    for (visit, watch) in on_both(device) {
        for (case, (field, id, place, bad, alarm)) in cases.into_iter().enumerate() {
            let mut simulation = moving(device, FEW, None);
            let mut values = pollster::block_on(simulation.read(field)).expect("a field");
            values[id][place] = bad;
            put(&mut simulation, field, &values);
            put(&mut simulation, ALARM, &alarm);
            stages.push(Stage::new(&format!("watch {visit} {case}"), simulation, watch.clone()));
        }
        // At rest the largest speed is 0: nothing of earlier workgroups remains, and what is not finite has none.
        let mut simulation = moving(device, FEW, None);
        let mut v = vec![glam::Vec4::ZERO; FEW];
        v[3].y = odd;
        put(&mut simulation, VELOCITY, &v);
        put(&mut simulation, ALARM, &words([u32::MAX; 2], [0.0, 0.0], 0));
        stages.push(Stage::new(&format!("watch {visit} at rest"), simulation, watch.clone()));
    }
}

/// The words about speeds: the first runaway's step and id, the maximum speed now and before, and the count of doublings.
fn words([step, id]: [u32; 2], [now, before]: [f32; 2], doubled: u32) -> [u32; QUIET.len()] {
    let mut alarm = QUIET;
    alarm[3..8].copy_from_slice(&[step, id, now.to_bits(), before.to_bits(), doubled]);
    alarm
}

/// What distinguishes a runaway from speeds that are merely high, or merely growing.
pub fn runaways(device: &Device, stages: &mut Vec<Stage>) {
    let (watches, tick) = (on_both(device), known("tick", stages));
    let speed = |v: &glam::Vec4| v.truncate().abs().max_element();
    // Along each axis 377 is the fastest, by far.
    for axis in 0..3 {
        let mut simulation = moving(device, FEW, None);
        let mut v = pollster::block_on(simulation.read(VELOCITY)).expect("velocities");
        v[377][axis] = -25.7 - 0.1 * f32::from(u8::try_from(axis).expect("few"));
        let most = v.iter().map(speed).fold(0.0, f32::max);
        assert!(most < 27.0 && v.iter().filter(|v| speed(v) > 0.8 * most).count() == 1, "377 is by far the fastest");
        let none = [u32::MAX; 2];
        let cases = [
            words(none, [0.0, most / 2.5], 7),
            words(none, [0.0, most / 2.0], 7),
            words(none, [0.0, most / 2.5], 6),
            words(none, [0.0, 2.0 * most], 9),
            words(none, [1.5 * most, 0.1 * most], 8),
            words([1, 50], [0.0, most / 2.5], 7),
            words([4, 490], [0.0, most / 2.5], 7),
            words([9, 490], [0.0, most / 2.5], 7),
        ];
        for (case, alarm) in cases.into_iter().enumerate() {
            for (visit, watch) in &watches {
                let mut simulation = moving(device, FEW, None);
                put(&mut simulation, VELOCITY, &v);
                put(&mut simulation, ALARM, &alarm);
                stages.push(Stage::new(&format!("runaway {visit} {axis} {case}"), simulation, watch.clone()));
            }
        }
    }
    for (case, [now, before]) in [[3.1, 1.3], [2.6, 1.3], [1.2, 1.3], [0.7, 0.0]].into_iter().enumerate() {
        for step in [14, 15, 16] {
            let mut simulation = moving(device, FEW, None);
            let clock = pollster::block_on(simulation.backend().world()).expect("a clock");
            simulation.backend().set_world(World { step, ..clock }).expect("a clock");
            put(&mut simulation, ALARM, &words([5, 6], [now, before], 4));
            stages.push(Stage::new(&format!("tick {case} {step}"), simulation, tick.clone()));
        }
    }
}
