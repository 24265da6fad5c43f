//! Arguments of the command line.

use std::path::PathBuf;

use super::crowds::args::CrowdsArgs;
use clap::{Args as ClapArgs, Parser, Subcommand, ValueEnum};

const AFTER: &str = "\
Exit codes:
  0   success
  2   invalid arguments
  3   an error in the scene, or in a WGSL file that it names
  4   an error in a file of particles
  5   no suitable adapter, or a limit of the device is exceeded
  6   NaN or infinity, a runaway, too many neighbours, a bond that is too long, a body that has outgrown the search for collisions, a step below dt_min, or below the shortest block time step, or a user's law with too many loop iterations
  7   the device was lost, ran out of memory or did not respond, or no thread could be started
  8   a result could not be written, or would overwrite those of another run
  9   `compare`, `doctor` or `validate` found a disagreement
  75  stopped by Ctrl-C, SIGTERM, SIGHUP or --max-hours; all results up to that step and a checkpoint are written
  130 ended immediately by a second signal

Examples:
  motes run galaxy
  motes run my.toml -o results --set simulation.dt=0.01
  motes run galaxy --frames 240
  motes resume out/galaxy
  motes convert stars.csv stars.hdf5
  motes compare galaxy --steps 20";

/// A GPU particle simulator, verified against an f64 CPU reference.
#[derive(Debug, Parser)]
#[command(name = "motes", version, after_help = AFTER, arg_required_else_help = true)]
pub struct Args {
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run a scene: tables, snapshots, a plot and pictures are written to a folder
    Run(RunArgs),
    /// Resume a run that was stopped or killed, from the newest checkpoint in its folder
    Resume(ResumeArgs),
    /// Open a window in which a scene runs: turn it, pause it, and change its settings while it moves
    View(ViewArgs),
    /// Check a scene, and predict memory and time, without running it
    Check(CheckArgs),
    /// Print what one step of a scene does, kernel by kernel; with --law, the language of a law of your own
    Explain(ExplainArgs),
    /// Compare the device with the f64 references, kernel by kernel and over some steps
    Compare(CompareArgs),
    /// Run a scene for all combinations of some values, and tabulate and plot the results
    Sweep(SweepArgs),
    /// Run pedestrians out of a floor plan, and report how long they need and where the bottlenecks are
    Crowds(CrowdsArgs),
    /// List the scenes that come with motes, or print one
    Scenes(ScenesArgs),
    /// Convert a file of particles to another format, chosen by the extension of the new file
    Convert(ConvertArgs),
    /// Print what a file of particles contains: counts, columns, box, time, extent, energies
    Info(InfoArgs),
    /// Integrate a harmonic oscillator and an exponential decay with every integrator, and plot which are stable
    Stability(StabilityArgs),
    /// Run scenes with known results, and compare with the published numbers
    Validate(ValidateArgs),
    /// Measure how fast this machine steps scenes: gravity, a tree, neighbours, springs and fluids
    Bench(BenchArgs),
    /// List adapters, and test driver features that simulations rely on
    Doctor(DoctorArgs),
}

/// Where kernels run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum BackendChoice {
    /// The best adapter, or the f64 references when there is none
    Auto,
    /// An adapter, or an error
    Gpu,
    /// The f64 references, on the processor
    Cpu,
}

#[derive(Debug, Clone, ClapArgs)]
pub struct DeviceArgs {
    /// Where kernels run
    #[arg(long, value_enum, default_value = "auto")]
    pub backend: BackendChoice,
    /// An adapter, by a part of its name or by its number in `motes doctor`
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
}

