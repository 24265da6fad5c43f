//! GeoJSON: degrees, properties and what is no plan.

use glam::DVec2;
use motes::formats::floor_plan::Scale;

use super::{are_same, read, rooms, two_rooms};

/// Makes degrees of all points.
fn turn(value: &mut serde_json::Value) {
    match value {
        serde_json::Value::Array(pair) if pair.len() == 2 && pair.iter().all(serde_json::Value::is_number) => {
            let [x, y] = [0, 1].map(|k| pair[k].as_f64().expect("a number"));
            let at = DVec2::new(13.37 + x / 67_910.22, 52.5 + y / 111_276.83);
            *value = serde_json::json!([at.x, at.y]);
        }
        serde_json::Value::Array(all) => all.iter_mut().for_each(turn),
        serde_json::Value::Object(all) => all.values_mut().for_each(turn),
        _ => {}
    }
}

/// The two rooms in Berlin, in degrees, by the lengths of a degree at 52.5° on WGS 84 (from the usual series: 111 276.8 m along the meridian, 67 910.2 m along the
/// parallel).
#[test]
fn degrees_become_metres() {
    let mut value: serde_json::Value = serde_json::from_str(rooms::FEATURES).expect("JSON");
    turn(&mut value);
    let plan = read(&value.to_string(), None).expect("a plan");
    // Both lengths are known to a tenth of a metre in 60 000: 0.04 mm of 24 m.
    are_same(&plan, &two_rooms(), 2e-4, "degrees");
    assert!(
        plan.remarks.iter().any(|remark| remark.contains("longitudes and latitudes") && remark.contains("13.37 52.5")),
        "{:?}",
        plan.remarks
    );
    // As metres the same numbers are a plan of a third of a millimetre.
    let metres = read(&value.to_string(), Some(Scale::Unit(1.0))).expect("numbers");
    assert!((metres.drawn.exits[0].path[0].x - 13.37).abs() < 1e-3 && metres.remarks.is_empty());
}

#[test]
fn features_are_what_their_properties_say() {
    let wrong = rooms::FEATURES.replace("\"kind\": \"exit\"", "\"kind\": \"floor\"");
    let said = read(&wrong, None).expect_err("a line");
    assert!(said.contains("feature 2 is a line that is to be floor"), "{said}");
    // A line is an exit also without a property; a single geometry is a plan, too; points are said.
    let bare = rooms::FEATURES.replace("\"kind\": \"exit\", \"name\": \"south\"", "");
    assert_eq!(read(&bare, None).expect("a plan").names(&[]), ["exit 1"]);
    let point = rooms::FEATURES.replace(
        "\"features\": [",
        "\"features\": [{\"type\": \"Feature\", \"geometry\": {\"type\": \"Point\", \"coordinates\": [1, 2]}},",
    );
    assert!(read(&point, None).expect("a plan").remarks[0].contains("1 features are points"));
    let one = r#"{"type": "GeometryCollection", "geometries": [{"type": "Polygon", "coordinates": [[[0, 0], [9, 0], [9, 9], [0, 0]]]},
        {"type": "LineString", "coordinates": [[8, 1], [8, 2]]}]}"#;
    let one = read(one, Some(Scale::Unit(0.5))).expect("a plan");
    assert_eq!(
        (one.drawn.polygons[0].outline[1], one.drawn.exits[0].path[1]),
        (DVec2::new(4.5, 0.0), DVec2::new(4.0, 1.0))
    );
}
