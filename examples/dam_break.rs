//! A breaking dam beside what was measured: its front (Koshizuka & Oka 1996; Martin & Moyce 1952), and the height of what is left
//! (Martin & Moyce 1952).
//!
//! `cargo run --release --example dam_break` runs the scene `dam_break_2d` at two resolutions, and once more with walls that let
//! slip, prints how far each is from each point, and writes `scenes/pictures/dam_break_measured.svg`; `--output FILE` writes
//! elsewhere, `--spacing D` takes another spacing for the finer ones.

use std::error::Error;
use std::path::{Path, PathBuf};

use motes::scene::{Options, Scene, Source};
use motes::{Gpu, POSITION, Setup, Simulation, gpu};
use plotters::coord::Shift;
use plotters::prelude::*;

/// The points, with where they come from: a letter for each source.
const FRONTS: &str = include_str!("../tests/physics/walls/dam_break_front.csv");
const HEIGHTS: &str = include_str!("../tests/physics/walls/dam_break_height.csv");
const SOURCES: [(&str, &str); 4] = [
    ("K", "Koshizuka & Oka 1996"),
    ("M", "Martin & Moyce 1952, tables"),
    ("N", "their figure, L = 1.125 in"),
    ("P", "their figure, L = 2.25 in"),
];
/// √(g / L) of the scene, where L is 1 m: τ is so many times t, and T is √2 τ.
const RATE: f64 = 3.132_091_953;
const INK: RGBColor = RGBColor(38, 42, 51);
const FAINT: RGBColor = RGBColor(226, 229, 235);
const LINES: [RGBColor; 3] = [RGBColor(150, 188, 230), RGBColor(36, 104, 196), RGBColor(146, 86, 190)];
const MARKS: [RGBColor; 2] = [RGBColor(214, 112, 32), RGBColor(24, 132, 96)];
/// The backend rounds to integers: so many of them for each pixel make smooth lines.
const FINE: i32 = 8;

type Points = Vec<(f64, f64)>;

/// A run: X over T and H over τ.
struct Dam {
    name: String,
    front: Points,
    height: Points,
}

fn main() -> Result<(), Box<dyn Error>> {
    let (mut output, mut finest) = (PathBuf::from("scenes/pictures/dam_break_measured.svg"), 0.025);
    let mut args = std::env::args().skip(1);
    while let Some(arg) = args.next() {
        let value = args.next().ok_or_else(|| format!("{arg} wants a value"))?;
        match arg.as_str() {
            "--output" => output = value.into(),
            "--spacing" => finest = value.parse()?,
            _ => return Err(format!("{arg} is none of --output, --spacing").into()),
        }
    }
    let mut dams = Vec::new();
    for (spacing, friction) in [(0.05, 1.0), (finest, 1.0), (finest, 0.0)] {
        let dam = pollster::block_on(dam(spacing, friction))?;
        tell(&dam)?;
        dams.push(dam);
    }
    draw(&output, &dams)?;
    println!("written: {}", output.display());
    Ok(())
}

/// The points of some sources.
fn measured(table: &str, sources: &str) -> Result<Points, Box<dyn Error>> {
    let mut points = Vec::new();
    for line in table.lines().filter(|line| !line.starts_with('#')).skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        if sources.contains(cells[0]) {
            points.push((cells[1].parse()?, cells[2].parse()?));
        }
    }
    Ok(points)
}

/// What is between two looks.
fn at(line: &Points, t: f64) -> f64 {
    let place = line.partition_point(|(time, _)| *time < t).clamp(1, line.len() - 1);
    let ((t0, x0), (t1, x1)) = (line[place - 1], line[place]);
    x0 + (x1 - x0) * (t - t0) / (t1 - t0)
}

fn rms(off: &[f64]) -> f64 {
    (off.iter().map(|e| e * e).sum::<f64>() / off.len() as f64).sqrt()
}

