//! What is no plan is refused, with the place and the way out.

use motes::formats::floor_plan::{self, Measure, Scale};

use super::{fault, rooms};

#[test]
fn faults_have_their_places() {
    let unit = Some(Scale::Unit(1.0));
    let svg = rooms::STROKES;
    let json = rooms::FEATURES;
    let dxf = rooms::dxf();
    let nested = format!("<svg xmlns=\"http://www.w3.org/2000/svg\">{}{}</svg>", "<g>".repeat(300), "</g>".repeat(300));
    let deep = format!("{}{}", "{\"type\": \"GeometryCollection\", \"geometries\": [".repeat(40), "]}".repeat(40));
    let entities = format!("<!DOCTYPE svg [<!ENTITY a \"aaaaaaaa\"><!ENTITY b \"&a;&a;&a;\">]>{svg}");
    let long = format!("<!DOCTYPE svg [<!ENTITY a \"{}\">]><svg>{}</svg>", "a".repeat(100_000), "&a;".repeat(1000));
    for (text, scale, why) in [
        ("<html><body/></html>", unit, "its first element is <html>"),
        ("<svg", unit, "it is no SVG, or damaged"),
        ("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 9\"/>", unit, "its viewBox is \"0 0 9\""),
        ("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 9 9\"/>", unit, "has no exit"),
        (&nested, unit, "nested more than 200 deep in line 1"),
        (&entities, unit, "entities of entities"),
        (&long, unit, "1000 uses of 1000"),
        (
            &svg.replace("viewBox", "width=\"9\" height=\"9\" preserveAspectRatio=\"none\" viewBox"),
            unit,
            "is stretched to 9 by 9",
        ),
        (svg, Some(Scale::Unit(100.0)), "check its scale"),
        (
            &svg.replace("M 12.1 6 V 10", "M 12.1 6 V 10 M 24.1 2 V 3").replace("24.2", "23"),
            unit,
            "has no closed room beside it",
        ),
        (&svg.replace("y2=\"9.5\"", "y2=\"0.7\""), unit, "is too short for an exit"),
        ("{\"type\": \"Topology\"}", None, "of the type \"Topology\", which GeoJSON has not"),
        ("{\"a\": 1}", None, "no member \"type\""),
        ("[1, 2]", None, "no GeoJSON: that is an object"),
        (&json[..200], None, "it is no GeoJSON (EOF"),
        (&deep, None, "more than 16 deep"),
        (
            &json.replace("[0, 10], [0, 0]]", "[0, 10]]"),
            None,
            "a ring of feature 1 is not closed: it begins at 0 0 and ends at 0 10",
        ),
        (&json.replace("[24, 0]", "[24, \"a\"]"), None, "point 6 of feature 1 is [24,\"a\"]"),
        (&json.replace("[24, 0]", "[24, 0, 3]"), None, "point 6 of feature 1, at 24 0, is at the height 3"),
        (json, Some(Scale::Paper(100.0)), "this file has none"),
        (&rooms::WALLS.replace("\"kind\": \"exit\"", "\"kind\": \"floor\""), None, "add a LineString on its floor"),
        (&dxf.replace("0\nEOF\n", ""), None, "has no EOF at its end"),
        (&dxf.replace("10\n24000", "10\n24x"), None, "is \"24x\", and the code 10 before it has a number"),
        (&dxf.replace("11\n12000\n", ""), None, "has no group 11"),
        (
            &dxf.replace("2\nPOST\n10\n12200", "2\nPILLAR\n10\n12200"),
            None,
            "the block \"PILLAR\", which the file does not have",
        ),
        (
            &dxf.replace("0\nLWPOLYLINE\n8\n0\n", "0\nINSERT\n2\nPOST\n10\n0\n20\n0\n0\nLWPOLYLINE\n8\n0\n"),
            None,
            "within more than 16 others, or within itself",
        ),
        (&dxf.replace("EXITS", "WAYS"), None, "on a layer with the word exits in its name; its layers are \"A-WALL\""),
        ("0\nSECTION\nx", None, "line 3 is \"x\", and a DXF has a code there"),
        ("0\nEOF", None, "no LINE"),
        ("%PDF-1.7", None, "save its drawing as SVG"),
        ("AC1032", None, "a DWG: save it as DXF"),
        ("AutoCAD Binary DXF\r\n", None, "in ASCII"),
    ] {
        let said = fault(text, scale);
        assert!(said.contains(why), "{said}");
    }
    for (bytes, why) in
        [(&b"\x1f\x8b\x08"[..], "unpack it"), (b"<svg>\xff</svg>", "byte 5 is no UTF-8"), (b"\xff\xfe<", "UTF-16")]
    {
        let said = floor_plan::read(bytes, &Measure::default()).expect_err("no plan");
        assert!(said.contains(why), "{said}");
    }
    let wkt = include_bytes!("../../../scenes/two_rooms.wkt");
    let said = floor_plan::read(wkt, &Measure { pixel: Some(0.1), scale: None }).expect_err("no pixels");
    assert!(said.contains("a pixel of 0.1 m is given, and well-known text has no pixels"), "{said}");
    let half = floor_plan::read(wkt, &Measure { pixel: None, scale: Some(Scale::Unit(0.5)) }).expect("a plan");
    assert!((half.drawn.exits[0].path[0].x - 11.75).abs() < 1e-12);
}