#[derive(Debug, Clone, ClapArgs)]
pub struct SceneArgs {
    /// A scene file, or the name of a scene that `motes scenes` lists
    pub scene: String,
    /// Run this many steps instead of the scene's own number
    #[arg(long, value_name = "N", conflicts_with = "until")]
    pub steps: Option<u64>,
    /// Run until this time instead of the scene's own end
    #[arg(long, value_name = "T")]
    pub until: Option<f64>,
    /// Set a value of the scene, such as simulation.dt=0.01 or force.0.g=2; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
    /// Multiply the number of particles of every shape and emitter by this factor; fluids get another spacing
    #[arg(long, value_name = "FACTOR", value_parser = positive)]
    pub scale: Option<f64>,
    /// Let the scene name files outside of its own folder
    #[arg(long)]
    pub allow_outside: bool,
    /// Divide time steps that are unstable for the scene's springs into stable substeps
    #[arg(long)]
    pub auto_substeps: bool,
    #[command(flatten)]
    pub device: DeviceArgs,
}

#[derive(Debug, Clone, ClapArgs)]
pub struct ViewArgs {
    /// A scene file, or the name of a scene that `motes scenes` lists
    #[arg(default_value = "galaxy")]
    pub scene: String,
    /// Set a value of the scene, such as simulation.dt=0.01 or force.0.g=2; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
    /// Multiply the number of particles of every shape and emitter by this factor; fluids get another spacing
    #[arg(long, value_name = "FACTOR", value_parser = positive)]
    pub scale: Option<f64>,
    /// Put a file beside the scene, as if it were dropped on the window: particles or a floor plan in the place of its own, or a law as
    /// one more force; may be repeated
    #[arg(long, value_name = "FILE")]
    pub beside: Vec<String>,
    /// Let the scene name files outside of its own folder
    #[arg(long)]
    pub allow_outside: bool,
    /// End after this many frames
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub frames: Option<u64>,
    /// Draw without a window, save the last frame here as a PNG, and end
    #[arg(long, value_name = "FILE", requires = "frames", value_parser = png)]
    pub screenshot: Option<PathBuf>,
    /// The size of the window, or of the screenshot [pixels]
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "1280x800", value_parser = size)]
    pub size: [u32; 2],
    /// An adapter, by a part of its name or by its number in `motes doctor`
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
}

#[derive(Debug, ClapArgs)]
pub struct CheckArgs {
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, ClapArgs)]
pub struct ExplainArgs {
    /// A scene file, or the name of a scene that `motes scenes` lists
    #[arg(required_unless_present = "law", conflicts_with = "law")]
    pub scene: Option<String>,
    /// Print what a law in WGSL may define, use and bind, and its limits
    #[arg(long)]
    pub law: bool,
    /// Set a value of the scene, such as simulation.dt=0.01 or force.0.g=2; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
    /// Multiply the number of particles of every shape and emitter by this factor; fluids get another spacing
    #[arg(long, value_name = "FACTOR", value_parser = positive)]
    pub scale: Option<f64>,
    /// Let the scene name files outside of its own folder
    #[arg(long)]
    pub allow_outside: bool,
    #[command(flatten)]
    pub device: DeviceArgs,
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, ClapArgs)]
pub struct RunArgs {
    #[command(flatten)]
    pub scene: SceneArgs,
    /// The folder for results [default: out/NAME]
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Remove the results and checkpoints of an earlier run in the folder
    #[arg(long)]
    pub overwrite: bool,
    /// Continue from a state written by an earlier run of the scene, snapshot_*.npz; steps and until count from the start of that run
    #[arg(long, value_name = "FILE")]
    pub from: Option<PathBuf>,
    /// Draw this many pictures, evenly spaced from the first state to the last, and join them into a film
    #[arg(long, value_name = "N")]
    pub frames: Option<u64>,
    /// Frames per second of the film
    #[arg(long, value_name = "N", default_value_t = 30, value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub fps: u16,
    /// Write the diagnostics of a fluid, fluid.csv, after every step
    #[arg(long)]
    pub ledger: bool,
    /// Resume if the folder has a checkpoint of this run, otherwise start
    #[arg(long, conflicts_with = "overwrite")]
    pub resume: bool,
    #[command(flatten)]
    pub stop: StopArgs,
    #[command(flatten)]
    pub show: ShowArgs,
}

