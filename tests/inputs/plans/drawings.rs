//! What of a drawing is a wall, an exit or none, and what is said of it.

use glam::DVec2;
use motes::formats::floor_plan::{Plan, Scale};

use super::{are_same, fault, read, rooms, usable};

const METRES: Option<Scale> = Some(Scale::Unit(1.0));

/// A room of 8 by 6 m with walls of 0.2 m, whose door of 1 m, in the middle of the right wall, is the exit; with more shapes.
fn room(more: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" viewBox=\"0 0 10 8\">\n\
         <path d=\"M 8.9 3.5 V 1 H 1 V 7 H 8.9 V 4.5\" fill=\"none\" stroke=\"#000\" stroke-width=\"0.2\"/>\n\
         <line x1=\"8.9\" y1=\"3.5\" x2=\"8.9\" y2=\"4.5\" stroke=\"#0a0\" stroke-width=\"0.1\"/>\n{more}\n</svg>"
    )
}

#[track_caller]
fn drawn(more: &str) -> Plan {
    read(&room(more), METRES).expect(more)
}

#[track_caller]
fn holds(plan: &Plan, x: f64, y: f64) -> bool {
    usable(plan, "a room").holds(DVec2::new(x, y))
}

/// Outside of the door the floor goes on, and nothing else is.
#[test]
fn a_door_to_the_outside_has_a_landing() {
    let plan = drawn("");
    assert!(plan.remarks.is_empty(), "{:?}", plan.remarks);
    assert!(plan.landings.len() == 1 && plan.landings[0].outward.normalize().x > 0.99, "{:?}", plan.landings);
    assert!(holds(&plan, 9.5, 4.0) && !holds(&plan, 0.5, 4.0) && holds(&plan, 5.0, 4.0));
}

/// Each of these covers the place 5 4 with a wall, or not.
#[test]
fn paint_and_names_decide_what_is_a_wall() {
    let square = |attributes: &str| format!("<rect x=\"4.5\" y=\"3.5\" width=\"1\" height=\"1\" {attributes}/>");
    for (more, is_floor) in [
        (square(""), false),
        (square("fill=\"#ddd\""), true),
        (square("fill=\"none\""), true),
        (square("fill-opacity=\"0.9\""), false),
        (square("opacity=\"0.2\""), true),
        (format!("<g opacity=\"0.5\">{}</g>", square("opacity=\"0.4\"")), true),
        (square("display=\"none\""), true),
        (square("style=\"fill:white\""), true),
        (square("transform=\"translate(2 0)\""), true),
        (square("transform=\"rotate(45 5 4)\""), false),
        (format!("<defs>{}</defs>", square("")), true),
        (format!("<defs>{}</defs><use href=\"#it\"/>", square("id=\"it\"")), false),
        (format!("<svg x=\"2\" viewBox=\"0 0 10 8\" width=\"10\" height=\"8\">{}</svg>", square("")), true),
        (
            format!(
                "<clipPath id=\"c\"><rect width=\"3\" height=\"3\"/></clipPath><g clip-path=\"url(#c)\">{}</g>",
                square("")
            ),
            true,
        ),
        (
            format!(
                "<clipPath id=\"c\"><rect width=\"9\" height=\"9\"/></clipPath><g clip-path=\"url(#c)\">{}</g>",
                square("")
            ),
            false,
        ),
        (
            format!(
                "<linearGradient id=\"g\"><stop stop-color=\"#111\"/><stop offset=\"1\" stop-color=\"#333\"/></linearGradient>{}",
                square("fill=\"url(#g)\"")
            ),
            false,
        ),
        (format!("<g id=\"furniture\">{}</g>", square("")), true),
        (format!("<g id=\"L1\" inkscape:label=\"Doors\">{}</g>", square("")), true),
        (format!("<g class=\"doors\">{}</g>", square("id=\"wall-7\"")), false),
        ("<path d=\"M 4 4 C 4.5 2 5.5 6 6 4\" fill=\"none\" stroke=\"black\" stroke-width=\"0.3\"/>".to_owned(), false),
        ("<path d=\"M 4 4 H 6\" stroke=\"black\" stroke-width=\"0.3\" stroke-dasharray=\"0.5 1\"/>".to_owned(), true),
        ("<text x=\"5\" y=\"4\">wall</text>".to_owned(), true),
    ] {
        // Where a shape is named a wall, others are none: the room is then to be named, too.
        let text = if more.contains("wall-7") {
            room(&more).replace("<path d=\"M 8.9", "<path class=\"wall\" d=\"M 8.9")
        } else {
            room(&more)
        };
        let plan = read(&text, METRES).expect(&text);
        assert_eq!(holds(&plan, 5.0, 4.0), is_floor, "{more}");
    }
}