/// Prints how far a run is from what was measured, as it is, and beside that from what would have begun later.
fn tell(dam: &Dam) -> Result<(), Box<dyn Error>> {
    let percent = |off: &[f64]| off.iter().map(|e| format!("{:+.1}", 100.0 * e)).collect::<Vec<_>>().join(" ");
    for sources in ["K", "MNP"] {
        let points = measured(FRONTS, sources)?;
        let off = |late: f64| -> Vec<f64> {
            points.iter().map(|(t, x)| at(&dam.front, (t - late).max(0.0)) / x - 1.0).collect()
        };
        let (late, left) = (0..60)
            .map(|n| 0.01 * f64::from(n))
            .map(|late| (late, rms(&off(late))))
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .ok_or("times")?;
        println!("  front, {sources}: rms {:.1} % ({} %);", 100.0 * rms(&off(0.0)), percent(&off(0.0)));
        println!("    {:.1} % where it starts {late:.2} of T later", 100.0 * left);
    }
    let off: Vec<f64> = measured(HEIGHTS, "M")?.iter().map(|(t, h)| at(&dam.height, *t) - h).collect();
    println!("  height: rms {:.1} % of 2 L ({} %)", 100.0 * rms(&off), percent(&off));
    Ok(())
}

/// Runs the scene as long as its height was measured.
async fn dam(spacing: f64, friction: f64) -> Result<Dam, Box<dyn Error>> {
    // Sound goes through a third of a particle's reach in a step.
    let overrides = [
        format!("force.1.spacing={spacing}"),
        format!("simulation.dt={}", 0.01 * spacing),
        format!("force.1.wall_friction={friction:?}"),
    ];
    let scene = Scene::load(&Source::find("dam_break_2d")?, &overrides, &Options::default())?;
    let setup = Setup {
        integrator: scene.integrator(),
        state: scene.particles,
        forces: scene.forces,
        dt: scene.dt,
        bounds: scene.bounds,
        solver: scene.solver,
    };
    let start = setup.start()?.ok_or("the scene has a fluid")?;
    let name = format!("motes, L / {:.0}{}", 1.0 / spacing, if friction == 0.0 { ", walls let slip" } else { "" });
    println!("{name}: {} particles of water, {} of walls", start.fluid, start.walls);
    let found = gpu::open(gpu::choose(gpu::adapters(&gpu::instance()).await, &gpu::Choice::Best)?).await?;
    let gpu = Gpu::new(&found.device, &found.queue, setup.check()?)?;
    let mut simulation = Simulation::on(gpu, &setup)?;
    let (mut front, mut height) = (vec![(0.0, 1.0)], vec![(0.0, 1.0)]);
    // A block comes before its tank: the first are of water.
    let water = start.fluid as usize;
    let mut tau = 0.0;
    while tau < 4.2 {
        simulation.step(40)?;
        simulation.check().await?;
        tau = simulation.steps() as f64 * setup.dt * RATE;
        let places = simulation.read(POSITION).await?;
        let places = places[..water].iter().map(|x| (f64::from(x.x), f64::from(x.y)));
        let tip = places.clone().map(|(x, _)| x).fold(0.0, f64::max) + 0.5 * spacing;
        // Until it is at the other wall.
        if front.last().is_none_or(|(_, x)| *x < 3.97) {
            front.push((tau * 2.0f64.sqrt(), tip));
        }
        // By the wall that it leans on, where it is highest; what is two spacings above all others is spray.
        let mut above: Vec<f64> = places.filter(|(x, _)| *x < 0.25).map(|(_, y)| y).collect();
        above.sort_by(f64::total_cmp);
        let top = above.iter().fold(0.0, |top, y| if y - top < 2.0 * spacing { *y } else { top });
        height.push((tau, 0.5 * (top + 0.5 * spacing)));
    }
    Ok(Dam { name, front, height })
}

fn text(size: i32) -> TextStyle<'static> {
    ("sans-serif", size * FINE).into_font().color(&INK)
}