#[derive(Debug, Clone, ClapArgs)]
pub struct SweepArgs {
    #[command(flatten)]
    pub scene: SceneArgs,
    /// A key of the scene and its values, such as simulation.dt=0.1,0.05,0.025; if repeated, all combinations are run
    #[arg(long, value_name = "KEY=VALUES", required = true)]
    pub vary: Vec<String>,
    /// The folder for the table, the plot and a folder of tables for each run [default: out/NAME_sweep]; pictures and snapshots are
    /// written where --set output.… asks for them
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Remove results of earlier runs that the folders hold
    #[arg(long)]
    pub overwrite: bool,
    /// Share the runs among these adapters, by parts of their names or by their numbers in `motes doctor`
    #[arg(long, value_name = "NAMES", value_delimiter = ',', conflicts_with_all = ["adapter", "backend"])]
    pub adapters: Vec<String>,
    #[command(flatten)]
    pub stop: StopArgs,
    #[command(flatten)]
    pub show: ShowArgs,
}

#[derive(Debug, ClapArgs)]
pub struct ResumeArgs {
    /// The folder of the run
    pub folder: PathBuf,
    #[command(flatten)]
    pub device: DeviceArgs,
    #[command(flatten)]
    pub stop: StopArgs,
    #[command(flatten)]
    pub show: ShowArgs,
}

/// Options that end a run before its last step.
#[derive(Debug, Clone, ClapArgs)]
pub struct StopArgs {
    /// Stop after this many hours, with a checkpoint from which --resume and `motes resume` continue
    #[arg(long, value_name = "H", value_parser = positive)]
    pub max_hours: Option<f64>,
}

/// The output of a run on the terminal.
#[derive(Debug, Clone, ClapArgs)]
pub struct ShowArgs {
    /// Print events as lines of JSON on standard output; `sweep` prints one object
    #[arg(long)]
    pub json: bool,
    /// Print nothing but errors
    #[arg(short, long)]
    pub quiet: bool,
}

#[derive(Debug, ClapArgs)]
pub struct CompareArgs {
    /// A scene file, or the name of a scene that `motes scenes` lists
    pub scene: String,
    /// Number of steps for which device and references are compared
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u32).range(1..))]
    pub steps: u32,
    /// Set a value of the scene, such as simulation.dt=0.01 or force.0.g=2; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
    /// Let the scene name files outside of its own folder
    #[arg(long)]
    pub allow_outside: bool,
    /// An adapter, by a part of its name or by its number in `motes doctor`
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
    /// Compare only the tree's forces with direct summation, at these opening angles, with and without quadrupoles
    #[arg(long, value_name = "ANGLES", value_delimiter = ',')]
    pub theta: Vec<f64>,
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, ClapArgs)]
pub struct ScenesArgs {
    /// Print the text of this scene; with --keys, the keys of this force, shape, measure or section
    pub name: Option<String>,
    /// Print all keys of scenes, forces, shapes and measures, with their units and defaults
    #[arg(long)]
    pub keys: bool,
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
}

/// Precision of the numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Width {
    /// Single where it represents all numbers exactly, double otherwise
    Auto,
    /// 32 bits
    Single,
    /// 64 bits
    Double,
}

#[derive(Debug, ClapArgs)]
pub struct ConvertArgs {
    /// The file that is read
    pub from: PathBuf,
    /// The file that is written
    pub to: PathBuf,
    /// The precision of the numbers that are written
    #[arg(long, value_enum, default_value = "auto")]
    pub precision: Width,
    /// Replace an existing file
    #[arg(long)]
    pub overwrite: bool,
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, ClapArgs)]
pub struct InfoArgs {
    /// A file of particles
    pub file: PathBuf,
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, ClapArgs)]
pub struct StabilityArgs {
    /// hω: the length of a step, in units of 1 / ω of the oscillator
    #[arg(long, value_name = "Y", default_value_t = 1.0, value_parser = positive)]
    pub omega_step: f64,
    /// ha: the length of a step, in units of 1 / a of the decay
    #[arg(long, value_name = "Z", default_value_t = 2.5, value_parser = positive)]
    pub decay_step: f64,
    /// Number of steps
    #[arg(long, value_name = "N", default_value_t = 40, value_parser = clap::value_parser!(u32).range(2..=100_000))]
    pub steps: u32,
    /// The file of the picture
    #[arg(short, long, value_name = "FILE", default_value = "stability.svg")]
    pub out: PathBuf,
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub device: DeviceArgs,
}

