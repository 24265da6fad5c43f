//! The plan of an evacuation, from a file.

use motes::Error;
use motes::evacuation;
use motes::floor_plan::{Exit, FloorPlan};
use motes::formats::{floor_picture, floor_plan};

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
    let is_picture = bytes.starts_with(b"\x89PNG");
    let floor_picture::Plan { drawn, landings, remarks } = match args.pixel {
        Some(side) if is_picture => floor_picture::read(&bytes, side).map_err(bad)?,
        Some(_) => {
            return Err(bad("--pixel is the scale of a picture (PNG), and this is none: leave it out".to_owned()));
        }
        None if is_picture => {
            return Err(bad(
                "a picture has no scale: give the side of a pixel in metres, as in --pixel 0.02".to_owned()
            ));
        }
        None => {
            let drawn = floor_plan::read(&words(bytes).map_err(bad)?).map_err(bad)?;
            floor_picture::Plan { drawn, ..Default::default() }
        }
    };
    let count = drawn.exits.len();
    if !(args.exits.is_empty() || args.exits.len() == count) {
        let given = args.exits.len();
        return Err(bad(format!("--exits has {given} names, and the plan has {count} exits: a name for each")));
    }
    if count == 0 {
        return Err(bad("the plan has no exit, so that no way leads out: add a LINESTRING on its floor".to_owned()));
    }
    let named = |(path, number): (_, usize)| Exit {
        name: args.exits.get(number - 1).cloned().unwrap_or_else(|| format!("exit {number}")),
        path,
        reach: REACH,
    };
    let exits: Vec<Exit> = drawn.exits.into_iter().zip(1..).map(named).collect();
    let wkt = evacuation::text(&drawn.polygons, &exits);
    let mut remarks = remarks;
    let plan = FloorPlan::new(&drawn.polygons, exits, args.cell).map_err(bad)?;
    remarks.extend(plan.exits().iter().filter_map(|exit| shut(&plan, exit)));
    Ok(Read { plan, wkt, landings, remarks })
}

fn words(bytes: Vec<u8>) -> Result<String, String> {
    String::from_utf8(bytes)
        .map_err(|_| "it is neither text nor a PNG: a plan is well-known text (WKT) or a picture".to_owned())
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
