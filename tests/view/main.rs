//! The viewer, by hand: events as a window gives them, and what they do to the run and to its picture.

mod contact;
mod hand;
mod panel;
mod play;
#[path = "../support/small.rs"]
mod small;
mod window;

use std::process::Command;

use egui::{Key, Modifiers, PointerButton, Pos2, Vec2};
use glam::Vec3;
use hand::Hand;
use motes::settings::Value;

const BIN: &str = env!("CARGO_BIN_EXE_motes");

/// Lit pixels of part of a picture, as a fraction of it: those that are brighter than the night.
fn lit(rgba: &[u8], width: usize, columns: std::ops::Range<usize>) -> f64 {
    let rows = rgba.chunks_exact(4 * width);
    let pixels: Vec<bool> = rows
        .flat_map(|row| row.chunks_exact(4).skip(columns.start).take(columns.len()))
        .map(|pixel| pixel[..3].iter().any(|part| *part > 60))
        .collect();
    pixels.iter().filter(|lit| **lit).count() as f64 / pixels.len() as f64
}

/// The mean distance of lit pixels from the middle column.
fn spread(rgba: &[u8], width: usize) -> f64 {
    let pixels = rgba.chunks_exact(4).enumerate().filter(|(_, pixel)| pixel[..3].iter().any(|part| *part > 60));
    let places: Vec<f64> = pixels.map(|(place, _)| ((place % width) as f64 - 0.5 * width as f64).abs()).collect();
    places.iter().sum::<f64>() / places.len() as f64
}

#[test]
fn frames_without_a_window_show_the_run_and_the_panel() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("view.png");
    let run = Command::new(BIN)
        .args(["view", "galaxy", "--scale", "0.05", "--frames", "3", "--size", "900x500", "--screenshot"])
        .arg(&file)
        .output()
        .expect("the program");
    let said = String::from_utf8_lossy(&run.stdout).into_owned();
    assert!(run.status.success(), "{said}{}", String::from_utf8_lossy(&run.stderr));
    assert!(said.starts_with("3 frames, 3 steps"), "{said}");
    let decoder = png::Decoder::new(std::io::BufReader::new(std::fs::File::open(&file).expect("a picture")));
    let mut reader = decoder.read_info().expect("a PNG");
    let mut rgb = vec![0; reader.output_buffer_size().expect("a size")];
    let info = reader.next_frame(&mut rgb).expect("pixels");
    assert_eq!((info.width, info.height), (960, 500), "the width is rounded up to whole rows of a copy");
    let rgba: Vec<u8> = rgb.chunks_exact(3).flat_map(|p| [p[0], p[1], p[2], 255]).collect();
    let (scene, panel) = (lit(&rgba, 960, 0..600), lit(&rgba, 960, 700..960));
    assert!(scene > 0.02, "the galaxy is not there: {scene}");
    assert!((0.02..0.9).contains(&panel), "the panel is not there: {panel}");
}

/// What was dropped on a window can be given to a command, and acts there: a law, or particles in the place of those of the scene.
#[test]
fn files_are_put_beside_a_scene() {
    let folder = tempfile::tempdir().expect("a folder");
    let [law, bodies, file] = ["pull.wgsl", "bodies.csv", "view.png"].map(|name| folder.path().join(name));
    let text = "// A spring to the middle.\nstruct Params { k: f32 }\n@group(3) @binding(0) var<uniform> params: Params;\n\
                fn force(me: Particle) -> vec4f { return vec4f(-params.k * me.position, 0.0); }\n";
    std::fs::write(&law, text).expect("a law");
    std::fs::write(&bodies, "x,y,z,mass\n1,0,0,1\n-1,0,0,1\n0,1,0,1\n").expect("bodies");
    let view = |more: &[&str]| {
        let mut run = Command::new(BIN);
        run.args(["view", "plummer", "--frames", "2", "--size", "640x400", "--screenshot"]).arg(&file).args(more);
        let run = run.output().expect("the program");
        (run.status.code(), String::from_utf8_lossy(&[run.stdout, run.stderr].concat()).into_owned())
    };
    let [law, bodies] = [&law, &bodies].map(|path| path.to_str().expect("a path"));
    let few = ["--set", "particles.0.count=100"];
    let (code, said) = view(&[&["--beside", law][..], &few, &["--set", "force.1.params.k=2"]].concat());
    assert_eq!(code, Some(0), "{said}");
    let (code, said) = view(&[&["--beside", law][..], &few, &["--set", "force.2.params.k=2"]].concat());
    assert_eq!(code, Some(3), "there are two forces: {said}");
    let (code, said) = view(&["--beside", bodies, "--beside", law, "--set", "force.1.params.k=2"]);
    assert_eq!(code, Some(0), "{said}");
    for more in [&few[..], &["--scale", "2"]] {
        let (code, said) = view(&[&["--beside", bodies][..], more].concat());
        assert!(code == Some(3) && said.contains("leave these out"), "{said}");
    }
    let (code, said) = view(&["--beside", "nothing.csv"]);
    assert!(code == Some(4) && said.contains("nothing.csv"), "{code:?}: {said}");
}