#[derive(Debug, ClapArgs)]
pub struct ValidateArgs {
    /// Claims or families, as --list shows them; none: all that take some seconds
    pub names: Vec<String>,
    /// The long ones too
    #[arg(long)]
    pub all: bool,
    /// List the claims, and run none
    #[arg(long, conflicts_with_all = ["names", "all", "controls", "output", "overwrite"])]
    pub list: bool,
    /// Run each scene once more with a value by which its claim has to fail
    #[arg(long)]
    pub controls: bool,
    /// A folder for the table (validation.md) and the numbers (validation.json)
    #[arg(short, long, value_name = "FOLDER")]
    pub output: Option<PathBuf>,
    /// Replace those of an earlier run
    #[arg(long, requires = "output")]
    pub overwrite: bool,
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub device: DeviceArgs,
}

pub fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x > 0.0 && x < 1e6 => Ok(x),
        _ => Err("it must be a number above 0 and below 1e6".to_owned()),
    }
}

/// The file of a picture, which is a PNG whatever it is called.
fn png(text: &str) -> Result<PathBuf, String> {
    let file = PathBuf::from(text);
    let is_png = file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"));
    if is_png { Ok(file) } else { Err("the picture is a PNG: give it a name that ends in .png".to_owned()) }
}

/// The size of a picture, as in 1280x800.
fn size(text: &str) -> Result<[u32; 2], String> {
    let side = |text: &str| text.trim().parse::<u32>().ok().filter(|n| (64..=4096).contains(n));
    let sides = text.split_once(['x', '×']).and_then(|(width, height)| Some([side(width)?, side(height)?]));
    sides.ok_or_else(|| "it must be a width and a height of 64 to 4096 pixels, as in 1280x800".to_owned())
}

/// The subject of a benchmark.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Topic {
    /// All subjects except `kernels`
    All,
    /// All pairs: `plummer`
    Gravity,
    /// Gravity through a tree: `plummer`
    Tree,
    /// Searches for neighbours: `flock`
    Neighbors,
    /// Cloth: `flag`
    Springs,
    /// Water: `dam_break`, weakly compressible and by DFSPH
    Fluids,
    /// Conjugate gradients: an iteration of `cloth` by linear_backward_euler
    Solve,
    /// Independent particles under drag and weight
    Stream,
    /// Each kernel of one step of a scene, by the device's own clock
    Kernels,
}

#[derive(Debug, ClapArgs)]
pub struct BenchArgs {
    /// The subject to measure [default: all of them]
    #[arg(value_enum)]
    pub topic: Option<Topic>,
    /// For `kernels`: a scene file, or the name of a scene that `motes scenes` lists
    #[arg(required_if_eq("topic", "kernels"))]
    pub scene: Option<String>,
    /// For `kernels`: set a value of the scene, such as particles.0.count=1000; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE", requires = "scene")]
    pub overrides: Vec<String>,
    /// The approximate maximum number of particles: each size has four times the particles of the one before [default: the smallest size only]
    #[arg(long, value_name = "N")]
    pub to: Option<u32>,
    /// Leave out sizes with which a topic is expected to take longer than this [s]
    #[arg(long, value_name = "S")]
    pub seconds: Option<f64>,
    /// Repetitions of each measurement; the median is reported
    #[arg(long, value_name = "N", default_value_t = 7)]
    pub repeat: usize,
    /// An adapter, by a part of its name or by its number in `motes doctor`
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
    /// Write the results to this file as JSON, anew after each measurement
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, ClapArgs)]
pub struct DoctorArgs {
    /// Test only this adapter, by a part of its name or by its number
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
    /// Print the result as JSON
    #[arg(long)]
    pub json: bool,
}
