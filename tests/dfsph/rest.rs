//! Columns at rest.

use glam::Vec4;
use motes::fluids::PRESSURE;
use motes::{POSITION, VELOCITY};

use crate::{DENSITY, SPACING, Tank, WEIGHT, support};

#[test]
fn a_column_at_rest_stays_and_weighs() {
    let shared = support::device();
    for (numbers, flat) in [([8, 20], true), ([6, 10], false)] {
        let tank = Tank::new(numbers, flat, 0.0);
        let height = tank.layers as f64 * SPACING;
        let fastest = (2.0 * WEIGHT * height).sqrt();
        // Sound of ten times that, and a quarter of the smoothing length over it.
        let weakly = 0.25 * SPACING / (10.0 * fastest);
        for times in [10.0] {
            let dt = times * weakly;
            let mut simulation = tank.simulation(&shared, &[("viscosity", motes::settings::Value::Number(std::env::var("VISC").unwrap().parse().unwrap()))], dt);
            let steps = (4.0 * (height / WEIGHT).sqrt() / dt) as u32;
            simulation.step(steps).expect("steps");
            let solves = pollster::block_on(simulation.pressure_solves()).expect("read");
            let read = |v: Vec<Vec4>| v[tank.walls()..].iter().map(|v| v.truncate().as_dvec3()).collect::<Vec<_>>();
            let x = read(pollster::block_on(simulation.read(POSITION)).expect("read"));
            let v = read(pollster::block_on(simulation.read(VELOCITY)).expect("read"));
            let p = pollster::block_on(simulation.read(PRESSURE)).expect("read");
            let p: Vec<f64> = p[tank.walls()..].iter().map(|p| f64::from(*p)).collect();
            let top = x.iter().map(|x| x.dot(tank.up)).fold(0.0, f64::max) + 0.5 * SPACING;
            let speed = v.iter().map(|v| v.length()).fold(0.0, f64::max);
            let mean = x.iter().zip(&p).map(|(x, p)| (p / DENSITY / WEIGHT - (top - x.dot(tank.up))).abs()).sum::<f64>() / x.len() as f64 / height;
            println!("flat {flat} dt {dt} steps {steps} sink {} speed {} pressure {mean}", (top + 0.5*SPACING-height)/SPACING, speed/fastest);
            let s = solves.unwrap(); println!("div {} {} {:.1e} dens {} {} fail {} {:.1e}", s[0].all_iterations as f64/steps as f64, s[0].most_iterations, s[0].error, s[1].all_iterations as f64/steps as f64, s[1].most_iterations, s[1].failures, s[1].error);
            for k in 0..tank.layers {
                let wide = x.len() / tank.layers;
                let (m, z) = (p[k * wide..][..wide].iter().sum::<f64>() / wide as f64, x[k * wide].dot(tank.up));
                if k % 3 == 0 {println!("   {:.3} {:.4} {:.4}", z / SPACING, m / DENSITY / WEIGHT / SPACING, (top - z) / SPACING);}
            }
        }
    }
}
