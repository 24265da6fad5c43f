//! Keys that a program gives and nothing has: a slip of the pen is an error, as in a scene.

use motes::settings::{Settings, Value};
use motes::{Bounds, Cpu, Error, Setup, Simulation, Solver, State, forces, integrators, shapes};

fn built(force: Box<dyn forces::Component>) -> Result<(), Error> {
    let mut some = State::default();
    some.push(glam::DVec3::X, glam::DVec3::ZERO, 1.0, 0.0);
    let integrator = Box::new(integrators::Leapfrog);
    let (bounds, solver) = (Bounds::default(), Solver::default());
    let setup = Setup { state: some, forces: vec![force], integrator, dt: 0.01, bounds, solver };
    Simulation::on(Cpu::new(1)?, &setup).map(|_| ())
}

#[test]
fn a_key_that_no_force_has_is_an_error_of_the_simulation() {
    for entry in forces::entries() {
        let settings = Settings::defaults(entry.keys).with("softning", Value::Number(0.1));
        let Err(Error::Scene(why)) = built((entry.build)(&settings)) else { panic!("{} takes it", entry.name) };
        assert!(why.contains(&format!("the force `{}` has no key `softning`", entry.name)), "{why}");
        assert!(entry.keys.iter().all(|key| why.contains(key.name)), "{why}");
    }
    let gravity = forces::entry("gravity").expect("gravity");
    let of = |value| built((gravity.build)(&Settings::defaults(gravity.keys).with("softening", value)));
    assert!(of(Value::Number(0.1)).is_ok());
    let Err(Error::Scene(why)) = of(Value::Text("0.1".into())) else { panic!("a text is no softening") };
    assert!(why.contains("a key `softening` of another kind"), "{why}");
}

/// What each shape must be given.
fn needs(shape: &shapes::Shape) -> Settings {
    use motes::settings::Kind;
    let mut settings = Settings::defaults(shape.keys);
    for key in shape.keys.iter().filter(|key| key.default.is_none()) {
        let value = match key.kind {
            Kind::Vector | Kind::Direction => Value::Vector(glam::DVec3::splat(3.0)),
            Kind::Choice(words) => Value::Text(words[0].into()),
            _ => Value::Number(4.0),
        };
        settings = settings.with(key.name, value);
    }
    settings
}

#[test]
fn a_key_that_no_shape_has_is_an_error() {
    let mut asked = 0;
    for shape in shapes::SHAPES {
        let good = needs(shape);
        if (shape.build)(&good).is_err() {
            continue;
        }
        asked += 1;
        let Err(Error::Scene(why)) = (shape.build)(&good.with("sacle", Value::Number(2.0))) else {
            panic!("{} takes it", shape.name)
        };
        assert!(why.contains(&format!("shape `{}` has no key `sacle`", shape.name)), "{why}");
    }
    assert!(asked > 12, "only {asked} shapes were asked");
}