/// What is not drawn is counted.
#[test]
fn what_is_left_out_is_said() {
    let said = |more: &str| drawn(more).remarks.join("; ");
    let text = said(
        "<text x=\"1\" y=\"1\">room <tspan>1</tspan></text><text>2</text><image href=\"/etc/passwd\" width=\"3\" height=\"3\"/><bench/>",
    );
    assert!(text.contains("left out of the drawing: 1 <bench>, 1 <image>, 2 <text>"), "{text}");
    let pattern = said(
        "<pattern id=\"p\" width=\"1\" height=\"1\"><rect width=\"1\" height=\"1\"/></pattern><rect width=\"1\" height=\"1\" fill=\"url(#p)\"/>",
    );
    assert!(pattern.contains("1 fills with patterns"), "{pattern}");
    let furniture = said(
        "<g id=\"furniture\"><rect x=\"4\" y=\"4\" width=\"1\" height=\"1\"/><rect x=\"6\" y=\"4\" width=\"1\" height=\"1\"/></g>",
    );
    assert!(furniture.contains("2 shapes named doors, furniture or text"), "{furniture}");
    let walls = room("<rect x=\"4\" y=\"4\" width=\"1\" height=\"1\"/>").replace("<path d", "<path class=\"walls\" d");
    let walls = read(&walls, METRES).expect("a plan").remarks.join("; ");
    assert!(walls.contains("1 dark shapes not named walls"), "{walls}");
    let unseen = said(
        "<g id=\"exits\"><line x1=\"8.9\" y1=\"3.5\" x2=\"8.9\" y2=\"4.5\" stroke=\"#0a0\"/>\n<path d=\"M 1 1 h 2\"/></g>",
    );
    assert!(unseen.contains("1 shapes named exits draw nothing, the first in line 5"), "{unseen}");
    let closed =
        said("<rect x=\"2\" y=\"2\" width=\"2\" height=\"2\" fill=\"none\" stroke=\"#000\" stroke-width=\"0.1\"/>");
    assert!(closed.contains("the closed room at") && closed.contains("of 3.6 m²"), "{closed}");
    // The inside of a wall that is drawn by its sides is none.
    let sides = said(
        "<rect x=\"2\" y=\"2\" width=\"0.4\" height=\"3.9\" fill=\"none\" stroke=\"#000\" stroke-width=\"0.02\"/>",
    );
    assert!(sides.is_empty(), "{sides}");
}

/// Exits are in the order of the file, with the names that it has.
#[test]
fn exits_have_names_and_an_order() {
    let more = "<g id=\"exits\"><path d=\"M 3 6.5 h 1\" stroke=\"black\" stroke-width=\"0.1\"><title>the hatch</title></path>\
                <path id=\"exit_b\" d=\"M 3 2 h 1\" stroke=\"red\" stroke-width=\"0.1\"/><path inkscape:label=\"Exit to the yard\" d=\"M 6 2 h 1\" stroke=\"red\"/></g>";
    let plan = read(&room(more).replace("<line", "<line id=\"exit-1\""), METRES).expect(more);
    assert_eq!(plan.names(&[]), ["exit 1", "the hatch", "exit_b", "Exit to the yard"].map(str::to_owned));
    assert!(plan.drawn.exits[1].path[0].y < 2.0 && plan.drawn.exits[2].path[0].y > 5.0, "{:?}", plan.drawn.exits);
    assert_eq!(plan.names(&["a", "b", "c", "d"].map(str::to_owned)), ["a", "b", "c", "d"]);
}

/// A hairline is a wall, and no way leads across it.
#[test]
fn hairlines_are_walls() {
    for width in ["0.001", "0"] {
        let line = format!("<path d=\"M 4.013 0.9 L 5.37 7.1\" stroke=\"#000\" stroke-width=\"{width}\"/>");
        let plan = drawn(&line);
        // A stroke of no width is none.
        assert_eq!(
            plan.remarks.iter().any(|remark| remark.contains("closed room")),
            width != "0",
            "{:?}",
            plan.remarks
        );
    }
}