#[test]
fn screenshots_are_png_files_by_their_names() {
    let run = Command::new(BIN).args(["view", "galaxy", "--frames", "1", "--screenshot", "a.jpg"]).output();
    let run = run.expect("the program");
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert_eq!(run.status.code(), Some(2), "{said}");
    assert!(said.contains("a name that ends in .png"), "{said}");
}

#[test]
fn a_film_has_a_picture_of_each_step() {
    let mut hand = Hand::on("plummer", &["particles.0.count=500"]);
    hand.frames(2);
    hand.key(Key::V, Modifiers::NONE);
    // The key is pressed in one frame and released in the next.
    let first = hand.steps() - 1;
    hand.until(first + 7);
    hand.key(Key::Space, Modifiers::NONE);
    let last = hand.steps();
    hand.frames(5);
    assert!(hand.message().starts_with("recording: "), "{}", hand.message());
    hand.key(Key::V, Modifiers::NONE);
    let film = hand.taken().expect("a film");
    assert_eq!(film.name, format!("plummer_{last:06}_film.png"));
    let mut reader = png::Decoder::new(std::io::Cursor::new(&film.png)).read_info().expect("a PNG");
    let animation = *reader.info().animation_control().expect("an animation");
    assert_eq!(
        u64::from(animation.num_frames),
        last - first + 1,
        "a picture of each step, and none where it stands still"
    );
    assert_eq!([reader.info().width, reader.info().height], hand.size());
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    for picture in 0..animation.num_frames {
        let info = reader.next_frame(&mut pixels).expect("a picture");
        // From the second on, what has not changed is transparent.
        let changed = pixels[..info.buffer_size()].chunks_exact(4).filter(|pixel| pixel[3] > 0).count();
        let all = info.buffer_size() / 4;
        assert!(
            if picture == 0 { changed == all } else { (1..all).contains(&changed) },
            "{picture}: {changed} of {all}"
        );
    }
    assert!(hand.taken().is_none(), "it is taken once");
    // A scene that is opened meanwhile ends a film.
    hand.key(Key::Space, Modifiers::NONE);
    hand.key(Key::V, Modifiers::NONE);
    hand.frames(2);
    assert!(hand.end().is_some_and(|film| film.png.len() > 1000));
}

#[test]
fn a_picture_and_a_film_of_one_frame_are_both_saved() {
    let mut hand = Hand::on("plummer", &["particles.0.count=100"]);
    hand.key(Key::V, Modifiers::NONE);
    hand.frames(2);
    hand.keys(&[Key::P, Key::V]);
    let names = [hand.taken(), hand.taken(), hand.taken()].map(|taken| taken.map(|taken| taken.name.len()));
    assert_eq!(names, [Some("plummer_000000.png".len()), Some("plummer_000000_film.png".len()), None]);
}

#[test]
fn keys_pause_step_and_go_back() {
    let mut hand = Hand::on("plummer", &["particles.0.count=500"]);
    hand.frames(3);
    assert_eq!(hand.steps(), 3);
    hand.key(Key::Space, Modifiers::NONE);
    hand.frames(3);
    let paused = hand.steps();
    hand.frames(2);
    assert_eq!(hand.steps(), paused, "a paused run moves");
    hand.key(Key::Period, Modifiers::NONE);
    assert_eq!(hand.steps(), paused + 1);
    hand.key(Key::Space, Modifiers::NONE);
    hand.until(20);
    let first = hand.positions();
    hand.key(Key::R, Modifiers::NONE);
    assert!(hand.steps() <= 2, "{} steps after going back", hand.steps());
    hand.until(20);
    assert_eq!(hand.positions(), first, "another run from the same start");
    // Shortcuts with Ctrl belong to others.
    let steps = hand.steps();
    hand.key(Key::R, Modifiers::CTRL);
    assert!(hand.steps() > steps);
}

