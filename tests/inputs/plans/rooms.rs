//! `scenes/two_rooms.wkt` in each format. Drawings lie on a grid of 0.02 m: a wall on it is within half a pixel of where it is drawn, corners are
//! cut by as much, and so are the ends of exits.

use glam::DVec2;
use motes::formats::floor_plan::{PIXEL, Scale};

use super::{are_same, read, two_rooms};

/// Half a pixel of the grid and half of one at corners and ends, along both axes.
const TOLERANCE: f64 = std::f64::consts::SQRT_2 * PIXEL;

/// The two rooms in metres, drawn by the walls, whose corner is at 0.2 0.2 of the drawing.
pub const STROKES: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-0.2 -0.2 24.4 10.4">
<rect x="-0.1" y="-0.1" width="24.2" height="10.2" fill="none" stroke="black" stroke-width="0.2"/>
<path d="M 12.1 0 V 4.8 M 12.1 6 V 10" stroke="#222" stroke-width="0.2"/>
<line x1="23.5" y1="0.5" x2="23.5" y2="9.5" stroke="green" stroke-width="0.05"/>
</svg>"##;

/// The same on paper in 1:100 and millimetres: the building is dark, its rooms are light, all is turned by half a turn and back, drawn by a style sheet, in
/// groups and by `use`; what is hidden and what is covered does not count.
pub const PAPER: &str = r##"<?xml version="1.0"?>
<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd" [<!ENTITY ink "#101020">]>
<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="244mm" height="104mm" viewBox="0 0 2440 1040">
<style>.paper { fill: #eeeeee } .ink { fill: &ink; } .way { stroke: rgb(200, 0, 0); stroke-width: 4; fill: none }</style>
<defs><rect id="room" width="1" height="1"/></defs>
<g transform="rotate(180)"><g transform="translate(-2440 -1040)"><g transform="rotate(-180) translate(-2440 -1040)">
  <rect class="ink" width="2440" height="1040"/>
  <use xlink:href="#room" class="paper" transform="translate(20 20) scale(1200 1000)"/>
  <g transform="matrix(10 0 0 10 20 20)"><path class="paper" d="M 122 0 h 118 v 100 h -118 Z M 119.5,48 h 3 v 12 h -3 z"/></g>
  <path class="ink" d="M 300 300 h 90 v 90 h -90 z" display="none"/>
  <circle class="ink" cx="500" cy="500" r="60"/><circle class="paper" cx="500" cy="500" r="62"/>
  <path class="ink" d="M 700 700 h 90" visibility="hidden"/>
  <polyline class="way" points="2370,70 2370,970"/>
</g></g></g></svg>"##;

/// The same by a floor and an exit with names, in centimetres; colours say nothing then.
pub const NAMED: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" width="2400" height="1000">
<g id="floor"><rect width="1200" height="1000"/><rect x="1220" width="1180" height="1000"/><rect x="1200" y="480" width="20" height="120"/></g>
<g class="all-exits"><line stroke="#000" x1="2350" y1="50" x2="2350" y2="950"/></g>
<rect width="2400" height="1000" fill="#ffffff"/>
<path d="M 600 100 v 800" stroke="#a00" stroke-width="30"/>
</svg>"##;

/// A DXF in millimetres, of the lines of walls: a group of a code and a value in two lines.
pub fn dxf() -> String {
    let line =
        |layer: &str, [a, b, c, d]: [i32; 4]| format!("0\nLINE\n8\n{layer}\n10\n{a}\n20\n{b}\n11\n{c}\n21\n{d}\n");
    let mut text =
        "999\ntwo rooms\n0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n".to_owned();
    text += "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nPOST\n10\n0\n20\n0\n";
    // A wall of one metre by 0.2 m, drawn from its lower left corner.
    text += "0\nLWPOLYLINE\n8\n0\n90\n4\n70\n1\n10\n0\n20\n0\n10\n1000\n20\n0\n10\n1000\n20\n200\n10\n0\n20\n200\n0\nENDBLK\n0\nENDSEC\n";
    text += "0\nSECTION\n2\nENTITIES\n";
    text += "0\nLWPOLYLINE\n8\nA-WALL\n90\n4\n70\n1\n43\n0\n10\n0\n20\n0\n10\n24000\n20\n0\n10\n24000\n20\n10000\n10\n0\n20\n10000\n";
    // Below the door a turned block, and above it lines.
    text += "0\nINSERT\n8\nA-WALL\n2\nPOST\n10\n12200\n20\n0\n41\n4.0\n42\n1.0\n50\n90\n";
    for wall in [[12000, 5200, 12000, 10000], [12200, 5200, 12200, 10000], [12000, 5200, 12200, 5200]] {
        text += &line("A-WALL", wall);
    }
    text += &line("EXITS", [23500, 500, 23500, 9500]);
    text += &line("A-DOOR", [12000, 4000, 12800, 4800]);
    text += "0\nTEXT\n8\nA-WALL\n10\n5\n20\n5\n1\nroom\n";
    text + "0\nENDSEC\n0\nEOF\n"
}

/// The floor and its exit as features.
pub const FEATURES: &str = r#"{"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"name": "hall"}, "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [12, 0], [12, 4], [12.2, 4], [12.2, 0],
  [24, 0], [24, 10], [12.2, 10], [12.2, 5.2], [12, 5.2], [12, 10], [0, 10], [0, 0]]]}},
{"type": "Feature", "properties": {"kind": "exit", "name": "south"}, "geometry": {"type": "LineString", "coordinates": [[23.5, 0.5], [23.5, 9.5]]}}]}"#;

