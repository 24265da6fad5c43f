//! Every kernel of the built-in scenes, of their pictures, of every force and of every integrator.

use motes::forces::Problem;
use motes::integrators::INTEGRATORS;
use motes::kernel::{Kernel, Machine};
use motes::render::{Exposure, Picture, Scenery, Trail};
use motes::scene::SCENES;
use motes::settings::Value;
use motes::{Bounds, Setup, Side, Solver};

use crate::support::scenes::{setup, small};
use crate::support::{self, choices, fluids, machines, states};

/// Machines that bring about every variant, with and without subgroups.
pub fn machines() -> Vec<(&'static str, Machine)> {
    let machine = |software, subgroup, invocations| {
        let (bindable, workgroups) = (128 << 20, 65_535);
        Machine { software, subgroup, invocations, bindable, workgroups, ..Machine::HOST }
    };
    vec![
        ("software with subgroups of eight", machine(true, 8, 256)),
        ("software without subgroups", machine(true, 0, 256)),
        ("a GPU with subgroups of 32", machine(false, 32, 1 << 18)),
        ("a GPU without subgroups", machine(false, 0, 1 << 18)),
    ]
}

/// Fluids with walls as no built-in scene has them.
pub fn fluids() -> Vec<(&'static str, Setup)> {
    let (count, flat) = (64, true);
    let setup = |settings: &[(&'static str, Value)]| Setup {
        state: fluids::cloud(count, flat, true),
        forces: vec![states::force("fluid", settings)],
        integrator: states::integrator("symplectic_euler"),
        dt: 1e-4,
        bounds: fluids::bounds(count, flat, Side::Open),
        solver: Solver::default(),
    };
    let of = |more: &[(&'static str, Value)]| {
        let same = [("density", Value::Number(fluids::DENSITY)), ("spacing", Value::Number(fluids::SPACING))];
        setup(&[&same[..], more].concat())
    };
    let sound = ("sound_speed", Value::Number(9.0));
    vec![
        ("a fluid by DFSPH", of(&[("solver", states::word("dfsph"))])),
        ("a fluid by continuity", of(&[sound.clone(), ("density_by", states::word("continuity"))])),
        ("a fluid with tension", of(&[sound.clone(), ("tension", Value::Number(0.1))])),
        ("a fluid with XSPH", of(&[sound, ("xsph", Value::Number(0.1))])),
    ]
}

/// Every kernel for a machine, with the name of what it belongs to.
pub fn every(machine: Machine) -> Vec<(String, Kernel)> {
    let mut all = Vec::new();
    let mut add =
        |of: &str, kernels: Vec<Kernel>| all.extend(kernels.into_iter().map(|kernel| (of.to_owned(), kernel)));
    for builtin in SCENES {
        let scene = small(builtin.name);
        let scenery = Scenery::of(&scene.particles);
        let trail = Trail::new(scene.particles.len());
        let picture = Picture::with(&scene.picture, &scene.particles, &[], trail, &scenery).expect("a picture");
        let plans = setup(scene).plans(machine).unwrap_or_else(|error| panic!("{}: {error}", builtin.name));
        add(builtin.name, plans.all().flat_map(|plan| plan.kernels.clone()).collect());
        for plan in [picture.plan(), picture.development(Exposure { knee: 0.1, white: 1.3 })] {
            add(&format!("the picture of {}", builtin.name), plan.expect("a plan").kernels);
        }
    }
    let cloud = support::cloud(100, 7);
    let problem = Problem::new(100, machine)
        .at(cloud.position(), Bounds::default())
        .of_species(cloud.species())
        .tied(&cloud.links, &cloud.held)
        .moved(&[choices::swing()], 0.01);
    for entry in choices::entries() {
        for (name, force) in choices::forces(entry) {
            add(&name, machines::kernels(force.as_ref(), &problem));
        }
    }
    for (name, setup) in fluids() {
        let plans = setup.plans(machine).unwrap_or_else(|error| panic!("{name}: {error}"));
        add(name, plans.all().flat_map(|plan| plan.kernels.clone()).collect());
    }
    for entry in INTEGRATORS {
        let setup = Setup {
            state: support::cloud(100, 7),
            forces: vec![states::force("uniform", &[])],
            integrator: entry.by_default(),
            dt: 0.01,
            bounds: Bounds::default(),
            solver: Solver::default(),
        };
        let plans = setup.plans(machine).expect("plans");
        add(entry.name, plans.all().flat_map(|plan| plan.kernels.clone()).collect());
    }
    assert!(all.len() > 500, "{} kernels are not all", all.len());
    all
}
