//! `motes crowds`: the bottleneck that a report names is the one that holds pedestrians up, and a wider or another door shows it.

use std::process::Command;

use serde_json::Value;

fn motes(args: &[&str]) -> (i32, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_motes")).args(args).output().expect("the program starts");
    let text = |bytes| String::from_utf8(bytes).expect("output is UTF-8");
    (output.status.code().unwrap_or(-1), text(output.stdout), text(output.stderr))
}

/// Two rooms of 6 by 8 metres with a door from `low` to `high` between them, and an exit as wide as the second room.
fn rooms([low, high]: [f64; 2]) -> String {
    format!(
        "GEOMETRYCOLLECTION (POLYGON ((0 0, 6 0, 6 {low}, 6.2 {low}, 6.2 0, 12 0, 12 8, 6.2 8, 6.2 {high}, 6 {high}, 6 8, 0 8, 0 0)), \
         LINESTRING (11.5 0.2, 11.5 7.8))"
    )
}

/// The report on a plan with 40 pedestrians in the first room.
fn report(plan: &str, seed: u64) -> (Value, tempfile::TempDir) {
    let folder = tempfile::tempdir().expect("a folder");
    let (file, out) = (folder.path().join("plan.wkt"), folder.path().join("out"));
    std::fs::write(&file, plan).expect("a plan");
    let [file, out] = [&file, &out].map(|path| path.to_str().expect("a path of words").to_owned());
    let seed = seed.to_string();
    let args = [
        "crowds",
        &file,
        "--people",
        "40",
        "--start",
        "0,0,6,8",
        "--seed",
        &seed,
        "-o",
        &out,
        "--json",
        "--backend",
        "cpu",
    ];
    let (code, text, words) = motes(&args);
    assert_eq!(code, 0, "{words}");
    (serde_json::from_str(&text).unwrap_or_else(|why| panic!("{why}: {text}")), folder)
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// A door of 1.2 m holds 40 pedestrians up. The report names it within half a metre, and its width within a cell; what it says is lost there is what a door
/// of 6 m saves, within a quarter: the wide door shortens ways a little, and its own small jam is not counted. A door elsewhere moves the name.
#[test]
fn the_named_bottleneck_is_the_door_that_holds_pedestrians_up() {
    for seed in [1, 2] {
        let (narrow, _folder) = report(&rooms([3.0, 4.2]), seed);
        let named = narrow["bottlenecks"].as_array().expect("a list");
        assert_eq!(named.len(), 1, "{named:?}");
        let place = |one: &Value| [&one["position"][0], &one["position"][1]].map(number);
        let [x, y] = place(&named[0]);
        assert!((x - 6.1).hypot(y - 3.6) < 0.5, "{x} {y}");
        assert!((number(&named[0]["width"]) - 1.2).abs() < 0.1, "{}", named[0]);
        assert!(named[0]["held_up"].as_u64() > Some(20) && named[0]["passed"].as_u64() == Some(40), "{}", named[0]);
        // The map has all of the delay, up to the rounding of nine digits each.
        let lost = &narrow["person_seconds"];
        assert!((number(&lost["on_the_map"]) - number(&lost["lost"])).abs() < 1e-5 * number(&lost["spent"]));
        let (wide, _folder) = report(&rooms([1.0, 7.0]), seed);
        let of = |report: &Value, what: &str| number(&report["person_seconds"][what]);
        let (saved, said) = (of(&narrow, "spent") - of(&wide, "spent"), number(&named[0]["lost"]));
        assert!((saved / said - 1.0).abs() < 0.25, "saved {saved}, said {said}");
        assert!(number(&narrow["evacuation"]["last"]) > 1.5 * number(&wide["evacuation"]["last"]));
        let (moved, _folder) = report(&rooms([6.0, 7.2]), seed);
        let [x, y] = place(&moved["bottlenecks"][0]);
        assert!((x - 6.1).hypot(y - 6.6) < 0.5, "{x} {y}");
    }
}

/// An exit half a metre behind a door: the way ends there, and what is named is still the door, with its width.
#[test]
fn a_door_with_its_exit_close_behind_has_its_width() {
    let plan = "GEOMETRYCOLLECTION (POLYGON ((0 0, 8 0, 8 3.5, 8.2 3.5, 8.2 2, 10 2, 10 6, 8.2 6, 8.2 4.5, 8 4.5, 8 8, 0 8, 0 0)), \
                LINESTRING (8.8 2.1, 8.8 5.9))";
    for seed in [1, 2] {
        let (report, _folder) = report(plan, seed);
        let named = &report["bottlenecks"][0];
        let [x, y, width] = [&named["position"][0], &named["position"][1], &named["width"]].map(number);
        assert!((x - 8.1).hypot(y - 4.0) < 0.2 && (width - 1.0).abs() < 0.1, "{named}");
        assert!(named["passed"].as_u64() == Some(40) && named["flow"].is_number(), "{named}");
    }
}

/// A door into the side of a wide corridor: the way turns within the door and crosses it at a slant, and what is named is the door.
#[test]
fn a_door_into_the_side_of_a_corridor_is_named() {
    let plan = "GEOMETRYCOLLECTION (POLYGON ((0 0, 8 0, 8 3.4, 8.2 3.4, 8.2 -3, 11.2 -3, 11.2 8, 8.2 8, 8.2 4.6, 8 4.6, 8 8, 0 8, 0 0)), \
                LINESTRING (8.3 -2.5, 11.1 -2.5))";
    for seed in [1, 2] {
        let (report, _folder) = report(plan, seed);
        let named = &report["bottlenecks"][0];
        let [x, y, width] = [&named["position"][0], &named["position"][1], &named["width"]].map(number);
        assert!((x - 8.1).hypot(y - 4.0) < 0.2 && (width - 1.2).abs() < 0.1, "{named}");
        assert!(number(&named["lost"]) > 0.8 * number(&report["person_seconds"]["lost"]), "{named}");
    }
}

/// Three rooms in a row: a first door, and a second one, of these widths.
fn row([first, second]: [f64; 2]) -> String {
    let [a, b] = [4.0 - 0.5 * first, 4.0 + 0.5 * first];
    let [c, d] = [4.0 - 0.5 * second, 4.0 + 0.5 * second];
    format!(
        "GEOMETRYCOLLECTION (POLYGON ((0 0, 6 0, 6 {a}, 6.2 {a}, 6.2 0, 12 0, 12 {c}, 12.2 {c}, 12.2 0, 15 0, 15 8, 12.2 8, 12.2 {d}, 12 {d}, 12 8, 6.2 8, \
         6.2 {b}, 6 {b}, 6 8, 0 8, 0 0)), LINESTRING (14.5 0.2, 14.5 7.8))"
    )
}

/// The mean of some numbers, and its standard error.
fn mean(all: &[f64]) -> [f64; 2] {
    let count = all.len() as f64;
    let mean = all.iter().sum::<f64>() / count;
    let square = all.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (count - 1.0);
    [mean, (square / count).sqrt()]
}

/// Of a narrow and a wide door in a row the narrow one is named, be it the first or the second, within two cells, and its width within one. A metre more
/// for that door shortens the evacuation by more than a metre more for the other one: in the mean of four seeds by 3.2 standard errors of the difference,
/// which Student's t of 3 degrees of freedom passes by chance in one of forty cases; and the other one's metre changes nothing beyond these errors.
fn widening(narrow: usize) {
    let widths = |more: Option<usize>| {
        let own = |door: usize| if door == narrow { 1.2 } else { 2.6 };
        [0, 1].map(|door| own(door) + if more == Some(door) { 1.0 } else { 0.0 })
    };
    let (mut gains, mut other_gains, mut apart) = (Vec::new(), Vec::new(), Vec::new());
    for seed in 1..=4 {
        let (before, _folder) = report(&row(widths(None)), seed);
        let named = &before["bottlenecks"][0];
        let [x, y, width] = [&named["position"][0], &named["position"][1], &named["width"]].map(number);
        assert!((x - [6.1, 12.1][narrow]).hypot(y - 4.0) < 0.2 && (width - 1.2).abs() < 0.1, "{named}");
        let inside = |more| number(&report(&row(widths(more)), seed).0["person_seconds"]["spent"]) / 40.0;
        let spent = number(&before["person_seconds"]["spent"]) / 40.0;
        let (gain, other) = (spent - inside(Some(narrow)), spent - inside(Some(1 - narrow)));
        gains.push(gain);
        other_gains.push(other);
        apart.push(gain - other);
    }
    let [[gain, _], [other, scatter], [more, error]] = [mean(&gains), mean(&other_gains), mean(&apart)];
    println!("door {narrow}: gains {gains:?}, of the other {other_gains:?}");
    assert!(
        gain > 0.0 && more > 3.2 * error,
        "door {narrow}: {gain} s, the other {other} s, difference {more} ± {error} s"
    );
    assert!(other.abs() < 3.2 * scatter, "door {narrow}: the other {other} ± {scatter} s");
}

#[test]
fn widening_the_named_first_door_helps_more_than_widening_the_second() {
    widening(0);
}

#[test]
fn widening_the_named_second_door_helps_more_than_widening_the_first() {
    widening(1);
}

/// Where nothing is narrow no bottleneck is named.
#[test]
fn an_open_hall_has_no_bottleneck() {
    let hall = "GEOMETRYCOLLECTION (POLYGON ((0 0, 12 0, 12 8, 0 8, 0 0)), LINESTRING (11.5 0.2, 11.5 7.8))";
    for seed in [1, 2] {
        let (report, _folder) = report(hall, seed);
        assert_eq!(report["bottlenecks"], serde_json::json!([]), "seed {seed}");
        let lost = &report["person_seconds"];
        assert!(number(&lost["lost"]) < 0.25 * number(&lost["spent"]), "{lost}");
    }
}

/// The scene in the folder makes the same run: the last has left at its end, and not a sample before. Two reports of the same plan are the same bytes.
#[test]
fn the_scene_of_a_report_makes_the_same_run() {
    let (first, folder) = report(&rooms([3.0, 4.2]), 3);
    let (again, other) = report(&rooms([3.0, 4.2]), 3);
    assert_eq!(first, again);
    let file =
        |folder: &tempfile::TempDir, name: &str| std::fs::read(folder.path().join("out").join(name)).expect("a file");
    for name in [
        "report.json",
        "report.md",
        "scene.toml",
        "trajectories.csv",
        "delay.svg",
        "density.svg",
        "tracks.svg",
        "left.svg",
    ] {
        assert_eq!(file(&folder, name), file(&other, name), "{name}");
    }
    let path = |name: &str| folder.path().join(name).to_str().expect("a path of words").to_owned();
    let (code, _, words) = motes(&["run", &path("out/scene.toml"), "-o", &path("run"), "--backend", "cpu", "--quiet"]);
    assert_eq!(code, 0, "{words}");
    let table = std::fs::read_to_string(path("run/population.csv")).expect("a table");
    let active = |line: &str| line.split(',').nth(3).and_then(|cell| cell.parse::<f64>().ok());
    let inside: Vec<f64> = table.lines().skip(1).filter_map(active).collect();
    let out: usize = first["exits"][0]["count"].as_u64().and_then(|n| usize::try_from(n).ok()).expect("a count");
    let [first, before, last] = [inside[0], inside[inside.len() - 2], inside[inside.len() - 1]];
    assert!(out == 40 && first > 39.5 && before > 0.5 && last < 0.5, "{inside:?}");
}

/// What cannot be is refused with the place, and a limit of time is said with those that are left.
#[test]
fn faults_of_plans_and_limits_are_said() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("a path of words").to_owned();
    let refused = |plan: &str, more: &[&str], code: i32, why: &str| {
        std::fs::write(path("plan.wkt"), plan).expect("a plan");
        let (plan, out) = (path("plan.wkt"), path("out"));
        let args = [&["crowds", &plan, "-o", &out, "--backend", "cpu", "--overwrite"], more].concat();
        let (got, _, words) = motes(&args);
        assert!(got == code && words.contains(why), "{got}: {words}");
    };
    let square = "POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0))";
    refused(square, &[], 4, "no exit");
    refused("POLYGON ((0 0, 9 0, 9 9))", &[], 4, "not closed");
    let plan = |exit: &str| format!("GEOMETRYCOLLECTION ({square}, LINESTRING ({exit}))");
    refused(&plan("12 1, 12 3"), &[], 4, "not on the floor at 12 2");
    refused(&plan("8 1, 8 3"), &["--people", "5000"], 3, "have no room");
    refused(&plan("8 1, 8 3"), &["--start", "20,20,30,30"], 3, "have no room");
    refused(&plan("8 1, 8 3"), &["--exits", "a,b"], 4, "has 2 names, and the plan has 1");
    refused(&plan("8 1, 8 3"), &["--start", "1,2,3"], 2, "two corners");
    refused(&plan("8 1, 8 3"), &["--speed", "1e5"], 3, "choose a lower --speed");
    // A wall right behind an exit pushes pedestrians back.
    std::fs::write(path("plan.wkt"), plan("8.9 1, 8.9 3")).expect("a plan");
    let near = ["crowds", &path("plan.wkt"), "-o", &path("near"), "--backend", "cpu", "--people", "2", "--limit", "1"];
    let (code, _, words) = motes(&near);
    let wall = "has a wall 0.10 m from its middle, at 8.90 2.00";
    assert!(code == 0 && words.contains(wall), "{words}");
    // The report keeps it, also where the terminal has only numbers.
    let page = std::fs::read_to_string(path("near/report.md")).expect("a report");
    let values = std::fs::read_to_string(path("near/report.json")).expect("a report");
    let (code, text, _) = motes(&[&near[..], &["--overwrite", "--json"]].concat());
    assert!(code == 0 && [&page, &values, &text].iter().all(|all| all.contains("has a wall 0.10 m")), "{page}{text}");
    std::fs::write(path("plan.wkt"), plan("8 1, 8 3")).expect("a plan");
    let args = ["crowds", &path("plan.wkt"), "-o", &path("short"), "--backend", "cpu", "--people", "5", "--limit", "1"];
    let (code, text, words) = motes(&args);
    assert!(
        code == 0 && text.contains("are still inside: the limit of time was reached; they are at"),
        "{text}{words}"
    );
    let (code, _, words) = motes(&args);
    assert!(code == 8 && words.contains("an earlier run"), "{words}");
}