fn draw(path: &Path, dams: &[Dam]) -> Result<(), Box<dyn Error>> {
    let (width, height) = (1080, 460);
    let mut svg = String::new();
    {
        let size = [width, height].map(|n: i32| (n * FINE).cast_unsigned());
        let root = SVGBackend::with_string(&mut svg, (size[0], size[1])).into_drawing_area();
        root.fill(&WHITE)?;
        let (left, right) = root.split_horizontally(width / 2 * FINE);
        let lines: Vec<_> = dams.iter().map(|dam| (dam.name.as_str(), &dam.front)).collect();
        let words = ["The front of a breaking dam, twice as high as long", "T = t √(2 g / L)", "X = x / L"];
        chart(&left, words, (0.0..3.5, 1.0..4.0), &lines, FRONTS, SeriesLabelPosition::UpperLeft)?;
        let lines: Vec<_> = dams.iter().map(|dam| (dam.name.as_str(), &dam.height)).collect();
        let words = ["The height of what is left of it", "τ = t √(g / L)", "H = height / 2 L"];
        chart(&right, words, (0.0..4.5, 0.0..1.0), &lines, HEIGHTS, SeriesLabelPosition::UpperRight)?;
        root.present()?;
    }
    let shown = format!("width=\"{width}\" height=\"{height}\"");
    svg = svg.replacen(&format!("width=\"{}\" height=\"{}\"", width * FINE, height * FINE), &shown, 1);
    Ok(std::fs::write(path, svg)?)
}

/// Lines, and the points of every source that a table has.
fn chart(
    area: &DrawingArea<SVGBackend, Shift>,
    [caption, x, y]: [&str; 3],
    ranges: (std::ops::Range<f64>, std::ops::Range<f64>),
    lines: &[(&str, &Points)],
    table: &str,
    legend: SeriesLabelPosition,
) -> Result<(), Box<dyn Error>> {
    let mut chart = ChartBuilder::on(area)
        .margin(16 * FINE)
        .caption(caption, text(17))
        .x_label_area_size(44 * FINE)
        .y_label_area_size(52 * FINE)
        .build_cartesian_2d(ranges.0, ranges.1)?;
    chart
        .configure_mesh()
        .axis_style(INK.stroke_width(8))
        .bold_line_style(FAINT.stroke_width(8))
        .light_line_style(TRANSPARENT)
        .label_style(text(13))
        .axis_desc_style(text(15))
        .x_desc(x)
        .y_desc(y)
        .draw()?;
    for ((name, line), color) in lines.iter().zip(LINES) {
        let line = LineSeries::new(line.iter().copied(), color.stroke_width(18));
        let key = move |(x, y)| PathElement::new(vec![(x, y), (x + 20 * FINE, y)], color.stroke_width(18));
        chart.draw_series(line)?.label(*name).legend(key);
    }
    for (nth, (source, name)) in SOURCES.iter().enumerate() {
        let (points, color) = (measured(table, source)?, MARKS[nth.min(1)]);
        if points.is_empty() {
            continue;
        }
        let key = |(x, y): (i32, i32)| (x + 10 * FINE, y);
        let (small, thin) = (9 * FINE / 2, color.stroke_width(11));
        let series = match nth {
            0 | 1 => chart.draw_series(points.into_iter().map(|point| Circle::new(point, small, color.filled())))?,
            2 => chart.draw_series(points.into_iter().map(|point| TriangleMarker::new(point, 6 * FINE, thin)))?,
            _ => chart.draw_series(points.into_iter().map(|point| Circle::new(point, 6 * FINE, thin)))?,
        };
        let series = series.label(*name);
        match nth {
            0 | 1 => series.legend(move |place| Circle::new(key(place), small, color.filled())),
            2 => series.legend(move |place| TriangleMarker::new(key(place), 6 * FINE, thin)),
            _ => series.legend(move |place| Circle::new(key(place), 6 * FINE, thin)),
        };
    }
    chart
        .configure_series_labels()
        .position(legend)
        .margin(12 * FINE)
        .legend_area_size(28 * FINE)
        .label_font(text(13))
        .background_style(WHITE.mix(0.8))
        .draw()?;
    Ok(())
}
