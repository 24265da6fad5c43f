//! The plan of an evacuation, from a file.

use motes::Error;
use motes::evacuation;
use motes::floor_plan::{Exit, FloorPlan};
use motes::formats::floor_plan::{self, Measure};

use super::args::CrowdsArgs;

/// The longest file that is read \[bytes\].
const LONGEST: u64 = 16 << 20;
/// The distance from the line of an exit at which a pedestrian has left \[m\], as of `[plan]`.
const REACH: f64 = 0.25;

/// The walls beside an exit are at least as far from its middle [m]: 0.53 − [`REACH`], rounded up.
const CLEAR: f64 = 0.3;

/// A plan, and its text for a scene.
pub struct Read {
    pub plan: FloorPlan,
    pub wkt: String,
    /// The floor outside of exits, where no pedestrian starts.
    pub landings: Vec<floor_plan::Landing>,
    /// What one should know about it.
    pub remarks: Vec<String>,
}

/// Reads the plan of the arguments.
pub fn read(args: &CrowdsArgs) -> Result<Read, Error> {
    let bad = |message: String| Error::Input { file: args.plan.clone(), message };
    let length = std::fs::metadata(&args.plan).map_err(|why| bad(why.to_string()))?.len();
    if length > LONGEST {
        return Err(bad(format!("{length} bytes are more than the {LONGEST} that a floor plan may have")));
    }
    let bytes = std::fs::read(&args.plan).map_err(|why| bad(why.to_string()))?;
    let read = floor_plan::read(&bytes, &Measure { scale: args.scale, pixel: args.pixel }).map_err(bad)?;
    let [x, y] = args.origin.unwrap_or_default();
    let read = read.from_origin(glam::DVec2::new(x, y));
    let count = read.drawn.exits.len();
    if !(args.exits.is_empty() || args.exits.len() == count) {
        let given = args.exits.len();
        return Err(bad(format!("--exits has {given} names, and the plan has {count} exits: a name for each")));
    }
    if count == 0 {
        return Err(bad("the plan has no exit, so that no way leads out: add a LINESTRING on its floor".to_owned()));
    }
    let names = read.names(&args.exits);
    let floor_plan::Plan { drawn, landings, mut remarks } = read;
    let exits = drawn.exits.into_iter().zip(names);
    let exits: Vec<Exit> = exits.map(|(exit, name)| Exit { name, path: exit.path, reach: REACH }).collect();
    let wkt = evacuation::text(&drawn.polygons, &exits);
    let plan = FloorPlan::new(&drawn.polygons, exits, args.cell).map_err(bad)?;
    remarks.extend(plan.exits().iter().filter_map(|exit| shut(&plan, exit)));
    Ok(Read { plan, wkt, landings, remarks })
}

/// A remark on an exit that a wall keeps pedestrians from. Before a wall the drive of one of 0.35 m is in balance with the exponential force at
/// 0.35 + 0.08 ln(2000 / 214) = 0.53 m, with the parameters of Helbing, Farkas & Vicsek (2000); it leaves at [`REACH`] from the line.
fn shut(plan: &FloorPlan, exit: &Exit) -> Option<String> {
    let clear = |[a, b]: [glam::DVec2; 2]| ((0.5 * (a + b)), plan.distance(0.5 * (a + b)));
    let (at, clear) = exit.pieces().map(clear).max_by(|a, b| a.1.total_cmp(&b.1))?;
    (clear < CLEAR).then(|| {
        format!(
            "the exit \"{}\" has a wall {clear:.2} m from its middle, at {:.2} {:.2}: walls push pedestrians back, and few may reach it; let the floor go on for a metre behind it",
            exit.name, at.x, at.y
        )
    })
}
