//! The dam break of motes in salva (DFSPH, all cores): reads where the fluid and its walls are, takes some steps, and says how
//! long they took.
//!
//! `salva-dam-break FLUID.csv WALLS.csv SPACING DT STEPS MAX_DENSITY_ERROR OUT.csv`, where the files have columns x, y and z under a
//! line of names; where the fluid is in the end goes into the last. `compare.py` runs it beside motes.

use std::process::ExitCode;
use std::time::Instant;

use salva3d::LiquidWorld;
use salva3d::math::Vector;
use salva3d::object::interaction_groups::InteractionGroups;
use salva3d::object::{Boundary, Fluid};
use salva3d::solver::{DFSPHSolver, DfsphParameters};

const DENSITY: f32 = 1000.0;
const GRAVITY: [f32; 3] = [0.0, 0.0, -9.81];
/// How far its kernel reaches, in spacings.
const SUPPORT: f32 = 2.0;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments) {
        Ok(line) => {
            println!("{line}");
            ExitCode::SUCCESS
        }
        Err(fault) => {
            eprintln!("error: {fault}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &[String]) -> Result<String, String> {
    let [fluid, walls, numbers @ .., out] = arguments else {
        return Err("say FLUID.csv WALLS.csv SPACING DT STEPS MAX_DENSITY_ERROR OUT.csv".to_owned());
    };
    let numbers: Vec<f32> = numbers
        .iter()
        .map(|text| text.parse().map_err(|_| format!("{text} is no number")))
        .collect::<Result<_, String>>()?;
    let [spacing, dt, steps, error] = &numbers[..] else {
        return Err("say SPACING, DT, STEPS and MAX_DENSITY_ERROR, too".to_owned());
    };
    let mut solver: DFSPHSolver = DFSPHSolver::new();
    solver.set_parameters(DfsphParameters { max_density_error: *error, ..solver.parameters() });
    // The kernel reaches 2 radius factor, and the radius is half of the spacing.
    let mut world = LiquidWorld::new(solver, 0.5 * spacing, SUPPORT, 1.0);
    let groups = InteractionGroups::default();
    let mut fluid = Fluid::new(places(fluid)?, 0.5 * spacing, DENSITY, groups);
    // Salva takes 0.8 of the lattice's volume; the same mass as elsewhere makes the work the same.
    fluid.volumes.fill(spacing.powi(3));
    let count = fluid.num_particles();
    let handle = world.add_fluid(fluid);
    let boundary = Boundary::new(places(walls)?, groups);
    let held = boundary.num_particles();
    let _ = world.add_boundary(boundary);
    let gravity = Vector::from(GRAVITY);
    world.step(*dt, &gravity);
    let start = Instant::now();
    let mut done = 1;
    while (done as f32) < *steps {
        world.step(*dt, &gravity);
        done += 1;
    }
    let seconds = start.elapsed().as_secs_f64();
    let fluid = world.fluids().get(handle).ok_or("the fluid is gone")?;
    let tip = fluid.positions.iter().map(|x| x.x).fold(f32::NEG_INFINITY, f32::max);
    let fastest = fluid.velocities.iter().map(|v| (v.x * v.x + v.y * v.y + v.z * v.z).sqrt()).fold(0.0, f32::max);
    let mut text = String::from("x,y,z\n");
    for x in &fluid.positions {
        text.push_str(&format!("{},{},{}\n", x.x, x.y, x.z));
    }
    std::fs::write(out, text).map_err(|e| format!("{out}: {e}"))?;
    Ok(format!(
        "{{\"program\": \"salva 0.11.0\", \"particles\": {count}, \"walls\": {held}, \"dt\": {dt}, \"steps_timed\": {}, \
         \"seconds\": {seconds}, \"tip\": {tip}, \"fastest\": {fastest}}}",
        done - 1
    ))
}

fn places(file: &str) -> Result<Vec<Vector<f32>>, String> {
    let text = std::fs::read_to_string(file).map_err(|e| format!("{file}: {e}"))?;
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    let column = |name| names.iter().position(|n| *n == name).ok_or(format!("{file} has no column {name}"));
    let columns = [column("x")?, column("y")?, column("z")?];
    lines
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            let cell = |c: usize| cells.get(c).and_then(|t| t.parse().ok()).ok_or(format!("{file}: {line}"));
            Ok(Vector::new(cell(columns[0])?, cell(columns[1])?, cell(columns[2])?))
        })
        .collect()
}