/// One floor with a wall on it, and an exit as an area.
pub const WALLS: &str = r#"{"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"indoor": "wall"}, "geometry": {"type": "MultiPolygon", "coordinates": [
  [[[12, -1], [12.2, -1], [12.2, 4], [12, 4], [12, -1]]], [[[12, 5.2], [12.2, 5.2], [12.2, 11], [12, 11], [12, 5.2]]]]}},
{"type": "Feature", "properties": {"kind": "exit"}, "geometry": {"type": "Polygon", "coordinates": [[[23.49, 0.5], [23.51, 0.5], [23.51, 9.5], [23.49, 9.5], [23.49, 0.5]]]}},
{"type": "Feature", "properties": {"kind": "floor"}, "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [24, 0], [24, 10], [0, 10], [0, 0]]]}}]}"#;

#[test]
fn two_rooms_are_the_same_in_each_format() {
    let wanted = two_rooms();
    let moved = |text: &str, scale, by: f64| read(text, scale).expect(text).from_origin(DVec2::splat(by));
    for (what, plan) in [
        ("strokes", moved(STROKES, Some(Scale::Unit(1.0)), 0.2)),
        ("paper", moved(PAPER, Some(Scale::Paper(100.0)), 0.2)),
        ("names", moved(NAMED, Some(Scale::Unit(0.01)), 0.0)),
        ("features of walls", moved(WALLS, None, 0.0)),
    ] {
        are_same(&plan, &wanted, TOLERANCE, what);
    }
    // Lines without a width that run between pixels take one on either side, and corners are cut by half of one.
    are_same(&moved(&dxf(), None, 0.0), &wanted, 2.0 * PIXEL, "DXF");
    let exact = moved(FEATURES, None, 0.0);
    assert_eq!(exact.drawn.polygons, wanted.drawn.polygons);
    assert_eq!(exact.names(&[]), ["south"]);
    are_same(&exact, &wanted, 1e-12, "features");
    // The check itself: a door that is 0.1 m farther is another plan.
    let other = moved(&STROKES.replace("V 4.8", "V 4.7"), Some(Scale::Unit(1.0)), 0.2);
    let found = std::panic::catch_unwind(|| are_same(&other, &two_rooms(), TOLERANCE, "another"));
    assert!(found.is_err());
}

/// Finer pixels, finer walls.
#[test]
fn pixels_may_be_given() {
    let pixel = 0.005;
    let measure = motes::formats::floor_plan::Measure { scale: Some(Scale::Unit(1.0)), pixel: Some(pixel) };
    let plan = motes::formats::floor_plan::read(STROKES.as_bytes(), &measure).expect("a plan");
    are_same(&plan.from_origin(DVec2::splat(0.2)), &two_rooms(), std::f64::consts::SQRT_2 * pixel, "fine");
}

/// A scene's plan is that of the file, in each format, with its scale; its remarks are the scene's.
#[test]
fn scenes_take_each_format() {
    use motes::scene::{Options, Scene, Source};
    let folder = tempfile::tempdir().expect("a folder");
    let dxf = dxf();
    for (name, text, more) in [
        ("plan.svg", STROKES, "scale = 1\norigin = [0.2, 0.2, 0]"),
        ("paper.svg", PAPER, "scale = \"1:100\"\norigin = [0.2, 0.2, 0]"),
        ("plan.dxf", &dxf, ""),
        ("plan.json", FEATURES, ""),
    ] {
        std::fs::write(folder.path().join(name), text).expect("a file");
        let scene = format!(
            "[simulation]\ndt = 1e-3\nsteps = 10\n[box]\nsize = [30, 20, 0]\nboundary = \"open\"\n[plan]\nfile = \"{name}\"\n{more}\n[[particles]]\nshape = \"crowd\"\n\
             count = 5\nsize = [10, 8, 0]\ncenter = [6, 5, 0]\n[[force]]\nkind = \"navigate\"\n"
        );
        let load = |text: String| {
            let source = Source::Text { name: "plan.toml".to_owned(), text, folder: folder.path().to_owned() };
            Scene::load(&source, &[], &Options::default()).unwrap_or_else(|faults| panic!("{faults}"))
        };
        let scene = load(scene);
        let plan = scene.particles.floor_plan.as_ref().expect("a plan");
        assert!((plan.exits()[0].width() - 9.0).abs() < 2.1 * PIXEL, "{name}: {:?}", plan.exits());
        assert!(plan.holds(DVec2::new(12.1, 4.6)) && !plan.holds(DVec2::new(12.1, 3.9)), "{name}");
        assert_eq!(
            scene.remarks.iter().any(|remark| remark.contains("A-DOOR")),
            name == "plan.dxf",
            "{:?}",
            scene.remarks
        );
        // What is written out reads back to the same plan.
        assert_eq!(load(scene.resolved.clone()).particles.floor_plan, scene.particles.floor_plan, "{name}");
    }
}
