//! The front of a breaking dam beside two digitisations of what Koshizuka & Oka (1996) measured.
//!
//! `cargo run --release --example dam_break` runs the scene `dam_break_2d` at two resolutions, prints how far it is from each
//! point, and writes `scenes/pictures/dam_break_front.svg`; `--output FILE` writes elsewhere, `--spacing D` takes another spacing
//! for the finer one.

use std::error::Error;
use std::path::PathBuf;

use motes::scene::{Options, Scene, Source};
use motes::{Gpu, POSITION, Setup, Simulation, gpu};
use plotters::prelude::*;

/// The points, with where they come from.
const MEASURED: &str = include_str!("../tests/walls/koshizuka_oka_1996.csv");
/// √(2 g / L) of the scene, where L is 1 m: T is so many times t.
const RATE: f64 = 4.429_446_918;
const INK: RGBColor = RGBColor(38, 42, 51);
const FAINT: RGBColor = RGBColor(226, 229, 235);
const BLUES: [RGBColor; 2] = [RGBColor(140, 180, 225), RGBColor(36, 104, 196)];
const ORANGE: RGBColor = RGBColor(214, 112, 32);
/// The backend rounds to whole numbers: so many of them for each pixel make smooth lines.
const FINE: i32 = 8;

type Points = Vec<(f64, f64)>;

fn main() -> Result<(), Box<dyn Error>> {
    let (mut output, mut finest) = (PathBuf::from("scenes/pictures/dam_break_front.svg"), 0.025);
    let mut args = std::env::args().skip(1);
    while let Some(arg) = args.next() {
        let value = args.next().ok_or_else(|| format!("{arg} wants a value"))?;
        match arg.as_str() {
            "--output" => output = value.into(),
            "--spacing" => finest = value.parse()?,
            _ => return Err(format!("{arg} is none of --output, --spacing").into()),
        }
    }
    let mut fronts = Vec::new();
    for spacing in [0.05, finest] {
        let front = pollster::block_on(front(spacing))?;
        for source in ["a", "b"] {
            let points = measured(source)?;
            let off: Vec<f64> = points.iter().map(|(t, x)| at(&front, *t) / x - 1.0).collect();
            let square = (off.iter().map(|e| e * e).sum::<f64>() / off.len() as f64).sqrt();
            let shown: Vec<String> = off.iter().map(|e| format!("{:+.1}", 100.0 * e)).collect();
            println!(
                "spacing {spacing}, points {source}: rms {:.1} %, one by one {} %",
                100.0 * square,
                shown.join(" ")
            );
        }
        fronts.push((spacing, front));
    }
    draw(&output, &fronts)?;
    println!("written: {}", output.display());
    Ok(())
}

/// The points of a source.
fn measured(source: &str) -> Result<Points, Box<dyn Error>> {
    let mut points = Vec::new();
    for line in MEASURED.lines().filter(|line| !line.starts_with('#')).skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        if cells[0] == source {
            points.push((cells[1].parse()?, cells[2].parse()?));
        }
    }
    Ok(points)
}

/// Where the front is at a time, between two looks at it.
fn at(front: &Points, t: f64) -> f64 {
    let place = front.partition_point(|(time, _)| *time < t).clamp(1, front.len() - 1);
    let ((t0, x0), (t1, x1)) = (front[place - 1], front[place]);
    x0 + (x1 - x0) * (t - t0) / (t1 - t0)
}

