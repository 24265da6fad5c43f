//! Orders of convergence as slopes, under every integrator.

use glam::{DVec3, DVec4};
use motes::integrators::{Entry, INTEGRATORS};
use motes::kernel::Array;
use motes::settings::Value;

use crate::pairs::{beginning, by_references, column, setup};
use crate::support::columns::{Columned, LEAK};
use crate::support::states::{force, one, word};

const TIME: f64 = 1.3;
const X: DVec3 = DVec3::new(0.7, -0.4, 0.2);
const V: DVec3 = DVec3::new(0.5, 0.3, -0.6);
const ANGLE: DVec3 = DVec3::new(0.4, -0.3, 0.9);
const SPIN: DVec3 = DVec3::new(-0.2, 0.8, 0.5);
const START: f64 = 1.3;

/// How far each column is from its solution in the end: charge, angle and spin, dose, tracer. The particle swings about 0.
fn errors(name: &str, steps: u32) -> [f64; 4] {
    let harmonic = force("attractor", &[("profile", word("harmonic")), ("strength", Value::Number(1.0))]);
    let start = [
        ("charge", Array::Float(vec![START])),
        ("angle", Array::Vec3(vec![ANGLE])),
        ("dose", Array::Float(vec![START])),
        ("spin", Array::Vec3(vec![SPIN])),
        ("tracer", Array::Float(vec![START])),
    ];
    let state = beginning(&one(X, V), &start);
    let setup = setup(&state, vec![Box::new(Columned), harmonic], name, TIME / f64::from(steps));
    let mut simulation = by_references(&setup);
    simulation.step(steps).expect("steps");
    let mut get = |name| match column(&mut simulation, name) {
        Array::Float(all) => DVec4::X * all[0],
        Array::Vec4(all) => all[0],
        other => panic!("{other:?}"),
    };
    let (sin, cos) = TIME.sin_cos();
    let swings = |x: DVec3, v: DVec3| (x * cos + v * sin, v * cos - x * sin);
    let ((angle, spin), x) = (swings(ANGLE, SPIN), swings(X, V).0.x);
    let dose = START + X.x * sin + V.x * (1.0 - cos);
    [
        (get("charge").x - START * (-LEAK * TIME).exp()).abs(),
        (get("angle").truncate() - angle).length() + (get("spin").truncate() - spin).length(),
        (get("angle").w - dose).abs(),
        (get("tracer").x - (START + x.sin() - X.x.sin())).abs(),
    ]
}

/// The orders of the four. A rate that depends on what a kick changes has that of forces that depend on velocity; a straight
/// way in the middle of which a rate is computed is of order 2; and implicit methods advance columns explicitly.
fn orders(entry: &Entry) -> [u32; 4] {
    let its = entry.by_default();
    let (order, with_velocity) = (its.order(), its.order_with_velocity());
    if its.is_implicit() {
        return [1, 1, order, order];
    }
    let staged = with_velocity > 1;
    [with_velocity, order, order, if staged { order } else { order.min(2) }]
}

#[test]
fn every_integrator_has_its_order() {
    for entry in INTEGRATORS.iter().filter(|entry| entry.by_default().advances_columns()) {
        let orders = orders(entry);
        for (place, what) in ["charge", "angle", "dose", "tracer"].into_iter().enumerate() {
            let order = orders[place];
            // So many that the next order bends the slope by less than a fifth, so few that rounding does not.
            let steps = [0, 512, 128, 64, 32][order as usize];
            let [coarse, fine] = [steps, 2 * steps].map(|steps| errors(entry.name, steps)[place]);
            let slope = (coarse / fine).log2();
            let name = format!("{what} under {}: {coarse:e}, {fine:e}", entry.name);
            assert!((slope - f64::from(order)).abs() < 0.2, "{name}: slope {slope:.3} is not {order}");
            assert!(fine > 1e-12, "{name} is rounding, which has no order");
        }
    }
}
