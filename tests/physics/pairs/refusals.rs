//! Columns that cannot be advanced as they say are refused, by name.

use motes::kernel::{Column, Columns, Kind, Shape};
use motes::rotation;

fn refused(columns: Vec<Column>, words: &[&str]) {
    let said = Columns::with(columns).err().map(|error| error.to_string()).unwrap_or_default();
    assert!(words.iter().all(|word| said.contains(word)), "{words:?} are not in: {said}");
}

fn of(name: &'static str, kind: Kind) -> Column {
    Column::new(name, kind, "", "")
}

#[test]
fn columns_that_cannot_be_advanced_are_refused() {
    let scalar = |name| of(name, Kind::Scalar);
    refused(vec![scalar("a").with_rate("b")], &["`a` is advanced by `b`, which no component declares"]);
    refused(
        vec![scalar("a").with_rate("b"), of("b", Kind::Vector)],
        &["`a` (scalar) cannot be advanced by `b` (vector)"],
    );
    refused(vec![of("a", Kind::Whole).with_rate("b"), of("b", Kind::Whole)], &["`a` (whole) cannot"]);
    refused(vec![of("a", Kind::Quaternion).with_rate("b"), of("b", Kind::Vector)], &["a quaternion turns by a vector"]);
    refused(vec![scalar("a").derived().with_rate("b"), scalar("b")], &["`a` (scalar) cannot", "the first a state"]);
    refused(vec![scalar("a").with_rate("b"), scalar("b").shaped(Shape::System(1))], &["of one kind and shape"]);
    // Two in a row, and rings.
    let row = vec![scalar("a").with_rate("b"), scalar("b").with_rate("c"), scalar("c")];
    refused(row, &["`a` is advanced by `b`, which a drift advances as well"]);
    refused(vec![scalar("a").with_rate("a")], &["`a` is advanced by `a`, which a drift"]);
    refused(vec![scalar("a").carried("b"), scalar("b")], &["`a` is carried along by `b`, which is a state"]);
    // Places.
    let packed = vec![of("v", Kind::Vector), scalar("a").within("v", 3).with_rate("b"), scalar("b").summed()];
    refused(packed, &["`a` lies in component 3 of `v`, and its rate `b` in component 0 of `b`"]);
    refused(vec![scalar("a").summed().within("velocity", 3)], &["`a` is a sum", "one buffer with `velocity`"]);
    refused(vec![scalar("start_a")], &["`start_a`, and names that begin with `start_` are those of integrators"]);
    // Bodies.
    let mut bodies = rotation::columns();
    bodies[1].rate = None;
    refused(bodies, &["`orientation` is `angular_velocity`", "a torque"]);
    let bodies: Vec<Column> = rotation::columns().into_iter().filter(|column| column.name != "inertia").collect();
    refused(bodies, &["`orientation` has its moments of inertia in `inertia`"]);
    let mut bodies = rotation::columns();
    bodies[3] = bodies[3].clone().within("angular_velocity", 0);
    refused(bodies, &["`inertia` belongs to a rigid body, and needs its own buffer"]);
    assert!(Columns::with(rotation::columns()).is_ok());
}