/// Runs the scene until the front is at the other wall.
async fn front(spacing: f64) -> Result<Points, Box<dyn Error>> {
    // Sound goes through a third of a particle's reach in a step.
    let overrides = [format!("force.1.spacing={spacing}"), format!("simulation.dt={}", 0.01 * spacing)];
    let scene = Scene::load(&Source::find("dam_break_2d")?, &overrides, &Options::default())?;
    let setup = Setup {
        particles: scene.particles,
        forces: scene.forces,
        integrator: (scene.integrator.build)(),
        dt: scene.dt,
        bounds: scene.bounds,
        solver: scene.solver,
    };
    let start = setup.start()?.ok_or("the scene has a fluid")?;
    println!("spacing {spacing}: {} particles of water, {} of walls", start.fluid, start.walls);
    let found = gpu::open(gpu::choose(gpu::adapters(&gpu::instance()).await, &gpu::Choice::Best)?).await?;
    let gpu = Gpu::new(&found.device, &found.queue, setup.check()?)?;
    let mut simulation = Simulation::on(gpu, &setup)?;
    let mut front = vec![(0.0, 1.0)];
    // A block comes before its tank: the first are of water.
    let water = start.fluid as usize;
    loop {
        simulation.step(40)?;
        simulation.check().await?;
        let places = simulation.read(POSITION).await?;
        let tip = places[..water].iter().map(|x| f64::from(x.x)).fold(0.0, f64::max) + 0.5 * spacing;
        front.push((simulation.steps() as f64 * setup.dt * RATE, tip));
        if tip > 3.97 {
            return Ok(front);
        }
    }
}

fn draw(path: &std::path::Path, fronts: &[(f64, Points)]) -> Result<(), Box<dyn Error>> {
    let (width, height) = (760, 480);
    let text = |size: i32| ("sans-serif", size * FINE).into_font().color(&INK);
    let mut svg = String::new();
    {
        let size = [width, height].map(|n: i32| (n * FINE).cast_unsigned());
        let root = SVGBackend::with_string(&mut svg, (size[0], size[1])).into_drawing_area();
        root.fill(&WHITE)?;
        let mut chart = ChartBuilder::on(&root)
            .margin(16 * FINE)
            .caption("The front of a breaking dam, twice as high as long", text(18))
            .x_label_area_size(44 * FINE)
            .y_label_area_size(52 * FINE)
            .build_cartesian_2d(0.0..3.5, 1.0..4.0)?;
        chart
            .configure_mesh()
            .axis_style(INK.stroke_width(8))
            .bold_line_style(FAINT.stroke_width(8))
            .light_line_style(TRANSPARENT)
            .label_style(text(13))
            .axis_desc_style(text(15))
            .x_desc("T = t √(2 g / L)")
            .y_desc("X = x / L")
            .draw()?;
        for ((spacing, front), color) in fronts.iter().zip(BLUES) {
            let line = LineSeries::new(front.iter().copied(), color.stroke_width(20));
            chart
                .draw_series(line)?
                .label(format!("motes, L / {:.0}", 1.0 / spacing))
                .legend(move |(x, y)| PathElement::new(vec![(x, y), (x + 20 * FINE, y)], color.stroke_width(20)));
        }
        let (a, b) = (measured("a")?, measured("b")?);
        let dots = a.into_iter().map(|point| Circle::new(point, 5 * FINE, ORANGE.filled()));
        let dot = |(x, y): (i32, i32)| Circle::new((x + 10 * FINE, y), 5 * FINE, ORANGE.filled());
        chart.draw_series(dots)?.label("Koshizuka & Oka 1996, as in PySPH").legend(dot);
        let rings = b.into_iter().map(|point| Circle::new(point, 5 * FINE, ORANGE.stroke_width(12)));
        let ring = |(x, y): (i32, i32)| Circle::new((x + 10 * FINE, y), 5 * FINE, ORANGE.stroke_width(12));
        chart.draw_series(rings)?.label("the same, as in DualSPHysics").legend(ring);
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::UpperLeft)
            .margin(14 * FINE)
            .legend_area_size(30 * FINE)
            .label_font(text(14))
            .background_style(WHITE.mix(0.8))
            .draw()?;
        root.present()?;
    }
    let shown = format!("width=\"{width}\" height=\"{height}\"");
    svg = svg.replacen(&format!("width=\"{}\" height=\"{}\"", width * FINE, height * FINE), &shown, 1);
    Ok(std::fs::write(path, svg)?)
}
