//! Stages of a minimization.

use glam::Vec4;
use motes::forces::{Component, Problem, Stage as Of};
use motes::kernel::{Columns, Kernel, Machine, POSITION, Plan};
use motes::motion::{Held, Hold};
use motes::settings::Value::Number;

use crate::stages::{Device, FEW, Stage, fill, moving};
use crate::support::equivalents::{Equivalent, same};
use crate::support::machines::alone;
use crate::support::states::force;

const ALWAYS_SET: &str = "the host sets every override";

pub const EQUIVALENT: &[Equivalent] = &[
    same("updaters/minimize.wgsl", "override TOLERANCE: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("updaters/minimize.wgsl", "override LONGEST: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same(
        "updaters/minimize.wgsl",
        "const LARGEST: f32",
        "1e37",
        "1.4999999999999999e37",
        "any number near the largest serves",
    ),
    same("updaters/minimize.wgsl", "let downhill = total.y", "<", "<=", "any number near the largest serves"),
    same("minimize/apply.wgsl", "override MOVE: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("minimize/measure.wgsl", "mass > 0.0", ">", ">=", "without mass all parts are 0"),
    same("minimize/apply.wgsl", "if size > 0.0", ">", ">=", "no particle is without velocity and force"),
    same("minimize/apply.wgsl", "if long * size > most", ">", ">=", "at the limit it is the limit either way"),
];

/// A minimization, downhill and uphill, before and after steps grow, at the longest and the shortest, and at rest.
pub fn all(device: &Device, stages: &mut Vec<Stage>) {
    let held = [3, 64, 130].map(|id| Held { id, by: Hold::Fixed });
    for (longest_way, held) in [(0.02, &held[..]), (0.002, &[])] {
        let settings = [("tolerance", Number(0.5)), ("largest_move", Number(longest_way)), ("longest", Number(8.0))];
        let minimize: Box<dyn Component> = force("minimize", &settings);
        let columns = Columns::with(minimize.columns()).expect("columns");
        let problem = Problem::new(u32::try_from(FEW).expect("few"), Machine::HOST)
            .tied(&motes::links::Links::default(), held)
            .of_columns(columns);
        let mut plan = Plan::default();
        for stage in [Of::StartOfStep, Of::AfterKick] {
            minimize.stage(stage, &mut plan, &problem).expect("a stage");
        }
        for kernel in plan.kernels {
            match &*kernel.name {
                _ if kernel.names("minimize_force") => stages.extend(decisions(device, &kernel)),
                "minimize measure" | "minimize apply" | "minimize follow" => {
                    let mut simulation = moving(device, FEW, None);
                    let mut places = pollster::block_on(simulation.read(POSITION)).expect("places");
                    places[13].w = 0.0;
                    simulation.write(POSITION, &places).expect("places");
                    let plan = alone(kernel);
                    fill(&mut simulation, &plan);
                    if plan.kernels[0].name == "minimize apply" {
                        // Squares that are not finite, of each component.
                        let scale = |i: usize| {
                            if (20..23).contains(&i) {
                                Vec4::select(
                                    glam::BVec4A::new(i == 20, i == 21, i == 22, false),
                                    Vec4::splat(1e30),
                                    Vec4::ONE,
                                )
                            } else {
                                Vec4::ONE
                            }
                        };
                        let some: Vec<Vec4> = (0..FEW).map(|i| scale(i) * places[i]).collect();
                        simulation.backend().write_bytes("acceleration", 0, bytemuck::cast_slice(&some)).expect("a");
                    }
                    stages.push(Stage::of("minimize", simulation, plan));
                }
                _ => {}
            }
        }
    }
}

fn decisions(device: &Device, kernel: &Kernel) -> Vec<Stage> {
    // m u · a, m a², F², the length of a step, steps downhill.
    let cases: [([f32; 4], u32); 12] = [
        ([2.0, 5.0, 4.0, 1.5], 7),
        ([2.0, 5.0, 4.0, 1.5], 5),
        ([2.0, 5.0, 4.0, 1.5], 4),
        ([2.0, 5.0, 4.0, 7.75], 9),
        ([-2.0, 5.0, 4.0, 1.5], 9),
        ([0.0, 5.0, 4.0, 1.5], 9),
        ([0.5, 5.0, 4.0, 1.5], 9),
        ([-2.0, 5.0, 4.0, 0.03], 9),
        ([2.0, 2e37, 4.0, 1.5], 9),
        ([2.0, 8e36, 4.0, 1.5], 9),
        ([2.0, 5.0, 0.25, 1.5], 9),
        ([2.0, 5.0, 0.2, 1.5], 9),
    ];
    let made = cases.map(|([power, squares, force, length], downhill)| {
        let mut simulation = moving(device, FEW, None);
        let plan = alone(kernel.clone());
        fill(&mut simulation, &plan);
        let gpu = simulation.backend();
        let mut put = |name: &str, words: &[f32]| gpu.write_bytes(name, 0, bytemuck::cast_slice(words)).expect(name);
        put("minimize_total", &[3.0, power, squares, 0.0]);
        put("minimize_largest", &[0.0, 0.0, 0.0, force]);
        put("minimize_length", &[length]);
        put("minimize_mixing", &[0.0625]);
        put("minimize_downhill", &[f32::from_bits(downhill)]);
        Stage::of("minimize", simulation, plan)
    });
    made.into()
}