/// Sizes: in length, on paper, in units, and by what the drawing itself says.
#[test]
fn scales_are_those_of_the_drawing_or_given() {
    let sized = |size: &str| room("").replace("viewBox", &format!("{size} viewBox"));
    let exit = |text: &str, scale: Option<Scale>| {
        let plan = read(text, scale).expect(text);
        (plan.drawn.exits[0].path[0].x, plan.remarks.join("; "))
    };
    let parsed = |text: &str| Some(text.parse::<Scale>().expect(text));
    for (size, scale) in [
        ("", parsed("1")),
        ("width=\"1000px\" height=\"800px\"", parsed("1")),
        ("width=\"100mm\" height=\"80mm\"", parsed("1:100")),
        ("width=\"10cm\" height=\"8cm\"", parsed("2 : 200")),
        ("width=\"10in\" height=\"8in\"", Some(Scale::Paper(1.0 / 0.0254))),
        ("width=\"10000mm\" height=\"8000mm\"", None),
    ] {
        let (x, said) = exit(&sized(size), scale);
        assert!((x - 8.9).abs() < 0.02, "{size}: {x}");
        assert_eq!(said.contains("full size, 10.00 by 8.00 m"), scale.is_none(), "{said}");
    }
    let none = fault(&sized(""), None);
    assert!(none.contains("10 by 8 units") && none.contains("--scale 0.01") && none.contains("scale = 0.01"), "{none}");
    let paper = fault(&sized("width=\"100mm\" height=\"80mm\""), None);
    assert!(
        paper.contains("100 by 80 mm") && paper.contains("--scale 1:100") && paper.contains("10.0 by 8.0 m"),
        "{paper}"
    );
    for bad in ["0", "-1", "1:0", "one", "1:2:3", "inf", "1e99"] {
        assert!(bad.parse::<Scale>().is_err_and(|why| why.contains("1:100")), "{bad}");
    }
}

/// Arcs of a DXF, by a bulge, as an ARC and as a CIRCLE, are on the circle within two millimetres and a pixel.
#[test]
fn arcs_of_a_dxf_are_round() {
    let head = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n6\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
    let exit = "0\nLINE\n8\nexits\n10\n-1\n20\n0\n11\n1\n21\n0\n0\nENDSEC\n0\nEOF\n";
    let half = |start: i32, end: i32| format!("0\nARC\n8\nwalls\n10\n0\n20\n0\n40\n5\n50\n{start}\n51\n{end}\n");
    for (what, walls) in [
        ("a circle", "0\nCIRCLE\n8\nwalls\n10\n0\n20\n0\n40\n5\n".to_owned()),
        ("arcs", half(300, 30) + &half(30, 300)),
        ("a polyline", "0\nLWPOLYLINE\n8\nwalls\n70\n1\n10\n5\n20\n0\n42\n1\n10\n-5\n20\n0\n42\n1\n".to_owned()),
        ("bulges", "0\nLWPOLYLINE\n8\nwalls\n70\n1\n10\n5\n20\n0\n42\n0.41421356237\n10\n0\n20\n5\n42\n0.41421356237\n10\n-5\n20\n0\n42\n1\n".to_owned()),
        (
            "vertices",
            "0\nPOLYLINE\n8\nwalls\n70\n1\n0\nVERTEX\n8\nwalls\n10\n5\n20\n0\n42\n-1\n0\nVERTEX\n8\nwalls\n10\n-5\n20\n0\n42\n-1\n0\nSEQEND\n".to_owned(),
        ),
        ("an ellipse", "0\nELLIPSE\n8\nwalls\n10\n0\n20\n0\n11\n0\n21\n5\n40\n1\n".to_owned()),
        ("seen from below", "0\nCIRCLE\n8\nwalls\n10\n-0\n20\n0\n40\n5\n230\n-1\n".to_owned()),
    ] {
        let plan = read(&format!("{head}{walls}{exit}"), None).expect(what);
        for x in plan.drawn.polygons.iter().flat_map(|one| &one.outline) {
            assert!((x.length() - 4.99).abs() < 0.03, "{what}: {x}");
        }
    }
}

/// Layers that are off, or on paper, and those of doors are none; units are given or in the file.
#[test]
fn layers_and_units_of_a_dxf() {
    let two = rooms::dxf();
    let plan = read(&two, None).expect("a plan");
    let said = plan.remarks.join("; ");
    assert!(
        said.contains("no lines are left out: \"TEXT\" (1)")
            && said.contains("doors, furniture and text are left out: \"A-DOOR\" (1)"),
        "{said}"
    );
    let metres = two.replace("$INSUNITS\n70\n4", "$INSUNITS\n70\n6");
    let given = read(&metres, Some(Scale::Unit(0.001))).expect("a plan");
    are_same(&given, &plan, 1e-9, "a unit that is given");
    let none = fault(&two.replace("$INSUNITS\n70\n4", "$INSUNITS\n70\n0"), None);
    assert!(none.contains("24000 by 10000 units") && none.contains("--scale 0.001"), "{none}");
    // Lines of any layer are walls where none is named so, and others are said where one is.
    let all = read(&two.replace("A-WALL", "LINES"), None).expect("a plan");
    are_same(&all, &plan, 1e-9, "all lines");
    assert!(all.remarks.join("; ").contains("no layer has the word walls"), "{:?}", all.remarks);
    let off = "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n0\nLAYER\n2\nEXITS\n70\n0\n62\n-3\n0\nENDTAB\n0\nENDSEC\n0\nSECTION\n2\nBLOCKS";
    let off = fault(&two.replace("0\nSECTION\n2\nBLOCKS", off), None);
    assert!(off.contains("no exit") && off.contains("\"A-WALL\" (5)"), "{off}");
}