/// A picture of two rooms, five hundredths of a metre to a pixel: the left one has a door of 1.2 m, the exit is the right wall's opening.
fn picture() -> Vec<u8> {
    let (width, height) = (250_u32, 170_u32);
    let color = |n: u32| -> [u8; 3] {
        let (x, y) = (n % width, n / width);
        let within = (5..245).contains(&x) && (5..165).contains(&y);
        match within {
            true if (235..239).contains(&x) && (9..161).contains(&y) => [220, 30, 30],
            // From 3.0 to 4.2 m above the floor's lower side, which is row 165.
            true if (125..129).contains(&x) && !(81..105).contains(&y) => [40, 40, 40],
            true => [250, 250, 245],
            false => [20, 20, 30],
        }
    };
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&(0..width * height).flat_map(color).collect::<Vec<u8>>()).expect("pixels");
    writer.finish().expect("an end");
    bytes
}

/// A plan as a picture: its door is named in metres from the lower left corner, with its width to a pixel.
#[test]
fn a_picture_is_a_plan() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_str().expect("a path of words").to_owned();
    std::fs::write(path("plan.png"), picture()).expect("a picture");
    let (plan, out) = (path("plan.png"), path("out"));
    let args =
        ["crowds", &plan, "-o", &out, "--backend", "cpu", "--json", "--people", "40", "--start", "0.3,0.3,6,8.2"];
    let (code, _, words) = motes(&args);
    assert!(code == 4 && words.contains("--pixel 0.02"), "{code}: {words}");
    let (code, text, words) = motes(&[&args[..], &["--pixel", "0.05"]].concat());
    assert_eq!(code, 0, "{words}");
    let report: Value = serde_json::from_str(&text).expect("JSON");
    let named = &report["bottlenecks"][0];
    let [x, y] = [&named["position"][0], &named["position"][1]].map(number);
    assert!((x - 6.35).hypot(y - 3.85) < 0.5, "{named}");
    assert!((number(&named["width"]) - 1.2).abs() < 0.1, "{named}");
    assert_eq!(report["exits"][0]["count"].as_u64(), Some(40));
}