/// A picture that would be the same is not drawn again, and one that would be another is: after a step, a change, and on the way to its exposure.
#[test]
fn what_stands_still_is_drawn_once() {
    let mut hand = Hand::on("plummer", &["particles.0.count=2000", "picture.style=\"glow\""]);
    // The exposure takes some twenty pictures.
    for _ in 0..30 {
        let before = hand.picture();
        hand.frames(3);
        assert!(!hand.rests() && hand.picture() != before, "it runs");
    }
    let acts: [&dyn Fn(&mut Hand); 5] = [
        &|hand| hand.key(Key::Space, Modifiers::NONE),
        &|hand| hand.key(Key::Period, Modifiers::NONE),
        &|hand| hand.choose("background", "paper"),
        &|hand| hand.key(Key::Num2, Modifiers::NONE),
        &|hand| hand.key(Key::R, Modifiers::NONE),
    ];
    for (number, act) in acts.into_iter().enumerate() {
        let before = hand.picture();
        act(&mut hand);
        hand.frames(60);
        assert!(hand.rests(), "after act {number}");
        let after = hand.picture();
        assert_ne!(before, after, "act {number} is not seen");
        hand.frames(3);
        assert_eq!(hand.picture(), after);
    }
    // A picture that is saved has its own exposure.
    hand.wheel(Pos2::new(250.0, 600.0), 600.0);
    hand.frames(60);
    assert!(hand.rests());
    let shown = hand.picture();
    hand.key(Key::P, Modifiers::NONE);
    let saved = hand.taken().expect("a picture");
    let mut reader = png::Decoder::new(std::io::Cursor::new(saved.png)).read_info().expect("a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    reader.next_frame(&mut pixels).expect("pixels");
    let channels = if pixels.len() == shown.len() { 4 } else { 3 };
    let pairs = pixels.chunks_exact(channels).zip(shown.chunks_exact(4));
    let worst = pairs.map(|(a, b)| (0..3).map(|part| a[part].abs_diff(b[part])).max()).max();
    assert!(worst.flatten().is_some_and(|worst| worst <= 2), "{worst:?} of 255 levels");
}

/// The controls of a frame come before what it does: a window that rests too soon shows nothing of it until the next input.
#[test]
fn nothing_rests_before_it_is_seen() {
    let mut hand = Hand::on("plummer", &["particles.0.count=500"]);
    hand.key(Key::Space, Modifiers::NONE);
    hand.frames(60);
    assert!(hand.rests());
    hand.keyed(&[Key::C], Modifiers::NONE, true);
    let said = hand.message().to_owned();
    assert!(said.contains("clipboard") && !hand.shows(&said), "{said}");
    assert!(!hand.rests());
    hand.frames(1);
    assert!(hand.rests());
    // What comes up is measured before it is shown, for which egui itself asks.
    hand.frames(1);
    assert!(hand.shows(&said), "{said}");
}

#[test]
fn dragging_turns_the_picture_and_the_wheel_comes_closer() {
    let mut hand = Hand::on("plummer", &["particles.0.count=500"]);
    hand.key(Key::Space, Modifiers::NONE);
    hand.frames(2);
    let (before, middle) = (hand.picture(), Pos2::new(250.0, 600.0));
    hand.frames(2);
    assert_eq!(hand.picture(), before, "nothing moves, and the picture changes");
    hand.drag(middle, Vec2::new(60.0, 20.0), PointerButton::Primary);
    let turned = hand.picture();
    assert_ne!(turned, before);
    hand.wheel(middle, 100.0);
    let closer = hand.picture();
    assert_ne!(closer, turned);
    let width = hand.size()[0] as usize;
    let [far, near] = [&turned, &closer].map(|rgba| spread(rgba, width));
    assert!(near > 1.05 * far, "closer, particles are farther from the middle: {near} after {far} pixels");
    hand.key(Key::F, Modifiers::NONE);
    assert_ne!(hand.picture(), closer);
}

/// The places of the brightest spots of a picture, in points of the window: pixels beyond it are cut off, as many at both sides.
fn spots(rgba: &[u8], width: usize, (shown, apart): (f32, f32), count: usize) -> Vec<Pos2> {
    let bright = |pixel: &[u8]| pixel[..3].iter().map(|part| u32::from(*part)).sum::<u32>();
    let mut left: Vec<(u32, Vec2)> = rgba
        .chunks_exact(4)
        .enumerate()
        .map(|(n, pixel)| (bright(pixel), Vec2::new((n % width) as f32 + 0.5, (n / width) as f32 + 0.5)))
        .filter(|(light, _)| *light > 90)
        .collect();
    let cut = 0.5 * (width as f32 - shown);
    (0..count)
        .map(|_| {
            let (_, at) = *left.iter().max_by_key(|(light, _)| *light).expect("a spot");
            left.retain(|(_, x)| (*x - at).length() > apart);
            at.to_pos2() - Vec2::new(cut, 0.0)
        })
        .collect()
}

#[test]
fn a_click_chooses_what_is_drawn_there_and_the_camera_goes_with_it() {
    let particles = ["particles.0.count=3", "particles.0.seed=4"];
    let mut hand = Hand::on("plummer", &particles);
    hand.key(Key::Space, Modifiers::NONE);
    hand.key(Key::H, Modifiers::NONE);
    hand.key(Key::F, Modifiers::NONE);
    hand.frames(4);
    let width = hand.size()[0] as usize;
    let seen = spots(&hand.picture(), width, (820.0, 60.0), 3);
    let mut found = Vec::new();
    for at in &seen {
        hand.click(*at);
        // A second click that follows at once is a double one.
        hand.frames(40);
        let (id, x) = hand.chosen().unwrap_or_else(|| panic!("nothing is chosen at {at:?} of {seen:?}"));
        let [a, b, c, _] = hand.positions()[id as usize].map(f32::from_bits);
        assert_eq!(Vec3::new(a, b, c).as_dvec3(), x, "particle {id} is elsewhere");
        found.push(id);
    }
    found.sort_unstable();
    assert_eq!(found, [0, 1, 2], "three spots are three particles");
    // The camera goes with the last one: it stays in the middle while it moves.
    let (id, start) = hand.chosen().expect("the last one");
    hand.key(Key::T, Modifiers::NONE);
    hand.key(Key::Space, Modifiers::NONE);
    hand.frames(10);
    let (still, now) = hand.chosen().expect("the same one");
    assert!(id == still && now != start, "particle {id} rests");
    let middle = Pos2::new(410.0, 600.0);
    let nearest = |hand: &mut Hand| {
        let spots = spots(&hand.picture(), width, (820.0, 20.0), 6);
        spots.iter().map(|at| (*at - middle).length()).fold(f32::INFINITY, f32::min)
    };
    // Its highlight is beside its middle, and the others are farther away.
    assert!(nearest(&mut hand) < 20.0, "it left the middle by {} points", nearest(&mut hand));
    // The panel lists its columns, and plots the one that is clicked.
    hand.key(Key::Space, Modifiers::NONE);
    hand.key(Key::H, Modifiers::NONE);
    hand.frames(20);
    let (place, below) = (hand.place("velocity"), hand.place("Picture"));
    assert!(hand.place(&format!("Particle {id}")).y < place.y && place.y < below.y);
    hand.click(place);
    hand.frames(20);
    assert!(hand.place("Picture").y > below.y + 100.0, "nothing is plotted");
    hand.key(Key::Escape, Modifiers::NONE);
    assert_eq!(hand.chosen(), None);
    // Where nothing is drawn nothing is chosen.
    hand.key(Key::H, Modifiers::NONE);
    hand.frames(3);
    let spots = spots(&hand.picture(), width, (820.0, 60.0), 3);
    let empty = [Pos2::new(20.0, 20.0), Pos2::new(790.0, 20.0), Pos2::new(20.0, 1180.0)];
    let empty =
        empty.iter().find(|at| spots.iter().all(|spot| (**at - *spot).length() > 100.0)).expect("an empty corner");
    hand.click(*empty);
    hand.frames(2);
    assert_eq!(hand.chosen(), None);
}

#[test]
fn colours_show_any_column() {
    let mut hand = Hand::on("dam_break_2d", &["force.1.spacing=0.1", "picture.style=balls"]);
    hand.until(30);
    hand.key(Key::Space, Modifiers::NONE);
    hand.frames(2);
    // In a view that is higher than wide, all of the tank is in the picture.
    let (before, width) = (hand.picture(), hand.size()[0] as usize);
    let shown = lit(&before, width, 0..width);
    assert!(shown > 0.01, "the fluid is not in the picture: {shown}");
    let place = hand.place_beside("color");
    hand.click(place);
    hand.frames(3);
    hand.frames(20);
    let place = hand.place("position");
    hand.click(place);
    hand.frames(3);
    assert_eq!(hand.message(), "");
    assert_eq!(hand.value_beside("color"), "position");
    assert!(hand.picture() != before, "the same colours");
    // The scale stays while the same is shown, whatever else changes: another background and back.
    hand.key(Key::Space, Modifiers::NONE);
    hand.until(120);
    hand.key(Key::Space, Modifiers::NONE);
    hand.frames(40);
    let before = hand.picture();
    for background in ["black", "night"] {
        hand.choose("background", background);
    }
    hand.frames(40);
    let differ = before.iter().zip(hand.picture()).filter(|(a, b)| a.abs_diff(*b) > 4).count();
    assert!(differ < before.len() / 1000, "{differ} of {} bytes are others", before.len());
    // Columns that a force computes lie elsewhere when its kernels are compiled anew.
    hand.choose("color", "density");
    let place = hand.place("fluid");
    hand.click(place);
    hand.frames(30);
    for choice in ["continuity", "summation"] {
        let shown = hand.picture();
        hand.choose("density_by", choice);
        hand.frames(3);
        assert!(hand.message().contains("compiled anew"), "{}", hand.message());
        let (kept, pixels) = (hand.picture(), shown.len());
        let differ = shown.iter().zip(&kept).filter(|(a, b)| a.abs_diff(**b) > 30).count();
        assert!(differ < pixels / 50, "{choice}: {differ} of {pixels} bytes are others");
    }
}

/// What is begun with a tool ends when another one is chosen, or when the drag goes on as one of the camera.
#[test]
fn escape_ends_what_was_begun() {
    let mut hand = Hand::on("plummer", &["particles.0.count=200"]);
    let (middle, edge) = (Pos2::new(250.0, 600.0), Pos2::new(310.0, 600.0));
    (0..3).for_each(|_| hand.key(Key::G, Modifiers::NONE));
    hand.hold_and(middle, edge, |hand| hand.key(Key::Escape, Modifiers::NONE));
    assert_eq!(hand.forces(), ["gravity"], "a ball was placed");
    hand.key(Key::G, Modifiers::NONE);
    hand.hold_and(middle, edge, |hand| {
        hand.frames(2);
        assert_ne!(hand.setting("tweezers", "depth"), Value::Number(0.0));
        hand.key(Key::Escape, Modifiers::NONE);
        assert_eq!(hand.setting("tweezers", "depth"), Value::Number(0.0), "it goes on pulling");
    });
    assert_eq!(hand.forces(), ["gravity", "tweezers"]);
}

#[test]
fn the_camera_flies_while_a_key_is_held() {
    let mut hand = Hand::on("plummer", &["particles.0.count=500"]);
    hand.key(Key::Space, Modifiers::NONE);
    hand.frames(3);
    let (before, width) = (hand.picture(), hand.size()[0] as usize);
    hand.hold_key(Key::W, 60);
    let near = hand.picture();
    let [far, closer] = [&before, &near].map(|rgba| spread(rgba, width));
    assert!(closer > 1.05 * far, "it does not come closer: {closer} after {far} pixels");
    hand.hold_key(Key::S, 20);
    hand.hold_key(Key::D, 10);
    assert!(hand.picture() != near, "the same picture");
    let steps = hand.steps();
    hand.frames(3);
    assert_eq!(hand.steps(), steps);
}
