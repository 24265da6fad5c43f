//! Arguments of `motes crowds`.

use std::path::PathBuf;

use clap::Args as ClapArgs;
use clap::builder::{PossibleValuesParser, TypedValueParser as _};
use motes::evacuation::Model;
use motes::formats::floor_plan::Scale;

use crate::cli::args::{DeviceArgs, ShowArgs, StopArgs, positive};

#[derive(Debug, Clone, ClapArgs)]
pub struct CrowdsArgs {
    /// The floor plan: polygons and lines of exits in metres (WKT, GeoJSON), layers of lines (DXF), or a drawing or picture in which walls are dark and exits are coloured (SVG, PNG)
    pub plan: PathBuf,
    /// The length of a unit of the plan [m], as in 0.01, or the scale of a drawing on paper, as in 1:100 [default: that of the file]
    #[arg(long, value_name = "SCALE")]
    pub scale: Option<Scale>,
    /// The side of a pixel of a picture, or of those that a drawing is drawn on [m] [default for drawings: 0.02]
    #[arg(long, value_name = "M", value_parser = positive)]
    pub pixel: Option<f64>,
    /// The point of the plan that is at 0 0 of the report [m] [default: 0,0]
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    pub origin: Option<[f64; 2]>,
    /// The number of pedestrians
    #[arg(long, value_name = "N", default_value_t = 300, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub people: u32,
    /// How they move: by forces, or by velocities that keep their distances
    #[arg(long, default_value = Model::default().name(), value_parser = model())]
    pub model: Model,
    /// The seed of their places, radii and desired speeds
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// The mean of desired speeds [m/s]; they are normal, between 0.37 and 1.64 of it
    #[arg(long, value_name = "V", default_value_t = 1.34, value_parser = positive)]
    pub speed: f64,
    /// A rectangle in which they start, by two corners [m]; may be repeated [default: the whole floor]
    #[arg(long, value_name = "X,Y,X,Y", value_parser = rectangle, allow_hyphen_values = true)]
    pub start: Vec<[f64; 4]>,
    /// Names of the exits, in their order in the plan
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub exits: Vec<String>,
    /// The side of the cells on which ways are found [m]
    #[arg(long, value_name = "M", default_value_t = 0.1, value_parser = positive)]
    pub cell: f64,
    /// End after this time, also if some are still inside [s]
    #[arg(long, value_name = "S", default_value_t = 1200.0, value_parser = positive)]
    pub limit: f64,
    /// The folder for the report, pictures, ways and the scene [default: out/NAME]
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Replace the report of an earlier run in the folder
    #[arg(long)]
    pub overwrite: bool,
    #[command(flatten)]
    pub device: DeviceArgs,
    #[command(flatten)]
    pub stop: StopArgs,
    #[command(flatten)]
    pub show: ShowArgs,
}

/// A model by its name.
fn model() -> impl clap::builder::TypedValueParser<Value = Model> {
    let by_name = |name: String| Model::ALL.into_iter().find(|model| model.name() == name).unwrap_or_default();
    PossibleValuesParser::new(Model::ALL.map(Model::name)).map(by_name)
}

/// A point.
fn point(text: &str) -> Result<[f64; 2], String> {
    let numbers: Vec<f64> = text.split(',').filter_map(|word| word.trim().parse().ok()).collect();
    let two = <[f64; 2]>::try_from(numbers).ok().filter(|all| all.iter().all(|x| x.is_finite()));
    two.filter(|_| text.split(',').count() == 2).ok_or_else(|| "it must be a point, as in 500000,5300000".to_owned())
}

/// Two corners.
fn rectangle(text: &str) -> Result<[f64; 4], String> {
    let numbers: Vec<f64> = text.split(',').filter_map(|word| word.trim().parse().ok()).collect();
    let four = <[f64; 4]>::try_from(numbers).ok().filter(|all| all.iter().all(|x| x.is_finite()));
    let four = four.filter(|[a, b, c, d]| (a - c).abs() > 0.0 && (b - d).abs() > 0.0 && text.split(',').count() == 4);
    four.ok_or_else(|| "it must be two corners of a rectangle, as in 0,0,15,8.5".to_owned())
}
